"""The dry run: one program through controller, card and table, and what came of it."""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from controller.card.log import CardLog
from controller.host.entries import Drive
from controller.motion.limits import row_limits
from controller.motion.plan import Plan
from controller.motion.planner import plan_rows
from controller.stepping.pulses import Pulses
from controller.stepping.steps import Steps
from parser.errors import ProgramError
from parser.findings import Finding, Severity
from parser.program import Program
from parser.toolpath import Floats, Toolpath
from sim.check.engine import Demands, check_program
from sim.check.result import Coverage
from sim.contours import Contour, find_contours
from sim.deviation import Deviation, DeviationMeter
from sim.meters import Sampling, SamplingMeter, StepMeters
from sim.motion import Motion, Progress, run_card, run_table
from sim.scenario import Scenario
from sim.stepped import Stepped, StepTally
from sim.table import Table, ringing
from sim.ticks import choose_ticks
from sim.trace import Trace


class PulseSink(Protocol):
    """Takes the pulses of a run as they are handed out."""

    def open(self, origin_um: tuple[int, int]) -> None:
        """Get ready for pulses that start from here."""

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates."""


class Deviations(NamedTuple):
    """Deviation of the steps and of the table from the ideal geometry.

    `interpolation` is that of the steps with each block moved to where the table stood when it began, so without what
    earlier blocks missed. `sampling` is known of the card's own interpolator alone.
    """

    interpolation: Deviation
    steps: Deviation
    table: Deviation
    sampling: Sampling | None


@dataclass(frozen=True, slots=True, eq=False)
class DryRun:
    """All that is known after a run.

    Attributes
    ----------
    program, scenario
        What was run.
    stepped, plan, trace
        What the controller made of it, and the table.
    deviations
        Of steps and table.
    contours
        Contours with their closures.
    block_time_s
        (n,) float64, planned time in each block.
    findings
        Of program and run, in file order.
    coverage
        How far their checks came.
    """

    program: Program
    scenario: Scenario
    stepped: Stepped
    plan: Plan
    trace: Trace
    deviations: Deviations
    contours: tuple[Contour, ...]
    block_time_s: Floats
    findings: tuple[Finding, ...]
    coverage: Coverage

    @property
    def toolpath(self) -> Toolpath:
        """The exact geometry that was run."""
        return self.program.toolpath


def verdict(findings: tuple[Finding, ...]) -> str:
    """``fail`` where any finding is an error, else ``pass``."""
    return "fail" if any(finding.severity is Severity.ERROR for finding in findings) else "pass"


def origin_um(toolpath: Toolpath) -> tuple[int, int]:
    """Start of the program in whole µm, where the steps begin."""
    x, y = np.rint(toolpath.start_um[0]).astype(int).tolist()
    return x, y


def dry_run(
    program: Program,
    scenario: Scenario,
    progress: Progress,
    sink: PulseSink | None = None,
    log: CardLog | None = None,
) -> DryRun:
    """Run a program on the machine of a scenario; its pulses go to `sink`, the calls to its card to `log`.

    Raises ProgramError where the program asks for more than any table can do.
    """
    checked = check_program(program, _demands(scenario))
    if checked.steps is None:
        raise _refusal(program, checked.findings)
    toolpath, motion = program.toolpath, _motion(program.toolpath, scenario)
    meters = _Meters(motion, checked.steps)
    sinks = [meters.take]
    if sink is not None:
        sink.open(motion.drive.origin_um)
        sinks.append(sink.take)

    def take(pulses: Pulses) -> None:
        for taker in sinks:
            taker(pulses)

    command = run_card(motion, take, progress, log)
    trace = run_table(motion, command, Table(scenario.machine.table, scenario.start_um), progress)
    stepped = meters.tally.result()
    plan = motion.drive.plan
    return DryRun(
        program=program,
        scenario=scenario,
        stepped=stepped,
        plan=plan,
        trace=trace,
        deviations=meters.deviations(trace),
        contours=find_contours(toolpath, stepped.corner_um),
        block_time_s=_block_times(plan, checked.steps.along_um),
        findings=checked.findings,
        coverage=checked.coverage,
    )


def _block_times(plan: Plan, before_um: Floats) -> Floats:
    """Planned time (n,) s in each block, which add up to the whole."""
    reached = plan.time_at(before_um)
    reached[-1] = plan.duration_s
    return np.diff(reached)


def _motion(toolpath: Toolpath, scenario: Scenario) -> Motion:
    controller = scenario.machine.controller
    limits = row_limits(toolpath, scenario.machine.feeds(scenario.thickness_mm), controller.limits)
    plan = plan_rows(limits, jerk_um_s3=controller.limits.jerk_um_s3)
    drive = Drive(toolpath, limits, plan, origin_um(toolpath), controller.interpolation)
    return Motion(drive, controller.card_settings, choose_ticks(toolpath, plan, ringing(scenario.machine.table)))


class _Meters:
    """All that is measured of the pulses of a run."""

    def __init__(self, motion: Motion, steps: Steps) -> None:
        drive = motion.drive
        self._toolpath = drive.toolpath
        own = drive.interpolation == "card"
        start = drive.toolpath.start_um
        drift = np.array(drive.origin_um) - (start[:1] if own else start - steps.corner_um[:-1])
        self._steps = StepMeters(drive, np.broadcast_to(drift, start.shape))
        self._sampling = SamplingMeter(drive, motion.card.servo_period_s) if own else None
        self.tally = StepTally(len(drive.toolpath), drive.origin_um)

    def take(self, pulses: Pulses) -> None:
        self._steps.take(pulses)
        self.tally.take(pulses)
        if self._sampling is not None:
            self._sampling.take(pulses)

    def deviations(self, trace: Trace) -> Deviations:
        of_table = DeviationMeter(self._toolpath)
        of_table.add(trace.row, trace.actual_um[:, 0], trace.actual_um[:, 1], trace.t_s)
        sampling = self._sampling.result() if self._sampling is not None else None
        return Deviations(self._steps.own, self._steps.placed, of_table.result(), sampling)


def _demands(scenario: Scenario) -> Demands:
    return Demands(scenario.machine.table, scenario.start_um, scenario.wire.offset_um, scenario.may_stay_open)


def _refusal(program: Program, findings: tuple[Finding, ...]) -> ProgramError:
    """Error of a program that asks for more than any table can do."""
    finding = next(finding for finding in findings if finding.code == "3B206")
    return ProgramError(finding, excerpt=program.excerpt(finding.line))
