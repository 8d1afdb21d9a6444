"""The room between contours: how far places and ways in it are from all of them."""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.offset.gouges import approaches
from parser.geometry.curves import Bools, Curves, Floats, Ints, joined
from parser.geometry.distance import feet
from parser.geometry.near import near_places
from sim.make.cam.model import Figure

TOLERANCE_UM: Final = 0.05
"""A way that comes nearer by less is free: a twentieth of a step of the machine, as gouges are judged."""
_SAME_UM: Final = 1e-3
_ROUNDS: Final = 50  # each one halves a ball, or more, where it does not end


class Room(NamedTuple):
    """Contours (n,) of all figures, and which figure (n,) each curve is of, as its place in their sequence."""

    curves: Curves
    figure: Ints

    def rows(self, figure: Ints) -> tuple[Ints, Ints]:
        """Rows (m,) of figures (k,), all of one behind those of the other, and whose they are (m,), 0 to k − 1."""
        first, past = np.searchsorted(self.figure, figure), np.searchsorted(self.figure, figure + 1)
        whose = np.repeat(np.arange(len(figure)), past - first)
        before = np.cumsum(past - first) - (past - first)
        return np.arange(len(whose)) - before[whose] + first[whose], whose


def room_of(figures: Sequence[Figure]) -> Room:
    """The room between the contours of figures, one at least."""
    number = [len(figure.contour) for figure in figures]
    return Room(joined([figure.contour for figure in figures]), np.repeat(np.arange(len(figures)), number))


def are_free(room: Room, ways: Curves, by_um: float) -> Bools:
    """(k,) whether lines and arcs keep a distance from all contours, less `TOLERANCE_UM`; exact, ends included."""
    free = np.ones(len(ways), dtype=np.bool_)
    free[approaches(room.curves, ways, by_um - TOLERANCE_UM).path_row] = False
    return free


class Nearest(NamedTuple):
    """The place (m, 2) of all contours nearest to each of m places, and how far off (m,); NaN and ∞ beyond a limit."""

    place_um: Floats
    distance_um: Floats


def nearest(room: Room, place_um: Floats, within_um: float) -> Nearest:
    """What is nearest to places (m, 2), no farther than a limit; some that lies farther may be found as well."""
    near = near_places(room.curves, place_um, within_um)
    foot = feet(room.curves, near.row, place_um[near.other]).place_um
    off = np.hypot(*(foot - place_um[near.other]).T)
    order = np.lexsort([near.row, off, near.other])
    first = order[np.diff(near.other[order], prepend=-1) > 0]
    result = Nearest(np.full((len(place_um), 2), np.nan), np.full(len(place_um), np.inf))
    result.place_um[near.other[first]] = foot[first]
    result.distance_um[near.other[first]] = off[first]
    return result


def balls_um(room: Room, place_um: Floats, out: Floats, most_um: float) -> Floats:
    """Radii (m,) of the largest circles free of contours that touch them at places (m, 2), on the sides `out` (m, 2).

    None is larger than `most_um`. Each circle shrinks until nothing lies within: the next one goes through the place
    that lies nearest to the centre of the last one (shrinking ball, Ma, Bae and Choi 2012).
    """
    radius = np.full(len(place_um), most_um)
    left: Ints = np.arange(len(place_um))
    for _ in range(_ROUNDS):
        found = nearest(room, place_um[left] + radius[left, None] * out[left], float(radius[left].max(initial=0.0)))
        inside = np.flatnonzero(found.distance_um < radius[left] - _SAME_UM)
        if not len(inside):
            break
        left = left[inside]
        by = found.place_um[inside] - place_um[left]
        radius[left] = (by * by).sum(axis=1) / (2.0 * (by * out[left]).sum(axis=1))
    return radius
