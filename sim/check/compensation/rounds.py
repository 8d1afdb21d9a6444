"""What a program compensates: stretches of cut blocks between set-up and cancel, and the contour that each runs along.

A program says itself where compensation begins and ends. Blocks within that lead to the contour and away from it: the
wire keeps to their side as well, but the contour is the loop that the stretch closes.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.offset.sections import OffsetSection, Round, Side
from controller.offset.shifted import closed_contour
from controller.offset.stretches import known_sides
from parser.geometry.along import along_um
from parser.geometry.curves import Bools, Curves, Floats
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.loops import find_loops
from parser.shape.passes import Passes
from parser.toolpath import Compensation, Toolpath
from sim.check.beside import Distances


class CompensatedRound(NamedTuple):
    """One stretch of compensated blocks.

    Attributes
    ----------
    round
        Its blocks, the set-up and the line that cancels included, and those along the contour.
    side
        On which the wire runs along the contour, in its direction.
    by_um
        Least distance of the wire's centre from the contour.
    part_side
        +1 with the part on the left of the path, −1 on the right, 0 where nothing tells: the wire comes to the contour
        from the waste.
    edge
        Number of the edge that it runs along: passes over one edge share it.
    kerf_um
        Least distance of all stretches along the same edge: what lies nearer is cut from the part.
    is_nearest
        Whether it is the first of them at that distance, which makes the edge.
    """

    round: Round
    side: Side
    by_um: float
    part_side: int
    edge: int = -1
    kerf_um: float = 0.0
    is_nearest: bool = True

    @property
    def distances(self) -> Distances:
        """How it keeps beside its contour."""
        return Distances(self.by_um, self.kerf_um, self.side)


def moved_um(told: Compensation) -> Floats:
    """(n,) how far to the left each block is moved; 0 along a stretch of which an offset is not known."""
    moved: Floats = np.where(known_sides(told) == 0, 0.0, told.left_um)
    return moved


def compensated_rounds(toolpath: Toolpath, left_um: Floats, passes: Passes) -> tuple[CompensatedRound, ...]:
    """The stretches of a toolpath in order; `left_um` (n,) is how far to the left each block is moved.

    Neither jumps nor blocks that are not moved belong to one. One in which nothing but its set-up moves has no contour,
    and is left out.
    """
    stretches = _stretches(left_um, ~toolpath.is_jump)
    of_row = np.full(len(toolpath), -1, dtype=np.int64)
    for number, (begin, past) in enumerate(stretches):
        of_row[begin:past] = number
    loops = find_loops(toolpath, of_row, np.arange(len(stretches)))
    loop_of = {of: number for number, of in enumerate(loops.contour.tolist())}
    was_left_um = np.append(0.0, left_um[:-1])
    found = []
    for number, (begin, past) in enumerate(stretches):
        at, part_side = loop_of.get(number), 0
        section = OffsetSection(begin + bool(was_left_um[begin] == 0.0), past - 1, closed=False)
        if at is not None:
            section = OffsetSection(int(loops.first[at]), int(loops.last[at]), closed=True)
            part_side = int(loops.part_side[at])
        if section.first <= section.last:
            led_out = past < len(toolpath) and left_um[past] == 0.0 and not toolpath.is_jump[past]
            along = left_um[section.first : section.last + 1]
            by_um = float(np.abs(along).min())
            whole = Round(begin, past + bool(led_out), section)
            found.append(CompensatedRound(whole, Side(int(np.sign(along[0]))), by_um, part_side))
    return _by_edge(found, passes)


def _stretches(left_um: Floats, is_cut: Bools) -> list[tuple[int, int]]:
    """First row of each run of cut blocks that are moved to one side, and one past its last."""
    way = np.concatenate([[0.0], np.sign(left_um) * is_cut, [0.0]])
    borders = np.flatnonzero(np.diff(way))
    return [(low, high) for low, high in zip(borders[:-1].tolist(), borders[1:].tolist(), strict=True) if way[low + 1]]


def contour_of(curves: Curves, section: OffsetSection) -> Curves:
    """The contour of a section; the last block of a loop is cut off where the loop is closed, if it runs on past it."""
    contour = curves.picked(slice(section.first, section.last + 1))
    if not section.closed:
        return contour
    gap_um = float(np.hypot(*(contour.end_um[-1] - contour.start_um[0])))
    return contour if gap_um == 0.0 else closed_contour(contour if gap_um <= CLOSED_WITHIN_UM else _cut_off(contour))


def _cut_off(contour: Curves) -> Curves:
    """The contour with its last block up to the place nearest to where it begins."""
    last = np.array([len(contour) - 1])
    length_um = contour.length_um.copy()
    length_um[last] = along_um(contour, last, contour.start_um[:1])
    end_um, sweep_rad = contour.end_um.copy(), contour.sweep_rad.copy()
    end_um[last] = contour.start_um[:1]
    sweep_rad[last] *= length_um[last] / contour.length_um[last]
    return replace(contour, end_um=end_um, sweep_rad=sweep_rad, length_um=length_um)


def _by_edge(rounds: list[CompensatedRound], passes: Passes) -> tuple[CompensatedRound, ...]:
    """The stretches, each with its edge and what those along it come to."""
    middle = [(one.round.section.first + one.round.section.last) // 2 for one in rounds]
    number = [int(passes.of_row[row]) for row in middle]
    edge = [passes.passes[of].edge if of >= 0 else -1 - at for at, of in enumerate(number)]
    nearest: dict[int, int] = {}
    for at in sorted(range(len(rounds)), key=lambda at: rounds[at].by_um):
        nearest.setdefault(edge[at], at)
    return tuple(
        one._replace(edge=of, kerf_um=rounds[nearest[of]].by_um, is_nearest=nearest[of] == at)
        for at, (of, one) in enumerate(zip(edge, rounds, strict=True))
    )
