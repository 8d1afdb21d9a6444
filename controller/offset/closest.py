"""Where a path comes closest to the curves near it, each pair in closed form."""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import along_um, places_at
from parser.geometry.broad_phase_places import near_curves
from parser.geometry.curves import Curves, Floats, Ints, joined
from parser.geometry.directions import to_left
from parser.geometry.distance import distance_to_curves
from parser.geometry.meets import by_xy, curves_meet


class Approaches(NamedTuple):
    """Places of a path and the curves that they lie near, k of them in no order.

    Attributes
    ----------
    path_row, row
        (k,) row of the path, row of the curve.
    place_um
        (k, 2) on the path.
    distance_um
        (k,) from the curve.
    """

    path_row: Ints
    row: Ints
    place_um: Floats
    distance_um: Floats

    def take(self, at: Ints) -> "Approaches":
        """Those at the indices `at`."""
        return Approaches(self.path_row[at], self.row[at], self.place_um[at], self.distance_um[at])


def approaches(curves: Curves, path: Curves, below_um: float) -> Approaches:
    """Wherever the distance between a row of the path and a curve is extreme, and below a limit.

    The distance is extreme at the ends of either, where the two cross, and where they have a normal in common.
    """
    near = near_curves(curves, path, below_um)
    return approaches_of(curves, path, near.other, near.row, below_um)


def approaches_of(curves: Curves, path: Curves, own: Ints, row: Ints, below_um: float) -> Approaches:
    """As `approaches`, of rows `own` (m,) of the path and rows `row` (m,) of the curves, pair by pair."""
    found = [(own, row, places_at(path, own, share * path.length_um[own])) for share in (0.0, 1.0)]
    feet = [along_um(path, own, end[row]) for end in (curves.start_um, curves.end_um)]
    # Where the two run parallel every place is extreme: the middle one stands for all.
    found += [(own, row, places_at(path, own, along)) for along in (*feet, 0.5 * (feet[0] + feet[1]))]
    found += [_crossings(curves, path, own, row), *_common_normals(curves, path, own, row)]
    path_row, row, place = (np.concatenate(column) for column in zip(*found, strict=True))
    distance, _ = distance_to_curves(curves, row, place[:, 0], place[:, 1])
    close = np.flatnonzero(distance < below_um)
    return Approaches(path_row, row, place, distance).take(close)


_Places = tuple[Ints, Ints, Floats]  # rows of the path and of the curves, and places on the path


def _beside(path: Curves, own: Ints, place_um: Floats) -> Floats:
    """Places of the path's rows that are nearest to the places (k, 2)."""
    return places_at(path, own, along_um(path, own, place_um))


def _crossings(curves: Curves, path: Curves, own: Ints, row: Ints) -> _Places:
    """Where rows of the path cross curves. A crossing beyond a row's end is moved to the end, a true place as well."""
    meets = curves_meet(joined([path.picked(slice(None)), curves.picked(slice(None))]), own, len(path) + row, 0.0)
    return meets.early, meets.late - len(path), _beside(path, meets.early, meets.place_um)


def _common_normals(curves: Curves, path: Curves, own: Ints, row: Ints) -> tuple[_Places, ...]:
    """Places whose normal is the curve's too: on a line beside the curve's centre, on an arc both ways from its own."""
    on_line = np.flatnonzero(~path.is_arc[own] & curves.is_arc[row])
    a, b = own[on_line], row[on_line]
    made = [(a, b, _beside(path, a, curves.center_um[b]))]
    on_arc = np.flatnonzero(path.is_arc[own])
    a, b = own[on_arc], row[on_arc]
    way = np.where(curves.is_arc[b][:, None], curves.center_um[b] - path.center_um[a], _across(curves, b))
    length = np.hypot(way[:, 0], way[:, 1])
    way *= (path.radius_um[a] / np.where(length > 0.0, length, np.inf))[:, None]
    made += [(a, b, _beside(path, a, path.center_um[a] + sign * way)) for sign in (1.0, -1.0)]
    return tuple(made)


def _across(curves: Curves, row: Ints) -> Floats:
    return to_left(np.stack(by_xy(curves, row), axis=1))
