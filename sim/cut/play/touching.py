"""When outlines that move come into touch, exact between polygons.

When two polygons come into touch, a corner of one meets a side of the other. Where it meets the side is known in closed
form, for a shift and for a turn. A physics engine would let them overlap a little first.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Point

_CHUNK = 1 << 20  # pairs of corners and sides looked at in one go: some 100 MB


class Sides(NamedTuple):
    """Sides of outlines, from (m, 2) to (m, 2) µm; each start is a corner."""

    start: Floats
    end: Floats


class Contact(NamedTuple):
    """How far something moves until it touches, µm or rad, and where; infinite and NaN where nothing is in the way."""

    by: float
    place_um: Point


class _First(NamedTuple):
    """How far the first corner is from a side, and which corner."""

    by: float
    corner: Floats


_Ways = Callable[[Floats, Sides], Floats]
"""Ways (c,) of corners (c, 2) to the first side that each meets, infinite where it meets none."""


def sides_of(lines_um: BaseGeometry) -> Sides:
    """All sides of lines and rings."""
    points, line = shapely.get_coordinates(shapely.get_parts(lines_um), return_index=True)
    same = np.flatnonzero((line[1:] == line[:-1]) & (points[1:] != points[:-1]).any(axis=1))
    return Sides(points[same], points[same + 1])


def shifted_until(moving: Sides, standing: Sides, toward_rad: float) -> Contact:
    """How far `moving` shifts in a direction until it touches `standing`."""
    u = np.array([np.cos(toward_rad), np.sin(toward_rad)])
    there = _first(moving, standing, lambda corner, side: _along(corner, side, u))
    back = _first(standing, moving, lambda corner, side: _along(corner, side, -u))
    if back.by < there.by:
        return Contact(back.by, Point(*back.corner.tolist()))
    return _touch(there.by, there.corner + np.where(np.isfinite(there.by), there.by, np.nan) * u)


def turned_until(moving: Sides, standing: Sides, about_um: Floats, sense: int) -> Contact:
    """Angle by which `moving` turns about a place until it touches `standing`; a sense of +1 is counter-clockwise."""
    there = _first(moving, standing, lambda corner, side: _round(corner - about_um, side, about_um, sense))
    back = _first(standing, moving, lambda corner, side: _round(corner - about_um, side, about_um, -sense))
    if back.by < there.by:
        return _touch(back.by, back.corner)
    angle = sense * there.by if np.isfinite(there.by) else np.nan
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return _touch(there.by, about_um + turned @ (there.corner - about_um))


def _touch(by: float, place: Floats) -> Contact:
    return Contact(by, Point(*place.tolist()))


def _first(of: Sides, sides: Sides, ways: _Ways) -> _First:
    first = _First(np.inf, np.full(2, np.nan))
    rows = max(_CHUNK // max(len(sides.start), 1), 1)
    for low in range(0, len(of.start), rows):
        corners = of.start[low : low + rows]
        way = ways(corners, sides)
        at = int(np.argmin(way))
        if way[at] < first.by:
            first = _First(float(way[at]), corners[at])
    return first


def _along(corner: Floats, side: Sides, u: Floats) -> Floats:
    """Ways of corners in the direction u."""
    across = np.array([-u[1], u[0]])
    level, low, high = corner @ across, side.start @ across, side.end @ across
    # Few sides cross the level of a corner. A side along u crosses none, but it ends at sides that do.
    one, other = np.nonzero((low <= level[:, None]) != (high <= level[:, None]))
    share = (level[one] - low[other]) / (high - low)[other]
    ahead = (side.start @ u)[other] + share * ((side.end - side.start) @ u)[other] - (corner @ u)[one]
    return _least(len(corner), one, np.where(ahead >= 0.0, ahead, np.inf))


def _round(out: Floats, side: Sides, about: Floats, sense: int) -> Floats:
    """Angles (c,) by which corners, (c, 2) seen from the place `about`, turn about it until they meet a side."""
    start, by = side.start - about, side.end - side.start
    square, radius = (by * by).sum(axis=1), (out * out).sum(axis=1)
    foot = np.clip(-(start * by).sum(axis=1) / square, 0.0, 1.0)
    nearest = ((start + foot[:, None] * by) ** 2).sum(axis=1)
    farthest = np.maximum((start * start).sum(axis=1), ((start + by) ** 2).sum(axis=1))
    one, other = np.nonzero((nearest <= radius[:, None]) & (farthest >= radius[:, None]))
    foot = -(start * by).sum(axis=1) / square
    apart = ((start + foot[:, None] * by) ** 2).sum(axis=1)
    half = np.sqrt(np.maximum(radius[one] - apart[other], 0.0) / square[other])
    turns = [_turn(out[one], start[other], by[other], foot[other] + way * half, sense) for way in (-1.0, 1.0)]
    return _least(len(out), one, np.minimum(*turns))


def _turn(out: Floats, start: Floats, by: Floats, share: Floats, sense: int) -> Floats:
    """Angles (k,) at (0, 0) from corners to points on sides, at a `share` of each; infinite beyond the side's ends."""
    to = start + share[:, None] * by
    angle = np.arctan2(to[:, 1], to[:, 0]) - np.arctan2(out[:, 1], out[:, 0])
    return np.where((share >= 0.0) & (share <= 1.0), np.mod(sense * angle, 2.0 * np.pi), np.inf)


def _least(number: int, of: Ints, value: Floats) -> Floats:
    least = np.full(number, np.inf)
    np.minimum.at(least, of, value)
    return least
