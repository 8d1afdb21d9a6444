"""Leads: from the thread point to where a pass begins, and from where it ends back, by the room between contours.

The room between contours: how far places and ways in it are from all of them.

Forms of a lead-in, each from a thread point straight across from where the pass begins.

A straight one, and with an arc at its end: a quarter circle, or a longer arc into which the line runs smoothly. All of
them stay within the circle about the thread point through the beginning of the pass. So where the contour comes nowhere
nearer to the thread point than at the entry, they stay as far from it as the pass does.
"""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from controller.offset.chain import lines_between
from controller.offset.gouges import approaches
from parser.drawing.model import running
from parser.geometry.along import directions, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import feet
from parser.geometry.near import near_places
from sim.make.cam.model import Figure, Thread
from sim.setup.making import LeadIn

TOLERANCE_UM: Final = 0.05
"""A way that comes nearer by less is free: a twentieth of a step of the machine, as gouges are judged."""
_SAME_UM: Final = 1e-3
_ROUNDS: Final = 50  # each one halves a ball, or more, where it does not end


class Room(NamedTuple):
    """Contours of all figures.

    Attributes
    ----------
    curves
        (n,) of all of them.
    figure
        (n,) which figure each is of, as its place in their sequence.
    is_spared
        (n,) whether no cut is to start on it.
    """

    curves: Curves
    figure: Ints
    is_spared: Bools

    def rows(self, figure: Ints) -> tuple[Ints, Ints]:
        """Rows (m,) of figures (k,), all of one behind those of the other, and whose they are (m,), 0 to k − 1."""
        first, past = np.searchsorted(self.figure, figure), np.searchsorted(self.figure, figure + 1)
        whose = np.repeat(np.arange(len(figure)), past - first)
        before = np.cumsum(past - first) - (past - first)
        return np.arange(len(whose)) - before[whose] + first[whose], whose


def room_of(figures: Sequence[Figure], is_spared: Bools | None = None) -> Room:
    """The room between the contours of figures, one at least; of their curves (n,) none is spared where None."""
    number = [len(figure.contour) for figure in figures]
    which = np.repeat(np.arange(len(figures)), number)
    spared = np.zeros(len(which), dtype=np.bool_) if is_spared is None else is_spared
    return Room(joined([figure.contour for figure in figures]), which, spared)


def are_free(room: Room, ways: Curves, by_um: float) -> Bools:
    """(k,) whether lines and arcs keep a distance from all contours, less `TOLERANCE_UM`; exact, ends included."""
    free = np.ones(len(ways), dtype=np.bool_)
    free[approaches(room.curves, ways, by_um - TOLERANCE_UM).path_row] = False
    return free


class Nearest(NamedTuple):
    """The place (m, 2) of all contours nearest to each of m places, and how far off (m,); NaN and ∞ beyond a limit."""

    place_um: Floats
    distance_um: Floats


def nearest(room: Room, place_um: Floats, within_um: float) -> Nearest:
    """What is nearest to places (m, 2), no farther than a limit; some that lies farther may be found as well."""
    near = near_places(room.curves, place_um, within_um)
    foot = feet(room.curves, near.row, place_um[near.other]).place_um
    off = np.hypot(*(foot - place_um[near.other]).T)
    order = np.lexsort([near.row, off, near.other])
    first = order[np.diff(near.other[order], prepend=-1) > 0]
    result = Nearest(np.full((len(place_um), 2), np.nan), np.full(len(place_um), np.inf))
    result.place_um[near.other[first]] = foot[first]
    result.distance_um[near.other[first]] = off[first]
    return result


def balls_um(room: Room, place_um: Floats, out: Floats, most_um: float) -> Floats:
    """Radii (m,) of the largest circles free of contours that touch them at places (m, 2), on the sides `out` (m, 2).

    None is larger than `most_um`. Each circle shrinks until nothing lies within: the next one goes through the place
    that lies nearest to the centre of the last one (shrinking ball, Ma, Bae and Choi 2012).
    """
    radius = np.full(len(place_um), most_um)
    left: Ints = np.arange(len(place_um))
    for _ in range(_ROUNDS):
        found = nearest(room, place_um[left] + radius[left, None] * out[left], float(radius[left].max(initial=0.0)))
        inside = np.flatnonzero(found.distance_um < radius[left] - _SAME_UM)
        if not len(inside):
            break
        left = left[inside]
        by = found.place_um[inside] - place_um[left]
        radius[left] = (by * by).sum(axis=1) / (2.0 * (by * out[left]).sum(axis=1))
    return radius


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


_SAME_PLACE_UM = 1e-3


def lead_in(thread: Thread, along: Curves) -> Curves:
    """The way (m,) from the thread point to where a pass `along` begins; none where the wire is threaded there."""
    heading = directions(along).leaving[0]
    return lead_of(thread.lead, np.array(thread.place_um, dtype=np.float64), along.start_um[0], heading)


def lead_out(thread: Thread, along: Curves) -> Curves:
    """The way (m,) from where a pass ends back to the thread point.

    A pass that ends where it began goes back as it came, in the kerf of its lead-in: another way would part the slug.
    """
    end, place = along.end_um[-1], np.array(thread.place_um, dtype=np.float64)
    if np.hypot(*(end - along.start_um[0])) > _SAME_PLACE_UM:
        return line(end, place)
    return run_back(lead_in(thread, along))


def run_back(way: Curves) -> Curves:
    """A way run from its end to its start."""
    rows = np.arange(len(way))[::-1]
    return running(way, rows, np.ones(len(way), dtype=np.bool_))
