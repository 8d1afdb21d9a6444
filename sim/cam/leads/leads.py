"""Leads: from the thread point to where a pass begins, and from where it ends back."""

import numpy as np

from parser.geometry.curves import Curves, curves_between
from parser.toolpath import Point
from sim.cam.model import Figure, Thread
from sim.setup.making import Making


def lead_in(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from the thread point to where a pass `along` begins. CannotCutError where none is free."""
    return _line(thread.place_um, Point(*along.start_um[0].tolist()))


def lead_out(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from where a pass ends back to the thread point."""
    return _line(Point(*along.end_um[-1].tolist()), thread.place_um)


def _line(start: Point, end: Point) -> Curves:
    """A line, none where it has no length."""
    rows = np.array([[start, end]], dtype=np.float64)
    rows = rows[np.hypot(*(rows[:, 1] - rows[:, 0]).T) > 1e-6]
    return curves_between(rows[:, 0], rows[:, 1], np.full((len(rows), 2), np.nan), np.zeros(len(rows)))
