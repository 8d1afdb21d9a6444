"""What a program compensates: stretches of cut blocks between set-up and cancel, and the contour that each runs along.

A program says itself where compensation begins and ends. Blocks within that lead to the contour and away from it: the
wire keeps to their side as well, but the contour is the loop that the stretch closes.

Which contours that a program compensates are one edge: a program writes each pass over it along the same places.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import OffsetSection, Round, Side, closed_contour
from controller.offset.stretches import known_sides
from parser.controller_words import Compensation
from parser.geometry.along import along_um, headings_along, places, places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, extents, joined
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import nearest_um
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.shape.loops import find_loops
from parser.toolpath import Toolpath
from sim.check.offset import Distances

_ON_UM = CLOSED_WITHIN_UM  # whole µm, and arcs that were drawn anew for a later pass
_MOST = 0.5  # of a contour that runs along another


class Along(NamedTuple):
    """A contour among all of a program.

    Attributes
    ----------
    edge
        Number of its edge, from 0 in the order first cut.
    number
        Of its pass over this edge, from 1.
    is_back
        Whether it runs against the first pass over this edge.
    is_tab
        Whether it cuts what the first pass leaves between its ends.
    """

    edge: int
    number: int
    is_back: bool
    is_tab: bool


ALONE = Along(0, 1, is_back=False, is_tab=False)
"""The only contour."""


class _Edge(NamedTuple):
    """The first contour along an edge: its curves, its box (2, 2), its length, and whether it closes."""

    curves: Curves
    box_um: Floats
    length_um: float
    is_closed: bool


def edges_of_contours(contours: Sequence[Curves]) -> tuple[Along, ...]:
    """Edges of the contours, each of them in the order in which it is cut."""
    ones = [_edge(curves) for curves in contours]
    boxes = np.empty((2, 2, len(ones)))  # of the first contour of each edge: low and high, X and Y
    first: list[int] = []  # contour of each edge
    counts: list[int] = []
    found = []
    for at, contour_edge in enumerate(ones):
        near = np.flatnonzero(_meets(boxes[:, :, : len(first)], contour_edge.box_um)).tolist()
        of, is_tab = next(_matches(contour_edge, {edge: ones[first[edge]] for edge in near}), (len(first), False))
        if of == len(first):
            boxes[:, :, of] = contour_edge.box_um
            first.append(at)
            counts.append(0)
        counts[of] += 1
        is_back = counts[of] > 1 and _is_back(contour_edge, ones[first[of]], is_tab)
        found.append(Along(of, counts[of], is_back, is_tab))
    return tuple(found)


def _meets(boxes_um: Floats, box_um: Floats) -> Bools:
    """(k,) whether boxes (2, 2, k) overlap another one (2, 2); by whole columns, for there may be thousands."""
    (low_x, low_y), (high_x, high_y) = boxes_um
    (x0, y0), (x1, y1) = (box_um[0] - _ON_UM).tolist(), (box_um[1] + _ON_UM).tolist()
    overlaps: Bools = (low_x <= x1) & (high_x >= x0) & (low_y <= y1) & (high_y >= y0)
    return overlaps


def _edge(curves: Curves) -> _Edge:
    low, high = extents(curves)
    gap_um = float(np.hypot(*(curves.end_um[-1] - curves.start_um[0])))
    box = np.stack([low.min(axis=0), high.max(axis=0)])
    return _Edge(curves, box, float(curves.length_um.sum()), gap_um <= CLOSED_WITHIN_UM)


def _matches(each_edge: _Edge, edges: Mapping[int, _Edge]) -> Iterator[tuple[int, bool]]:
    """Of some edges, by their numbers, those that a contour runs along, or whose tab it cuts."""
    for number, other in edges.items():
        shorter, longer = sorted((each_edge, other), key=lambda edge: edge.length_um)
        if shorter.length_um >= _MOST * longer.length_um and _share_on(shorter.curves, longer.curves) >= _MOST:
            yield number, False
        elif _is_tab(each_edge, other):
            yield number, True


def _share_on(curves: Curves, other: Curves) -> float:
    """Share of the length of curves that runs along others, by the middles of the curves."""
    middle = places(curves, np.arange(len(curves)), np.full(len(curves), 0.5))
    on = nearest_um(other, middle, _ON_UM) <= _ON_UM
    return float(curves.length_um[on].sum() / max(float(curves.length_um.sum()), 1e-9))


def _is_tab(this: _Edge, other: _Edge) -> bool:
    """Whether a contour goes from one end of an open one to the other, at most a little way along it."""
    if other.is_closed or this.is_closed or this.length_um > _MOST * other.length_um:
        return False
    ends = np.stack([other.curves.start_um[0], other.curves.end_um[-1]])
    return bool((nearest_um(this.curves, ends, _ON_UM) <= _ON_UM).all())


def _is_back(edge: _Edge, first: _Edge, is_tab: bool) -> bool:
    """Whether a contour runs against the first one along its edge, or its tab from the start of that one to its end."""
    if is_tab:
        from_end = np.hypot(*(edge.curves.start_um[0] - first.curves.end_um[-1]))
        return bool(np.hypot(*(edge.curves.start_um[0] - first.curves.start_um[0])) < from_end)
    row = np.array([int(np.argmax(edge.curves.length_um))])
    place = places(edge.curves, row, np.array([0.5]))
    rows = np.arange(len(first.curves))
    off, _ = distance_to_curves(first.curves, rows, *np.broadcast_to(place, (len(rows), 2)).T)
    near = np.array([int(np.argmin(off))])
    way = headings_along(first.curves, near, along_um(first.curves, near, place))
    own = headings_along(edge.curves, row, 0.5 * edge.curves.length_um[row])
    return float((way * own).sum()) < 0.0


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
    wedge
        Row of the contour that begins at another offset and ends at this one; −1 where there is none.
    at_jump
        Whether the contour begins or ends at a jump: controllers differ in how a jump and a block make a corner.
    along
        Which edge it runs along, and in which pass.
    kerf_um
        Least distance of all stretches along the same edge, or along its tab: what lies nearer is cut from the part.
    is_nearest
        Whether it is the first of them at that distance, which makes the edge.
    """

    round: Round
    side: Side
    by_um: float
    part_side: int
    wedge: int = -1
    at_jump: bool = False
    along: Along = ALONE
    kerf_um: float = 0.0
    is_nearest: bool = True

    @property
    def distances(self) -> Distances:
        """How it keeps beside its contour."""
        return Distances(self.by_um, self.kerf_um, self.side)


