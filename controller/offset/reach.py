"""The true offset: loops on which the wire's centre comes as near to a contour as it can, cut of slices.

Curves cut wherever they meet: slices between one place and the next.

Things that hang together, directly or through others.

All curves that lie at the offset from a block or a corner, wherever a part of the true offset may run.

Slices put together, end to end, into loops.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.shifted import Side
from parser.geometry.along import along_um, directions, headings_at, places_at, to_left
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import curves_meet, distance_to_curves
from parser.geometry.near import cell_keys, near_pairs, near_places, nearest_um

SNAP_UM = 1e-5
"""Places this near each other are one. Double precision keeps ends and crossings within 1e-9 µm over 1 m."""
_BACK_RAD = 1e-9  # within this of half a turn, a contour goes back on itself, and its end is an outer corner


class Candidates(NamedTuple):
    """m curves along the contour's direction, in its order.

    Attributes
    ----------
    curves
        Blocks moved aside, and arcs about outer corners.
    source_row
        (m,) row of the contour; of a corner's arc the one before the corner.
    corner
        (m,) True on arcs about corners.
    """

    curves: Curves
    source_row: Ints
    corner: NDArray[np.bool_]


class ClosedContour(NamedTuple):
    """A closed contour without gaps and blocks of no length: its curves, and the rows (n,) that they come from."""

    curves: Curves
    row: Ints


def closed_ring(contour: Curves) -> ClosedContour:
    """The contour with its gaps bridged by lines that belong to the block before them."""
    row = np.flatnonzero(contour.length_um > SNAP_UM)
    curves = contour.picked(row)
    start, end = curves.end_um, np.roll(curves.start_um, -1, axis=0)
    gap = np.flatnonzero(np.hypot(*(end - start).T) > SNAP_UM)
    bridges = curves_between(start[gap], end[gap], np.full((len(gap), 2), np.nan), np.zeros(len(gap)))
    order = np.argsort(np.concatenate([np.arange(len(row)), gap]), kind="stable")
    return ClosedContour(joined([curves, bridges]).picked(order), np.concatenate([row, row[gap]])[order])


def candidates(ring: ClosedContour, offset_um: float, side: Side) -> Candidates:
    """Blocks moved by the offset to the side, and arcs about the corners that point to it.

    An arc with a radius of no more than the offset has no place for it on its inner side, and is left out there.
    """
    contour = ring.curves
    leaving, arriving = directions(contour)
    slices, moved = _moved(contour, leaving, arriving, offset_um * side)
    at, corners = _corners(contour, np.roll(leaving, -1, axis=0), arriving, offset_um * side)
    order = np.argsort(np.concatenate([2 * slices, 2 * at + 1]), kind="stable")
    return Candidates(
        curves=joined([moved, corners]).picked(order),
        source_row=ring.row[np.concatenate([slices, at])[order]],
        corner=np.repeat([False, True], [len(slices), len(at)])[order],
    )


def _moved(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Rows of the blocks that have a place at the offset, and these moved to the left, or to the right if it is < 0."""
    radius = contour.radius_um - np.sign(contour.sweep_rad) * left_um
    kept_rows = np.flatnonzero(~contour.is_arc | (radius * np.minimum(np.abs(contour.sweep_rad), 1.0) > SNAP_UM))
    shifted = Curves(
        kind=np.where(contour.is_arc, CurveKind.ARC, CurveKind.LINE).astype(np.int64),
        start_um=contour.start_um + left_um * to_left(leaving),
        end_um=contour.end_um + left_um * to_left(arriving),
        center_um=contour.center_um,
        radius_um=radius,
        start_angle_rad=contour.start_angle_rad,
        sweep_rad=contour.sweep_rad,
        length_um=np.where(contour.is_arc, radius * np.abs(contour.sweep_rad), contour.length_um),
    )
    return kept_rows, shifted.picked(kept_rows)


