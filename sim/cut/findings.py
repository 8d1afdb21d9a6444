"""Findings on a cut: what the wire or its arm touches, cuts that leave the workpiece or miss it, and what pieces do."""

from collections.abc import Iterator, Sequence

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.contours import Contour
from parser.units import mm
from sim.cut.obstacles import BodyShapes, Touch, Way, grown, sides, swept, touches, way_of
from sim.cut.pieces.pieces import Piece, Pieces
from sim.cut.regions import RegionError
from sim.setup.obstacles import Outline
from sim.setup.scenario import Scenario
from sim.table.trace import Trace

ASTRAY_UM = 3.0
"""A wire this near to the edge of the work runs along it: steps and table stray from the path by as much."""


def obstacle_findings(program: Program, trace: Trace, contours: Sequence[Contour], scenario: Scenario) -> list[Finding]:
    """Findings 3B404 and 3B405 of a run.

    3B404, an error, is the first touch of the wire, and of the arm, on each clamp. The wire is threaded on cuts alone;
    the arm moves on jumps too. 3B405, a warning, is the first place of each contour where the wire's centre leaves the
    work, save at its lead-in from outside and its lead-out.
    """
    if not scenario.clamps and scenario.work_um is None:
        return []
    wire = way_of(trace.wire_um, trace.row)
    cut = wire.picked(~program.toolpath.is_jump[trace.row[wire.ends[:, 1]]])
    return [*_touched(program, trace, cut, scenario), *_findings_of(program, trace, cut, contours, scenario)]


def missed_work_findings(program: Program, trace: Trace, scenario: Scenario) -> list[Finding]:
    """Finding 3B408, an error, of a run whose kerf nowhere comes to the work."""
    if scenario.work_um is None:
        return []
    wire = way_of(trace.wire_um, trace.row)
    cut = wire.picked(~program.toolpath.is_jump[trace.row[wire.ends[:, 1]]])
    if not len(cut.ends) or any(touches(cut, grown(scenario.work_um, scenario.wire.reach_um))):
        return []
    begin = Touch(int(cut.ends[0, 0]) + 1, 0.0)
    return [at_block(program.toolpath, program.lines, "3B408", _row(trace, begin), **_where(trace, cut, begin))]


def _touched(program: Program, trace: Trace, cut: Way, scenario: Scenario) -> Iterator[Finding]:
    """First touch of each body on each clamp."""
    arm_um = scenario.machine.arm_um
    table = way_of(trace.table_um, trace.row) if arm_um is not None else cut
    for clamp in scenario.clamps:
        bodies: dict[str, tuple[Way, BodyShapes]] = {"wire": (cut, grown(clamp.outline_um, scenario.wire.radius_um))}
        if arm_um is not None:
            bodies["arm"] = table, swept(clamp.outline_um, arm_um)
        for body, (way, pieces) in bodies.items():
            for touch in touches(way, pieces):
                values: dict[str, Value] = {"body": body, "name": clamp.name, **_where(trace, way, touch)}
                yield at_block(program.toolpath, program.lines, "3B404", _row(trace, touch), **values)
                break


def _findings_of(
    program: Program, trace: Trace, cut: Way, contours: Sequence[Contour], scenario: Scenario
) -> Iterator[Finding]:
    if scenario.work_um is not None:
        for touch in leavings(scenario.work_um, trace, cut, contours):
            yield at_block(program.toolpath, program.lines, "3B405", _row(trace, touch), **_where(trace, cut, touch))


def _row(trace: Trace, touch: Touch) -> int:
    return int(trace.row[touch.sample])


def _where(trace: Trace, way: Way, touch: Touch) -> dict[str, float]:
    """Place of the wire at a touch, mm, and the time, s."""
    sample, share = touch
    place, time = way.place_um[sample - 1 : sample + 1], trace.t_s[sample - 1 : sample + 1]
    x, y = mm(place[0] + share * (place[1] - place[0])).tolist()
    return {"x_mm": x, "y_mm": y, "t_s": float(time[0] + share * (time[1] - time[0]))}


def leavings(outline_um: Outline, trace: Trace, cut: Way, contours: Sequence[Contour]) -> Iterator[Touch]:
    """First place of each contour at which the wire's centre leaves the work; `cut` is its way where it cuts.

    A lead-out, the last block, leaves no finding; neither does the first block of a contour that begins outside.
    """
    work, edges = grown(outline_um, 0.0), sides(outline_um, ASTRAY_UM)
    for contour in contours:
        way = _of_contour(cut, trace, contour)
        if len(way.ends):
            yield from _first_out(way, trace, contour, work, edges)


def _of_contour(cut: Way, trace: Trace, contour: Contour) -> Way:
    row = trace.row[cut.ends[:, 1]]
    return cut.picked((row >= contour.first - 1) & (row <= contour.last - 1))


def _first_out(way: Way, trace: Trace, contour: Contour, work: BodyShapes, edges: BodyShapes) -> Iterator[Touch]:
    """The first leaving that counts, if any: the last crossing of the edge before the wire is clear of it outside."""
    begins_inside = inside = work.hold(_at(way.place_um, int(way.ends[0, 0])))
    quiet = {contour.last - 1} if begins_inside else {contour.first - 1, contour.last - 1}
    crossing: Touch | None = None
    for sample, _ in touches(way, edges):
        start, end = _at(way.place_um, sample - 1), _at(way.place_um, sample)
        holds = work.hold(end)
        if not holds and work.hold(start):
            crossing = Touch(sample, 1.0 - work.entered_at(end, start))
        if edges.hold(end):
            continue
        if (
            (inside and not holds and crossing is not None)
            # A block may end on the edge; then the next one leaves.
            and quiet.isdisjoint(trace.row[[crossing.sample, sample]].tolist())
        ):
            yield crossing
            return
        inside = holds


def _at(place_um: Floats, sample: int) -> tuple[float, float]:
    x, y = np.asarray(place_um[sample]).tolist()
    return x, y


def piece_findings(program: Program, pieces: Pieces) -> list[Finding]:
    """Finding 3B406 for each piece that comes free before its cut is done."""
    return [_early(program, piece) for piece in pieces.freed if piece.early]


def region_finding(program: Program, error: RegionError) -> Finding:
    """Finding 3B407: what is left could not be worked out."""
    first, last = (int(program.toolpath.source.block[number - 1]) for number in (error.first, error.last))
    return at_block(program.toolpath, program.lines, "3B407", error.first - 1, first=first, last=last)


def _early(program: Program, piece: Piece) -> Finding:
    freed = piece.freed
    return at_block(
        program.toolpath,
        program.lines,
        "3B406",
        freed.block - 1,
        kind=piece.kind,
        pause=program.reading.spelling.pause,
        area_mm2=piece.area_mm2,
        cut_after=piece.cut_after_um,
        t_s=freed.t_s,
        x_mm=mm(freed.wire_um.x),
        y_mm=mm(freed.wire_um.y),
    )
