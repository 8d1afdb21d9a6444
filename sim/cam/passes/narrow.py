"""Slots and necks of a contour that the wire does not enter.

The wire's way at an offset leaves a stretch of the contour out wherever two of its curves meet that do not touch the
contour at one place. In an inside corner that is what no wire can cut. Before a slot narrower than the wire it is all
of the slot: the contour turns outward round its lips, and goes on deeper than the offset.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from controller.offset.reach import OffsetLoop
from parser.geometry.along import along_um, places, places_at
from parser.geometry.curves import Curves, Floats, Ints, total_before
from parser.geometry.directions import directions
from parser.toolpath import Point

_OUTWARD_RAD = 0.1
"""How far a contour turns outward round lips, at least; fitted arcs turn by up to 0.04 rad where they meet."""
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


def _of_loop(contour: Curves, turned: tuple[Floats, Floats], loop: OffsetLoop, by_um: float) -> Iterator[Mouth]:
    row, behind = loop.source_row, np.roll(loop.source_row, -1)
    place = loop.curves.end_um
    leave, arrive = along_um(contour, row, place), along_um(contour, behind, place)
    # An arc about a corner touches the contour there alone.
    leave = np.where(loop.corner, contour.length_um[row], leave)
    arrive = np.where(np.roll(loop.corner, -1), contour.length_um[behind], arrive)
    before = total_before(contour.length_um)
    left = np.mod(before[behind] + arrive - before[row] - leave, before[-1])
    outward = _until(contour, turned, behind, arrive) - _until(contour, turned, row, leave)
    outward = np.where(before[behind] + arrive < before[row] + leave, outward + turned[0][-1], outward)
    # Where two rows are nearly one line, rounding lets the way step back from one to the other.
    is_left = (left > by_um) & (left < before[-1] - by_um) & (outward > _OUTWARD_RAD)
    for at in np.flatnonzero(is_left).tolist():
        if _deepest(contour, int(row[at]), int(behind[at]), place[at]) > 2.0 * by_um:
            lips = places_at(contour, np.array([row[at], behind[at]]), np.array([leave[at], arrive[at]]))
            yield Mouth(Point(*lips.mean(axis=0).tolist()), float(np.hypot(*(lips[1] - lips[0]))))


def _outward(contour: Curves, is_inside: bool) -> tuple[Floats, Floats]:
    """How far, rad, a contour has turned toward the wire before each row (n + 1,), and turns in each (n,)."""
    sense = -1.0 if is_inside else 1.0
    leaving, arriving = directions(contour)
    leaving = np.roll(leaving, -1, axis=0)
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    kink = np.maximum(sense * np.arctan2(cross, (arriving * leaving).sum(axis=1)), 0.0)
    along = np.maximum(sense * contour.sweep_rad, 0.0)
    return total_before(along + kink), along


def _until(contour: Curves, turned: tuple[Floats, Floats], row: Ints, along_um_: Floats) -> Floats:
    """How far (k,) the contour has turned toward the wire up to lengths along rows."""
    before, along = turned
    result: Floats = before[row] + along[row] * along_um_ / np.maximum(contour.length_um[row], _NOTHING_UM)
    return result


def _deepest(contour: Curves, row: int, behind: int, place_um: Floats) -> float:
    """How far µm the contour between two rows gets from a place: at the ends and in the middle of each row there."""
    between = (row + np.arange((behind - row) % len(contour) + 1)) % len(contour)
    ends = contour.end_um[between[:-1]]
    middles = places(contour, between[1:-1], np.full(max(len(between) - 2, 0), 0.5))
    off = np.concatenate([ends, middles]) - place_um
    return float(np.hypot(off[:, 0], off[:, 1]).max(initial=0.0))
