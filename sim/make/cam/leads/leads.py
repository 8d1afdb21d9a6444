"""Leads: from the thread point to where a pass begins, and from where it ends back.

Forms of a lead-in, each from a thread point straight across from where the pass begins.

A straight one, and with an arc at its end: a quarter circle, or a longer arc into which the line runs smoothly. All of
them stay within the circle about the thread point through the beginning of the pass. So where the contour comes nowhere
nearer to the thread point than at the entry, they stay as far from it as the pass does.
"""

import math

import numpy as np

from controller.offset.chain import lines_between
from parser.drawing.model import running
from parser.geometry.along import directions, to_left
from parser.geometry.curves import Curves, Floats, curves_between, joined
from sim.make.cam.model import Thread
from sim.setup.making import LeadIn

_SHORTEST_UM = 20.0  # of leads with arcs: of less, the arcs would be steps
_ACROSS = 0.02  # cosine between a lead and the pass, up to which it comes straight across


def lead_of(form: LeadIn, start_um: Floats, end_um: Floats, heading: Floats) -> Curves:
    """Curves from a thread point (2,) to the beginning (2,) of a pass with a heading (2,), none between equal places.

    A line where the form has no arc, the thread point does not lie across, or the way is too short for an arc.
    """
    by = start_um - end_um
    length = math.hypot(*by)
    if form not in ("arc", "tangent") or length < _SHORTEST_UM or abs(by @ heading) > _ACROSS * length:
        return line(start_um, end_um)
    out = by / length
    radius, turn = (0.5 * length, 0.5 * math.pi) if form == "arc" else (length / 3.0, 2.0 * math.pi / 3.0)
    center = end_um + radius * out
    # Seen from the centre the arc ends where `out` comes from, and begins a turn before that.
    begin = center + radius * (-math.cos(turn) * out - math.sin(turn) * heading)
    is_left = float(to_left(heading[None])[0] @ out) > 0.0
    arc = curves_between(begin[None], end_um[None], center[None], np.array([turn if is_left else -turn]))
    return joined([line(start_um, begin), arc])


def line(start_um: Floats, end_um: Floats) -> Curves:
    """A line, none where it has no length."""
    whole = lines_between(start_um[None], end_um[None])
    return whole.picked(np.flatnonzero(whole.length_um > 1e-6))


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