def _corners(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Blocks that end at an outer corner, and the arcs about those; `leaving` is that of the next block."""
    turn = np.arctan2(arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0], (arriving * leaving).sum(axis=1))
    outward = -np.sign(left_um)
    turn = np.where(np.abs(turn) > np.pi - _BACK_RAD, outward * np.abs(turn), turn)
    at = np.flatnonzero(outward * turn * abs(left_um) > SNAP_UM)
    about = contour.end_um[at]
    start, end = (about + left_um * to_left(way[at]) for way in (arriving, leaving))
    return at, curves_between(start, end, about, turn[at])


_CORNERS = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])  # a place belongs to the cells of all four that meet near it


def groups(count: int, this: Ints, other: Ints) -> Ints:
    """(count,) the least number in the group of each of 0 … count − 1, where the pairs (k,) hang together."""
    least = np.arange(count)
    while True:
        lower = least.copy()
        np.minimum.at(lower, this, least[other])
        np.minimum.at(lower, other, least[this])
        np.minimum.at(lower, least, lower)  # the whole group so far moves with any of its members
        lower = lower[lower]
        if np.array_equal(lower, least):
            return least
        least = lower


def same_places(place_um: Floats, within_um: float) -> Ints:
    """(m,) for each of the places (m, 2) the least index of those that are one with it, directly or through others.

    Two places within the distance are one. Two places three times as far apart are one only through others.
    """
    low = np.floor(place_um / within_um - 0.5).astype(np.int64)
    cells = cell_keys(*(low[:, None, :] + _CORNERS).reshape(-1, 2).T)
    order = np.argsort(cells)
    same = np.flatnonzero(cells[order[1:]] == cells[order[:-1]])
    this, other = order[same] // 4, order[same + 1] // 4
    # Two cells of one hash are found out by their distance.
    near = np.abs(place_um[this] - place_um[other]).max(axis=1) <= 2.0 * within_um
    return groups(len(place_um), this[near], other[near])


_SHORT_UM = 1e-3  # a slice that ends where it starts is rounding if it is shorter than this, else it goes round
_ALL = 1 << 62
_CLEAR_SINE = 0.01  # of the angle between two curves; where they cross flatter than this, distances tell
_BENT_UM = 1e-2  # arcs of a smaller radius turn too much between two places that are one


class Slices(NamedTuple):
    """k slices, those of one curve in order, one curve behind the other.

    Attributes
    ----------
    row
        (k,) the curve.
    first_um, last_um
        (k,) lengths along it, between which the slice lies.
    tail, head
        (k,) numbers of the places where the slice starts and ends.
    place_um
        (p, 2) all places.
    """

    row: Ints
    first_um: Floats
    last_um: Floats
    tail: Ints
    head: Ints
    place_um: Floats

    def take(self, at: Ints) -> "Slices":
        """The slices at the indices `at`, with all places."""
        row, first, last, tail, head, place = self
        return Slices(row[at], first[at], last[at], tail[at], head[at], place)


class _Cuts(NamedTuple):
    """Curves (k,), where they are cut (k, 2), and on which side of that they are barred.

    `barred` (k,) is −1 before the cut, +1 behind it, 0 where that is not known.
    """

    row: Ints
    place_um: Floats
    barred: Ints


def open_slices(curves: Curves, side: Side) -> Slices:
    """Slices of all n curves, cut where two cross, and where one ends on another.

    Every curve bars its other side, where the contour is too near. A crossing makes two slices of a curve: one of them
    lies on the side that the other curve bars, and is left out.
    """
    n = len(curves)
    ends = np.concatenate([curves.start_um, curves.end_um])
    own = _Cuts(np.tile(np.arange(n), 2), ends, np.zeros(2 * n, dtype=np.int64))
    cuts = [own, *_crossings(curves, side), _ends_on(curves, ends)]
    row, place, barred = (np.concatenate(column) for column in zip(*cuts, strict=True))
    along = np.concatenate([np.zeros(n), curves.length_um, along_um(curves, row[2 * n :], place[2 * n :])])
    return _between(row, along, place, barred)


def _between(row: Ints, along: Floats, place_um: Floats, barred: Ints) -> Slices:
    """Slices from each cut of a curve to the next; a slice that is barred at one of its ends is left out."""
    order = np.lexsort((along, row))
    row, along, place_um, barred = row[order], along[order], place_um[order], barred[order]
    is_slice = (row[1:] == row[:-1]) & (along[1:] > along[:-1]) & (barred[:-1] <= 0) & (barred[1:] >= 0)
    first = np.flatnonzero(is_slice)
    place_um = np.concatenate([place_um[first], place_um[first + 1]])
    tail, head = same_places(place_um, SNAP_UM).reshape(2, -1)
    cut = Slices(row[first], along[first], along[first + 1], tail, head, place_um)
    return cut.take(np.flatnonzero((tail != head) | (cut.last_um - cut.first_um > _SHORT_UM)))


def _crossings(curves: Curves, side: Side) -> tuple[_Cuts, _Cuts]:
    """Cuts of each two curves that cross."""
    pairs = near_pairs(curves, np.zeros(len(curves), dtype=np.int64), 0.0, _ALL, SNAP_UM)
    meets = curves_meet(curves, pairs.early, pairs.late, 0.0)
    x, y = meets.place_um[:, 0], meets.place_um[:, 1]
    off = [distance_to_curves(curves, row, x, y)[0] for row in (meets.early, meets.late)]
    meets = meets.take(np.flatnonzero(np.maximum(*off) <= SNAP_UM))
    a, b = (headings_at(curves, row, meets.place_um) for row in (meets.early, meets.late))
    sine = side * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    bent = np.fmin(curves.radius_um[meets.early], curves.radius_um[meets.late]) < _BENT_UM
    into = np.where((np.abs(sine) > _CLEAR_SINE) & ~bent, np.sign(sine), 0.0).astype(np.int64)
    return _Cuts(meets.early, meets.place_um, into), _Cuts(meets.late, meets.place_um, -into)


def _ends_on(curves: Curves, end_um: Floats) -> _Cuts:
    """Cuts where ends lie on other curves."""
    near = near_places(curves, end_um, SNAP_UM)
    near = near.take(np.flatnonzero(near.other % len(curves) != near.row))
    off, _ = distance_to_curves(curves, near.row, end_um[near.other, 0], end_um[near.other, 1])
    on = near.take(np.flatnonzero(off <= SNAP_UM))
    return _Cuts(on.row, end_um[on.other], np.zeros(len(on.row), dtype=np.int64))


def stitched(cut: Slices, middle_um: Floats, clear_um: Floats, same_um: float) -> tuple[Ints, ...]:
    """Indices of the slices of each loop, in order; a loop begins with its least index, and loops are in order of it.

    Parameters
    ----------
    middle_um, clear_um
        (k, 2) middles of the slices, and (k,) how far these are from the contour. Where more slices end at a place than
        leave it, or fewer, the one of the surplus that is least far from the contour is taken away.
    same_um
        Slices between the same places whose middles are this near are one.
    """
    pieces = _balanced(cut, _without_copies(cut, middle_um, same_um), clear_um)
    return _walks(pieces, _next(cut.take(pieces)))


def _without_copies(cut: Slices, middle_um: Floats, same_um: float) -> Ints:
    """Indices of the slices that are no copy of an earlier one, as where blocks run along the same way again."""
    order = np.lexsort((middle_um[:, 0], cut.head, cut.tail))
    same = (cut.tail[order][1:] == cut.tail[order][:-1]) & (cut.head[order][1:] == cut.head[order][:-1])
    same &= np.hypot(*np.diff(middle_um[order], axis=0).T) <= same_um
    return np.delete(np.arange(len(order)), order[1:][same])


def _balanced(cut: Slices, kept_rows: Ints, clear_um: Floats) -> Ints:
    """The slices that are left once as many of them end at each place as leave it."""
    while len(kept_rows):
        number = len(cut.place_um)
        surplus = np.bincount(cut.tail[kept_rows], minlength=number) - np.bincount(
            cut.head[kept_rows], minlength=number
        )
        if not surplus.any():
            break
        worst = [
            _least_clear(end[kept_rows], clear_um[kept_rows], sign * surplus > 0)
            for end, sign in ((cut.tail, 1), (cut.head, -1))
        ]
        kept_rows = np.delete(kept_rows, np.concatenate(worst))
    return kept_rows


def _least_clear(end: Ints, clear_um: Floats, surplus: NDArray[np.bool_]) -> Ints:
    """Of the slices at each place with too many, the one that keeps least clear."""
    there = np.flatnonzero(surplus[end])
    order = there[np.lexsort((clear_um[there], end[there]))]
    return order[np.diff(end[order], prepend=-1) > 0]


def _next(cut: Slices) -> Ints:
    """(k,) the slice that follows each; as many slices leave each place as end there.

    The next one in number follows where it can, since slices are in the contour's order.
    """
    count = len(cut.row)
    on = np.roll(np.arange(count), -1)
    follows = cut.tail[on] == cut.head
    result = np.where(follows, on, -1)
    left = np.ones(count, dtype=np.bool_)
    left[on[follows]] = False
    ending, leaving = np.flatnonzero(~follows), np.flatnonzero(left)
    by_head, by_tail = (np.argsort(end, kind="stable") for end in (cut.head[ending], cut.tail[leaving]))
    result[ending[by_head]] = leaving[by_tail]
    return result


def _walks(kept_rows: Ints, following: Ints) -> tuple[Ints, ...]:
    """Cycles of a permutation. They are walked slice by slice, since their order is asked for (0.1 µs a slice)."""
    order, ends, after = [], [0], following.tolist()
    for first in range(len(after)):
        at = first
        while after[at] >= 0:
            order.append(at)
            after[at], at = -1, after[at]
        if len(order) > ends[-1]:
            ends.append(len(order))
    row = kept_rows[np.array(order, dtype=np.int64)]
    return tuple(row[a:b] for a, b in pairwise(ends))


TOLERANCE_UM = 1e-5
"""A loop lies at least the offset less this from its contour: a slot as wide as the kerf is reached."""


class OffsetLoop(NamedTuple):
    """One loop, m curves in the contour's direction, each from the end of the one before it, the first from the last.

    Attributes
    ----------
    curves
        Lines, and arcs with the centres of their blocks, or with a corner as centre and the offset as radius.
    source_row
        (m,) row of the contour that each comes from; of a corner's arc the one before the corner.
    corner
        (m,) True on arcs about corners.
    """

    curves: Curves
    source_row: Ints
    corner: NDArray[np.bool_]


class Reached(NamedTuple):
    """What the wire's centre reaches of a contour's offset: no loop, one, or several where a pocket falls apart."""

    loops: tuple[OffsetLoop, ...]


def reach(contour: Curves, offset_um: float, side: Side) -> Reached:
    """Loops that lie everywhere at the offset from a contour or farther, on its side, with arcs about outer corners.

    Parameters
    ----------
    contour
        One closed chain of lines and arcs of at most one turn, end to start. A gap is bridged by a line.
    offset_um
        More than 0.
    side
        Where the loops lie, along the contour's direction.

    Notes
    -----
    Go along a curve at the offset from its block. It comes too near to the contour, or clear of it again, only where
    it crosses another such curve, of a block or of a corner. So the curves are cut into slices at their crossings, and
    the middle of a slice tells whether the whole slice is kept.
    """
    ring = closed_ring(contour)
    made = candidates(ring, offset_um, side)
    if not len(made.curves):
        return Reached(())
    cut = open_slices(made.curves, side)
    middle = places_at(made.curves, cut.row, 0.5 * (cut.first_um + cut.last_um))
    distance = nearest_um(ring.curves, middle, offset_um + TOLERANCE_UM)
    clear = np.flatnonzero(distance >= offset_um - TOLERANCE_UM)
    loops = stitched(cut.take(clear), middle[clear], distance[clear], 10.0 * SNAP_UM)
    return Reached(tuple(_loop(made, cut.take(clear[loop])) for loop in loops))


def _loop(made: Candidates, cut: Slices) -> OffsetLoop:
    """A loop of slices; slices that follow each other on one curve become one."""
    on = (cut.row[1:] == cut.row[:-1]) & (cut.first_um[1:] == cut.last_um[:-1])
    first, last = np.flatnonzero(np.append(True, ~on)), np.flatnonzero(np.append(~on, True))
    row = cut.row[first]
    begin, end = cut.first_um[first], cut.last_um[last]
    of = made.curves
    share = np.where(of.is_arc[row], (end - begin) / of.length_um[row], 0.0)
    start_um = cut.place_um[cut.tail[first]]
    end_um = cut.place_um[cut.head[last]]
    curves = Curves(
        kind=of.kind[row],
        start_um=start_um,
        end_um=end_um,
        center_um=of.center_um[row],
        radius_um=of.radius_um[row],
        start_angle_rad=of.start_angle_rad[row] + begin / of.length_um[row] * of.sweep_rad[row],
        sweep_rad=share * of.sweep_rad[row],
        length_um=end - begin,
    )
    return OffsetLoop(curves, made.source_row[row], made.corner[row])
