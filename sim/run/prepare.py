"""Before anything moves: a program checked, and its offset, its own or one that the controller adds.

The offset that a controller adds to a program on the drawing's contour: its path, and what cannot be cut so.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.offset.chain import OffsetPath, offset_toolpath
from controller.offset.compensate import compensate
from controller.offset.passes import PassedPath, PassedRound, first_without_way_back, in_passes
from controller.offset.shifted import Side, closed_contour, rounds_of
from controller.stepping.steps import Steps, interpolate
from controller.taper.tilted import TiltedPath
from parser.dialect.reader import in_codes
from parser.findings.codes import Check, Severity
from parser.findings.errors import ProgramError, SettingsError
from parser.findings.findings import Finding, NotSimulated, WithoutOffset, file_order, telling
from parser.geometry.curves import Floats
from parser.program import Program, upper_program
from parser.shape.passes import Passes, find_passes, pass_numbers
from parser.toolpath import Toolpath
from sim.check.compensation.check import WithoutValue, compensation_of, is_known
from sim.check.lean import LeanDemands, Offsets, leaning_offset, own_offsets, tilted_path, with_upper
from sim.check.offset import (
    Distances,
    Offsetting,
    PassBeside,
    PassOverRound,
    beside_round,
    gouge_findings,
    loop_findings,
    no_way_back,
    uncut_findings,
)
from sim.check.passes import asked_pass_findings
from sim.check.path_checks import Checked, Demands, run_checks
from sim.check.result import CheckState, Coverage
from sim.check.taper import not_widened, taper_findings, top_offset_findings
from sim.check.travel import refusal, too_many_steps, travel_findings
from sim.setup.part import Offset
from sim.setup.quiz import refuse_unanswerable
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings


def offsetting(program: Program, offset: Offset) -> Offsetting:
    """Run a program's toolpath through the controller's compensation, each contour once for each pass.

    ProgramError where a pass cannot begin.
    """
    drawn = program.toolpath
    rounds = rounds_of(drawn)
    stuck = first_without_way_back(drawn, rounds, offset.back)
    if stuck is not None:
        finding = no_way_back(program, stuck)
        raise ProgramError(finding, excerpt=program.excerpt(finding.line))
    passed = in_passes(drawn, rounds, offset.back)
    of = np.array([round_.number for round_ in passed.rounds], dtype=np.int64)
    by_um = np.array([pass_.by_um for pass_ in offset.passes])
    side = np.where(offset.back, -offset.side, offset.side)
    path = compensate(passed.curves, passed.sections, by_um[of], side[of])
    parts = [_pass_over_round(passed, path, round_, offset) for round_ in passed.rounds]
    left_um = np.concatenate([np.zeros(0), *(part.left_um for part in parts)])
    met = tuple(gouge for part in parts for gouge in part.gouges)
    closed = {
        round_.round.section: distances.loops
        for round_, distances in zip(passed.rounds, parts, strict=True)
        if distances.loops is not None
    }
    found = [
        *uncut_findings(program, offset, passed, path.vanished, left_um),
        *gouge_findings(program, offset, passed, path, met),
        *loop_findings(program, offset, passed, closed),
    ]
    run = replace(program, toolpath=offset_toolpath(passed, path))
    return Offsetting(
        passed=passed,
        program=run,
        path=path,
        side=offset.side,
        passes=tuple(PassBeside(pass_.by_um, back) for pass_, back in zip(offset.passes, offset.back, strict=True)),
        edge_passes=find_passes(run.toolpath),
        left_um=left_um,
        gouges=met,
        loops=tuple(closed.values()),
        findings=tuple(sorted(found, key=file_order)),
    )


def refuse_twice(program: Program, offset: Offset | None) -> None:
    """SettingsError where an offset is asked for besides the compensation of the program's own."""
    if offset is not None and compensation_of(program.toolpath) is not None:
        raise SettingsError("compensates-itself", name=program.name)


def refuse_unknown(program: Program, findings: Sequence[Finding]) -> None:
    """ProgramError (ISO500, ISO501) where a program compensates by what nobody tells; `findings` has it."""
    compensation = compensation_of(program.toolpath)
    if compensation is not None and not is_known(compensation):
        finding, _ = next(telling(findings, WithoutValue))
        raise ProgramError(finding, excerpt=program.excerpt(finding.line))


def as_run_in(program: Program, scenario: Scenario) -> Program:
    """The program with the path that the controller of a scenario makes of it. Raises what `as_run` does."""
    return as_run(program, leaning_offset(scenario.offset, scenario.taper))


def as_run(program: Program, offset: Offset | None) -> Program:
    """The program with the path that a controller makes of it: by its own compensation, by an offset, or as written.

    SettingsError where both are asked for, ProgramError where it cannot run.
    """
    refuse_twice(program, offset)
    if offset is not None:
        return offsetting(program, offset).program
    if compensation_of(program.toolpath) is None:
        return program
    checked = run_checks(program, Demands())
    refuse_unknown(program, checked.findings)
    return program if checked.compensation is None else checked.compensation.program


