"""A run whose wire leans: four axes along its two contours, what they cut, and what is wrong with it.

The rest of a run goes by the program plane, with an upright wire: there the wire is where the program says.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from controller.motion.limits import run_starts
from parser.drawing.model import Drawing
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.program import Program
from sim.check.result import CheckState
from sim.cut.solids import TiltedCut, tilted_cut
from sim.cut.wire_rows import WireRows
from sim.measure.compare.findings import compare_cut
from sim.measure.compare.result import Comparison
from sim.measure.compare.starts import placed
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
    return tilted_cut(ready.program, axes, scenario, wire, kerf=asks_for_pieces(scenario))


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


def compared_at_top(
    program: Program,
    cut: TiltedCut | None,
    scenario: Scenario,
    drawing: Drawing | None,
    below: Comparison | None,
) -> Comparison | None:
    """The edge at the top of the work beside its drawing, which lies on the sheet as that of the program plane does.

    None where it is not compared: nobody asked, the edge could not be worked out, or the other was not compared, and
    so nobody knows where the drawing lies.
    """
    target = scenario.drawing and scenario.drawing.of_top
    if cut is None or target is None or drawing is None or below is None or cut.sections[-1].pieces is None:
        return None
    section = cut.sections[-1]
    lies = replace(drawing, curves=placed(drawing.curves, below.placement))
    return compare_cut(replace(program, toolpath=section.toolpath), section.remains(program, scenario), lies, target)


def with_tilt(states: tuple[CheckState, ...], cut: TiltedCut | None, scenario: Scenario) -> tuple[CheckState, ...]:
    """How far checks came, the one of the lean among them where the wire is not upright.

    That is complete but where somebody asked for pieces, and those of a section could not be worked out.
    """
    if cut is None:
        return states
    if asks_for_pieces(scenario) and any(section.pieces is None for section in cut.sections):
        return (*states, CheckState(Check.TAPER, "incomplete", "reason-no-region"))
    return (*states, CheckState(Check.TAPER))


def asks_for_pieces(scenario: Scenario) -> bool:
    """Whether a run works out what is left of the work."""
    return scenario.kerf or scenario.drawing is not None
