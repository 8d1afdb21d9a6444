"""Thread points that are given: asked for, or marked in the drawing."""

from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.offset.chain import lines_between
from parser.geometry.curves import Bools, Floats, Ints, extents, is_inside
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places
from parser.toolpath import Point
from sim.make.cam.leads.room import Room, are_free
from sim.make.cam.model import CannotCutError, Entry, Figure, Refusal
from sim.make.cam.threads.entries import MOST, Entries, EntryRequest, across_from, corners

ON_UM: Final = 1.0
"""A place this near to a contour lies on it: a step of the machine."""


class Waste(NamedTuple):
    """Pairs (k,) of figures and places that lie in their waste, and how far these lie off their contours.

    That is within a figure where the wire runs inside, and in no other one that lies within it; else outside, and
    within no other one that does not lie around the figure.
    """

    figure: Ints
    place: Ints
    off_um: Floats

    def take(self, at: Ints | Bools) -> "Waste":
        """Those at the indices `at`."""
        return Waste(self.figure[at], self.place[at], self.off_um[at])


def waste_of(figures: Sequence[Figure], around: Sequence[int], place_um: Floats) -> Waste:
    """In whose waste places (m, 2) lie."""
    innermost = _innermost(figures, place_um)
    by_home = np.argsort(innermost, kind="stable")
    home = np.array([at if figure.runs_inside else around[at] for at, figure in enumerate(figures)])
    first, past = (np.searchsorted(innermost[by_home], home, side=side) for side in ("left", "right"))
    places = [by_home[low:high] for low, high in zip(first.tolist(), past.tolist(), strict=True)]
    off = [_off(figure, place_um[of]) for figure, of in zip(figures, places, strict=True) if len(of)]
    figure = np.repeat(np.arange(len(figures)), past - first)
    return Waste(figure, np.concatenate(places), np.concatenate([np.empty(0), *off]))


def _innermost(figures: Sequence[Figure], place_um: Floats) -> Ints:
    """(m,) the deepest figure that each place lies within, −1 for none; those in the box of a figure are looked at."""
    innermost, depth = np.full(len(place_um), -1), np.full(len(place_um), -1)
    by_x = np.argsort(place_um[:, 0], kind="stable")
    x = place_um[by_x, 0]
    for at, figure in enumerate(figures):
        low, high = (edge(ends, axis=0) for edge, ends in zip((np.min, np.max), extents(figure.contour), strict=True))
        near = by_x[np.searchsorted(x, low[0]) : np.searchsorted(x, high[0], side="right")]
        near = near[(place_um[near, 1] >= low[1]) & (place_um[near, 1] <= high[1]) & (depth[near] < figure.depth)]
        if len(near):
            inside = near[is_inside(figure.contour, place_um[near])]
            innermost[inside], depth[inside] = at, figure.depth
    return innermost


def _off(figure: Figure, place_um: Floats) -> Floats:
    """(m,) how far places lie from a contour."""
    which, row = np.divmod(np.arange(len(place_um) * len(figure.contour)), len(figure.contour))
    off, _ = distance_to_curves(figure.contour, row, place_um[which, 0], place_um[which, 1])
    nearest_: Floats = off.reshape(len(place_um), -1).min(axis=1)
    return nearest_


class FiguresWithThread(NamedTuple):
    """Figures that have thread points: of those that are given now, and from before, so that they need no more."""

    now: frozenset[int]
    before: frozenset[int]


def matched(waste: Waste, taken: FiguresWithThread, place_um: Floats) -> dict[int, int]:
    """Which of the places (m, 2) is for which figure: one in whose waste it lies, the nearest pairs first.

    A place for none but figures that had thread points before is left out. CannotCutError where another one is for
    none: ``start-nowhere`` if it lies in no waste, ``start-twice`` if others lie there already.
    """
    waste = waste.take(np.lexsort([waste.figure, waste.place, waste.off_um]))
    of_figure: dict[int, int] = {}
    closed = taken.now | taken.before
    placed: set[int] = set()
    for at, each in zip(waste.figure.tolist(), waste.place.tolist(), strict=True):
        if at not in of_figure and each not in placed and at not in closed:
            of_figure[at] = each
            placed.add(each)
    left = np.setdiff1d(np.arange(len(place_um)), list(placed))
    nowhere = np.setdiff1d(left, waste.place)
    if len(nowhere):
        raise refused("start-nowhere", place_um[nowhere])
    twice = np.intersect1d(left, waste.place[~np.isin(waste.figure, list(taken.before))])
    if len(twice):
        raise refused("start-twice", place_um[twice])
    return of_figure


def on_contour(room: Room, place_um: Floats) -> dict[int, int]:
    """Which of the places (m, 2) lies on the contour of which figure, within `ON_UM`."""
    found: dict[int, int] = {}
    near = near_places(room.curves, place_um, ON_UM)
    off, _ = distance_to_curves(room.curves, near.row, place_um[near.other, 0], place_um[near.other, 1])
    for each, row in zip(near.other[off <= ON_UM].tolist(), near.row[off <= ON_UM].tolist(), strict=True):
        if each not in found.values():
            found.setdefault(int(room.figure[row]), each)
    return found


def across(room: Room, side: Floats, places: Mapping[int, Floats], reach_um: float) -> dict[int, Entry]:
    """Entries of figures for thread points (2,), each straight across from its own, the nearest one that is free.

    Where none lies across it is a corner of the part; a figure to which no way is free has none.
    """
    found = _free(room, side, places, reach_um, across_from)
    left = {at: place for at, place in places.items() if at not in found}
    return found | at_corners(room, side, left, reach_um)


def at_corners(room: Room, side: Floats, places: Mapping[int, Floats], reach_um: float) -> dict[int, Entry]:
    """Entries of figures at the corners nearest to thread points (2,) to which the straight way is free."""
    return _free(room, side, places, reach_um, corners)


def _free(
    room: Room,
    side: Floats,
    places: Mapping[int, Floats],
    reach_um: float,
    find: Callable[[Room, Floats, EntryRequest], tuple[Entries, Ints]],
) -> dict[int, Entry]:
    """The first of the entries of each figure, among the few best, to which the straight way is free."""
    if not places:
        return {}
    entry_request = EntryRequest(np.array(list(places)), np.array(list(places.values())), reach_um)
    found, whose = find(room, side, entry_request)
    best = np.flatnonzero(np.arange(len(whose)) - np.searchsorted(whose, whose) < MOST)
    ways = lines_between(entry_request.place_um[whose[best]], found.take(best).begin_um)
    free = best[are_free(room, ways, reach_um)]
    first = free[np.diff(whose[free], prepend=-1) > 0]
    return {int(entry_request.figure[whose[at]]): found.entry(room, at) for at in first.tolist()}


def refused(why: str, place_um: Floats, values: tuple[tuple[str, str], ...] = ()) -> CannotCutError:
    """What to raise for thread points (k, 2) that cannot be."""
    return CannotCutError(Refusal(why, tuple(Point(x, y) for x, y in place_um.tolist()), values))
