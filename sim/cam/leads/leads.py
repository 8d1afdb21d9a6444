"""Leads: from the thread point to where a pass begins, and from where it ends back."""

import numpy as np

from parser.drawing.model import running
from parser.geometry.curves import Curves
from parser.geometry.directions import directions
from sim.cam.leads.forms import lead_of
from sim.cam.model import Figure, Thread
from sim.setup.making import Making


def lead_in(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from the thread point to where a pass `along` begins; none where the wire is threaded there."""
    heading = directions(along).leaving[0]
    return lead_of(thread.lead, np.array(thread.place_um), along.start_um[0], heading)


def lead_out(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from where a pass ends back to the thread point, of the same form as the lead-in."""
    end, heading = along.end_um[-1], -directions(along).arriving[-1]
    into = lead_of(thread.lead, np.array(thread.place_um), end, heading)
    return running(into, np.arange(len(into))[::-1], np.ones(len(into), dtype=np.bool_))
