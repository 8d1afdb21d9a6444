"""Places where the wire may come to a contour: middles of its curves, places across from a point, its corners."""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import along_um, directions, headings_along, places_at, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.distance import feet
from parser.toolpath import Point
from sim.make.cam.leads import Room
from sim.make.cam.model import Entry

MOST: Final = 12
"""Entries of a figure that are looked at."""
_LONG_UM: Final = 1000.0  # a line as long as this takes an entry before any arc
_ACROSS: Final = 1e-6
_SMOOTH: Final = math.cos(math.radians(2.5))  # fitted arcs meet at up to 2.4° (docs/program.md)


class Entries(NamedTuple):
    """Entries (m,), the best of each figure first.

    Attributes
    ----------
    row, along_um
        (m,) row of the room, and how far along it.
    place_um, out
        (m, 2) on the contour, and unit vectors into the waste.
    aside_um
        (m,) how far out from the place a pass at the offset begins: the offset, more in a corner.
    """

    row: Ints
    along_um: Floats
    place_um: Floats
    out: Floats
    aside_um: Floats

    def take(self, at: Ints) -> "Entries":
        """Those at the indices `at`."""
        return Entries(self.row[at], self.along_um[at], self.place_um[at], self.out[at], self.aside_um[at])

    @property
    def begin_um(self) -> Floats:
        """(m, 2) where the pass at the offset begins."""
        return self.place_um + self.aside_um[:, None] * self.out

    def entry(self, room: Room, at: int) -> Entry:
        """One of them, with the row of its own contour."""
        row = int(self.row[at])
        first = int(np.searchsorted(room.figure, room.figure[row]))
        (x, y), (out_x, out_y) = self.place_um[at].tolist(), self.out[at].tolist()
        return Entry(row - first, float(self.along_um[at]), Point(x, y), Point(out_x, out_y))


class _Looked(NamedTuple):
    """Where entries are looked for: at a share (rows,) of the length of each curve, on so many of a figure at most.

    On a circle they are looked for where it crosses the axes, at one of these places or at all `around` of them.
    """

    share: Floats
    most: int
    around: int = 1


def starts(room: Room, side: Floats, wanted: Ints, reach_um: float) -> Entries:
    """As `middles`, the few best, but of an arc that goes on smoothly from another one its start.

    An entry there costs no block.
    """
    return _entries(room, side, wanted, reach_um, _Looked(np.where(_is_joint(room), 0.0, 0.5), MOST))


def middles(room: Room, side: Floats, wanted: Ints, reach_um: float) -> Entries:
    """Middles of curves of each of the figures `wanted`, of circles all quarters, where a mark hurts least first.

    Lines of 1 mm and more come first, the longest before the others, then what else there is, by length; arcs of a
    radius no larger than the reach of the wire only where there is nothing else, and spared curves only where all are.
    `side` (figures,) is 1 where the waste lies within.
    """
    return _entries(room, side, wanted, reach_um, _Looked(np.full(len(room.figure), 0.5), 4 * len(room.figure), 4))


def _entries(room: Room, side: Floats, wanted: Ints, reach_um: float, looked: _Looked) -> Entries:
    """Entries of each of the figures, the best first."""
    row = np.flatnonzero(np.isin(room.figure, wanted))
    row = np.repeat(row, np.where(_is_circle(room.curves.picked(row)), looked.around, 1))
    curves = room.curves.picked(row)
    quarter = np.arange(len(row)) - np.searchsorted(row, row)
    is_small = curves.is_arc & (curves.radius_um <= reach_um)
    grade = np.where(is_small, 2, np.where(~curves.is_arc & (curves.length_um >= _LONG_UM), 0, 1))
    grade[room.is_spared[row]] = 3
    on_axis = np.mod(_to_axis(curves) + 0.25 * quarter * curves.length_um, curves.length_um)
    along = np.where(_is_circle(curves), on_axis, looked.share[row] * curves.length_um)
    along = _to_whole(room, row, along)
    place = places_at(room.curves, row, along)
    keys = (*np.round(place.T[::-1]), -np.round(curves.length_um), grade, room.figure[row])
    order = np.lexsort(keys)
    figure, grade = room.figure[row[order]], grade[order]
    start = np.flatnonzero(np.diff(figure, prepend=-1))
    of = np.cumsum(np.diff(figure, prepend=-1) > 0) - 1
    is_best = (np.arange(len(order)) - start[of] < looked.most) & ((grade < 2) | (grade == grade[start[of]]))
    order = order[is_best]
    out = _out(room, side, row[order], headings_along(room.curves, row[order], along[order]))
    return Entries(row[order], along[order], place[order], out, np.full(len(order), reach_um))


class EntryRequest(NamedTuple):
    """Thread points (k, 2) of figures (k,) that ask for entries, and how far leads keep off contours."""

    figure: Ints
    place_um: Floats
    reach_um: float


def across_from(room: Room, side: Floats, request: EntryRequest) -> tuple[Entries, Ints]:
    """Entries straight across from thread points, and which of these (m,) each is for: the nearest of each first.

    Arcs no larger than the reach come behind all others, and spared curves last.
    """
    row, whose = room.rows(request.figure)
    place = request.place_um[whose]
    foot = feet(room.curves, row, place).place_um
    along = along_um(room.curves, row, foot)
    by = place - foot
    length = np.hypot(*by.T)
    heading = headings_along(room.curves, row, along)
    is_across = (np.abs((by * heading).sum(axis=1)) < _ACROSS * length) & (length > 0.0)
    is_small = room.curves.is_arc[row] & (room.curves.radius_um[row] <= request.reach_um)
    found = np.flatnonzero(is_across)
    found = found[np.lexsort([length[found], is_small[found], room.is_spared[row[found]], whose[found]])]
    out, aside = _out(room, side, row[found], heading[found]), np.full(len(found), request.reach_um)
    return Entries(row[found], along[found], foot[found], out, aside), whose[found]


