"""Blocks whose steps end elsewhere than their geometry: the cost of the count axis, from a stepped run."""

from dataclasses import dataclass, fields, replace

import numpy as np

from controller.stepping.point_by_point import interpolate, words_of
from controller.stepping.steps import Steps
from parser.controller_words import Axis, StepWords
from parser.dialect.reader import at_block
from parser.findings.findings import (
    DoubtfulEnd,
    Finding,
    PrintedElsewhere,
    WrongBlock,
    telling,
)
from parser.geometry.curves import Bools, Floats, Ints
from parser.program import Program
from parser.step_words.words import counted_way
from parser.text.source import Field
from parser.toolpath import Toolpath

STEPPED_END_UM = 12.0
"""40,000 random arcs of 10 µm to 1 m radius, on the right count axis, ended at most 9.5 µm from their exact end when
stepped, half of them within 1.0 µm and 95 % within 3.7 µm; the worst found, on purpose, was 9.94 µm off."""
COST_UM = 2.0
"""A wrong count axis that costs less than the machine's own resolution of 1 µm a side is not named."""
_EITHER_AXIS_UM = 5.0  # so near 45° rounding decides which axis the rule names, and both end well


@dataclass(frozen=True, slots=True)
class WrongAxis(WrongBlock):
    """The block does not count on the axis that the rule names, `ruled`; on that axis its J would be `count_um`."""

    ruled: Axis
    count_um: int


def stepped_end_findings(program: Program, steps: Steps) -> list[Finding]:
    """Wrong count axes with their cost (3B204), and other blocks that miss their exact end (3B303).

    Where J itself is in doubt, no axis is named, unless J is the length of the line on the ruled one.
    """
    toolpath, words = program.toolpath, words_of(program.toolpath)
    off = stepped_miss(toolpath, steps)
    turns = np.maximum(np.abs(toolpath.sweep_rad) / (2.0 * np.pi), 1.0)
    ruled = ruled_count_axis(toolpath)
    doubtful = _doubtful_counts(program)
    swapped = ~toolpath.is_arc & (words.count_um == np.where(ruled == Axis.X, words.x_um, words.y_um))
    is_wrong = (words.count_axis != ruled) & (off > COST_UM) & ~_near_either(toolpath)
    wrong = np.flatnonzero(is_wrong & (~doubtful | swapped))
    right = _miss_on(toolpath, wrong, ruled[wrong])
    counts = np.where(swapped[wrong], words.count_um[wrong], count_on(toolpath, wrong, ruled[wrong]))
    costly = right < off[wrong] - 1.0
    found = [
        at_block(
            toolpath,
            program.lines,
            "3B204",
            row,
            Field.AXIS,
            axis=Axis(int(words.count_axis[row])).name,
            ruled=Axis(int(ruled[row])).name,
            cost=float(off[row]),
            right=float(best),
            count=count,
        ).with_fact(WrongAxis(Axis(int(ruled[row])), count))
        for row, best, count in zip(*(c[costly].tolist() for c in (wrong, right, counts)), strict=True)
    ]
    limits = STEPPED_END_UM * turns
    missed = off > limits
    missed[wrong[costly]] = False
    missed[doubtful] = False
    return found + [
        at_block(toolpath, program.lines, "3B303", row, miss=float(off[row]), limit=float(limits[row])).with_fact(
            WrongBlock()
        )
        for row in np.flatnonzero(missed).tolist()
    ]


def _doubtful_counts(program: Program) -> Bools:
    """(n,) True on blocks of which the words do not fit each other; a printed end is looked at by itself."""
    doubtful = np.zeros(len(program.toolpath), dtype=np.bool_)
    facts = telling(program.findings, DoubtfulEnd)
    doubtful[[found.block - 1 for found, fact in facts if not isinstance(fact, PrintedElsewhere)]] = True
    return doubtful


def stepped_miss(toolpath: Toolpath, steps: Steps) -> Floats:
    """Distance (n,) µm of each block's stepped end from its exact end, both from where the block begins."""
    miss = np.diff(steps.corner_um, axis=0) - (toolpath.end_um - toolpath.start_um)
    return np.hypot(miss[:, 0], miss[:, 1])


def ruled_count_axis(toolpath: Toolpath) -> Ints:
    """Axis (n,) that the trade's rule counts on (docs/3b.md §1): arcs by their end, lines by their longer side.

    Near an extreme of the counted axis one count is a long way along the path; the rule keeps the end away from it.
    """
    end = _extents(toolpath)
    on_y = np.where(toolpath.is_arc, end[:, 0] > end[:, 1], end[:, 1] > end[:, 0])
    return np.where(on_y, np.int64(Axis.Y), np.int64(Axis.X))


def count_on(toolpath: Toolpath, row: Ints, axis: Ints) -> Ints:
    """Count lengths (m,) in whole µm that end the blocks `row` (m,) where they end, counted on `axis` (m,).

    Of a line it is the side on that axis, of an arc the way there and back between its extremes.
    """
    side = np.abs(toolpath.end_um[row] - toolpath.start_um[row])
    of_line = np.where(axis == Axis.X, side[:, 0], side[:, 1])
    # On X an arc counts |d cos|, on Y |d sin|, which is the same a quarter turn on.
    shift = np.where(axis == Axis.X, 0.0, -np.pi / 2.0)
    low = toolpath.start_angle_rad[row] + shift
    way = np.abs(counted_way(low + toolpath.sweep_rad[row]) - counted_way(low)) * toolpath.radius_um[row]
    return np.rint(np.where(toolpath.is_arc[row], way, of_line)).astype(np.int64)


def _extents(toolpath: Toolpath) -> Floats:
    """(n, 2) absolute: of lines their sides, of arcs their end from the centre."""
    origin = np.where(toolpath.is_arc[:, None], toolpath.center_um, toolpath.start_um)
    return np.abs(toolpath.end_um - origin)


def _near_either(toolpath: Toolpath) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    extent = _extents(toolpath)
    near: np.ndarray[tuple[int], np.dtype[np.bool_]] = np.abs(extent[:, 0] - extent[:, 1]) <= _EITHER_AXIS_UM
    return near


def _miss_on(toolpath: Toolpath, row: Ints, axis: Ints) -> Floats:
    """Distance (m,) µm of the stepped from the exact ends of the blocks `row` if they counted on `axis`."""
    if not len(row):
        return np.zeros(0)
    picked = {f.name: getattr(toolpath, f.name)[row] for f in fields(toolpath) if f.name not in _PARTS}
    of_all = words_of(toolpath)
    words = {f.name: getattr(of_all, f.name)[row] for f in fields(StepWords)}
    words |= {"count_axis": axis, "count_um": count_on(toolpath, row, axis)}
    others = replace(
        toolpath,
        **picked,
        words=StepWords(**words),
        source=toolpath.source.picked(row),
        stops=(),
    )
    return stepped_miss(others, interpolate(others))


_PARTS = ("words", "source", "stops", "compensation", "told_center_um")
