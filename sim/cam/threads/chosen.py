"""Thread points chosen in the waste."""

from typing import Final

import numpy as np

from controller.offset.rows import lines_between
from parser.geometry.along import along_um
from parser.geometry.curves import Floats, Ints
from parser.geometry.feet import feet
from parser.toolpath import Point
from sim.cam.leads.room import Room, are_free, balls_um
from sim.cam.model import CannotCutError, Refusal, Thread
from sim.cam.threads.entries import Entries, middles

USUAL_LEAD_UM: Final = 2000.0
"""How long leads are where nobody asks: room for a start hole of 3 mm, and little to cut (assumed)."""
BEYOND_UM: Final = 10.0
"""A lead is longer than the largest offset by this much."""
_WHOLE_UM: Final = 3.0  # a place moves by less when it is rounded to whole µm, from one side to the other
_ON_UM: Final = 0.01  # a place this near to whole µm is one: files lose as much by printing decimals
_NEARLY: Final = 0.8  # of the largest circle that any entry has beside it: so large a one is large enough


def chosen(room: Room, side: Floats, wanted: Ints, reach_um: float, lead_um: float | None) -> dict[int, Thread]:
    """A thread point for each of the figures `wanted`, in whole µm, across from an entry, where a lead is free.

    It lies as far from the entry as `lead_um` says, 2 mm where it is None, and from all contours no less, so that the
    start hole has room. Where no entry has so much room beside it, the thread point lies in the middle of what there
    is. CannotCutError, ``too-small``, where a lead longer than the reach has no room; ``short-lead`` where one that is
    asked for is no longer.
    """
    most, least = USUAL_LEAD_UM if lead_um is None else lead_um, reach_um + BEYOND_UM
    if lead_um is not None and lead_um < least:
        raise CannotCutError(Refusal("short-lead", (), (("least_mm", f"{least / 1000.0:g}"),)))
    most = max(most, least)
    found = middles(room, side, wanted, reach_um)
    figure = room.figure[found.row]
    ball = balls_um(room, found.place_um, found.out, most + _WHOLE_UM)
    largest = np.zeros(len(side))
    np.maximum.at(largest, figure, ball)
    order = np.lexsort([np.arange(len(ball)), ball < _NEARLY * largest[figure], ball < most, figure])
    found, figure, length = found.take(order), figure[order], np.minimum(ball[order] - _WHOLE_UM, most)
    place, entries, far = _in_whole_um(room, found, length)
    fits = np.flatnonzero((far >= least) & are_free(room, lines_between(place, entries.begin_um), reach_um))
    first = fits[np.diff(figure[fits], prepend=-1) > 0]
    missing = np.setdiff1d(wanted, figure[first])
    if len(missing):
        starts = room.curves.start_um[np.searchsorted(room.figure, missing)]
        raise CannotCutError(Refusal("too-small", tuple(Point(x, y) for x, y in starts.tolist())))
    return {
        int(figure[at]): Thread(Point(*place[at].tolist()), "chosen", entries.one(room, at)) for at in first.tolist()
    }


def begun_on(room: Room, side: Floats, wanted: Ints) -> dict[int, Thread]:
    """Threads of the figures `wanted` on their contours, in whole µm, at entries that are so if there are any."""
    found = middles(room, side, wanted, 0.0)
    figure, place = room.figure[found.row], np.round(found.place_um) + 0.0
    off = np.abs(found.place_um - place).max(axis=1)
    order = np.lexsort([np.arange(len(off)), off > _ON_UM, figure])
    first = order[np.diff(figure[order], prepend=-1) > 0]
    return {
        int(figure[at]): Thread(Point(*place[at].tolist()), "contour", found.one(room, at)) for at in first.tolist()
    }


def _in_whole_um(room: Room, found: Entries, length_um: Floats) -> tuple[Floats, Entries, Floats]:
    """Places (m, 2) out from entries, in whole µm; the entries straight across from those, and how far off (m,)."""
    place = np.round(found.place_um + np.maximum(length_um, 0.0)[:, None] * found.out) + 0.0
    foot = feet(room.curves, found.row, place)
    by = place - foot.place_um
    far = np.hypot(*by.T)
    out = np.where((far > 0.0)[:, None], by / np.where(far > 0.0, far, 1.0)[:, None], found.out)
    along = along_um(room.curves, found.row, foot.place_um)
    return place, Entries(found.row, along, foot.place_um, out, np.minimum(found.aside_um, far)), far
