"""The dry run: one program through controller, card and table, and what came of it."""

from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol

import numpy as np

from controller.card.log.writer import CardLog
from controller.motion.limits import Feeds
from controller.motion.plan import Plan
from controller.stepping.pulses import Pulses
from parser.drawing.model import Drawing
from parser.findings.codes import Severity
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Floats, total_before
from parser.program import Program
from parser.shape.contours import Contour, find_contours
from parser.shape.passes import Passes, find_passes
from parser.toolpath import Toolpath
from sim.check.result import CheckState, Coverage
from sim.cut.obstacles.findings import missed_work_findings, obstacle_findings
from sim.cut.pieces.findings import piece_findings, region_finding
from sim.cut.regions import RegionError
from sim.cut.remains import Remains, remains_of
from sim.cut.wire_lag import bowed
from sim.measure.compare.findings import compare_cut, drawing_findings
from sim.measure.compare.result import Comparison
from sim.measure.deviation.measured import Deviations, Meters
from sim.measure.deviation.meters import BlockSteps
from sim.measure.passes.figures import PassFigures, figures_of_passes, wire_taken
from sim.run.offsetting import Offsetting
from sim.run.prepare import prepare
from sim.setup.expectations import Missed
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario
from sim.table.findings import loss_findings
from sim.table.motion import Progress, motion_of, silent, simulate
from sim.table.record.history import History
from sim.table.record.losses import Loss
from sim.table.record.peaks import Peak
from sim.table.trace import Trace

REMAINS: Final = "check-remains"
"""Name of the check of what a cut leaves, which only a run makes."""