def moved_um(compensation: Compensation) -> Floats:
    """(n,) how far to the left each block is moved; 0 along a stretch of which an offset is not known."""
    moved: Floats = np.where(known_sides(compensation) == 0, 0.0, compensation.left_um)
    return moved


def compensated_rounds(toolpath: Toolpath, left_um: Floats) -> tuple[CompensatedRound, ...]:
    """The stretches of a toolpath in order; `left_um` (n,) is how far to the left each block is moved.

    Neither jumps nor blocks that are not moved belong to one, and where the offset changes another one begins. What
    moves but closes no loop, between the same set-up and cancel as one that does, leads to that one or away from it.
    """
    stretches = _stretches(left_um, toolpath.is_jump)
    is_jump = np.concatenate([[False], toolpath.is_jump, [False]])  # of the block before each
    of_row = np.full(len(toolpath), -1, dtype=np.int64)
    for number, stretch in enumerate(stretches):
        of_row[stretch.begin : stretch.past] = number
    loops = find_loops(toolpath, of_row, np.arange(len(stretches)))
    loop_of = {of: number for number, of in enumerate(loops.contour.tolist())}
    with_loop = {stretches[of].together for of in loop_of}
    found = []
    for number, stretch in enumerate(stretches):
        at, part_side = loop_of.get(number), 0
        section = OffsetSection(stretch.begin + int(stretch.is_led_in), stretch.past - 1, closed=False)
        if at is not None:
            section = OffsetSection(int(loops.first[at]), int(loops.last[at]), closed=True)
            part_side = int(loops.part_side[at])
        if section.first <= section.last and (at is not None or stretch.together not in with_loop):
            led_out = (
                stretch.past < len(toolpath) and left_um[stretch.past] == 0.0 and not toolpath.is_jump[stretch.past]
            )
            side, by_um = Side(int(np.sign(left_um[stretch.begin]))), abs(float(left_um[stretch.begin]))
            begin = stretch.begin if section.closed else section.first
            wedge = stretch.begin if section.first == stretch.begin and stretch.is_led_in else -1
            whole = Round(begin, stretch.past + bool(led_out), section)
            at_jump = is_jump[[section.first, section.last + 2]].any()
            found.append(CompensatedRound(whole, side, by_um, part_side, wedge, bool(at_jump)))
    return _by_edge(toolpath, found)


class _Stretch(NamedTuple):
    """Blocks from `begin` up to but without `past` at one offset.

    Whether the first one comes from another offset to the same side, or from none; and a number that the stretch shares
    with those that no jump and no cancel parts from it.
    """

    begin: int
    past: int
    is_led_in: bool
    together: int


def _stretches(left_um: Floats, is_jump: Bools) -> list[_Stretch]:
    """Stretches of rows (n,) that are moved."""
    way = np.concatenate([[0.0], np.where(is_jump, 0.0, left_um), [0.0]])
    before = np.append(0.0, left_um)
    found: list[_Stretch] = []
    for low, high in pairwise(np.flatnonzero(np.diff(way)).tolist()):
        if way[low + 1]:
            was = float(before[low])
            together = found[-1].together if found and way[low] else len(found)
            is_led_in = bool(was * left_um[low] >= 0.0 and was != left_um[low])
            found.append(_Stretch(low, high, is_led_in, together))
    return found


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
    until_um = along_um(contour, last, contour.start_um[:1])
    return joined([contour.picked(slice(-1)), parts_of(contour, last, np.zeros(1), until_um)])


def parts_of(curves: Curves, row: Ints, first_um: Floats, last_um: Floats) -> Curves:
    """Parts of the curves `row` (k,), from a length (k,) along each to another."""
    whole = curves.picked(row)
    at = np.arange(len(row))
    share = 1.0 / np.where(whole.length_um > 0.0, whole.length_um, 1.0)
    return replace(
        whole,
        start_um=places_at(whole, at, first_um),
        end_um=places_at(whole, at, last_um),
        start_angle_rad=whole.start_angle_rad + first_um * share * whole.sweep_rad,
        sweep_rad=(last_um - first_um) * share * whole.sweep_rad,
        length_um=last_um - first_um,
    )


def _by_edge(toolpath: Toolpath, rounds: list[CompensatedRound]) -> tuple[CompensatedRound, ...]:
    """The stretches, each with its edge and what those along it come to."""
    along = edges_of_contours([contour_of(toolpath, compensated_round.round.section) for compensated_round in rounds])
    nearest: dict[tuple[int, bool], int] = {}
    for at in sorted(range(len(rounds)), key=lambda at: rounds[at].by_um):
        nearest.setdefault((along[at].edge, along[at].is_tab), at)
    found = []
    for at, compensated_round in enumerate(rounds):
        first = nearest[along[at].edge, along[at].is_tab]
        found.append(compensated_round._replace(along=along[at], kerf_um=rounds[first].by_um, is_nearest=first == at))
    return tuple(found)
