"""Before anything moves: a program checked, and its offset: the one that it compensates by, or one that is added."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.stepping.point_by_point import interpolate
from controller.stepping.steps import Steps
from parser.dialect.reader import in_codes
from parser.findings.codes import Check, Severity
from parser.findings.findings import Finding, NotSimulated, WithoutOffset
from parser.program import Program
from sim.check.engine import Checked, run_checks
from sim.check.pass_over_round import Offsetting
from sim.check.passes import asked_pass_findings
from sim.check.path_checks import Demands
from sim.check.result import CheckState, Coverage
from sim.check.travel import refusal, too_many_steps, travel_findings
from sim.run.offsetting import offsetting, refuse_twice, refuse_unknown
from sim.setup.quiz import refuse_unanswerable
from sim.setup.scenario import Scenario


class Prepared(NamedTuple):
    """A program that is ready to run.

    Attributes
    ----------
    program
        The program, its toolpath the one that runs.
    steps
        Of that toolpath, point by point.
    offset
        What the offset made of the program; None where it runs as written.
    feeds
        How fast each block is to be run.
    findings, coverage
        Of the program as it was read, and of its offset; and how far their checks came.
    """

    program: Program
    steps: Steps
    offset: Offsetting | None
    feeds: Feeds
    findings: tuple[Finding, ...]
    coverage: Coverage


def prepare(program: Program, scenario: Scenario) -> Prepared:
    """Check a program, and add the offset of the scenario.

    ProgramError where no table can do what it asks for, SettingsError where the scenario asks about a block that the
    program does not have.
    """
    checked, steps = checked_for(program, scenario)
    feeds = scenario.machine.feeds(scenario.thickness_mm)
    refuse_unknown(program, checked.findings)
    if checked.compensation is not None:
        return _compensated(checked, checked.compensation, feeds)
    if scenario.offset is None:
        return Prepared(program, steps, None, feeds, checked.findings, checked.coverage)
    offset = offsetting(program, scenario.offset)
    steps = interpolate(offset.program.toolpath)
    beyond = too_many_steps(offset.program, steps)
    if beyond:
        raise refusal(program, beyond)
    travel = travel_findings(offset.program, steps, scenario.machine.table, scenario.start_um)
    coverage = _looked_at(checked.coverage, (Check.CORNERS, Check.TRAVEL))
    by_pass = np.array([scenario.pass_feed_um_s(pass_) for pass_ in scenario.offset.passes])
    feeds = feeds._replace(cut_um_s=by_pass[offset.pass_of_row])
    added = (*offset.findings, *_between_passes(offset, scenario), *travel)
    named = program.toolpath.source.names.named(in_codes(program.reading, added))
    findings = (*_under_offset(checked.findings), *named)
    return Prepared(offset.program, steps, offset, feeds, findings, coverage)


def checked_for(program: Program, scenario: Scenario) -> tuple[Checked, Steps]:
    """The check that every run begins with, and the steps of the program as written. Raises what `prepare` does."""
    refuse_unanswerable(scenario.quiz, program.toolpath)
    refuse_twice(program, scenario.offset)
    checked = _as_run(run_checks(program, _demands(scenario)))
    if checked.steps is None:
        raise refusal(program, checked.findings)
    return checked, checked.steps


def _as_run(checked: Checked) -> Checked:
    """The checks, with an error where the machine would go another way than a run of the path here."""
    return checked._replace(
        findings=tuple(
            finding._replace(graver=Severity.ERROR)
            if isinstance(finding.fact, NotSimulated) and finding.fact.otherwise
            else finding
            for finding in checked.findings
        )
    )


def _compensated(checked: Checked, made: Offsetting, feeds: Feeds) -> Prepared:
    """A program that compensates itself: its checks were of the path that runs."""
    steps = interpolate(made.program.toolpath)
    beyond = too_many_steps(made.program, steps)
    if beyond:
        raise refusal(made.program, beyond)
    return Prepared(made.program, steps, made, feeds, checked.findings, checked.coverage)


def _demands(scenario: Scenario) -> Demands:
    """What the program is held against; with an offset, corners and travel are those of the offset path."""
    if scenario.offset is not None:
        return Demands(may_stay_open=scenario.may_stay_open, added_um=scenario.offset.by_um)
    return Demands(scenario.machine.table, scenario.start_um, scenario.wire.reach_um, scenario.may_stay_open)


def _under_offset(findings: Sequence[Finding]) -> Iterator[Finding]:
    """The findings, where one says that the path is without the controller's offset mended to say that it has it."""
    for found in findings:
        if isinstance(found.fact, WithoutOffset):
            yield found._replace(values={**found.values, "path": "path-with-offset"})
        else:
            yield found


def _between_passes(offset: Offsetting, scenario: Scenario) -> list[Finding]:
    """Findings on how the passes that were asked for follow each other.

    Passes of the program's own, and figures that it leaves open, are told of the program as it was read.
    """
    if scenario.offset is None or len(scenario.offset.passes) == 1:
        return []
    return asked_pass_findings(offset.program, offset.edge_passes, scenario.wire.reach_um)


def _looked_at(coverage: Coverage, names: Sequence[Check]) -> Coverage:
    """The coverage with some checks done after all."""
    states = (CheckState(state.name) if state.name in names else state for state in coverage.checks)
    return coverage._replace(checks=tuple(states))
