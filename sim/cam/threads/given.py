"""Thread points that are given: asked for, or marked in the drawing."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.offset.rows import lines_between
from parser.geometry.broad_phase_places import near_places
from parser.geometry.curves import Bools, Floats
from parser.geometry.distance import distance_to_curves
from parser.geometry.extents import extents
from parser.toolpath import Point
from parser.units import mm
from sim.cam.leads.room import Room, are_free
from sim.cam.model import CannotCutError, Entry, Figure, Refusal
from sim.cam.parts.inside import is_inside
from sim.cam.threads.entries import MOST, Entries, across_from, corners

ON_UM: Final = 1.0
"""A place this near to a contour lies on it: a step of the machine."""


class Waste(NamedTuple):
    """In whose waste each of m places lies.

    Attributes
    ----------
    is_in
        (figures, m) whether it lies in the waste of a figure: within, where the wire runs inside, and in no other one
        that lies within it; else outside, and within no other one that does not lie around the figure.
    off_um
        (figures, m) how far it lies from the figure's contour.
    """

    is_in: Bools
    off_um: Floats

    def of(self, place: Bools) -> "Waste":
        """That of some of the places."""
        return Waste(self.is_in[:, place], self.off_um[:, place])


def waste_of(figures: Sequence[Figure], around: Sequence[int], place_um: Floats) -> Waste:
    """In whose waste places (m, 2) lie."""
    inside = np.stack([_inside(figure, place_um) for figure in figures])
    depth = np.array([figure.depth for figure in figures])
    deepest = np.where(inside, depth[:, None], -1)
    innermost = np.where(inside.any(axis=0), deepest.argmax(axis=0), -1)
    home = np.array([at if figure.runs_inside else around[at] for at, figure in enumerate(figures)])
    is_in: Bools = innermost[None] == home[:, None]
    off = np.full(is_in.shape, np.inf)
    for at in np.flatnonzero(is_in.any(axis=1)).tolist():
        off[at, is_in[at]] = _off(figures[at], place_um[is_in[at]])
    return Waste(is_in, off)


def _off(figure: Figure, place_um: Floats) -> Floats:
    """(m,) how far places lie from a contour."""
    which, row = np.divmod(np.arange(len(place_um) * len(figure.contour)), len(figure.contour))
    off, _ = distance_to_curves(figure.contour, row, place_um[which, 0], place_um[which, 1])
    nearest_: Floats = off.reshape(len(place_um), -1).min(axis=1)
    return nearest_


def _inside(figure: Figure, place_um: Floats) -> Bools:
    """(m,) whether places lie within a figure; those in its box are looked at."""
    low, high = (edge(ends, axis=0) for edge, ends in zip((np.min, np.max), extents(figure.contour), strict=True))
    inside: Bools = ((place_um >= low) & (place_um <= high)).all(axis=1)
    if inside.any():
        inside[inside] = is_inside(figure.contour, place_um[inside])
    return inside


def matched(waste: Waste, is_open: Bools, place_um: Floats) -> dict[int, int]:
    """Which of the places (m, 2) is for which figure that is open: one in whose waste it lies, the nearest pairs first.

    CannotCutError where one is for none: ``start-nowhere`` if it lies in no waste, ``start-twice`` if others lie there
    already.
    """
    figure, place = np.nonzero(waste.is_in & is_open[:, None])
    order = np.lexsort([figure, place, waste.off_um[figure, place]])
    of_figure: dict[int, int] = {}
    placed: set[int] = set()
    for at, one in zip(figure[order].tolist(), place[order].tolist(), strict=True):
        if at not in of_figure and one not in placed:
            of_figure[at] = one
            placed.add(one)
    left = [one for one in range(len(place_um)) if one not in placed]
    if left:
        nowhere = [one for one in left if not waste.is_in[:, one].any()]
        raise refused("start-nowhere" if nowhere else "start-twice", place_um[nowhere or left])
    return of_figure


def on_contour(room: Room, place_um: Floats) -> dict[int, int]:
    """Which of the places (m, 2) lies on the contour of which figure, within `ON_UM`."""
    found: dict[int, int] = {}
    near = near_places(room.curves, place_um, ON_UM)
    off, _ = distance_to_curves(room.curves, near.row, place_um[near.other, 0], place_um[near.other, 1])
    for one, row in zip(near.other[off <= ON_UM].tolist(), near.row[off <= ON_UM].tolist(), strict=True):
        if one not in found.values():
            found.setdefault(int(room.figure[row]), one)
    return found


def across(room: Room, side: Floats, places: Mapping[int, Floats], reach_um: float) -> dict[int, Entry]:
    """Entries of figures for thread points (2,), each straight across from its own, the nearest one that is free.

    Where none lies across it is a corner of the part; a figure to which no way is free has none.
    """
    found = free_from(
        room, [across_from(room, side, at, one, reach_um) for at, one in places.items()], places, reach_um
    )
    left = {at: one for at, one in places.items() if at not in found}
    return found | at_corners(room, side, left, reach_um)


def at_corners(room: Room, side: Floats, places: Mapping[int, Floats], reach_um: float) -> dict[int, Entry]:
    """Entries of figures at the corners nearest to thread points (2,) to which the straight way is free."""
    return free_from(room, [corners(room, side, at, one, reach_um) for at, one in places.items()], places, reach_um)


def free_from(room: Room, found: Sequence[Entries], places: Mapping[int, Floats], reach_um: float) -> dict[int, Entry]:
    """The first of the entries of each figure to which the straight way from its thread point is free."""
    begin = [one.take(np.arange(min(len(one.row), MOST))).begin_um for one in found]
    which = np.repeat(np.arange(len(found)), [len(one) for one in begin])
    if not len(which):
        return {}
    ways = lines_between(np.array(list(places.values()))[which], np.concatenate(begin))
    free = np.flatnonzero(are_free(room, ways, reach_um))
    first = free[np.diff(which[free], prepend=-1) > 0]
    start = np.searchsorted(which, which[first])
    figures = list(places)
    pairs = zip(which[first].tolist(), (first - start).tolist(), strict=True)
    return {figures[one]: found[one].one(room, at) for one, at in pairs}


def refused(why: str, place_um: Floats, values: tuple[tuple[str, str], ...] = ()) -> CannotCutError:
    """What to raise for thread points (k, 2) that cannot be."""
    said = "; ".join(f"{mm(x):.10g}, {mm(y):.10g}" for x, y in place_um.tolist())
    return CannotCutError(
        Refusal(why, tuple(Point(x, y) for x, y in place_um.tolist()), (("places_mm", said), *values))
    )
