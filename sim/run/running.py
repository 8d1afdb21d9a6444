"""A run: a program, or what a card was told, through card and table, and all that came of it.

Passes over each edge of a run, and what each came to.

What a run leaves, worked out as far as its scenario asks: kerf, pieces and sizes, and the cut beside its drawing.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from controller.card.log import CardLog
from controller.motion.limits import Feeds
from controller.stepping.pulses import Pulses
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding, WithoutOffset, telling
from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.contours import Contour, find_contours
from parser.shape.passes import Pass, find_passes
from sim.base.progress import Progress, silent
from sim.check.result import CheckState
from sim.cut.findings import missed_work_findings, obstacle_findings, piece_findings, region_finding
from sim.cut.regions import RegionError
from sim.cut.remains import Remains, remains_of
from sim.cut.solids import TiltedCut, weighed
from sim.cut.wire_lag import bowed
from sim.cut.wire_rows import WireRows, wire_rows
from sim.measure.causes import Meters
from sim.measure.compare.findings import compare_cut, drawing_findings, top_findings
from sim.measure.compare.result import Comparison
from sim.measure.kerf_fit import offset_findings, tolerance_findings
from sim.measure.passes import PassFigures, figures_of_passes, wire_taken
from sim.run.drawings import NO_DRAWINGS, Drawings, drawings_of
from sim.run.dryrun import DryRun, Ending, PulseSink, motion_to_end, trip_of
from sim.run.prepare import Prepared, in_file_order, prepare, tilt_findings
from sim.run.sparks import check_states, cut_under_sparks, stop_findings, work_of
from sim.run.tilt import asks_for_pieces, compared_at_top, cut_tilted, lost_findings, with_tilt
from sim.setup.scenario import Scenario
from sim.table.losses import loss_findings
from sim.table.motion import Motion, Moved, TableRun, driven
from sim.table.trace import Trace

_REMAINS: Final = "check-remains"  # the check of what a cut leaves, which only a run makes


class CutResult(NamedTuple):
    """What a cut leaves, beside its drawings; None where nobody asked, or where no region could be worked out.

    `top` is the edge at the top of the work, where the wire leans. `findings` are those about all of it, and `state`
    says how far the check of it came.
    """

    remains: Remains | None
    comparison: Comparison | None
    top: Comparison | None
    findings: list[Finding]
    state: CheckState


class WireCut(NamedTuple):
    """A cut.

    Attributes
    ----------
    program
        What was cut.
    trace
        Where the wire was, until the run ended.
    contours
        Of the program.
    reach_um
        (n,) half the width of the kerf in each row.
    tilted
        What came of a wire that leans; None of an upright one.
    is_whole
        Whether the run came to the end of its program.
    """

    program: Program
    trace: Trace
    contours: tuple[Contour, ...]
    reach_um: Floats
    tilted: TiltedCut | None
    is_whole: bool


def left_of(cut: WireCut, scenario: Scenario, drawings: Drawings, progress: Progress, *, measured: bool) -> CutResult:
    """What a cut leaves, as far as the scenario asks for it; `measured`, with all its sizes and plays.

    A run that is not whole, since it ended early, is not held against the drawing: all that differs comes of that.
    """
    program, target = cut.program, scenario.drawing
    if not asks_for_pieces(scenario):
        return CutResult(None, None, None, [], CheckState(_REMAINS, "not asked", "reason-no-kerf"))
    progress("kerf", 0, 1)
    try:
        remains = remains_of(program, cut.trace, cut.contours, scenario, cut.reach_um)
        solids = () if cut.tilted is None else cut.tilted.solids
        remains = replace(remains, pieces=weighed(remains.pieces, solids))
        remains = remains.measured() if measured else remains
    except RegionError as error:
        state = CheckState(_REMAINS, "incomplete", "reason-no-region")
        return CutResult(None, None, None, [region_finding(program, error)], state)
    found = piece_findings(program, remains.pieces)
    if target is None or drawings.plane is None:
        return CutResult(remains, None, None, found, CheckState(_REMAINS))
    if not cut.is_whole:
        return CutResult(remains, None, None, found, CheckState(_REMAINS, "incomplete", "reason-ended"))
    progress("comparison", 0, 1)
    comparison = compare_cut(program, remains, drawings.plane, target)
    top = compared_at_top(program, cut.tilted, scenario, drawings.top, comparison)
    found += [*drawing_findings(program, comparison), *top_findings(program, top)]
    return CutResult(remains, comparison, top, found, CheckState(_REMAINS))


class Along(NamedTuple):
    """What is run: a program that is ready, its motion, where that ends early, its pulses, and its feeds.

    What it leaves is `measured` where someone looks at its sizes, and at how its pieces can move.
    """

    ready: Prepared
    motion: Motion
    ended: Ending | None
    pulses: Iterator[Pulses]
    feeds: Feeds | None
    measured: bool = True


def dry_run(  # noqa: PLR0913 - whom it tells
    program: Program,
    scenario: Scenario,
    progress: Progress = silent,
    sink: PulseSink | None = None,
    log: CardLog | None = None,
    *,
    measured: bool = True,
) -> DryRun:
    """Run a program on the machine of a scenario; its pulses go to `sink`, the calls to its card to `log`.

    Sizes and plays of what it leaves take a quarter of the time of a run with kerf: without `measured` they are worked
    out when they are first looked at.

    Raises ProgramError where the program asks for more than any table can do, DrawingError where a drawing of the
    scenario cannot be read, and SettingsError where there is one of the top and the wire is upright.
    """
    progress("checks", 0, 1)
    drawings = drawings_of(scenario.drawing)
    ready = prepare(program, scenario)
    if drawings.top is not None and ready.tilt is None:
        raise SettingsError("upper-drawing-upright")
    progress("plan", 0, 1)
    motion, ended = motion_to_end(ready, scenario)
    along = Along(ready, motion, ended, driven(motion, log), ready.feeds, measured)
    return run_along(along, scenario, drawings, progress, sink)


def run_along(
    along: Along,
    scenario: Scenario,
    drawings: Drawings = NO_DRAWINGS,
    progress: Progress = silent,
    sink: PulseSink | None = None,
) -> DryRun:
    """Let the table follow what is run, and tell all that came of it; the pulses go to `sink`, too."""
    ready, motion, ended, pulses, feeds, measured = along
    program, toolpath = ready.program, ready.program.toolpath
    meters = Meters(motion, ready.steps)
    moved = _followed(motion, pulses, meters, sink, progress)
    passes = find_passes(toolpath) if ready.offset is None else ready.offset.edge_passes
    wire = wire_rows(toolpath, scenario, passes)
    trace = bowed(moved.trace, toolpath, wire.lag_um)
    stepped, plan = meters.tally.result(), motion.drive.plan
    contours = find_contours(toolpath, stepped.corner_um)
    ended = trip_of(moved.losses) or ended
    cut = trace.until(ended.t_s) if ended else trace
    border_s = plan.border_s(ready.steps.along_um)
    block_time_s = np.diff(np.minimum(border_s, ended.t_s if ended else plan.duration_s))
    figures = figures_of_passes(toolpath, passes, block_time_s, wire_taken(toolpath, plan, cut), wire.reach_um)
    process = cut_under_sparks(work_of(ready.steps, toolpath, scenario, figures, wire), scenario, ended)
    reach_um = wire.reach_um if process is None else wire.reach_um + process.wider_um
    tilted = cut_tilted(ready, scenario, wire._replace(reach_um=reach_um))
    if ready.tilt is not None:
        reach_um = reach_um / np.cos(ready.tilt.wall_rad(len(toolpath)))
    wire_cut = WireCut(program, cut, contours, reach_um, tilted, is_whole=ended is None)
    left = left_of(wire_cut, scenario, drawings, progress, measured=measured)
    found = [
        *_met(program, scenario, moved, trace, contours),
        *left.findings,
        *_fits(ready, scenario, figures, wire, left.comparison),
        *stop_findings(program, process),
        *tilt_findings(ready, scenario),
        *lost_findings(program, tilted, scenario),
    ]
    states = with_tilt((*ready.coverage.checks, left.state, *check_states(process)), tilted, scenario)
    return DryRun(
        program=program,
        scenario=scenario,
        offset=ready.offset,
        feeds=feeds,
        plan=plan,
        ended=ended,
        stepped=stepped,
        trace=trace,
        losses=moved.losses,
        peaks=moved.peaks,
        history=moved.history,
        deviations=meters.deviations(cut, moved.probes.until(ended.t_s) if ended else moved.probes),
        contours=contours,
        passes=passes,
        pass_figures=figures,
        border_s=border_s,
        process=process,
        tilted=tilted,
        reach_um=reach_um,
        remains=left.remains,
        comparison=left.comparison,
        top=left.top,
        findings=in_file_order(ready, found),
        checked=ready.findings,
        coverage=ready.coverage._replace(checks=states),
    )


def _followed(
    motion: Motion, pulses: Iterator[Pulses], meters: Meters, sink: PulseSink | None, progress: Progress
) -> Moved:
    """How the table moved by pulses, which meters and sink take too."""
    table = TableRun(motion, progress)
    if sink is not None:
        sink.open(motion.drive.origin_um)
    for followed in table.followed(pulses):
        meters.take(followed)
        if sink is not None:
            sink.take(followed)
    return table.moved


def _fits(
    ready: Prepared,
    scenario: Scenario,
    figures: Sequence[PassFigures],
    wire: WireRows,
    comparison: Comparison | None,
) -> Iterator[Finding]:
    """Findings on offsets, trims and a tolerance that do not fit the kerfs that a technology says; none without one."""
    if scenario.technology is None:
        return
    program, passes = ready.program, () if scenario.offset is None else scenario.offset.passes
    without, of_header = any(telling(ready.findings, WithoutOffset)), program.header.get("offset_um")
    header_um = of_header if isinstance(of_header, float) and not without else None

    def offset_of(pass_: Pass) -> float | None:
        if pass_.told_um is not None:
            return pass_.told_um
        return passes[min(pass_.number, len(passes)) - 1].by_um if passes else header_um

    yield from offset_findings(program, figures, wire.reach_um, wire.spread_um, offset_of)
    if comparison is not None:
        last = [each.of.first for each in figures if each.of.shift_um <= each.of.edge_um]
        yield from tolerance_findings(program, comparison, float(np.abs(wire.spread_um[last]).max(initial=0.0)))


def _met(
    program: Program, scenario: Scenario, moved: Moved, trace: Trace, contours: tuple[Contour, ...]
) -> list[Finding]:
    """Findings on what table and wire met on their way, and on what the drives lost."""
    return [
        *obstacle_findings(program, trace, contours, scenario),
        *missed_work_findings(program, trace, scenario),
        *loss_findings(program, moved.losses, scenario.machine.table.motor),
    ]
