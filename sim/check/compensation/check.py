"""The check of a program's own compensation: its words, the path that comes of it, and that path beside the contour."""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.offset.passes import PassedPath, PassedRound
from controller.offset.path import OffsetPath, offset_toolpath
from controller.offset.programmed import compensated
from controller.offset.sections import Side
from parser.findings.findings import file_order
from parser.geometry.curves import Bools, Floats
from parser.program import Program
from parser.shape.passes import Passes
from parser.told.compensation import Compensation
from parser.toolpath import Toolpath
from sim.check.beside import Offsetting
from sim.check.compensation.contours import contour_findings
from sim.check.compensation.held import Held, held
from sim.check.compensation.passes import drawn_passes, passes_beside, path_passes
from sim.check.compensation.rounds import CompensatedRound, compensated_rounds, moved_um
from sim.check.compensation.words import word_findings


class OwnCompensation(NamedTuple):
    """What a program's own compensation makes of it, and the passes of its own toolpath, as drawn."""

    made: Offsetting
    drawn_passes: Passes


def own_compensation(program: Program, told: Compensation, is_judged: Bools) -> OwnCompensation:
    """What the compensation of a program, as `told`, makes of it.

    Stretches whose offset is not known run on the contour. `is_judged` (n,) is False on blocks of contours that are not
    whole: no findings come of their shape.
    """
    drawn = program.toolpath
    made = compensated(drawn)
    stretches = held(drawn, made.path, compensated_rounds(drawn, moved_um(told)))
    runs = [one.run for one in stretches]
    judged = [one for one in stretches if is_judged[slice(*one.run.round[:2])].all()]
    found = [
        *word_findings(program, told, made.alarms, [run.wedge for run in runs]),
        *contour_findings(program, made.path, judged, made.alarms),
    ]
    passes = drawn_passes(runs, len(drawn))
    passed = _as_written(drawn, runs, passes)
    offset = Offsetting(
        passed=passed,
        program=replace(program, toolpath=offset_toolpath(passed, made.path)),
        path=made.path,
        side=Side(int(told.side[np.flatnonzero(told.side)[0]])),
        passes=passes_beside(runs, moved_um(told)),
        edge_passes=path_passes(runs, made.path),
        left_um=_left_um(made.path, stretches),
        gouges=tuple(gouge for one in stretches for gouge in one.beside.gouges),
        loops=tuple(one.beside.loops for one in stretches if one.beside.loops is not None),
        findings=tuple(sorted(found, key=file_order)),
    )
    return OwnCompensation(offset, passes)


def _as_written(drawn: Toolpath, runs: Sequence[CompensatedRound], passes: Passes) -> PassedPath:
    """The toolpath as passes that the program writes out itself."""
    number = np.array([*(one.number - 1 for one in passes.passes), -1], dtype=np.int64)[passes.of_row]
    rounds = tuple(PassedRound(one.round, one.along.number - 1) for one in runs)
    forward = np.zeros(len(drawn), dtype=np.bool_)
    return PassedPath(drawn, drawn.picked(slice(None)), np.arange(len(drawn)), number, forward, rounds, drawn.stops)


def _left_um(path: OffsetPath, stretches: Sequence[Held]) -> Floats:
    """(v,) what stays at each row that vanished; 0 at those that lead to a contour or away from it."""
    left_um = np.zeros(len(path.vanished))
    for one in stretches:
        section = one.run.round.section
        left_um[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] = one.beside.left_um
    return left_um
