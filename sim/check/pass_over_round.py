"""A path beside its contour: what an offset makes of a program, whoever asks for it, and what it leaves and gouges."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from controller.offset.chain import OffsetPath, RowOrigin
from controller.offset.gouges import TOLERANCE_UM, Gouge, gouges, uncut_um
from controller.offset.passes import PassedPath
from controller.offset.reach import reach
from controller.offset.shifted import Round, Side
from parser.findings.findings import Finding
from parser.geometry.curves import Curves, Floats, Ints
from parser.program import Program
from parser.shape.passes import Passes


class PassBeside(NamedTuple):
    """One pass: the least distance of the wire's centre from the contour, and whether it runs against the first one."""

    by_um: float
    is_back: bool


@dataclass(frozen=True, slots=True, eq=False)
class Offsetting:
    """What became of a program under an offset.

    Attributes
    ----------
    passed
        The program's own toolpath, which runs along the drawing's contour, in the passes that are run.
    program
        The program with the offset path as its toolpath.
    path
        The offset path, and which row of the passes each of its rows comes from.
    side
        Side of the contour in the first pass, along its cutting direction.
    passes
        The passes over each contour; where contours differ, as far as the one with the most.
    edge_passes
        Which rows of the path make each pass over an edge.
    left_um
        (v,) float64, material beyond that of its pass that stays at each row that vanished.
    gouges
        Where the wire cuts into the contour; rows of the contour are rows of the passes.
    loops
        How many closed paths each closed section of the contour allows without a gouge, at the least offset.
    findings
        On all of this, in file order.
    """

    passed: PassedPath
    program: Program
    path: OffsetPath
    side: Side
    passes: tuple[PassBeside, ...]
    edge_passes: Passes
    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: tuple[int, ...]
    findings: tuple[Finding, ...]

    @property
    def by_um(self) -> float:
        """Least offset: of the pass that makes the edge."""
        return min(pass_.by_um for pass_ in self.passes)

    @property
    def pass_of_row(self) -> Ints:
        """(m,) pass of each row of the path, from 0; −1 where it belongs to none, as a jump."""
        return self.passed.number[self.path.source_row]


class Distances(NamedTuple):
    """How a pass keeps beside a contour.

    Attributes
    ----------
    by_um
        How far the wire's centre is from it.
    kerf_um
        How near it may come: a wide pass leaves stock, and gouges only with the kerf of the pass at the least offset.
    side
        On which side, in the direction of the pass.
    """

    by_um: float
    kerf_um: float
    side: Side


class PassOverRound(NamedTuple):
    """What a pass over one round does to its contour.

    Attributes
    ----------
    left_um
        (v,) material left at each row that vanished, in their order.
    gouges
        Where it cuts in, in rows of the whole path and contour.
    loops
        How many closed paths the contour allows; None where nobody asks.
    """

    left_um: Floats
    gouges: tuple[Gouge, ...]
    loops: int | None


def beside_round(contour: Curves, path: OffsetPath, round_: Round, run: Distances, *, counted: bool) -> PassOverRound:
    """What a pass over a round does to the `contour` of its section; `counted` asks for the closed paths as well."""
    section = round_.section
    near = rows_beside(path, round_)
    curves = path.curves.picked(near)
    met = [g for g in gouges(contour, curves, run.kerf_um, run.side) if not _is_overhang(contour, round_, g)]
    gone = path.vanished[slice(*np.searchsorted(path.vanished, (section.first, section.last + 1)))] - section.first
    return PassOverRound(
        left_um=uncut_um(contour, curves, run.by_um, gone),
        gouges=tuple(g._replace(row=section.first + g.row, path_row=int(near[g.path_row])) for g in met),
        loops=len(reach(contour, run.by_um, run.side).loops) if counted else None,
    )


def rows_beside(path: OffsetPath, round_: Round) -> Ints:
    """Rows of the path that come from a round. Leads of an open section are left out: they may begin and end on it."""
    rows = np.arange(*np.searchsorted(path.source_row, round_[:2]).tolist())
    near: Ints = rows[round_.section.closed | (path.made[rows] != RowOrigin.LEAD)]
    return near


def _is_overhang(contour: Curves, round_: Round, gouge: Gouge) -> bool:
    """Whether no more is cut than what the ends of a contour miss each other by, where they meet.

    Whole µm never close a contour exactly. Ends that lie side by side are joined midway, which cuts into one of them.
    """
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return round_.section.closed and gouge.row in (0, len(contour) - 1) and gouge.depth_um <= gap_um + TOLERANCE_UM
