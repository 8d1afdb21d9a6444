"""Thread points chosen in the waste.

Thread points that lie apart: where one start hole is, there is no room for another one.
"""

from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
import shapely

from controller.offset.chain import lines_between
from parser.geometry.along import along_um
from parser.geometry.curves import Bools, Floats, Ints
from parser.geometry.distance import feet
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.entries import MOST, Entries, EntryRequest, corners, middles, starts
from sim.make.cam.leads import Room, are_free, balls_um, nearest
from sim.make.cam.model import CannotCutError, Refusal, Thread

HOLE_UM: Final = 1000.0
"""Thread points lie apart by a start hole of 1 mm (assumed).

A reader of 3B takes what ends within a kerf of a figure's corner for another pass over it
(`parser.shape.parallel_runs`): so near to one thread point no jump leads to another one.
"""


def are_apart(place_um: Floats, kept_um: Floats) -> Bools:
    """(m,) which of places (m, 2) lie apart from all that are kept (k, 2)."""
    apart = np.ones(len(place_um), dtype=np.bool_)
    apart[_near(place_um, kept_um)[0]] = False
    return apart


def crowded(threads: Mapping[int, Thread], kept_um: Floats) -> list[int]:
    """Figures whose thread points lie near those that are kept (k, 2), or near that of another figure that stays."""
    figures = sorted(threads)
    place_um = np.array([threads[at].place_um for at in figures]).reshape(-1, 2)
    moving = ~are_apart(place_um, kept_um)
    this, other = _near(place_um, place_um)
    for first, second in sorted(zip(other.tolist(), this.tolist(), strict=True)):
        if first < second and not moving[first]:
            moving[second] = True
    return [figures[at] for at in np.flatnonzero(moving).tolist()]


def _near(place_um: Floats, kept_um: Floats) -> tuple[Ints, Ints]:
    """Pairs of places (m, 2) and of those that are kept (k, 2) that lie nearer than a start hole, by their rows."""
    tree = shapely.STRtree(np.asarray(shapely.points(kept_um), dtype=np.object_))
    place, hole = tree.query(shapely.points(place_um), predicate="dwithin", distance=HOLE_UM)
    return place, hole


USUAL_LEAD_UM: Final = 2000.0
"""How long leads are where nobody asks: room for a start hole of 3 mm, and little to cut (assumed)."""
CENTRE_UM: Final = 5000.0
"""A hole that is no wider than twice this is threaded in its middle, as shops drill start holes of small openings.

Of a larger one that lead would cost more than it saves: there the start hole stands near the edge (usual in wire EDM
handbooks; the bound is assumed).
"""
BEYOND_UM: Final = 10.0
"""A lead is longer than the largest offset by this much."""
_SHORTER: Final = (1.0, 0.5, 0.25)  # leads to corners, where there is less room
_ON_UM: Final = 0.01  # a place this near to whole µm is one: files lose as much by printing decimals
_NOWHERE: Final = np.empty((0, 2))

_MOST_ROUNDS: Final = 5  # figures that were moved may lie near each other: ever fewer do
_FOOT_UM: Final = 10.0  # more than what is straight across moves as a place becomes whole µm
_SAME_BALL_UM: Final = 0.01  # circles that differ by no more are one
_NEARLY: Final = 0.8  # of the largest circle that any entry has beside it: so large a one is large enough


class Wanted(NamedTuple):
    """What is asked of leads.

    Attributes
    ----------
    reach_um
        How far all of them keep off contours.
    lead_um
        How long they are where there is room; `USUAL_LEAD_UM` where None.
    spare_um
        How much nearer to its entry than to anything else a thread point lies.
    has_leads
        Whether there are any; else the wire begins on the contour.
    """

    reach_um: float
    lead_um: float | None
    spare_um: float
    has_leads: bool = True

    @property
    def least_um(self) -> float:
        """How long leads are at least."""
        return self.reach_um + BEYOND_UM

    @property
    def most_um(self) -> float:
        """How long leads are where there is room."""
        return max(USUAL_LEAD_UM, self.least_um) if self.lead_um is None else self.lead_um

    @property
    def centre_um(self) -> float:
        """Holes with no more room than this in any direction are threaded in their middle."""
        return CENTRE_UM if self.lead_um is None else 0.0

    @property
    def widest_um(self) -> float:
        """How much room matters: more than that is as good."""
        return max(self.most_um, self.centre_um + _SAME_BALL_UM)