def _pass_over_round(passed: PassedPath, path: OffsetPath, passed_round: PassedRound, offset: Offset) -> PassOverRound:
    """What a pass over one round does to the contour; how many loops that allows is asked at the least offset."""
    section = passed_round.round.section
    contour = passed.curves.picked(slice(section.first, section.last + 1))
    side = Side(-offset.side if offset.back[passed_round.number] else offset.side)
    run = Distances(offset.passes[passed_round.number].by_um, offset.by_um, side)
    counted = section.closed and passed_round.number == offset.nearest
    return beside_round(
        closed_contour(contour) if section.closed else contour, path, passed_round.round, run, counted=counted
    )


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
    tilt
        The way of a wire that leans; None of an upright one.
    top
        What the offset made of the upper contour; None where there is none, or no offset.
    """

    program: Program
    steps: Steps
    offset: Offsetting | None
    feeds: Feeds
    findings: tuple[Finding, ...]
    coverage: Coverage
    tilt: TiltedPath | None = None
    top: Offsetting | None = None


def prepare(program: Program, scenario: Scenario) -> Prepared:
    """Check a program, add the offset of the scenario, and let the wire lean.

    ProgramError where no table can do what it asks for, or where its blocks and those of its upper contour do not
    match; SettingsError where the scenario asks about a block that the program does not have, and for what
    `tilted_path` refuses.
    """
    taper = scenario.taper
    program = with_upper(program, taper)
    ready = _in_plane(program, replace(scenario, offset=leaning_offset(scenario.offset, taper)))
    demands = LeanDemands(taper or TaperSettings(), scenario.known_guides, scenario.thickness_mm)
    offsets = _offsets(program, ready.offset, scenario.offset)
    return ready._replace(tilt=tilted_path(program, offsets, demands), top=offsets.top)


def _offsets(program: Program, plane: Offsetting | None, added: Offset | None) -> Offsets:
    """What an offset made of a program, `plane`, with what it makes of its upper contour."""
    if plane is None or added is None or program.toolpath.upper is None:
        return own_offsets(program, plane)
    return Offsets(plane, offsetting(upper_program(program), added))


def _in_plane(program: Program, scenario: Scenario) -> Prepared:
    """A program with the offset of a scenario, both as they are in the program plane."""
    checked, steps = checked_for(program, scenario)
    feeds = _feeds(program, scenario)
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
    by_pass = np.array(scenario.pass_feeds_um_s)
    feeds = feeds._replace(cut_um_s=by_pass[offset.pass_of_row])
    added = (*offset.findings, *_between_passes(offset, scenario), *travel)
    named = program.toolpath.source.names.named(in_codes(program.reading, added))
    findings = (*_under_offset(checked.findings), *named)
    return Prepared(offset.program, steps, offset, feeds, findings, coverage)


def tilt_findings(ready: Prepared, scenario: Scenario) -> Iterator[Finding]:
    """Findings 3B701 to 3B710 on a wire that leans; none on an upright one."""
    if ready.tilt is None:
        return
    table, start_um = scenario.machine.table, scenario.start_um
    yield from taper_findings(ready.program, ready.tilt, scenario.known_guides, table, start_um)
    yield from top_offset_findings(ready.program, Offsets(ready.offset, ready.top))
    if ready.offset is None and scenario.taper is not None and scenario.taper.angle_rad:
        yield from not_widened(ready.program, scenario.taper.angle_rad, scenario.wire.reach_um)


def in_file_order(ready: Prepared, found: Sequence[Finding]) -> tuple[Finding, ...]:
    """All findings in file order, those `found` beyond the checks in the codes of the program's dialect."""
    program = ready.program
    coded = program.toolpath.source.names.named(in_codes(program.reading, found))
    return tuple(sorted([*ready.findings, *coded], key=file_order))


def _feeds(program: Program, scenario: Scenario) -> Feeds:
    """How fast each block of a program is to be run: as the technology has its pass, else at the machine's own rate."""
    feeds = scenario.machine.feeds(scenario.thickness_mm)
    if scenario.technology is None or scenario.offset is not None:
        return feeds
    number = pass_numbers(program.toolpath, find_passes(program.toolpath))
    of_pass = [scenario.technology_feed_um_s(each) for each in range(1, int(number.max(initial=1)) + 1)]
    return feeds._replace(cut_um_s=np.array(of_pass)[number - 1])


def time_spread_s(toolpath: Toolpath, passes: Passes, row_s: Floats, scenario: Scenario) -> tuple[float, float]:
    """By how much the time of a path may be less, and by how much more, as the technology has its feeds, s.

    `row_s` (n,) is what each row takes. All passes are as fast, or as slow, as they may be: who errs in one mostly errs
    in all.
    """
    number = pass_numbers(toolpath, passes)
    ratios = np.array([scenario.technology_of(each).time_ratios for each in range(1, int(number.max(initial=1)) + 1)])
    cut_s = np.where(toolpath.is_jump, 0.0, row_s)
    less_s, more_s = (cut_s @ np.abs(ratios - 1.0)[number - 1]).tolist()
    return less_s, more_s


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
        return Demands(may_stay_open=scenario.may_stay_open, added_um=scenario.offset.by_um, has_heights=True)
    return Demands(
        scenario.machine.table, scenario.start_um, scenario.wire.reach_um, scenario.may_stay_open, has_heights=True
    )


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
