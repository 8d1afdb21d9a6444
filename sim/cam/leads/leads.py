"""Leads: from the thread point to where a pass begins, and from where it ends back."""

import numpy as np

from parser.drawing.model import running
from parser.geometry.curves import Curves, joined
from parser.geometry.directions import directions
from sim.cam.leads.forms import lead_of, line
from sim.cam.leads.room import are_free, nearest, room_of
from sim.cam.model import Figure, Thread
from sim.setup.making import Making

_SAME_UM = 1e-3


def lead_in(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from the thread point to where a pass `along` begins; none where the wire is threaded there."""
    heading = directions(along).leaving[0]
    return lead_of(thread.lead, np.array(thread.place_um), along.start_um[0], heading)


def lead_out(figure: Figure, thread: Thread, along: Curves, making: Making) -> Curves:
    """The way (m,) from where a pass ends back to the thread point.

    It leaves a pass that ends where it began as the wire came. From the end of an overcut it runs straight, or, where
    that comes nearer to the contour than the pass does, back along the overcut first.
    """
    end, place = along.end_um[-1], np.array(thread.place_um)
    if np.hypot(*(end - along.start_um[0])) <= _SAME_UM:
        return _turned(lead_of(thread.lead, place, end, -directions(along).arriving[-1]))
    straight = line(end, place)
    if _is_free(figure, straight):
        return straight
    begun = np.flatnonzero(np.hypot(*(along.start_um - along.start_um[0]).T) <= _SAME_UM)
    overcut = along.picked(slice(int(begun[-1]), None))
    return joined([_turned(overcut), line(along.start_um[0], place)])


def _is_free(figure: Figure, way: Curves) -> bool:
    """Whether a way keeps from the contour of its own figure as far as its start, or its end if that is nearer."""
    room = room_of([figure])
    ends = nearest(room, np.concatenate([way.start_um, way.end_um]), float(way.length_um.max(initial=0.0)))
    return bool(are_free(room, way, float(ends.distance_um.min(initial=np.inf))).all())


def _turned(way: Curves) -> Curves:
    """A way run from its end to its start."""
    return running(way, np.arange(len(way))[::-1], np.ones(len(way), dtype=np.bool_))
