"""Thread points that are given: asked for, or marked in the drawing.

Thread points: those that are asked for, those that are marked in the drawing, and others chosen in the waste.

Thread points that stand in the drawing: points and circles on the layer of thread points, points in holes.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final, NamedTuple

import numpy as np

from controller.offset.chain import lines_between
from parser.drawing.model import Drawing
from parser.findings.catalogue import Remark
from parser.geometry.curves import Bools, Floats, Ints, extents, is_inside
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.chosen import Wanted, before_corners, begun_on, chosen
from sim.make.cam.entered import entered, figures_at
from sim.make.cam.entries import MOST, Entries, EntryRequest, across_from, corners, nearest_of
from sim.make.cam.leads import TOLERANCE_UM, Room, are_free, nearest, room_of
from sim.make.cam.model import CannotCutError, Entry, Figure, Refusal, Thread, ThreadedBy, refused
from sim.make.cam.offset_path import offset_path
from sim.make.cam.order import around
from sim.make.cam.passes import has_slug_tab
from sim.make.cam.picks import spared
from sim.setup.making import Making

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


_SAME_UM = 1.0


def marks_of_layer(drawing: Drawing, layer: str) -> Floats:
    """Places (m, 2) of points, and centres of circles, on a layer, each once.

    CannotCutError, ``no-marks``, where there is none.
    """
    name = layer.casefold()
    found = [mark.place_um for mark in drawing.marks if mark.layer.casefold() == name]
    on_layer = [
        at for at, entity in enumerate(drawing.entities) if entity.layer.casefold() == name and entity.kind == "CIRCLE"
    ]
    row = np.isin(drawing.entity, np.array(on_layer, dtype=np.int64)) & drawing.curves.is_arc
    place = _each_once(np.concatenate([np.array(found).reshape(-1, 2), drawing.curves.center_um[row]]))
    if not len(place):
        raise CannotCutError(Refusal("no-marks", (), (("layer", layer),)))
    return place


def points_of(drawing: Drawing) -> Floats:
    """Places (m, 2) of the points of a drawing, each once."""
    return _each_once(np.array([mark.place_um for mark in drawing.marks if not mark.radius_um]).reshape(-1, 2))


def _each_once(place: Floats) -> Floats:
    """Places (m, 2) in whole µm, those that are one but once."""
    once: Floats = np.unique(np.round(place / _SAME_UM) * _SAME_UM + 0.0, axis=0)
    return once


_ROUND = ("arc", "tangent")
_WITHOUT_LEAD = ("contour", "kerf")
_NONE: Mapping[int, Thread] = MappingProxyType({})
_SPARE_UM = 3.0  # more than places move from one side to the other as they become whole µm
_MOST_NUMBERS = 20  # of figures that one refusal names
_LEAST_UM = 1.0  # what leads of an offset of 0 keep off contours, but for their ends


def threads_of(
    drawing: Drawing, figures: Sequence[Figure], making: Making, reach_um: float, in_kerf: Mapping[int, Thread] = _NONE
) -> tuple[Thread, ...]:
    """A thread point for each figure, and a lead from there that keeps from all contours by the largest offset.

    First come the points that are asked for, then those of the layer of thread points, or points of the drawing that
    lie alone in the waste of one hole; then those of `in_kerf`; all others are chosen. Where the offset is 0 and
    nothing else is asked, the wire begins on the contour. CannotCutError where a thread point cannot be, or there is no
    room for one.
    """
    waste = _Waste(figures, reach_um, spared(drawing, figures, making.spared))
    threads = waste.threads_at(_whole(making.starts_um), "asked", {})
    if making.thread_layer is None:
        threads |= waste.lone(points_of(drawing), threads)
    else:
        threads |= waste.threads_at(marks_of_layer(drawing, making.thread_layer), "marked", threads)
    threads = {**in_kerf, **threads}
    demands = waste.demands(making)
    places = figures_at(waste.room, _whole(making.entries_um), in_kerf)
    threads |= entered(waste.room, waste.side, places, threads, demands)
    wanted = np.array([at for at in range(len(figures)) if at not in threads], dtype=np.int64)
    if len(wanted) and demands.has_leads:
        threads |= waste.chosen(wanted, making, threads)
    elif len(wanted):
        threads |= begun_on(waste.room, waste.side, wanted)
    return waste.led(threads, making, frozenset(places))


def thread_notes(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> tuple[Remark, ...]:
    """What is to be said of leads that are not as they are asked for."""
    return (*_shortened(figures, threads, making), *_straightened(figures, threads, making))


def _shortened(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> Iterator[Remark]:
    """Leads with no room for the length that is asked for."""
    if making.lead_um is None:
        return
    least_um = making.lead_um - _SPARE_UM
    numbers = [
        str(figure.number)
        for figure, thread in zip(figures, threads, strict=True)
        if thread.by == "chosen" and math.dist(thread.place_um, thread.entry.place_um) < least_um
    ]
    if numbers:
        yield Remark("shorter-leads", {"figures": ", ".join(numbers)})


def _straightened(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> tuple[Remark, ...]:
    """Leads that are not round where that is asked for."""
    if making.lead in _ROUND and _is_back(making):
        return (Remark("straight-back"),)
    straight: dict[str, list[str]] = {"straight-leads": [], "straight-to-parts": [], "straight-to-tabs": []}
    for figure, thread in zip(figures, threads, strict=True):
        if thread.lead != making.lead and thread.by not in _WITHOUT_LEAD:
            straight[_why_straight(figure, making)].append(str(figure.number))
    return tuple(Remark(name, {"figures": ", ".join(numbers)}) for name, numbers in straight.items() if numbers)


def _why_straight(figure: Figure, making: Making) -> str:
    """Name of the remark that says why the lead of a figure is straight."""
    if making.lead not in _ROUND:
        return "straight-leads"
    if not figure.runs_inside:
        return "straight-to-parts"
    return "straight-to-tabs" if has_slug_tab(figure, making) else "straight-leads"


class _Waste:
    """The waste of figures, in which their thread points lie."""

    def __init__(self, figures: Sequence[Figure], reach_um: float, is_spared: Bools) -> None:
        self.figures = figures
        self.reach_um = reach_um
        self.clear_um = max(reach_um, _LEAST_UM)
        self.room: Room = room_of(figures, is_spared)
        self.side: Floats = np.where([figure.runs_inside for figure in figures], 1.0, -1.0)

    def threads_at(self, place_um: Floats, by: ThreadedBy, taken: Mapping[int, Thread]) -> dict[int, Thread]:
        """Threads at places (m, 2), for figures that are not taken yet; what is marked for those that are is left out.

        CannotCutError where a place is for none.
        """
        threads, place_um = self._begun_at(place_um)
        if not len(place_um):
            return threads
        waste = waste_of(self.figures, around(self.figures), place_um)
        begun = FiguresWithThread(frozenset(threads), frozenset(taken))
        places = {at: place_um[each] for at, each in matched(waste, begun, place_um).items()}
        return threads | self._threaded(places, by)

    def _begun_at(self, place_um: Floats) -> tuple[dict[int, Thread], Floats]:
        """Threads at those of the places that lie on contours, and the other places."""
        on = on_contour(self.room, place_um)
        which = np.isin(np.arange(len(place_um)), list(on.values()))
        if on and self.reach_um > 0.0:
            raise refused("start-on-contour", place_um[which])
        begun = {
            at: Thread(Point(*place_um[each].tolist()), "contour", nearest_of(self.room, self.side, at, place_um[each]))
            for at, each in on.items()
        }
        return begun, place_um[~which]

    def lone(self, place_um: Floats, taken: Mapping[int, Thread]) -> dict[int, Thread]:
        """Threads at points that lie alone in the waste within a figure, and in that of no other one, if they fit."""
        place_um = place_um[self._clear(place_um) > self.clear_um]
        if not len(place_um):
            return {}
        waste = waste_of(self.figures, around(self.figures), place_um)
        alone = (np.bincount(waste.place)[waste.place] == 1) & (np.bincount(waste.figure)[waste.figure] == 1)
        alone &= (self.side > 0.0)[waste.figure] & ~np.isin(waste.figure, list(taken))
        found = waste.take(alone)
        places = {at: place_um[each] for at, each in zip(found.figure.tolist(), found.place.tolist(), strict=True)}
        entries = across(self.room, self.side, places, self.clear_um)
        return {at: Thread(Point(*places[at].tolist()), "marked", entry) for at, entry in entries.items()}

    def _threaded(self, places: Mapping[int, Floats], by: ThreadedBy) -> dict[int, Thread]:
        """Threads of figures at places (2,) that must do."""
        place_um = np.array(list(places.values())).reshape(-1, 2)
        clear = self._clear(place_um)
        if (clear <= self.clear_um).any():
            values = (("off_mm", f"{mm(float(clear.min())):.4g}"), ("least_mm", f"{mm(self.clear_um):.4g}"))
            raise refused("start-too-near", place_um[clear <= self.clear_um], values)
        entries = across(self.room, self.side, places, self.clear_um)
        hidden = [at not in entries for at in places]
        if any(hidden):
            raise refused("start-hidden", place_um[hidden])
        return {at: Thread(Point(*places[at].tolist()), by, entry) for at, entry in entries.items()}

    def chosen(self, wanted: Ints, making: Making, taken: Mapping[int, Thread]) -> dict[int, Thread]:
        """Threads of the figures `wanted` at places in their waste, apart from those that are taken.

        CannotCutError for figures that the wire does not fit into, or in whose waste there is no room.
        """
        demands = self.demands(making)
        kept_um = np.array([each.place_um for each in taken.values()]).reshape(-1, 2)
        found = chosen(self.room, self.side, wanted, demands, kept_um)
        if making.lead == "point":
            found |= before_corners(self.room, self.side, found, demands, kept_um)
        missing = [at for at in wanted.tolist() if at not in found]
        if missing:
            for at in missing:  # where the wire itself does not fit in, that is why there is no room
                offset_path(self.figures[at], self.reach_um, making.corners)
            places = tuple(Point(*self.figures[at].contour.start_um[0].tolist()) for at in missing)
            numbers = ", ".join(str(self.figures[at].number) for at in missing[:_MOST_NUMBERS])
            values = (("figures", numbers), ("least_mm", f"{mm(demands.least_um):.4g}"))
            numbers_of = tuple(self.figures[at].number for at in missing)
            raise CannotCutError(Refusal("no-room", places[:_MOST_NUMBERS], values, numbers_of))
        return found

    def demands(self, making: Making) -> Wanted:
        """What is asked of leads."""
        spare_um = _SPARE_UM if making.lead in _ROUND else 0.0
        return Wanted(self.clear_um, making.lead_um, spare_um, self.reach_um > 0.0 or making.lead_um is not None)

    def _clear(self, place_um: Floats) -> Floats:
        """(m,) how far places lie from all contours, as far as it matters."""
        return nearest(self.room, place_um, self.clear_um).distance_um

    def led(
        self, threads: Mapping[int, Thread], making: Making, entered: frozenset[int] = frozenset()
    ) -> tuple[Thread, ...]:
        """Threads of all figures, in their order, with the lead that is asked for where that may be.

        Leads to corners are not for figures that are `entered` where it was asked for.

        Round leads are for slugs alone. A pass runs into the kerf of its own lead-in before it comes to its end: a part
        would fall with a nib on its edge, while that of a hole is cut off the part that stays. Nor are they for passes
        back and forth: the lead of a pass back would cut the slug in two. Nor are they for slugs that hang by tabs,
        into which they would cut.
        """
        lead = making.lead
        lead_off = {at: thread for at, thread in threads.items() if thread.by not in _WITHOUT_LEAD}
        places = {at: np.array(each.place_um, dtype=np.float64) for at, each in lead_off.items()}
        found = dict(threads)
        if lead == "point":
            places = {at: place for at, place in places.items() if at not in entered}
            for at, entry in at_corners(self.room, self.side, places, self.clear_um).items():
                found[at] = threads[at]._replace(entry=entry, lead=lead)
        elif lead in _ROUND and places and not _is_back(making):
            off = np.array([math.dist(each.place_um, each.entry.place_um) for each in lead_off.values()])
            clear = nearest(self.room, np.array(list(places.values())), float(off.max())).distance_um
            # Leads of all forms are free in the circle about the thread point that touches contours at the entry alone.
            is_round = (clear >= off - TOLERANCE_UM) & (self.side[list(lead_off)] > 0.0)
            is_round &= [not has_slug_tab(self.figures[at], making) for at in lead_off]
            for at in np.array(list(lead_off))[is_round].tolist():
                found[at] = threads[at]._replace(lead=lead)
        return tuple(found[at] for at in range(len(self.figures)))


def _is_back(making: Making) -> bool:
    """Whether some passes run back."""
    return making.returning == "back" and len(making.passes_um) > 1


def _whole(places: Sequence[Point]) -> Floats:
    """Places (m, 2) in whole µm."""
    return np.round(np.array(places, dtype=np.float64).reshape(-1, 2)) + 0.0
