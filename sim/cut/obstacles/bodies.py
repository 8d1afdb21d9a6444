"""Bodies that stand still, as convex shapes of pymunk: clamps grown by what moves past them, and the work."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import pymunk

from parser.geometry.curves import Floats
from sim.setup.obstacles import Outline

ALL = pymunk.ShapeFilter()
_ON_UM = 1e-3  # a point this near to a shape lies in it, and so does one on the seam between two shapes

Place = tuple[float, float]
_FLAT_UM = 1e-6


class BodyShapes(NamedTuple):
    """Shapes of one body in a space of their own, and the boxes (m, 2, 2) µm round them, lowest and highest (x, y)."""

    space: pymunk.Space
    boxes_um: Floats

    def near(self, low: Place, high: Place) -> list[pymunk.Shape]:
        """Shapes whose boxes meet a box."""
        return self.space.bb_query(pymunk.BB(*low, *high), ALL)

    def hold(self, place: Place) -> bool:
        """Whether a place lies in the body or on its edge."""
        return bool(self.space.point_query(place, _ON_UM, ALL))

    def entered_at(self, start: Place, end: Place) -> float:
        """Share of the way from outside to inside at which the body begins."""
        hit = self.space.segment_query_first(start, end, 0.0, ALL)
        return hit.alpha if hit is not None else 1.0


def grown(outline_um: Outline, radius_um: float) -> BodyShapes:
    """Where the centre of a circle stands when it touches an outline: the outline, grown by the radius."""
    return _pieces(triangles(outline_um), radius_um)


def swept(outline_um: Outline, moving_um: Outline) -> BodyShapes:
    """Where the origin of a moving outline stands when it touches an outline that stands still.

    That is the Minkowski sum of the standing outline and the moving one mirrored at the origin (M. de Berg et al.,
    "Computational Geometry", 3rd ed. 2008, 13.2). For two convex pieces it is the hull of the differences of their
    corners.
    """
    still, moving = triangles(outline_um), triangles(moving_um)
    return _pieces((one[:, None] - other for one in still for other in moving), 0.0)


def sides(outline_um: Outline, radius_um: float) -> BodyShapes:
    """All places within a radius of the sides of an outline.

    The sides are polygons of two corners: a query along a line misses the round ends of pymunk's own segments.
    """
    corners = np.array(outline_um)
    return _pieces(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1), radius_um)


def _pieces(hulls: Iterable[Floats], radius_um: float) -> BodyShapes:
    """Pieces of the hulls of points (…, 2)."""
    space = pymunk.Space()
    corners = ([(x, y) for x, y in hull.reshape(-1, 2).tolist()] for hull in hulls)
    shapes = [pymunk.Poly(space.static_body, hull, radius=radius_um) for hull in corners]
    space.add(*shapes)
    boxes = np.array([(shape.bb.left, shape.bb.bottom, shape.bb.right, shape.bb.top) for shape in shapes])
    return BodyShapes(space, boxes.reshape(-1, 2, 2))


def triangles(outline_um: Outline) -> Floats:
    """Triangles (m, 3, 2) µm, counter-clockwise, that fill an outline and do not overlap."""
    left, found = np.array(outline_um), []
    while len(left) > 3:
        ear = int(np.argmax(_clearances_um(left)))
        found.append(left[[ear - 1, ear, (ear + 1) % len(left)]])
        left = np.delete(left, ear, axis=0)
    cut = np.array([*found, left])
    side = np.roll(cut, -1, axis=1) - cut
    height = _cross(side[:, 0], side[:, 1]) / np.hypot(side[..., 0], side[..., 1]).max(axis=1)
    kept: Floats = cut[height > _FLAT_UM]
    return kept


def _clearances_um(corners: Floats) -> Floats:
    """How far outside the ear at each corner of (n, 2) the nearest other corner lies; −inf at reflex corners.

    A polygon has two ears or more (G. H. Meisters, "Polygons have ears", 1975): the clearest corner is one.
    """
    ear = np.stack([np.roll(corners, 1, axis=0), corners, np.roll(corners, -1, axis=0)], axis=1)
    side = np.roll(ear, -1, axis=1) - ear
    unit = side / np.hypot(side[..., 0], side[..., 1])[..., None]
    to = corners[None, None, :] - ear[:, :, None]
    outside = -_cross(unit[:, :, None], to).min(axis=1)  # beyond any one of three sides is outside
    own = np.eye(len(corners), dtype=np.bool_)
    outside[own | np.roll(own, 1, axis=1) | np.roll(own, -1, axis=1)] = np.inf
    clearance: Floats = outside.min(axis=1)
    clearance[_cross(side[:, 0], side[:, 1]) <= 0.0] = -np.inf
    return clearance


def _cross(one: Floats, other: Floats) -> Floats:
    product: Floats = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return product
