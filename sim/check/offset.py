"""Findings on the offset that a controller adds: what it leaves uncut, gouges, contours that it closes or divides."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from controller.offset.chain import OffsetPath
from controller.offset.gouges import TOLERANCE_UM, Gouge
from controller.offset.passes import NoWayBack, PassedPath
from controller.offset.shifted import OffsetSection
from parser.dialect.reader import at_block
from parser.findings.findings import Fact, Finding, Value
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.program import Program
from parser.toolpath import Toolpath
from parser.units import mm
from sim.check.pass_over_round import Distances
from sim.setup.part import Offset


@dataclass(frozen=True, slots=True)
class InPass(Fact):
    """The finding is about one pass over its block: `number`, from 0."""

    number: int


def no_way_back(program: Program, stuck: NoWayBack) -> Finding:
    """Finding 3B505 on a pass that cannot begin where the one before it ended."""
    drawn = program.toolpath
    first, last = (int(drawn.source.block[row]) for row in (stuck.round.begin, stuck.round.past - 1))
    values = {"first": first, "last": last, "before": stuck.number, "number": stuck.number + 1, "gap": stuck.gap_um}
    return at_block(drawn, program.lines, "3B505", stuck.round.past - 1, **values)


def uncut_findings(
    program: Program, offset: Offset, passed: PassedPath, gone: Ints, left_um: Floats
) -> Iterator[Finding]:
    """Findings at the rows `gone` (v,) of the passes, along which `left_um` (v,) of material stay.

    3B501 at an inner arc no larger than the offset, 3B502 where some material stays along another block. Only what all
    passes at the least offset leave stays on the part.
    """
    run = Distances(offset.by_um, offset.by_um, offset.side)
    nearest = [number for number, pass_ in enumerate(offset.passes) if pass_.by_um == offset.by_um]
    last = np.isin(passed.number[gone], nearest)
    rows, of, times = np.unique(passed.row[gone[last]], return_inverse=True, return_counts=True)
    least = np.full(len(rows), np.inf)
    np.minimum.at(least, of, left_um[last])
    stays = times == len(nearest)
    rows, least = rows[stays], least[stays]
    fact = InPass(nearest[0])
    for row, left in zip(rows.tolist(), least.tolist(), strict=True):
        if left > TOLERANCE_UM or _is_small_arc(program.toolpath, row, run):
            yield uncut_finding(program, row, left, run).with_fact(fact)


def uncut_finding(program: Program, row: int, left_um: float, run: Distances, *, stops: bool = False) -> Finding:
    """Finding 3B501 or 3B502 at a row that vanished in a pass; whether the controller `stops` there."""
    drawn, by_um = program.toolpath, run.by_um
    (x_mm, y_mm), radius_um = mm(places(drawn, np.array([row]), np.full(1, 0.5)))[0].tolist(), drawn.radius_um[row]
    values: dict[str, Value] = {"offset": by_um, "left": left_um, "x_mm": x_mm, "y_mm": y_mm}
    values["act"] = "compensation-stops" if stops else "compensation-leaves-out"
    if _is_small_arc(drawn, row, run):
        return at_block(drawn, program.lines, "3B501", row, radius=float(radius_um), **values)
    return at_block(drawn, program.lines, "3B502", row, **values)


def _is_small_arc(drawn: Toolpath, row: int, run: Distances) -> bool:
    """Whether a row is an inner arc with a radius no larger than the offset."""
    return bool(drawn.is_arc[row] and drawn.radius_um[row] <= run.by_um and drawn.sweep_rad[row] * run.side > 0.0)


def gouge_findings(
    program: Program, offset: Offset, passed: PassedPath, path: OffsetPath, gouges: Iterable[Gouge]
) -> Iterator[Finding]:
    """Finding 3B503 for each place where the wire cuts into the contour of the program as read.

    Where several passes cut into one block beside the same other, only the pass that cuts deepest is told.
    """
    by_blocks: dict[tuple[int, int], dict[int, list[Gouge]]] = {}
    for gouge in gouges:
        row, number = path.source_row[gouge.path_row], int(passed.number[gouge.row])
        pair = int(passed.row[row]), int(passed.row[gouge.row])
        by_blocks.setdefault(pair, {}).setdefault(number, []).append(gouge)
    for (row, into), by_pass in by_blocks.items():
        deepest = max(by_pass, key=lambda number: max(gouge.depth_um for gouge in by_pass[number]))
        for gouge in by_pass[deepest]:
            number = deepest + 1 if len(offset.passes) > 1 else 0
            yield gouge_finding(program, (row, into), gouge, offset.by_um, number).with_fact(InPass(deepest))


def gouge_finding(program: Program, rows: tuple[int, int], gouge: Gouge, by_um: float, number: int = 0) -> Finding:
    """Finding 3B503 where the wire cuts beside the first of two rows into the other.

    `number` is that of its pass, 0 of the only one.
    """
    drawn, (row, into) = program.toolpath, rows
    values = {
        "other": int(drawn.source.block[into]),
        "pass": number,
        "depth": gouge.depth_um,
        "offset": by_um,
        "x_mm": mm(gouge.place_um.x),
        "y_mm": mm(gouge.place_um.y),
    }
    return at_block(drawn, program.lines, "3B503", row, **values)


def loop_findings(
    program: Program, offset: Offset, passed: PassedPath, loops: Mapping[OffsetSection, int]
) -> Iterator[Finding]:
    """Finding 3B504 at each closed section that does not allow one closed path without a gouge, but none or several.

    The sections are those of a pass at the least offset.
    """
    for section, count in loops.items():
        if count != 1:
            first = int(passed.row[[section.first, section.last]].min())
            yield loop_finding(program, first, count, offset.by_um)


def loop_finding(program: Program, first: int, loops: int, by_um: float) -> Finding:
    """Finding 3B504 at the first row of a contour that allows so many closed paths without a gouge."""
    return at_block(program.toolpath, program.lines, "3B504", first, loops=loops, offset=by_um)
