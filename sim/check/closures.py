"""Findings about where contours and blocks end: whether contours close, and the cost of the count axis.

Findings about contours: whether they close, exact and stepped, and which block may be why not.

Blocks whose steps end elsewhere than their geometry: the cost of the count axis, from a stepped run.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from controller.stepping.steps import Steps, interpolate, words_of
from parser.controller_words import Axis, StepWords
from parser.dialect.mender import Suspect
from parser.dialect.reader import at_block
from parser.findings.findings import DoubtfulEnd, Fact, Finding, PrintedElsewhere, Value, WrongBlock, telling
from parser.geometry.curves import Bools, Floats, Ints
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM, Contour
from parser.shape.loops import end_in_waste
from parser.step_words.words import counted_way
from parser.text.source import Field
from parser.toolpath import Toolpath

STEPPED_CLOSURE_UM = 12.0
"""A sound arc may end up to 9.9 µm off when stepped (sim/check/closures.py)."""
STEPPED_CLOSURE_UM_PER_ROOT_ARC = 6.0
"""Arcs end about 2 µm off, each in its own direction, so the sum of many grows as the root of their number. Three times
that does not happen by chance."""

MOST_SUSPECTED = 50
"""Contours of a program in which a broken block is looked for. If more stay open, the cause is no slip of a digit."""


@dataclass(frozen=True, slots=True)
class OpenContour(Fact):
    """The contour whose first block is `first` does not close."""

    first: int


@dataclass(frozen=True, slots=True)
class Suspected(Fact):
    """The contour whose first block is `first` would close with a field of this block written otherwise.

    Each of the `suspects` alone is enough. `is_proved` tells that there is but one, and that it explains more.
    """

    first: int
    suspects: tuple[Suspect, ...]
    is_proved: bool = False


def contour_findings(
    program: Program, contours: tuple[Contour, ...], rows: Ints, known: tuple[Finding, ...], *, may_stay_open: bool
) -> list[Finding]:
    """Open contours (3B301) with their suspects (3B304) unless they may stay open; poor stepped closure (3B302).

    `rows` (n,) is each row's contour. A contour with a closed loop may lead out elsewhere than it led in (3B311). A
    block that is `known` to be wrong explains its contour: then no other block is suspected, and the stepped closure is
    not named. Of the contours that do not close, the first `MOST_SUSPECTED` get suspects. Among them are contours that
    only run forward: a triangle with a wrong quadrant does so too, and a parting cut hardly ever has a block that would
    close it.
    """
    guilty = np.sort(np.array([finding.block for finding, _ in telling(known, WrongBlock)], dtype=np.int64))
    found: list[Finding] = []
    suspected = 0
    unclosed = [contour for contour in contours if contour.is_open and not may_stay_open]
    left = _left_elsewhere(program, rows, unclosed)
    for contour in contours:
        low, high = np.searchsorted(guilty, [contour.first, contour.last + 1])
        explained = bool(low < high)
        if contour.first in left:
            found += [_lead_out(program, contour, block) for block in (contour.first, contour.last)]
            continue
        gap, limit = contour.closure_stepped_um, stepped_limit_um(contour)
        if contour.is_open and not may_stay_open:
            found.append(_open(program, contour))
        elif (
            program.toolpath.words is not None  # else steps are ours alone, and no word can be wrong
            and contour.closure_exact_um <= contour.tolerance_um
            and gap - contour.closure_exact_um > limit
            and not explained
        ):
            values = _ends_of(contour) | {"gap": gap, "limit": limit}
            found.append(at_block(program.toolpath, program.lines, "3B302", contour.last - 1, **values))
        may_close = contour.is_open or contour.last - contour.first > 1  # one line or two are no figure
        if may_close and not (contour.returns or contour.in_kerf or may_stay_open) and suspected < MOST_SUSPECTED:
            suspected += 1
            found += _suspects(program, contour, guilty[low:high])
    return found


def _left_elsewhere(program: Program, rows: Ints, contours: list[Contour]) -> set[int]:
    """First blocks of those open contours whose loop is closed, and whose lead-out ends in the waste.

    A contour that ends within some µm of its start was to end there, and is not among them.
    """
    far = (contour.first for contour in contours if contour.closure_exact_um > CLOSED_WITHIN_UM)
    first = np.fromiter(far, dtype=np.int64)
    if not len(first):
        return set()
    number = rows[first - 1]
    return set(first[np.isin(number, end_in_waste(program.toolpath, rows, number))].tolist())


def _lead_out(program: Program, contour: Contour, block: int) -> Finding:
    values = _ends_of(contour) | {"gap": contour.closure_exact_um}
    return at_block(program.toolpath, program.lines, "3B311", block - 1, **values)


def stepped_limit_um(contour: Contour) -> float:
    """Closure in µm within which the steps of a sound contour end."""
    return float(STEPPED_CLOSURE_UM + STEPPED_CLOSURE_UM_PER_ROOT_ARC * contour.arcs**0.5)


def _open(program: Program, contour: Contour) -> Finding:
    values = _ends_of(contour) | {"gap": contour.closure_exact_um}
    found = at_block(program.toolpath, program.lines, "3B301", contour.last - 1, **values)
    return found.with_fact(OpenContour(contour.first))


def _ends_of(contour: Contour) -> dict[str, Value]:
    return {"first": contour.first, "last": contour.last}


def _suspects(program: Program, contour: Contour, guilty: Ints) -> list[Finding]:
    """Notes at blocks that would close the contour if one of their fields were written otherwise.

    Where some of its blocks are known to be `guilty`, of these alone.
    """
    if program.mender is None:
        return []
    found: dict[int, list[Suspect]] = {}
    for suspect in program.mender.suspects(program.toolpath, contour.first - 1, contour.last):
        if not len(guilty) or suspect.row + 1 in guilty:
            found.setdefault(suspect.row, []).append(suspect)
    return [suspect_finding(program, contour.first, contour.last, tuple(of)) for of in found.values()]


def suspect_finding(program: Program, first: int, last: int, suspects: tuple[Suspect, ...]) -> Finding:
    """Finding 3B304 at a block with which the contour of the blocks from `first` to `last` closes in these ways."""
    first_suspect, others = (
        suspects[0],
        [] if program.mender is None else [program.mender.mends_text((s.mend,)) for s in suspects[1:]],
    )
    return at_block(
        program.toolpath,
        program.lines,
        "3B304",
        first_suspect.row,
        first_suspect.field,
        first=first,
        last=last,
        field=first_suspect.field.term,
        written=first_suspect.written,
        other=first_suspect.other,
        others=" / ".join(others),
    ).with_fact(Suspected(first, suspects))


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


_PARTS = ("words", "source", "stops", "compensation", "told_center_um", "taper", "upper")
