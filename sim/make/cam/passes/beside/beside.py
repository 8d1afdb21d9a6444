"""The way of the wire's centre beside a contour, all round it.

Slots and necks of a contour that the wire does not enter.

The wire's way at an offset leaves a stretch of the contour out wherever two of its curves meet that do not touch the
contour at one place. In an inside corner that is what no wire can cut. Before a slot narrower than the wire it is all
of the slot: the contour turns toward the wire round its lips, so that its sides do not run together as those of a
corner do, or not soon, and it goes on deeper than the offset.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from controller.offset.reach import OffsetLoop, reach
from controller.offset.sections import Side
from parser.geometry.along import along_um, places, places_at
from parser.geometry.curves import Curves, Floats, Ints, total_before
from parser.geometry.directions import directions
from parser.toolpath import Point
from sim.make.cam.model import CannotCutError, Figure, Refusal
from sim.make.cam.passes.beside.convex import beside_convex
from sim.make.cam.passes.beside.corners import with_corners
from sim.make.cam.passes.beside.short import without_short
from sim.setup.making import Corners

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


def _angle(one: Floats, other: Floats) -> Floats:
    """Angles (k,) from directions to others (k, 2), positive to the left."""
    angle: Floats = np.arctan2(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], (one * other).sum(axis=1))
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


def beside(figure: Figure, by_um: float, corners: Corners) -> Curves:
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
        raise CannotCutError(Refusal("too-small", (Point(*figure.contour.start_um[0].tolist()),), values))
    narrow = sorted(mouths(figure.contour, loops, by_um, figure.runs_inside), key=lambda mouth: mouth.wide_um)
    places = tuple(mouth.place_um for mouth in narrow)
    if narrow:
        why = "narrow-neck" if len(loops) > 1 else "narrow-slot"
        raise CannotCutError(Refusal(why, places, (*values, ("width_mm", _mm(narrow[0].wide_um)))))
    if len(loops) > 1:
        starts = tuple(Point(*loop.curves.start_um[0].tolist()) for loop in loops)
        raise CannotCutError(Refusal("falls-apart", starts, values))
    (loop,) = loops
    kept = np.flatnonzero(loop.curves.length_um > 0.0)
    return OffsetLoop(loop.curves.picked(kept), loop.source_row[kept], loop.corner[kept])


def _mm(length_um: float) -> str:
    return f"{round(length_um, 1) / 1000.0:g}"
