"""When outlines that move come into touch, exact between polygons.

When two polygons come into touch, a corner of one meets a side of the other. Where it meets the side is known in closed
form, for a shift and for a turn. A physics engine would let them overlap a little first.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from parser.toolpath import Point


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


def sides_of(lines_um: BaseGeometry) -> Sides:
    """All sides of lines and rings."""
    points, line = shapely.get_coordinates(shapely.get_parts(lines_um), return_index=True)
    same = np.flatnonzero((line[1:] == line[:-1]) & (points[1:] != points[:-1]).any(axis=1))
    return Sides(points[same], points[same + 1])


def shifted_until(moving: Sides, standing: Sides, toward_rad: float) -> Contact:
    """How far `moving` shifts in a direction until it touches `standing`."""
    u = np.array([np.cos(toward_rad), np.sin(toward_rad)])
    there, back = _first_ahead(moving, standing, u), _first_ahead(standing, moving, -u)
    if back.by < there.by:
        return Contact(back.by, Point(*back.corner.tolist()))
    return _touch(there.by, there.corner + np.where(np.isfinite(there.by), there.by, np.nan) * u)


def turned_until(moving: Sides, standing: Sides, about_um: Floats, sense: int) -> Contact:
    """Angle by which `moving` turns about a place until it touches `standing`; a sense of +1 is counter-clockwise."""
    there, back = _first_round(moving, standing, about_um, sense), _first_round(standing, moving, about_um, -sense)
    if back.by < there.by:
        return _touch(back.by, back.corner)
    angle = sense * there.by if np.isfinite(there.by) else np.nan
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return _touch(there.by, about_um + turned @ (there.corner - about_um))


def _touch(by: float, place: Floats) -> Contact:
    return Contact(by, Point(*place.tolist()))


def _first_ahead(of: Sides, sides: Sides, u: Floats) -> _First:
    """The first corner to meet a side as all shift in the direction u."""
    seen = np.stack([u, [-u[1], u[0]]], axis=1)  # along u, and across it
    by, at = _ahead(of.start @ seen, sides.start @ seen, sides.end @ seen)
    return _First(by, of.start[at] if at >= 0 else np.full(2, np.nan))


def _first_round(of: Sides, sides: Sides, about_um: Floats, sense: int) -> _First:
    """The first corner to meet a side as all turn about a place."""
    by, at = _round(of.start - about_um, sides.start - about_um, sides.end - sides.start, float(sense))
    return _First(by, of.start[at] if at >= 0 else np.full(2, np.nan))


@compiled("Tuple((f8, i8))(f8[:,::1], f8[:,::1], f8[:,::1])")
def _ahead(corner: Floats, start: Floats, end: Floats) -> tuple[float, int]:
    """The shortest way along the first axis from a corner (c, 2) to a side (m, 2), and which corner; inf and −1."""
    least, first = np.inf, -1
    for c in range(corner.shape[0]):
        level = corner[c, 1]
        for s in range(start.shape[0]):
            # Few sides cross the level of a corner. A side along it crosses none, but it ends at sides that do.
            if (start[s, 1] <= level) != (end[s, 1] <= level):
                share = (level - start[s, 1]) / (end[s, 1] - start[s, 1])
                ahead = start[s, 0] + share * (end[s, 0] - start[s, 0]) - corner[c, 0]
                if 0.0 <= ahead < least:
                    least, first = ahead, c
    return least, first


@compiled("Tuple((f8, i8))(f8[:,::1], f8[:,::1], f8[:,::1], f8)")
def _round(corner: Floats, start: Floats, by: Floats, sense: float) -> tuple[float, int]:
    """The least angle about (0, 0) from a corner (c, 2) to a side (m, 2), and which corner; inf and −1.

    A side meets the circle of a corner where its own distance from (0, 0) is the radius: at up to two places.
    """
    least, first = np.inf, -1
    for s in range(start.shape[0]):
        x, y, by_x, by_y = start[s, 0], start[s, 1], by[s, 0], by[s, 1]
        square = by_x * by_x + by_y * by_y
        foot = -(x * by_x + y * by_y) / square
        inside = min(max(foot, 0.0), 1.0)
        nearest = (x + inside * by_x) ** 2 + (y + inside * by_y) ** 2
        farthest = max(x * x + y * y, (x + by_x) ** 2 + (y + by_y) ** 2)
        apart = (x + foot * by_x) ** 2 + (y + foot * by_y) ** 2
        for c in range(corner.shape[0]):
            radius = corner[c, 0] ** 2 + corner[c, 1] ** 2
            if nearest <= radius <= farthest:
                half = np.sqrt(max(radius - apart, 0.0) / square)
                angle = np.arctan2(corner[c, 1], corner[c, 0])
                for share in (foot - half, foot + half):
                    if 0.0 <= share <= 1.0:
                        there = np.arctan2(y + share * by_y, x + share * by_x)
                        turn = np.mod(sense * (there - angle), 2.0 * np.pi)
                        if turn < least:
                            least, first = turn, c
    return least, first
