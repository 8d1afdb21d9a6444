"""Leads: from the thread point to where a pass begins, and from where it ends back."""

import numpy as np

from parser.drawing.model import running
from parser.geometry.curves import Curves
from parser.geometry.directions import directions
from sim.cam.leads.forms import lead_of, line
from sim.cam.model import Thread

_SAME_UM = 1e-3


def lead_in(thread: Thread, along: Curves) -> Curves:
    """The way (m,) from the thread point to where a pass `along` begins; none where the wire is threaded there."""
    heading = directions(along).leaving[0]
    return lead_of(thread.lead, np.array(thread.place_um, dtype=np.float64), along.start_um[0], heading)


def lead_out(thread: Thread, along: Curves) -> Curves:
    """The way (m,) from where a pass ends back to the thread point.

    A pass that ends where it began goes back as it came, in the kerf of its lead-in: another way would part the slug.
    """
    end, place = along.end_um[-1], np.array(thread.place_um, dtype=np.float64)
    if np.hypot(*(end - along.start_um[0])) > _SAME_UM:
        return line(end, place)
    into = lead_in(thread, along)
    return running(into, np.arange(len(into))[::-1], np.ones(len(into), dtype=np.bool_))
