"""The check of a program's own compensation: its words, the path that comes of it, and that path beside the contour."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from controller.offset.passes import PassedPath, PassedRound
from controller.offset.path import OffsetPath, offset_toolpath
from controller.offset.programmed import compensated
from controller.offset.sections import Side
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Bools, Floats
from parser.program import Program
from parser.shape.passes import Passes
from parser.toolpath import Compensation, Toolpath
from sim.check.beside import Offsetting, PassBeside
from sim.check.compensation.contours import Held, contour_findings, held
from sim.check.compensation.rounds import CompensatedRound, compensated_rounds, moved_um
from sim.check.compensation.words import word_findings


def own_offsetting(program: Program, told: Compensation, passes: Passes, is_judged: Bools) -> Offsetting:
    """What the compensation of a program, as `told`, makes of it.

    Stretches whose offset is not known run on the contour. `is_judged` (n,) is False on blocks of contours that are not
    whole: no findings come of their shape.
    """
    drawn = program.toolpath
    made = compensated(drawn)
    stretches = held(drawn, made.path, compensated_rounds(drawn, moved_um(told), passes))
    judged = [one for one in stretches if is_judged[slice(*one.run.round[:2])].all()]
    found = [
        *word_findings(program, told, made.alarms),
        *contour_findings(program, made.path, judged, made.alarms),
    ]
    passed = _as_written(drawn, [one.run for one in stretches], passes)
    return Offsetting(
        passed=passed,
        program=replace(program, toolpath=offset_toolpath(passed, made.path)),
        path=made.path,
        side=Side(int(told.side[np.flatnonzero(told.side)[0]])),
        passes=_passes([one.run for one in stretches], passed, passes),
        left_um=_left_um(made.path, stretches),
        gouges=tuple(gouge for one in stretches for gouge in one.beside.gouges),
        loops=tuple(one.beside.loops for one in stretches if one.beside.loops is not None),
        findings=tuple(sorted((_coded(program, finding) for finding in found), key=file_order)),
    )


def _coded(program: Program, finding: Finding) -> Finding:
    """The finding under the code that it has in the program's dialect."""
    return finding._replace(code=program.reading.codes.get(finding.code, finding.code))


def _as_written(drawn: Toolpath, runs: Sequence[CompensatedRound], passes: Passes) -> PassedPath:
    """The toolpath as passes that the program writes out itself."""
    n = len(drawn)
    number_of_pass = np.array([one.number - 1 for one in passes.passes] + [-1], dtype=np.int64)
    number = number_of_pass[passes.of_row]
    rounds = tuple(PassedRound(one.round, max(int(number[one.round.section.first]), 0)) for one in runs)
    rows, forward = np.arange(n), np.zeros(n, dtype=np.bool_)
    return PassedPath(drawn, drawn.picked(slice(None)), rows, number, forward, rounds, drawn.stops)


def _passes(runs: Sequence[CompensatedRound], passed: PassedPath, passes: Passes) -> tuple[PassBeside, ...]:
    """What the passes of each number are: the least offset of all, and the direction of the first."""
    count = max([one.number for one in passes.passes], default=0)
    back = {one.number - 1: one.is_back for one in reversed(passes.passes)}
    by_um: dict[int, float] = {}
    for run, one in zip(runs, passed.rounds, strict=True):
        by_um[one.number] = min(run.by_um, by_um.get(one.number, np.inf))
    return tuple(PassBeside(by_um.get(number, 0.0), back.get(number, False)) for number in range(count))


def _left_um(path: OffsetPath, stretches: Sequence[Held]) -> Floats:
    """(v,) what stays at each row that vanished; 0 at those that lead to a contour or away from it."""
    left_um = np.zeros(len(path.vanished))
    for one in stretches:
        section = one.run.round.section
        left_um[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] = one.beside.left_um
    return left_um