class PulseSink(Protocol):
    """Takes the pulses of a run as they are handed out."""

    def open(self, origin_um: tuple[int, int]) -> None:
        """Get ready for pulses that start from here."""

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates."""


@dataclass(frozen=True, slots=True, eq=False)
class DryRun:
    """All that is known after a run.

    Attributes
    ----------
    program, scenario
        What was run: the toolpath of the program is the one that ran.
    offset
        What the controller's compensation made of the program; None where it ran as written.
    feeds
        How fast each block was to be run.
    stepped, plan, trace
        What the controller made of it, and table and wire.
    losses, peaks
        What the drives lost, and how near they came to their limits.
    history
        How the table moved over time.
    deviations
        Of steps, table and wire.
    contours
        Contours with their closures.
    passes, pass_figures
        Which blocks make each pass over an edge, and what it came to, one behind the other.
    block_time_s
        (n,) float64, planned time in each block.
    remains
        Kerf, pieces and sizes; None where nobody asked for them or for a drawing.
    comparison
        The cut edge beside its drawing; None where there is no drawing, or no edge.
    findings
        Of program and run, in file order; behind them one for each of `missed`.
    coverage
        How far their checks came.
    missed
        What its scenario expects of the report, and the report does not say; none before it is held against that.
    """

    program: Program
    scenario: Scenario
    offset: Offsetting | None
    feeds: Feeds
    stepped: BlockSteps
    plan: Plan
    trace: Trace
    losses: tuple[Loss, ...]
    peaks: tuple[Peak, ...]
    history: History
    deviations: Deviations
    contours: tuple[Contour, ...]
    passes: Passes
    pass_figures: tuple[PassFigures, ...]
    block_time_s: Floats
    remains: Remains | None
    comparison: Comparison | None
    findings: tuple[Finding, ...]
    coverage: Coverage
    missed: tuple[Missed, ...] = ()

    @property
    def border_s(self) -> Floats:
        """(n + 1,) float64, planned times at which the blocks begin, and the end of the last one."""
        return total_before(self.block_time_s)

    @property
    def has_trims(self) -> bool:
        """Whether any edge is cut in more than one pass; those who show a run speak of passes only then."""
        return any(one.number > 1 for one in self.passes.passes)

    @property
    def tripped(self) -> Loss | None:
        """Where a drive tripped; None where none did."""
        return next((loss for loss in self.losses if loss.kind == "trip"), None)

    @property
    def ran_s(self) -> float:
        """How long the machine ran: until a drive tripped, else as planned."""
        return self.plan.duration_s if self.tripped is None else self.tripped.t_s

    @property
    def cut(self) -> Trace:
        """The trace as far as the machine ran: after a trip it stands, and cuts nothing of what follows."""
        return _cut(self.trace, self.losses)

    @property
    def toolpath(self) -> Toolpath:
        """The exact geometry that was run, the offset added."""
        return self.program.toolpath


def verdict(findings: tuple[Finding, ...]) -> str:
    """``fail`` where any finding is an error, else ``pass``."""
    return "fail" if any(finding.severity is Severity.ERROR for finding in findings) else "pass"


def dry_run(
    program: Program,
    scenario: Scenario,
    progress: Progress = silent,
    sink: PulseSink | None = None,
    log: CardLog | None = None,
) -> DryRun:
    """Run a program on the machine of a scenario; its pulses go to `sink`, the calls to its card to `log`.

    Raises ProgramError where the program asks for more than any table can do, and DrawingError where the scenario's
    drawing cannot be read.
    """
    drawing = _drawing(scenario.drawing)
    ready = prepare(program, scenario)
    program, toolpath = ready.program, ready.program.toolpath
    motion = motion_of(toolpath, ready.feeds, scenario.machine, scenario.start_um, scenario.trace_spacing_um)
    meters = Meters(motion, ready.steps)
    sinks = [meters.take]
    if sink is not None:
        sink.open(motion.drive.origin_um)
        sinks.append(sink.take)

    def take(pulses: Pulses) -> None:
        for taker in sinks:
            taker(pulses)

    moved = simulate(motion, take, progress, log)
    trace = bowed(moved.trace, toolpath, scenario.wire_lag_um)
    stepped = meters.tally.result()
    contours = find_contours(toolpath, stepped.corner_um)
    met = obstacle_findings(program, trace, contours, scenario)
    missed = missed_work_findings(program, trace, scenario)
    lost = loss_findings(program, moved.losses, scenario.machine.table.motor)
    plan = motion.drive.plan
    cut = _cut(trace, moved.losses)
    passes, block_time_s = find_passes(toolpath), _block_times(plan, ready.steps.along_um)
    way = wire_taken(toolpath, plan, cut)
    left = _left(program, cut, contours, scenario, drawing)
    return DryRun(
        program=program,
        scenario=scenario,
        offset=ready.offset,
        feeds=ready.feeds,
        stepped=stepped,
        plan=plan,
        trace=trace,
        losses=moved.losses,
        peaks=moved.peaks,
        history=moved.history,
        deviations=meters.deviations(cut),
        contours=contours,
        passes=passes,
        pass_figures=figures_of_passes(toolpath, passes, block_time_s, way, scenario.wire.reach_um),
        block_time_s=block_time_s,
        remains=left.remains,
        comparison=left.comparison,
        findings=tuple(sorted([*ready.findings, *met, *missed, *lost, *left.findings], key=file_order)),
        coverage=ready.coverage._replace(checks=(*ready.coverage.checks, left.state)),
    )


def _drawing(target: DrawingTarget | None) -> Drawing | None:
    if target is None:
        return None
    from parser.drawing.read import read_drawing  # noqa: PLC0415 - most runs have no drawing, and ezdxf loads for 0.3 s

    return read_drawing(target.file, layer=target.layer, gap_um=target.gap_um)


class _Left(NamedTuple):
    """What the cut leaves, beside the drawing, with findings; and how far the check of it came."""

    remains: Remains | None
    comparison: Comparison | None
    findings: list[Finding]
    state: CheckState


def _left(
    program: Program, cut: Trace, contours: tuple[Contour, ...], scenario: Scenario, drawing: Drawing | None
) -> _Left:
    """What the cut leaves, as far as the scenario asks for it."""
    target = scenario.drawing
    if not scenario.kerf and target is None:
        return _Left(None, None, [], CheckState(REMAINS, "not asked", "reason-no-kerf"))
    try:
        remains = remains_of(program, cut, contours, scenario)
    except RegionError as error:
        return _Left(
            None, None, [region_finding(program, error)], CheckState(REMAINS, "incomplete", "reason-no-region")
        )
    found = piece_findings(program, remains.pieces)
    if target is None or drawing is None:
        return _Left(remains, None, found, CheckState(REMAINS))
    comparison = compare_cut(program, remains, drawing, target)
    return _Left(remains, comparison, [*found, *drawing_findings(program, comparison)], CheckState(REMAINS))


def _cut(trace: Trace, losses: tuple[Loss, ...]) -> Trace:
    """The trace as far as the machine ran: after a trip it stands, and cuts nothing of what follows."""
    trip = next((loss for loss in losses if loss.kind == "trip"), None)
    return trace.until(trip.t_s) if trip else trace


def _block_times(plan: Plan, before_um: Floats) -> Floats:
    """Planned time (n,) s in each block, which add up to the whole."""
    reached = plan.time_at(before_um)
    reached[-1] = plan.duration_s
    return np.diff(reached)
