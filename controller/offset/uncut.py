"""What a path leaves: material between the contour and the kerf, where blocks have no place on the path."""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places, nearest_um

_WITHIN_UM = 0.01  # a hundredth of a step


class _Stretches(NamedTuple):
    """Stretches (m,) of rows, from a length along each to another; pairs (p,) of a stretch and a curve near it."""

    of: Ints
    first_um: Floats
    last_um: Floats
    pair: Ints
    curve: Ints


def uncut_um(contour: Curves, path: Curves, offset_um: float, rows: Ints) -> Floats:
    """Material (k,) µm left at the rows (k,) of a contour: how far at most each lies from the kerf, within 0.01 µm.

    The kerf is what lies within the offset of the path. Where the path has no row with length, the wire stands at
    the begin of the contour (`compensate`).
    """
    most = np.zeros(len(rows))
    if not len(rows):
        return most
    if not path.length_um.any():
        path = _standing(contour)
    on = _whole(contour, path, offset_um, rows)
    while len(on.of):
        half = 0.5 * (on.last_um - on.first_um)
        middle = places_at(contour, rows[on.of], on.first_um + half)
        away, _ = distance_to_curves(path, on.curve, middle[on.pair, 0], middle[on.pair, 1])
        nearest = np.full(len(on.of), np.inf)
        np.minimum.at(nearest, on.pair, away)
        left = nearest - offset_um
        np.maximum.at(most, on.of, left)
        # Distances change by no more than the way between two places.
        may_be_nearest = away <= nearest[on.pair] + 2.0 * half[on.pair]
        on = _halved(on, left + half > most[on.of] + _WITHIN_UM, may_be_nearest)
    return most


def _standing(contour: Curves) -> Curves:
    """The begin of a contour, as a line so short that no figure tells it from a place; curves have length."""
    place = contour.start_um[:1]
    return curves_between(place, place + np.array([0.1 * _WITHIN_UM, 0.0]), np.full((1, 2), np.nan), np.zeros(1))


def _whole(contour: Curves, path: Curves, offset_um: float, rows: Ints) -> _Stretches:
    """The rows as one stretch each."""
    length = contour.length_um[rows]
    middle = places_at(contour, rows, 0.5 * length)
    reach = float((_distance_um(path, middle, 2.0 * offset_um) + length).max())
    near = near_places(path, middle, reach)
    return _Stretches(np.arange(len(rows)), np.zeros(len(rows)), length, near.other, near.row)


def _halved(on: _Stretches, is_open: Bools, may_be_nearest: Bools) -> _Stretches:
    """Both halves of the open stretches, with the curves that may still be the nearest to them."""
    open_ = np.flatnonzero(is_open)
    number = np.full(len(on.of), -1)
    number[open_] = np.arange(len(open_))
    kept_rows = np.flatnonzero(is_open[on.pair] & may_be_nearest)
    pair, curve = number[on.pair[kept_rows]], on.curve[kept_rows]
    of, first, last = on.of[open_], on.first_um[open_], on.last_um[open_]
    middle = 0.5 * (first + last)
    return _Stretches(
        of=np.tile(of, 2),
        first_um=np.concatenate([first, middle]),
        last_um=np.concatenate([middle, last]),
        pair=np.concatenate([pair, pair + len(of)]),
        curve=np.tile(curve, 2),
    )


def _distance_um(path: Curves, place_um: Floats, within_um: float) -> Floats:
    """Distances (m,) of places from the path, looked for farther and farther away."""
    result = nearest_um(path, place_um, within_um)
    far = np.flatnonzero(result > within_um)
    if len(far):
        result[far] = _distance_um(path, place_um[far], 4.0 * within_um)
    return result
