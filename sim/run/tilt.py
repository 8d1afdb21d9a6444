"""A run whose wire leans: four axes along its two contours, what they cut, and what is wrong with it.

The rest of a run goes by the program plane, with an upright wire: there the wire is where the program says.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np

from controller.motion.limits import run_starts
from controller.taper.tilted import TiltedPath
from parser.dialect.reader import at_block
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.program import Program
from parser.units import mm
from sim.check.lean import LeanDemands, tilted_path
from sim.check.result import CheckState
from sim.check.taper import taper_findings
from sim.cut.solids import TiltedCut, UprightWire, tilted_cut
from sim.cut.wire_rows import WireRows
from sim.run.prepare import Prepared
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings
from sim.table.losses import loss_findings
from sim.table.ticks import Sampling
from sim.table.tilted import follow_tilted

_MOST_OFF_UM: Final = 1.0


def tilt_of(drawn: Program, ready: Prepared, scenario: Scenario) -> TiltedPath | None:
    """The way of the wire of a program that is ready; None where it is upright. Raises what `tilted_path` does."""
    demands = LeanDemands(scenario.taper or TaperSettings(), scenario.known_guides, scenario.thickness_mm)
    return tilted_path(drawn, ready.offset, demands)


def cut_tilted(ready: Prepared, path: TiltedPath | None, scenario: Scenario, wire: WireRows) -> TiltedCut | None:
    """What the cut of a wire that leans comes to, by the motion of its four axes; None of an upright one.

    `wire` is an upright one in each row of the toolpath.
    """
    if path is None:
        return None
    source, feeds = path.source_row, ready.feeds
    cut = np.broadcast_to(feeds.cut_um_s, (len(ready.program.toolpath),))[source]
    rests = np.searchsorted(source, run_starts(ready.program.toolpath))
    guides, sampling = scenario.known_guides, Sampling(scenario.trace_spacing_um, scenario.wire_lag_um)
    axes = follow_tilted(
        path, feeds._replace(cut_um_s=cut), scenario.machine, guides, scenario.start_um, rests, sampling
    )
    kerf = scenario.kerf or scenario.drawing is not None
    return tilted_cut(ready.program, axes, scenario, UprightWire(wire.reach_um, wire.lag_um), kerf=kerf)


def tilt_findings(ready: Prepared, cut: TiltedCut | None, scenario: Scenario) -> Iterator[Finding]:
    """Findings 3B701 to 3B710 on a wire that leans, and those of what its drives lose; none on an upright one."""
    if cut is None:
        return
    program, axes = ready.program, cut.axes
    yield from taper_findings(program, cut.path, scenario.known_guides, scenario.machine.table, scenario.start_um)
    yield from _not_widened(ready, scenario)
    for lost, names in ((axes.lost_xy, "XY"), (axes.lost_uv, "UV")):
        of_rows = tuple(each._replace(row=int(cut.path.source_row[each.row])) for each in lost)
        for found in loss_findings(program, of_rows, scenario.machine.table.motor):
            axis = str(found.values["axis"])
            yield found._replace(values={**found.values, "axis": names["XY".index(axis)]})


def _not_widened(ready: Prepared, scenario: Scenario) -> Iterator[Finding]:
    """3B708: the path has the offset of an upright wire in it, and the wire leans."""
    program, angle_rad = ready.program, scenario.taper.angle_rad if scenario.taper is not None else None
    header_um, reach_um = program.header.get("offset_um"), scenario.wire.reach_um
    if not angle_rad or ready.offset is not None or not isinstance(header_um, float):
        return
    needed_um = reach_um / float(np.cos(angle_rad))
    if needed_um - header_um > _MOST_OFF_UM and abs(header_um - reach_um) < _MOST_OFF_UM:
        values = {"offset_mm": mm(header_um), "off": needed_um - header_um, "needed_mm": mm(needed_um)}
        yield at_block(program.toolpath, program.lines, "3B708", 0, **values)


def with_tilt(states: tuple[CheckState, ...], path: TiltedPath | None) -> tuple[CheckState, ...]:
    """How far checks came, the one of the lean among them where the wire is not upright: that is complete."""
    return states if path is None else (*states, CheckState(Check.TAPER))
