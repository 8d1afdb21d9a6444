"""The offset that a controller adds to a program on the drawing's contour: its path, and what cannot be cut so."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from controller.offset.chain import OffsetPath, offset_toolpath
from controller.offset.compensate import compensate
from controller.offset.passes import PassedPath, PassedRound, first_without_way_back, in_passes
from controller.offset.shifted import Side, closed_contour, rounds_of
from parser.findings.errors import ProgramError, SettingsError
from parser.findings.findings import Finding, file_order, telling
from parser.program import Program
from parser.shape.passes import find_passes
from sim.check.compensation.words import WithoutValue, compensation_of, is_known
from sim.check.engine import run_checks
from sim.check.offset import gouge_findings, loop_findings, no_way_back, uncut_findings
from sim.check.pass_over_round import Distances, Offsetting, PassBeside, PassOverRound, beside_round
from sim.check.path_checks import Demands
from sim.setup.part import Offset


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


def as_run(program: Program, offset: Offset | None) -> Program:
    """The program with the path that the controller makes of it: by its own compensation, by an offset, or as written.

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
