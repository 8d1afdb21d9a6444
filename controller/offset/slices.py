"""Curves cut wherever they meet, in slices from one place to the next, and slices put together, end to end, in loops.

Things that hang together, directly or through others.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.shifted import Side
from parser.geometry.along import along_um, headings_at
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import curves_meet, distance_to_curves
from parser.geometry.near import cell_keys, near_pairs, near_places

SNAP_UM = 1e-5
"""Places this near each other are one. Double precision keeps ends and crossings within 1e-9 µm over 1 m."""

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
