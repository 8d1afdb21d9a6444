"""A run whose wire leans: four axes along its two contours, what they cut, and what is wrong with it.

The rest of a run goes by the program plane, with an upright wire: there the wire is where the program says.
"""

from collections.abc import Iterator

import numpy as np

from controller.motion.limits import run_starts
from controller.taper.tilted import TiltedPath
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.program import Program
from sim.check.result import CheckState
from sim.cut.solids import TiltedCut, tilted_cut
from sim.cut.wire_rows import WireRows
from sim.run.prepare import Prepared
from sim.setup.scenario import Scenario
from sim.table.losses import loss_findings
from sim.table.ticks import Sampling
from sim.table.tilted import follow_tilted


def cut_tilted(ready: Prepared, scenario: Scenario, wire: WireRows) -> TiltedCut | None:
    """What the cut of a wire that leans comes to, by the motion of its four axes; None of an upright one.

    `wire` is an upright one in each row of the toolpath.
    """
    path = ready.tilt
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
    return tilted_cut(ready.program, axes, scenario, wire, kerf=kerf)


def lost_findings(program: Program, cut: TiltedCut | None, scenario: Scenario) -> Iterator[Finding]:
    """Findings on what the drives of four axes lost; none on an upright wire."""
    if cut is None:
        return
    axes = cut.axes
    for lost, names in ((axes.lost_xy, "XY"), (axes.lost_uv, "UV")):
        of_rows = tuple(each._replace(row=int(cut.path.source_row[each.row])) for each in lost)
        for found in loss_findings(program, of_rows, scenario.machine.table.motor):
            axis = str(found.values["axis"])
            yield found._replace(values={**found.values, "axis": names["XY".index(axis)]})


def with_tilt(states: tuple[CheckState, ...], path: TiltedPath | None) -> tuple[CheckState, ...]:
    """How far checks came, the one of the lean among them where the wire is not upright: that is complete."""
    return states if path is None else (*states, CheckState(Check.TAPER))
