"""The dry run: one program through controller, card and table, what ended it, and what came of it.

What ends a run before its program is through: a servo that trips, or the end of the travel.

What a run took for granted, and what it did not look at: no run without a finding is to promise more than it can.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

import numpy as np

from controller.motion.limits import Feeds
from controller.motion.plan import Plan
from controller.stepping.chunks import CHUNK_STEPS, chunk_of
from controller.stepping.pulses import Pulses
from controller.stepping.steps import Steps
from parser.controller_words import Axis
from parser.dialect.reader import Assumption
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.program import Program
from parser.shape.contours import Contour
from parser.shape.passes import Passes
from parser.text.source import BlockNames
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.check.offset import Offsetting
from sim.check.result import Coverage
from sim.check.travel import ROUNDING_UM, beyond_um
from sim.cut.remains import Remains
from sim.cut.solids import TiltedCut
from sim.measure.causes import BlockSteps, Deviations
from sim.measure.compare.result import Comparison
from sim.measure.factor import Interval, factor_of, interval_of
from sim.measure.passes import PassFigures
from sim.process.cut import ProcessRun
from sim.run.prepare import Prepared, time_spread_s
from sim.setup.expectations import Missed
from sim.setup.machine.machine import Machine, MeasuredValue, measured_values
from sim.setup.machine.table import TableModel
from sim.setup.scenario import Scenario
from sim.setup.technology import LEVEL
from sim.table.history import History
from sim.table.losses import Loss, Peak
from sim.table.motion import Motion, motion_of
from sim.table.ticks import Sampling
from sim.table.trace import Trace, origin_um

Cause = Literal["trip", "travel"]

_STEPPED_UM = 2.0
"""The steps of a block leave its curve by less than this."""


class Ending(NamedTuple):
    """Where the machine stopped before its program was through.

    Attributes
    ----------
    cause
        ``trip``: a servo gave up; ``travel``: the next step would have left the travel.
    axis
        Whose servo, or whose travel.
    row
        Row of the toolpath that was running (block number less one).
    t_s
        When.
    x_um, y_um
        Place in program coordinates: of the table at a trip, of the last step at the end of the travel.
    """

    cause: Cause
    axis: Axis
    row: int
    t_s: float
    x_um: float
    y_um: float


def trip_of(losses: Iterable[Loss]) -> Ending | None:
    """The trip among the losses of a run, if there is one."""
    trip = next((loss for loss in losses if loss.kind == "trip"), None)
    return trip and Ending("trip", trip.axis, trip.row, trip.t_s, trip.x_um, trip.y_um)


def motion_to_end(ready: Prepared, scenario: Scenario) -> tuple[Motion, Ending | None]:
    """The motion of a program, and where it ends early because the path leaves the travel."""
    toolpath, machine, start_um = ready.program.toolpath, scenario.machine, scenario.start_um
    sampling = Sampling(scenario.trace_spacing_um, scenario.wire_lag_um)
    motion = motion_of(toolpath, ready.feeds, machine, start_um, sampling, ready.steps)
    if scenario.past_stop:
        return motion, None
    ended = travel_end(ready, motion, scenario)
    return (motion.until(ended.t_s), ended) if ended else (motion, None)


def travel_end(ready: Prepared, motion: Motion, scenario: Scenario) -> Ending | None:
    """Where a motion leaves the travel; None where it does not."""
    of = ready.program.toolpath, ready.steps, motion.drive.plan
    return _travel_end(*of, scenario.machine.table, scenario.start_um)


def _travel_end(
    toolpath: Toolpath, steps: Steps, plan: Plan, table: TableModel, start_um: tuple[float, float]
) -> Ending | None:
    """The last step before the one that first leaves the travel, from a start on the table; None where all fit."""
    beyond = beyond_um(toolpath, steps, table, start_um)
    highest = from_mm(np.array([table.travel_x_mm, table.travel_y_mm]))
    for row in np.flatnonzero((beyond > -_STEPPED_UM).any(axis=1)).tolist():
        past = int(steps.before[row + 1])
        for since in range(int(steps.before[row]), past, CHUNK_STEPS):
            chunk = chunk_of(steps, since, min(since + CHUNK_STEPS, past))
            place = np.stack([chunk.x_um, chunk.y_um], axis=1) + np.array(start_um)
            out = np.argwhere((place < -ROUNDING_UM) | (place > highest + ROUNDING_UM))
            if len(out):
                return _before_step(toolpath, steps, plan, since + int(out[0, 0]), Axis(int(out[0, 1])))
    return None


def _before_step(toolpath: Toolpath, steps: Steps, plan: Plan, number: int, axis: Axis) -> Ending:
    """The place and the time before the step that has so many steps before it."""
    row = int(np.searchsorted(steps.before, number, side="right")) - 1
    along_um = (
        chunk_of(steps, number - 1, number).along_um if number > steps.before[row] else steps.along_um[row : row + 1]
    )
    x, y = steps.place_after(number)
    x0, y0 = origin_um(toolpath)
    return Ending("travel", axis, row, float(plan.time_at(along_um)[0]), float(x + x0), float(y + y0))


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
        How fast each block was to be run; None where a program for the card set its own speeds.
    plan
        What the controller planned for the whole of it.
    ended
        Where the machine stopped before its program was through; None where it ran to its end. Steps, figures and times
        are of what ran, save where they are said to be planned.
    stepped, trace
        The steps that it made, and table and wire.
    losses, peaks
        What the drives lost, and how near they came to their limits.
    history
        How the table moved over time.
    deviations
        Of steps, table and wire.
    contours
        Contours of the program with their closures.
    passes, pass_figures
        Which blocks make each pass over an edge, and what it came to, one behind the other.
    border_s
        (n + 1,) float64, planned times at which the blocks begin, and the end of the last one.
    process
        What came of the cut under sparks; None where nobody asked for that.
    tilted
        What came of a wire that leans; None of an upright one.
    reach_um
        (n,) float64, half the width of the kerf in each row.
    remains
        Kerf, pieces and sizes; None where nobody asked for them or for a drawing.
    comparison
        The cut edge beside its drawing; None where there is no drawing, or no edge.
    top
        The edge at the top of the work beside a drawing of its own; None without one, or of an upright wire.
    findings
        Of program and run, in file order; behind them one for each of `missed`.
    checked
        Those of `findings` that were known before anything moved.
    coverage
        How far their checks came.
    missed
        What its scenario expects of the report, and the report does not say; none before it is held against that.
    """

    program: Program
    scenario: Scenario
    offset: Offsetting | None
    feeds: Feeds | None
    plan: Plan
    ended: Ending | None
    stepped: BlockSteps
    trace: Trace
    losses: tuple[Loss, ...]
    peaks: tuple[Peak, ...]
    history: History
    deviations: Deviations
    contours: tuple[Contour, ...]
    passes: Passes
    pass_figures: tuple[PassFigures, ...]
    border_s: Floats
    process: ProcessRun | None
    tilted: TiltedCut | None
    reach_um: Floats
    remains: Remains | None
    comparison: Comparison | None
    findings: tuple[Finding, ...]
    checked: tuple[Finding, ...]
    coverage: Coverage
    top: Comparison | None = None
    missed: tuple[Missed, ...] = ()

    @property
    def time_s(self) -> Interval | None:
        """How long it takes, by the technology, else by no cut of this machine.

        None where a program for the card set its own speeds.
        """
        if self.feeds is None:
            return None
        if self.scenario.technology is None:
            return interval_of(self.ran_s, factor_of(np.empty(0)))
        less_s, more_s = time_spread_s(self.toolpath, self.passes, self.block_time_s, self.scenario)
        return Interval(self.ran_s - less_s, self.ran_s, self.ran_s + more_s, LEVEL)

    @property
    def has_trims(self) -> bool:
        """Whether any edge is cut in more than one pass; those who show a run speak of passes only then."""
        return any(pass_.number > 1 for pass_ in self.passes.passes)

    @property
    def pass_feed_um_s(self) -> tuple[float, ...]:
        """Feed of each pass of the offset; where the program compensates itself, that of the machine for all."""
        offset = self.scenario.offset
        if offset is not None:
            return self.scenario.pass_feeds_um_s
        feeds = self.scenario.machine.feeds(self.scenario.thickness_mm)
        return (float(feeds.cut_um_s),) * (len(self.offset.passes) if self.offset else 0)

    @property
    def ran_s(self) -> float:
        """How long the machine ran: until it stopped early, else as planned."""
        return self.plan.duration_s if self.ended is None else self.ended.t_s

    @property
    def ran_um(self) -> float:
        """Length of the exact path that ran, jumps included."""
        if self.ended is None:
            return float(self.toolpath.length_um.sum())
        return float(self.plan.at(self.ended.t_s).along_um)

    @property
    def block_time_s(self) -> Floats:
        """(n,) float64, time that each block ran, which add up to that of the run."""
        return np.diff(np.minimum(self.border_s, self.ran_s))

    @property
    def whole_contours(self) -> tuple[Contour, ...]:
        """The contours that the run came to the end of."""
        ended = self.ended
        return tuple(contour for contour in self.contours if ended is None or contour.last <= ended.row)

    @property
    def cut(self) -> Trace:
        """The trace as far as the machine ran: after a trip it stands, and cuts nothing of what follows."""
        return self.trace.until(self.ended.t_s) if self.ended else self.trace

    @property
    def toolpath(self) -> Toolpath:
        """The exact geometry that was run, the offset added."""
        return self.program.toolpath

    @property
    def block_names(self) -> BlockNames:
        """What people call its blocks."""
        return self.toolpath.source.names


class Assumptions(NamedTuple):
    """What was taken for granted in a run.

    Attributes
    ----------
    machine
        The machine.
    by_default
        Whether nobody named one.
    program
        What the text of the program leaves open.
    values
        Keys of its values that nobody has measured, as its file says.
    measured
        Its values that somebody has.
    compared
        Whether the cut was held against a drawing.
    wire_bows
        Whether the wire bows back; else it runs straight.
    """

    machine: Machine
    by_default: bool
    program: tuple[Assumption, ...]
    values: tuple[str, ...]
    measured: tuple[MeasuredValue, ...]
    compared: bool
    wire_bows: bool


def assumptions_of(run: DryRun) -> Assumptions:
    """What was taken for granted in a run."""
    scenario = run.scenario
    return Assumptions(
        machine=scenario.machine,
        by_default=scenario.machine_by_default,
        program=run.program.reading.assumptions,
        values=scenario.machine.assumed,
        measured=measured_values(scenario.machine),
        compared=run.comparison is not None,
        wire_bows=scenario.wire_lag_um > 0.0,
    )
