"""The way of the wire's centre beside a contour, all round it.

Slots and necks of a contour that the wire does not enter.

The wire's way at an offset leaves a stretch of the contour out wherever two of its curves meet that do not touch the
contour at one place. In an inside corner that is what no wire can cut. Before a slot narrower than the wire it is all
of the slot: the contour turns toward the wire round its lips, so that its sides do not run together as those of a
corner do, or not soon, and it goes on deeper than the offset.

Pieces of a way that are too short for whole µm, taken out so that their neighbours meet.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from controller.offset.reach import OffsetLoop, reach
from controller.offset.shifted import Side
from parser.geometry.along import along_um, directions, places, places_at
from parser.geometry.curves import Curves, Floats, Ints, total_before
from parser.toolpath import Point
from sim.make.cam.convex import Met, beside_convex, met_near, with_ends
from sim.make.cam.corners import with_corners
from sim.make.cam.model import CannotCutError, Figure, Refusal
from sim.setup.making import Corners

SHORT_UM = 3.0
"""Of a shorter line, whole µm make a direction that is off by more than 15°."""
MOST_OFF_UM = 0.1
"""How far each of two rounds may move the way."""
_ROUNDS = 2


def without_short(way: Curves) -> Curves:
    """A closed way (m,) without pieces shorter than 3 µm, as far as it moves by no more than 0.2 µm for that.

    Of neighbours that are short the shorter one goes first, the other one in a second round. Where the neighbours of
    a piece do not meet, as two arcs of one circle, their ends are made one in the middle of it if it is short enough.
    """
    for _ in range(_ROUNDS):
        if len(way) < 4 or float(way.length_um.min()) >= SHORT_UM:
            break
        way = _once(way)
    return way


def _once(way: Curves) -> Curves:
    length, number = way.length_um, len(way)
    at = np.flatnonzero((length < SHORT_UM) & (length < np.roll(length, 1)) & (length <= np.roll(length, -1)))
    middle = places(way, at, np.full(len(at), 0.5))
    met = met_near(way, at - 1, (at + 1) % number, middle)
    is_met = _moved(way, at, met) <= MOST_OFF_UM
    gone = is_met | (length[at] <= 2.0 * MOST_OFF_UM)
    place = np.where(is_met[:, None], met.place_um, middle)[gone]
    start, end = way.start_um.copy(), way.end_um.copy()
    end[at[gone] - 1], start[(at[gone] + 1) % number] = place, place
    return with_ends(way, start, end).picked(np.delete(np.arange(number), at[gone]))


def _moved(way: Curves, at: Ints, met: Met) -> Floats:
    """How far (k,) µm the way moves at most where the neighbours of pieces meet; ∞ where they do not, or far away.

    The piece and the place where its neighbours meet make a triangle. Old and new way run along sides of it, or beside
    them by the rise of an arc. So they lie no farther apart than the corner that one of them leaves out lies from the
    side that the other one takes.
    """
    before, behind = at - 1, (at + 1) % len(way)
    a, b, m = way.end_um[before], way.start_um[behind], met.place_um
    on, back = met.on_um, met.before_um
    across = np.select(
        [(on >= 0.0) & (back >= 0.0), (on >= 0.0) & (back < 0.0), (on < 0.0) & (back >= 0.0)],
        [_from_line(m, a, b), _from_line(b, a, m), _from_line(a, m, b)],
        np.maximum(np.hypot(*(a - m).T), np.hypot(*(b - m).T)),
    )
    near = (np.abs(on) <= 0.4 * way.length_um[before]) & (np.abs(back) <= 0.4 * way.length_um[behind])
    rises = _rise(way, before, on) + _rise(way, behind, back) + _rise(way, at, way.length_um[at])
    moved: Floats = np.where(near & ~np.isnan(across), across + rises, np.inf)
    return moved


def _rise(way: Curves, row: Ints, length_um: Floats) -> Floats:
    """How far (k,) arcs so long on the circles of rows lie off their chords at most: L²/8R is no less; 0 on lines."""
    radius = np.where(way.is_arc[row], way.radius_um[row], np.inf)
    rise: Floats = length_um * length_um / (8.0 * radius)
    return rise


def _from_line(place: Floats, start: Floats, end: Floats) -> Floats:
    """Distances (k,) of places from straight lines between others (k, 2), ends included."""
    by, out = end - start, place - start
    square = (by * by).sum(axis=1)
    share = np.clip((out * by).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    off = out - share[:, None] * by
    away: Floats = np.hypot(off[:, 0], off[:, 1])
    return away


_LIPS_RAD = 0.1
"""How far a contour turns toward the wire round lips, at least; fitted arcs turn by up to 0.04 rad where they meet."""
_PARALLEL_RAD = 0.05  # sides that run together by no more do not make a corner
_DEEPEST = 2.0  # times what two straight sides would leave: what goes deeper is a slot (as in `measure/compare`)
_NOTHING_UM = 1e-9


class Mouth(NamedTuple):
    """Where the wire does not go in: the middle between the two places that it touches, and how far they are apart."""

    place_um: Point
    wide_um: float


def mouths(contour: Curves, loops: Sequence[OffsetLoop], by_um: float, is_inside: bool) -> tuple[Mouth, ...]:
    """Slots and necks of a closed contour that loops at an offset within it or outside of it leave out.

    What is no deeper than the offset is none: it is a corner with short sides.
    """
    turned = _outward(contour, is_inside)
    return tuple(mouth for loop in loops for mouth in _of_loop(contour, turned, loop, by_um))


class _Turned(NamedTuple):
    """How far, rad, a contour has turned toward the wire before each row (n + 1,), and turns in each (n,); its ends."""

    before: Floats
    along: Floats
    arriving: Floats
    sense: float


def _of_loop(contour: Curves, turned: _Turned, loop: OffsetLoop, by_um: float) -> Iterator[Mouth]:
    row, behind = loop.source_row, np.roll(loop.source_row, -1)
    is_corner, to_corner = loop.corner, np.roll(loop.corner, -1)
    ways = directions(loop.curves)
    arriving, leaving = ways.arriving, np.roll(ways.leaving, -1, axis=0)
    place = loop.curves.end_um
    # An arc about a corner touches the contour there alone.
    leave = np.where(is_corner, contour.length_um[row], along_um(contour, row, place))
    arrive = np.where(to_corner, contour.length_um[behind], along_um(contour, behind, place))
    before = total_before(contour.length_um)
    early, late = before[row] + leave, before[behind] + arrive
    left = np.mod(late - early, before[-1])
    outward = _until(contour, turned, behind, arrive) - _until(contour, turned, row, leave)
    outward += np.where(late < early, turned.before[-1], 0.0)
    outward += np.where(to_corner, turned.sense * _angle(turned.arriving[behind], leaving), 0.0)
    outward -= np.where(is_corner, turned.sense * _angle(turned.arriving[row], arriving), 0.0)
    turn = np.maximum(-turned.sense * _angle(arriving, leaving), 0.0)
    # Where two rows are nearly one line, rounding lets the way step back from one to the other.
    is_parallel = outward + turn >= np.pi - _PARALLEL_RAD
    is_left = (left > by_um) & (left < before[-1] - by_um) & (is_parallel | (outward > _LIPS_RAD))
    for at in np.flatnonzero(is_left).tolist():
        deep = _deepest(contour, int(row[at]), int(behind[at]), place[at]) - by_um
        straight = by_um / np.cos(0.5 * turn[at]) - by_um
        if deep > by_um and (is_parallel[at] or deep > _DEEPEST * straight):
            lips = places_at(contour, np.array([row[at], behind[at]]), np.array([leave[at], arrive[at]]))
            yield Mouth(Point(*lips.mean(axis=0).tolist()), float(np.hypot(*(lips[1] - lips[0]))))


def _outward(contour: Curves, is_inside: bool) -> _Turned:
    sense = -1.0 if is_inside else 1.0
    leaving, arriving = directions(contour)
    kink = np.maximum(sense * _angle(arriving, np.roll(leaving, -1, axis=0)), 0.0)
    along = np.maximum(sense * contour.sweep_rad, 0.0)
    return _Turned(total_before(along + kink), along, arriving, sense)


def _angle(this: Floats, other: Floats) -> Floats:
    """Angles (k,) from directions to others (k, 2), positive to the left."""
    angle: Floats = np.arctan2(this[:, 0] * other[:, 1] - this[:, 1] * other[:, 0], (this * other).sum(axis=1))
    return angle


def _until(contour: Curves, turned: _Turned, row: Ints, length_um: Floats) -> Floats:
    """How far (k,) the contour has turned toward the wire up to lengths along rows."""
    share = length_um / np.maximum(contour.length_um[row], _NOTHING_UM)
    result: Floats = turned.before[row] + turned.along[row] * share
    return result


def _deepest(contour: Curves, row: int, behind: int, place_um: Floats) -> float:
    """How far µm the contour between two rows gets from a place: at the ends and in the middle of each row there."""
    between = (row + np.arange((behind - row) % len(contour) + 1)) % len(contour)
    ends = contour.end_um[between[:-1]]
    middles = places(contour, between[1:-1], np.full(max(len(between) - 2, 0), 0.5))
    off = np.concatenate([ends, middles]) - place_um
    return float(np.hypot(off[:, 0], off[:, 1]).max(initial=0.0))


def offset_path(figure: Figure, by_um: float, corners: Corners) -> Curves:
    """Closed way (m,) counter-clockwise at an offset from the contour of a figure, in the waste.

    It is the true offset, but for sharp outside corners, and for 0.3 µm where pieces too short for whole µm are mended.
    CannotCutError where the wire does not fit in, or where a slot or a neck is narrower than the wire.
    """
    contour = figure.contour
    if by_um <= 0.0:
        return contour
    loop = beside_convex(contour, by_um, figure.runs_inside)
    if loop is not None:
        return without_short(with_corners(loop, by_um, corners, None))
    return without_short(with_corners(_reached(figure, by_um), by_um, corners, contour))


def _reached(figure: Figure, by_um: float) -> OffsetLoop:
    """The one loop that the wire reaches. CannotCutError where there is none, or more, or it leaves out a slot."""
    side = Side.LEFT if figure.runs_inside else Side.RIGHT
    loops = reach(figure.contour, by_um, side).loops
    values = (("figure", str(figure.number)), ("offset_mm", _mm(by_um)), ("kerf_mm", _mm(2.0 * by_um)))
    if not loops:
        start = Point(*figure.contour.start_um[0].tolist())
        raise CannotCutError(Refusal("too-small", (start,), values, (figure.number,)))
    narrow = sorted(mouths(figure.contour, loops, by_um, figure.runs_inside), key=lambda mouth: mouth.wide_um)
    places = tuple(mouth.place_um for mouth in narrow)
    if narrow:
        why = "narrow-neck" if len(loops) > 1 else "narrow-slot"
        width = ("width_mm", _mm(narrow[0].wide_um))
        raise CannotCutError(Refusal(why, places, (*values, width), (figure.number,)))
    if len(loops) > 1:
        starts = tuple(Point(*loop.curves.start_um[0].tolist()) for loop in loops)
        raise CannotCutError(Refusal("falls-apart", starts, values, (figure.number,)))
    (loop,) = loops
    kept_rows = np.flatnonzero(loop.curves.length_um > 0.0)
    return OffsetLoop(loop.curves.picked(kept_rows), loop.source_row[kept_rows], loop.corner[kept_rows])


def _mm(length_um: float) -> str:
    return f"{round(length_um, 1) / 1000.0:g}"
