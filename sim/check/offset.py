"""Findings on the offset that a controller adds: what it leaves uncut, gouges, contours that it closes or divides."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from controller.offset.gouges import TOLERANCE_UM, Gouge
from controller.offset.passes import NoWayBack, PassedPath
from controller.offset.path import OffsetPath
from controller.offset.sections import OffsetSection
from parser.dialect.at_block import at_block
from parser.findings.findings import Fact, Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.program import Program
from parser.units import mm
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
    drawn, side = program.toolpath, offset.side
    nearest = [number for number, one in enumerate(offset.passes) if one.by_um == offset.by_um]
    last = np.isin(passed.number[gone], nearest)
    rows, of, times = np.unique(passed.row[gone[last]], return_inverse=True, return_counts=True)
    least = np.full(len(rows), np.inf)
    np.minimum.at(least, of, left_um[last])
    stays = times == len(nearest)
    rows, least = rows[stays], least[stays]
    middle_mm = mm(places(drawn, rows, np.full(len(rows), 0.5)))
    for row, left, (x_mm, y_mm) in zip(rows.tolist(), least.tolist(), middle_mm.tolist(), strict=True):
        values = {"offset": offset.by_um, "left": left, "x_mm": x_mm, "y_mm": y_mm}
        radius_um = float(drawn.radius_um[row])
        fact = InPass(nearest[0])
        if drawn.is_arc[row] and radius_um <= offset.by_um and drawn.sweep_rad[row] * side > 0.0:
            yield at_block(drawn, program.lines, "3B501", row, radius=radius_um, **values).with_fact(fact)
        elif left > TOLERANCE_UM:
            yield at_block(drawn, program.lines, "3B502", row, **values).with_fact(fact)


def gouge_findings(
    program: Program, offset: Offset, passed: PassedPath, path: OffsetPath, gouges: Iterable[Gouge]
) -> Iterator[Finding]:
    """Finding 3B503 for each place where the wire cuts into the contour of the program as read.

    Where several passes cut into one block beside the same other, only the pass that cuts deepest is told.
    """
    drawn = program.toolpath
    told: dict[tuple[int, int], dict[int, list[Gouge]]] = {}
    for gouge in gouges:
        row, number = path.source_row[gouge.path_row], int(passed.number[gouge.row])
        pair = int(passed.row[row]), int(passed.row[gouge.row])
        told.setdefault(pair, {}).setdefault(number, []).append(gouge)
    for (row, into), by_pass in told.items():
        deepest = max(by_pass, key=lambda number: max(gouge.depth_um for gouge in by_pass[number]))
        for gouge in by_pass[deepest]:
            values = {
                "other": int(drawn.source.block[into]),
                "pass": deepest + 1 if len(offset.passes) > 1 else 0,
                "depth": gouge.depth_um,
                "offset": offset.by_um,
                "x_mm": mm(gouge.place_um.x),
                "y_mm": mm(gouge.place_um.y),
            }
            yield at_block(drawn, program.lines, "3B503", row, **values).with_fact(InPass(deepest))


def loop_findings(
    program: Program, offset: Offset, passed: PassedPath, loops: Mapping[OffsetSection, int]
) -> Iterator[Finding]:
    """Finding 3B504 at each closed section that does not allow one closed path without a gouge, but none or several.

    The sections are those of a pass at the least offset.
    """
    for section, count in loops.items():
        if count != 1:
            first = int(passed.row[[section.first, section.last]].min())
            yield at_block(program.toolpath, program.lines, "3B504", first, loops=count, offset=offset.by_um)