def chosen(room: Room, side: Floats, figures: Ints, wanted: Wanted, kept_um: Floats) -> dict[int, Thread]:
    """A thread point for each of the figures that has room for it, in whole µm, across from an entry.

    Of a small hole it lies in the middle, where nobody asks for another lead. Else it lies as far from the entry as is
    wanted, and from all contours no less, so that the start hole has room. Where no entry has so much room beside it,
    the thread point lies in the middle of what there is. The few longest curves of each figure are looked at, and the
    middles of all of those that have room at none of them. CannotCutError, ``short-lead``, where a lead that is asked
    for is shorter than the least.

    Where there is room it lies a start hole away from all others, and from the thread points (k, 2) that are kept.
    """
    if wanted.most_um < wanted.least_um:
        raise CannotCutError(Refusal("short-lead", (), (("least_mm", f"{mm(wanted.least_um):g}"),)))
    found = _chosen(room, side, starts(room, side, figures, wanted.reach_um), wanted, _NOWHERE)
    left = np.array([at for at in figures.tolist() if at not in found], dtype=np.int64)
    if len(left):
        found |= _chosen(room, side, middles(room, side, left, wanted.reach_um), wanted, _NOWHERE)
    return _apart(room, side, found, wanted, kept_um)


def _apart(room: Room, side: Floats, found: dict[int, Thread], wanted: Wanted, kept_um: Floats) -> dict[int, Thread]:
    """With other places for figures whose thread points lie in one start hole with those of others."""
    for _ in range(_MOST_ROUNDS):
        moving = set(crowded(found, kept_um))
        if not moving:
            break
        staying_um = np.array([each.place_um for at, each in found.items() if at not in moving]).reshape(-1, 2)
        entries = middles(room, side, np.array(sorted(moving)), wanted.reach_um)
        moved = _chosen(room, side, entries, wanted, np.concatenate([kept_um, staying_um]))
        if not moved:
            break
        found = found | moved
    return found


def _chosen(room: Room, side: Floats, found: Entries, wanted: Wanted, kept_um: Floats) -> dict[int, Thread]:
    """A thread point for each figure that has room for it across from one of the entries, apart from those kept."""
    figure = room.figure[found.row]
    ball = balls_um(room, found.place_um, found.out, wanted.widest_um + wanted.spare_um)
    largest = np.zeros(int(room.figure[-1]) + 1)
    np.maximum.at(largest, figure, ball)
    is_small = (side[figure] > 0.0) & (largest[figure] <= wanted.centre_um)
    # Beside other contours more room than is wanted is no better: the entries stay in their order.
    room_um = np.where(is_small, largest[figure], np.minimum(largest[figure], wanted.most_um))
    enough_um = np.where(is_small, room_um - _SAME_BALL_UM, wanted.most_um)
    order = np.lexsort([np.arange(len(ball)), ball < _NEARLY * room_um, ball < enough_um, figure])
    length = np.minimum(ball - wanted.spare_um, room_um)[order]
    found, figure = found.take(order), figure[order]
    place, entries, far = _in_whole_um(room, found, length)
    is_free = are_free(room, lines_between(place, entries.begin_um), wanted.reach_um)
    fits = np.flatnonzero((far >= wanted.least_um) & is_free & are_apart(place, kept_um))
    first = fits[np.diff(figure[fits], prepend=-1) > 0]
    return {
        int(figure[at]): Thread(Point(*place[at].tolist()), "chosen", entries.entry(room, at)) for at in first.tolist()
    }


