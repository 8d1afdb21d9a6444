"""Thread points: those that are asked for, those that are marked in the drawing, and others chosen in the waste."""

from collections.abc import Sequence

import numpy as np

from parser.drawing.model import Drawing
from parser.geometry.along import headings_along, places_at
from parser.toolpath import Point
from sim.cam.model import Entry, Figure, Thread
from sim.setup.making import Making

_USUAL_LEAD_UM = 2000.0


def threads_of(drawing: Drawing, figures: Sequence[Figure], making: Making, reach_um: float) -> tuple[Thread, ...]:
    """A thread point for each figure; CannotCutError where there is no place for one."""
    return tuple(_thread(figure, making, reach_um) for figure in figures)


def entry_at(figure: Figure, row: int, along_um: float) -> Entry:
    """The entry at a place along a contour; the waste is within a hole, and outside of a part."""
    rows = np.array([row])
    place = places_at(figure.contour, rows, np.array([along_um]))[0]
    way = headings_along(figure.contour, rows, np.array([along_um]))[0]
    sign = 1.0 if figure.runs_inside else -1.0
    return Entry(row, along_um, Point(*place.tolist()), Point(float(-way[1] * sign), float(way[0] * sign)))


def _thread(figure: Figure, making: Making, reach_um: float) -> Thread:
    """Across from the middle of the longest line, else of the longest curve."""
    longest = int(np.argmax(figure.contour.length_um - 1e9 * figure.contour.is_arc))
    entry = entry_at(figure, longest, 0.5 * float(figure.contour.length_um[longest]))
    lead = making.lead_um or _USUAL_LEAD_UM
    if not reach_um:
        return Thread(entry.place_um, "contour", entry)
    at = Point(round(entry.place_um.x + lead * entry.out.x), round(entry.place_um.y + lead * entry.out.y))
    return Thread(at, "chosen", entry)
