"""Where cuts start that are asked for: the entry on the nearest contour, and a thread point for it."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from controller.offset.chain import lines_between
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import feet
from parser.toolpath import Point
from sim.make.cam.chosen import Wanted, crowded, out_from
from sim.make.cam.entries import Entries, EntryRequest, corners_at, entries_at
from sim.make.cam.leads import Room, are_free
from sim.make.cam.model import Thread, refused

_SHARES: Final = (1.0, 0.5, 0.25)
"""Of the wanted length of a lead, tried one after the other: thread points of cuts that face each other lie apart."""


def figures_at(room: Room, place_um: Floats, in_kerf: Mapping[int, Thread]) -> dict[int, Floats]:
    """Places (m, 2) µm by the figures whose contours lie nearest.

    CannotCutError where two are for one figure, or one for a figure that begins in the kerf of others.
    """
    row = np.arange(len(room.figure))
    figure: list[int] = []
    for place in place_um:
        foot = feet(room.curves, row, np.broadcast_to(place, (len(row), 2))).place_um
        figure.append(int(room.figure[np.argmin(np.hypot(*(foot - place).T))]))
    twice = np.array([figure.count(at) > 1 for at in figure], dtype=np.bool_)
    if twice.any():
        raise refused("enter-twice", place_um[twice])
    kerf = np.array([at in in_kerf for at in figure], dtype=np.bool_)
    if kerf.any():
        raise refused("enter-in-kerf", place_um[kerf])
    return dict(zip(figure, place_um, strict=True))


def entered(
    room: Room, side: Floats, places: Mapping[int, Floats], threads: Mapping[int, Thread], wanted: Wanted
) -> dict[int, Thread]:
    """Threads of figures whose entries are to be near places (2,) µm, or at the corners there.

    From a thread point that stands the wire comes to its entry straight; another one is chosen out from it, or lies on
    the contour where leads have no length. CannotCutError, ``enter-hidden``, where there is no room.
    """
    if not places:
        return {}
    request = EntryRequest(np.array(list(places)), np.array(list(places.values())), wanted.reach_um)
    at_corners, others = (find(room, side, request) for find in (corners_at, entries_at))
    found = _from_standing(room, others, threads, wanted) | _from_standing(room, at_corners, threads, wanted)
    left = np.array([at for at in places if at not in threads], dtype=np.int64)
    if wanted.has_leads:
        found |= _out_from(room, side, (_of(room, at_corners, left), _of(room, others, left)), threads, wanted)
    else:
        found |= _on_contours(room, _of(room, others, left))
    hidden = [at not in found for at in places]
    if any(hidden):
        raise refused("enter-hidden", request.place_um[hidden])
    return found


def _of(room: Room, found: Entries, figures: Ints) -> Entries:
    """The entries of some figures."""
    return found.take(np.flatnonzero(np.isin(room.figure[found.row], figures)))


def _from_standing(room: Room, found: Entries, threads: Mapping[int, Thread], wanted: Wanted) -> dict[int, Thread]:
    """Threads that stand with these entries, those to which the straight way is free."""
    standing = _of(room, found, np.array(list(threads), dtype=np.int64))
    figure = room.figure[standing.row].tolist()
    from_um = np.array([threads[at].place_um for at in figure]).reshape(-1, 2)
    free = are_free(room, lines_between(from_um, standing.begin_um), wanted.reach_um)
    return {
        figure[at]: threads[figure[at]]._replace(entry=standing.entry(room, at)) for at in np.flatnonzero(free).tolist()
    }


def _out_from(
    room: Room, side: Floats, found: tuple[Entries, Entries], threads: Mapping[int, Thread], wanted: Wanted
) -> dict[int, Thread]:
    """Thread points out from entries, each in a start hole of its own."""
    at_corners, others = found
    chosen: dict[int, Thread] = {}
    for share in _SHARES:
        demands = wanted if share == 1.0 else wanted._replace(lead_um=share * wanted.most_um)
        left = np.setdiff1d(room.figure[others.row], list(chosen))
        if not len(left) or demands.most_um < demands.least_um:
            break
        taken_um = np.array([each.place_um for each in (*threads.values(), *chosen.values())]).reshape(-1, 2)
        more = out_from(room, side, (_of(room, at_corners, left), _of(room, others, left)), demands, taken_um)
        moving = set(crowded(more, taken_um))
        chosen |= {at: thread for at, thread in more.items() if at not in moving}
    return chosen


def _on_contours(room: Room, found: Entries) -> dict[int, Thread]:
    """Threads on contours, in whole µm, at their entries."""
    place_um = (np.round(found.place_um) + 0.0).tolist()
    figure = room.figure[found.row].tolist()
    return {
        of: Thread(Point(*place), "contour", found.entry(room, at))
        for at, (of, place) in enumerate(zip(figure, place_um, strict=True))
    }