def out_from(
    room: Room, side: Floats, found: tuple[Entries, Entries], wanted: Wanted, kept_um: Floats
) -> dict[int, Thread]:
    """A thread point for each figure that has room for it out from its corner, or else from its other entry."""
    at_corners, entries = found
    threads = _out_from_corners(room, at_corners, wanted, kept_um)
    left = entries.take(np.flatnonzero(~np.isin(room.figure[entries.row], list(threads))))
    return threads | _chosen(room, side, left, wanted, kept_um)


def before_corners(
    room: Room, side: Floats, threads: Mapping[int, Thread], wanted: Wanted, kept_um: Floats
) -> dict[int, Thread]:
    """Other thread points of figures that have them: midway out from their nearest corner with room before it.

    A lead to a corner from anywhere else runs along a side of it: what is cut comes free before the wire is round.
    """
    if not threads:
        return {}
    places = np.array([thread.place_um for thread in threads.values()])
    found, whose = corners(room, side, EntryRequest(np.array(list(threads)), places, wanted.reach_um))
    best = np.flatnonzero(np.arange(len(whose)) - np.searchsorted(whose, whose) < MOST)
    moved = _out_from_corners(room, found.take(best), wanted, kept_um)
    staying_um = np.array([thread.place_um for at, thread in threads.items() if at not in moved]).reshape(-1, 2)
    near = set(crowded(moved, np.concatenate([kept_um, staying_um])))
    return {at: each for at, each in moved.items() if at not in near}


def _out_from_corners(room: Room, found: Entries, wanted: Wanted, kept_um: Floats) -> dict[int, Thread]:
    """A thread point midway out from the first of its corners that has room before it, for each figure."""
    moved = dict[int, Thread]()
    for share in _SHORTER:
        place = np.round(found.begin_um + share * wanted.most_um * found.out) + 0.0
        is_free = are_free(room, lines_between(place, found.begin_um), wanted.reach_um)
        is_clear = nearest(room, place, wanted.least_um).distance_um >= wanted.least_um
        for at in np.flatnonzero(is_free & is_clear & are_apart(place, kept_um)).tolist():
            x, y = place[at].tolist()
            moved.setdefault(int(room.figure[found.row[at]]), Thread(Point(x, y), "chosen", found.entry(room, at)))
    return moved


def begun_on(room: Room, side: Floats, wanted: Ints) -> dict[int, Thread]:
    """Threads of the figures `wanted` on their contours, in whole µm, at entries that are so if there are any."""
    found = starts(room, side, wanted, 0.0)
    figure, place = room.figure[found.row], np.round(found.place_um) + 0.0
    off = np.abs(found.place_um - place).max(axis=1)
    order = np.lexsort([np.arange(len(off)), off > _ON_UM, figure])
    first = order[np.diff(figure[order], prepend=-1) > 0]
    return {
        int(figure[at]): Thread(Point(*place[at].tolist()), "contour", found.entry(room, at)) for at in first.tolist()
    }


def _in_whole_um(room: Room, found: Entries, length_um: Floats) -> tuple[Floats, Entries, Floats]:
    """Places (m, 2) out from entries, in whole µm; the entries straight across from those, and how far off (m,).

    From near the centre of an arc all of it is straight across: there the entry stays, on the axis of a circle.
    """
    place = np.round(found.place_um + np.maximum(length_um, 0.0)[:, None] * found.out) + 0.0
    foot = feet(room.curves, found.row, place).place_um
    stays = np.hypot(*(foot - found.place_um).T) > _FOOT_UM
    foot = np.where(stays[:, None], found.place_um, foot)
    along = np.where(stays, found.along_um, along_um(room.curves, found.row, foot))
    by = place - foot
    far = np.hypot(*by.T)
    out = np.where((far > 0.0)[:, None], by / np.where(far > 0.0, far, 1.0)[:, None], found.out)
    return place, Entries(found.row, along, foot, out, np.minimum(found.aside_um, far)), far
