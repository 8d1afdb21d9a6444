"""Findings of things in the way: clamps that the wire or its arm touches, and cuts that leave the workpiece."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding, Value
from parser.program import Program
from parser.shape.contours import Contour
from parser.units import mm
from sim.cut.obstacles.bodies import Pieces, grown, swept
from sim.cut.obstacles.leaving import leavings
from sim.cut.obstacles.touches import Touch, Way, touches, way_of
from sim.setup.scenario import Scenario
from sim.table.trace import Trace


class _Met(NamedTuple):
    """Something met on a way: its code, where, and what the finding says besides."""

    code: str
    way: Way
    touch: Touch
    values: dict[str, Value]


def obstacle_findings(program: Program, trace: Trace, contours: Sequence[Contour], scenario: Scenario) -> list[Finding]:
    """Findings 3B404 and 3B405 of a run.

    3B404, an error, is the first touch of the wire, and of the arm, on each clamp. The wire is threaded on cuts alone;
    the arm moves on jumps too. 3B405, a warning, is the first place of each contour where the wire's centre leaves the
    work, save at its lead-in from outside and its lead-out.
    """
    if not scenario.clamps and scenario.work_um is None:
        return []
    wire = way_of(trace.wire_um, trace.row)
    cut = wire.kept(~program.toolpath.is_jump[trace.row[wire.ends[:, 1]]])
    met = [*_touched(trace, cut, scenario), *_left(trace, cut, contours, scenario)]
    return [_finding(program, trace, one) for one in met]


def _touched(trace: Trace, cut: Way, scenario: Scenario) -> Iterator[_Met]:
    """First touch of each body on each clamp."""
    arm_um = scenario.machine.arm_um
    table = way_of(trace.table_um, trace.row) if arm_um is not None else cut
    for clamp in scenario.clamps:
        bodies: dict[str, tuple[Way, Pieces]] = {"wire": (cut, grown(clamp.outline_um, scenario.wire.radius_um))}
        if arm_um is not None:
            bodies["arm"] = table, swept(clamp.outline_um, arm_um)
        for body, (way, pieces) in bodies.items():
            for touch in touches(way, pieces):
                yield _Met("3B404", way, touch, {"body": body, "name": clamp.name})
                break


def _left(trace: Trace, cut: Way, contours: Sequence[Contour], scenario: Scenario) -> Iterator[_Met]:
    if scenario.work_um is not None:
        for touch in leavings(scenario.work_um, trace, cut, contours):
            yield _Met("3B405", cut, touch, {})


def _finding(program: Program, trace: Trace, met: _Met) -> Finding:
    """Finding of what was met, with the place of the wire then, mm, and the time, s."""
    sample, share = met.touch
    place, time = met.way.place_um[sample - 1 : sample + 1], trace.t_s[sample - 1 : sample + 1]
    x, y = mm(place[0] + share * (place[1] - place[0])).tolist()
    values: dict[str, Value] = {"x_mm": x, "y_mm": y, "t_s": float(time[0] + share * (time[1] - time[0]))}
    row = int(trace.row[sample])
    return at_block(program.toolpath, program.lines, met.code, row, **met.values, **values)
