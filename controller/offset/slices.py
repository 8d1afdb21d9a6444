"""Curves cut wherever they meet: slices between one place and the next."""

from typing import NamedTuple

import numpy as np

from controller.offset.candidates import SNAP_UM
from controller.offset.groups import same_places
from controller.offset.sections import Side
from parser.geometry.along import along_um
from parser.geometry.broad_phase_pairs import near_pairs
from parser.geometry.broad_phase_places import near_places
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings_at
from parser.geometry.distance import distance_to_curves
from parser.geometry.meets import curves_meet

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
