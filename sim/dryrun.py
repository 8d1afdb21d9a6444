"""The dry run: one program through controller, card and table, and what came of it."""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from controller.plan import Plan, plan_runs
from controller.pulses import Pulses
from controller.steps import Steps
from parser.errors import ProgramError
from parser.findings import Finding, Severity
from parser.program import Program
from parser.toolpath import Floats, Toolpath
from sim.check.engine import Demands, check_program
from sim.check.result import Coverage
from sim.contours import Contour
from sim.deviation import Deviation, DeviationMeter
from sim.motion import Motion, Progress, run_card, run_table
from sim.scenario import Scenario
from sim.table import Table, ringing
from sim.ticks import choose_ticks
from sim.trace import Trace


class PulseSink(Protocol):
    """Takes the pulses of a run as they are handed out."""

    def open(self, steps: Steps, origin_um: tuple[int, int]) -> None:
        """Get ready for all pulses of these steps."""

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates."""


class Deviations(NamedTuple):
    """Deviation of the steps and of the table from the ideal geometry.

    `interpolation` is that of the steps with each block moved to where the table stood when it began, so without what
    earlier blocks missed.
    """

    interpolation: Deviation
    steps: Deviation
    table: Deviation


@dataclass(frozen=True, slots=True, eq=False)
class DryRun:
    """All that is known after a run.

    Attributes
    ----------
    program, scenario
        What was run.
    steps, plan, trace
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
    steps: Steps
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


def dry_run(program: Program, scenario: Scenario, progress: Progress, sink: PulseSink | None = None) -> DryRun:
    """Run a program on the machine of a scenario.

    Raises ProgramError where the program asks for more than any table can do.
    """
    toolpath, machine = program.toolpath, scenario.machine
    checked = check_program(program, _demands(scenario))
    if checked.steps is None:
        raise _refusal(program, checked.findings)
    steps = checked.steps
    plan = plan_runs(toolpath, machine.feeds(scenario.thickness_mm))
    motion = Motion(steps, plan, choose_ticks(toolpath, plan, ringing(machine.table)), origin_um(toolpath))
    meters = _StepMeters(toolpath, motion)

    def take(pulses: Pulses) -> None:
        meters.take(pulses)
        if sink is not None:
            sink.take(pulses)

    if sink is not None:
        sink.open(steps, motion.origin_um)
    command = run_card(motion, take, progress)
    trace = run_table(motion, command, Table(machine.table, scenario.start_um), progress)
    of_table = DeviationMeter(toolpath)
    of_table.add(trace.row, trace.actual_um[:, 0], trace.actual_um[:, 1], trace.t_s)
    return DryRun(
        program=program,
        scenario=scenario,
        steps=steps,
        plan=plan,
        trace=trace,
        deviations=Deviations(meters.own.result(), meters.placed.result(), of_table.result()),
        contours=checked.contours,
        block_time_s=np.diff(plan.time_at(steps.along_um)),
        findings=checked.findings,
        coverage=checked.coverage,
    )


class _StepMeters:
    """Deviation of the steps where they are, and of each block from where it began."""

    def __init__(self, toolpath: Toolpath, motion: Motion) -> None:
        self.placed, self.own = DeviationMeter(toolpath), DeviationMeter(toolpath)
        self._drift = motion.steps.corner_um[:-1] + np.array(motion.origin_um) - toolpath.start_um

    def take(self, pulses: Pulses) -> None:
        x, y = pulses.x_um.astype(np.float64), pulses.y_um.astype(np.float64)
        self.placed.add(pulses.row, x, y, pulses.t_s)
        self.own.add(pulses.row, x - self._drift[:, 0][pulses.row], y - self._drift[:, 1][pulses.row], pulses.t_s)


def _demands(scenario: Scenario) -> Demands:
    return Demands(scenario.machine.table, scenario.start_um, scenario.wire.offset_um, scenario.may_stay_open)


def _refusal(program: Program, findings: tuple[Finding, ...]) -> ProgramError:
    """Error of a program that asks for more than any table can do."""
    finding = next(finding for finding in findings if finding.code == "3B206")
    return ProgramError(finding, excerpt=program.excerpt(finding.line))