def corners(room: Room, side: Floats, request: EntryRequest) -> tuple[Entries, Ints]:
    """Entries where curves meet, from midway between both, those nearest to each of the thread points first.

    Corners of spared curves come last.

    With them, which thread point (m,) each is for. Where the waste lies in a corner, the wire reaches no nearer to it
    than where it touches both sides.
    """
    row, whose = room.rows(request.figure)
    leaving, arriving = (way[row] for way in directions(room.curves))
    first = np.searchsorted(whose, whose)
    last = np.searchsorted(whose, whose, side="right") - 1
    at = np.arange(len(row))
    before = np.where(at > first, at - 1, last)
    arriving = arriving[before]
    is_spared = room.is_spared[row] | room.is_spared[row[before]]
    sense = side[room.figure[row], None]
    normal, middle = sense * to_left(leaving), sense * (to_left(leaving) + to_left(arriving))
    length = np.hypot(*middle.T)
    off = np.hypot(*(room.curves.start_um[row] - request.place_um[whose]).T)
    corner = np.flatnonzero(length > _ACROSS)
    corner = corner[np.lexsort([off[corner], is_spared[corner], whose[corner]])]
    out = middle[corner] / length[corner, None]
    turn = (arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0])[corner]
    aside = request.reach_um / np.where(sense[corner, 0] * turn > 0.0, (out * normal[corner]).sum(axis=1), 1.0)
    found = Entries(row[corner], np.zeros(len(corner)), room.curves.start_um[row[corner]], out, aside)
    return found, whose[corner]


def entries_at(room: Room, side: Floats, request: EntryRequest) -> Entries:
    """The places of contours that are nearest to those of a request, one each, in whole µm along lines."""
    row, whose = room.rows(request.figure)
    place = request.place_um[whose]
    foot = feet(room.curves, row, place).place_um
    order = np.lexsort([np.hypot(*(foot - place).T), whose])
    best = order[np.diff(whose[order], prepend=-1) > 0]
    row = row[best]
    along = _to_whole(room, row, along_um(room.curves, row, foot[best]))
    out = _out(room, side, row, headings_along(room.curves, row, along))
    return Entries(row, along, places_at(room.curves, row, along), out, np.full(len(row), request.reach_um))


def corners_at(room: Room, side: Floats, request: EntryRequest) -> Entries:
    """The corner that is nearest to each place of a request, of those no farther than the reach.

    Beside a corner that the waste lies in, the wire would touch its other side.
    """
    found, whose = corners(room, side, request)
    first = np.flatnonzero(np.diff(whose, prepend=-1) > 0)
    off = np.hypot(*(found.place_um[first] - request.place_um[whose[first]]).T)
    return found.take(first[off <= request.reach_um])


def nearest_of(room: Room, side: Floats, at: int, place_um: Floats) -> Entry:
    """The entry of one figure at its place nearest to another one (2,)."""
    row, _ = room.rows(np.array([at]))
    foot = feet(room.curves, row, np.broadcast_to(place_um, (len(row), 2))).place_um
    nearest = int(np.argmin(np.hypot(*(foot - place_um).T)))
    row, foot = row[nearest : nearest + 1], foot[nearest : nearest + 1]
    along = along_um(room.curves, row, foot)
    out = _out(room, side, row, headings_along(room.curves, row, along))
    return Entries(row, along, foot, out, np.zeros(1)).entry(room, 0)


def _is_circle(curves: Curves) -> Bools:
    circle: Bools = curves.is_arc & (np.abs(curves.sweep_rad) >= 2.0 * np.pi - _ACROSS)
    return circle


def _to_axis(curves: Curves) -> Floats:
    """Lengths (n,) µm along circles to where they cross an axis, about their middle; no numbers of lines.

    There a circle begins whole µm from its centre on one axis, and closes without an error of its count.
    """
    turn = np.sign(curves.sweep_rad)
    quarters = np.round((curves.start_angle_rad + np.pi * turn) / (0.5 * np.pi))
    along: Floats = curves.radius_um * turn * (0.5 * np.pi * quarters - curves.start_angle_rad)
    return along


def _is_joint(room: Room) -> Bools:
    """Of all rows: whether an arc goes on smoothly from another one, as fitted ones do."""
    rows = np.arange(len(room.figure))
    first = np.searchsorted(room.figure, room.figure)
    before = np.where(rows > first, rows - 1, np.searchsorted(room.figure, room.figure, side="right") - 1)
    leaving, arriving = directions(room.curves)
    runs_on = (leaving * arriving[before]).sum(axis=1) > _SMOOTH
    smooth: Bools = runs_on & room.curves.is_arc & room.curves.is_arc[before] & (before != rows)
    return smooth


def _out(room: Room, side: Floats, row: Ints, heading: Floats) -> Floats:
    """Unit vectors (m, 2) into the waste; contours run counter-clockwise."""
    out: Floats = side[room.figure[row], None] * to_left(heading)
    return out


def _to_whole(room: Room, row: Ints, along: Floats) -> Floats:
    """Lengths along lines moved by less than 1 µm, so that their places are whole µm along the axis nearest to them."""
    place, heading = places_at(room.curves, row, along), headings_along(room.curves, row, along)
    axis = np.argmax(np.abs(heading), axis=1)
    at = np.arange(len(row))
    by = (np.round(place[at, axis]) - place[at, axis]) / heading[at, axis]
    is_line = ~room.curves.is_arc[row] & (room.curves.length_um[row] > 2.0)
    return np.where(is_line, along + by, along)
