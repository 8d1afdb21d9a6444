"""The offset that a controller adds to a program on the drawing's contour: its path, and what cannot be cut so."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.offset.compensate import compensate
from controller.offset.gouges import TOLERANCE_UM, Gouge, gouges
from controller.offset.passes import PassedPath, PassedRound, first_without_way_back, in_passes
from controller.offset.path import Made, OffsetPath, offset_toolpath
from controller.offset.reach import reach
from controller.offset.sections import OffsetSection, Side, rounds_of
from controller.offset.shifted import closed_contour
from controller.offset.uncut import uncut_um
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Curves, Floats, Ints
from parser.program import Program
from sim.check.offset import gouge_findings, loop_findings, no_way_back, uncut_findings
from sim.setup.part import Offset


@dataclass(frozen=True, slots=True, eq=False)
class Offsetting:
    """What became of a program under an offset.

    Attributes
    ----------
    passed
        The program's own toolpath, which runs along the drawing's contour, in the passes that were asked for.
    program
        The program with the offset path as its toolpath.
    path
        The offset path, and which row of the passes each of its rows comes from.
    left_um
        (v,) float64, material beyond that of its pass that stays at each row that vanished.
    gouges
        Where the wire cuts into the contour; rows of the contour are rows of the passes.
    loops
        How many closed paths each closed section of the contour allows without a gouge, at the least offset.
    findings
        3B501 to 3B504, in file order.
    """

    passed: PassedPath
    program: Program
    path: OffsetPath
    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: tuple[int, ...]
    findings: tuple[Finding, ...]

    @property
    def pass_of_row(self) -> Ints:
        """(m,) pass of each row of the path, from 0; −1 where it belongs to none, as a jump."""
        return self.passed.number[self.path.source_row]


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
    of = np.array([one.number for one in passed.rounds], dtype=np.int64)
    by_um = np.array([one.by_um for one in offset.passes])
    side = np.where(offset.back, -offset.side, offset.side)
    path = compensate(passed.curves, passed.sections, by_um[of], side[of])
    parts = [_beside_round(passed, path, one, offset) for one in passed.rounds]
    left_um = np.concatenate([np.zeros(0), *(one.left_um for one in parts)])
    met = tuple(gouge for one in parts for gouge in one.gouges)
    closed = {
        one.round.section: beside.loops
        for one, beside in zip(passed.rounds, parts, strict=True)
        if beside.loops is not None
    }
    found = [
        *uncut_findings(program, offset, passed, path.vanished, left_um),
        *gouge_findings(program, offset, passed, path, met),
        *loop_findings(program, offset, passed, closed),
    ]
    return Offsetting(
        passed=passed,
        program=replace(program, toolpath=offset_toolpath(passed, path)),
        path=path,
        left_um=left_um,
        gouges=met,
        loops=tuple(closed.values()),
        findings=tuple(sorted(found, key=file_order)),
    )


class _Beside(NamedTuple):
    """What a pass leaves and gouges beside one section; how many loops that allows, None where nobody asks."""

    left_um: Floats
    gouges: list[Gouge]
    loops: int | None


def _beside_round(passed: PassedPath, path: OffsetPath, one: PassedRound, offset: Offset) -> _Beside:
    """What a pass over one round does to the contour.

    A wide pass leaves stock, which the pass at the least offset takes: what that one leaves stays. A gouge is one if it
    reaches into the contour with the kerf of that pass.
    """
    section, by_um = one.round.section, offset.passes[one.number].by_um
    side = Side(-offset.side if offset.back[one.number] else offset.side)
    contour = passed.curves.picked(slice(section.first, section.last + 1))
    beside = slice(*np.searchsorted(path.source_row, one.round[:2]).tolist())
    # Leads of an open section are left out: where it has none of its own, they begin and end on it.
    near = np.arange(beside.start, beside.stop)[section.closed | (path.made[beside] != Made.LEAD)]
    curves = path.curves.picked(near)
    if section.closed:
        contour = closed_contour(contour)
    met = [g for g in gouges(contour, curves, offset.by_um, side) if not _is_overhang(contour, section, g)]
    gone = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] - section.first
    counted = section.closed and one.number == offset.nearest
    return _Beside(
        left_um=uncut_um(contour, curves, by_um, gone),
        gouges=[g._replace(row=section.first + g.row, path_row=int(near[g.path_row])) for g in met],
        loops=len(reach(contour, by_um, side).loops) if counted else None,
    )


def _is_overhang(contour: Curves, section: OffsetSection, gouge: Gouge) -> bool:
    """Whether no more is cut than what the ends of a contour miss each other by, where they meet.

    Whole µm never close a contour exactly. Ends that lie side by side are joined midway, which cuts into one of them.
    """
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return section.closed and gouge.row in (0, len(contour) - 1) and gouge.depth_um <= gap_um + TOLERANCE_UM
