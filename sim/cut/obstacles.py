"""Bodies that stand still, as convex shapes of pymunk: clamps grown by what moves past them, and the work.

Where a moving point meets bodies that stand still: the engine's queries, asked only where the point comes near.

A way of hundreds of thousands of samples is looked at in stretches. Numpy tells by boxes which stretches come near;
those are halved for as long as the band round their chord meets the body, down to single moves between samples.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pymunk
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
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
    return _pieces((each[:, None] - other for each in still for other in moving), 0.0)


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
    solid: Floats = cut[height > _FLAT_UM]
    return solid


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


def _cross(this: Floats, other: Floats) -> Floats:
    product: Floats = this[..., 0] * other[..., 1] - this[..., 1] * other[..., 0]
    return product


STRETCH = 256
"""Samples in a stretch, at most."""

_GRACE_UM = 1e-3  # added to the band, so that it holds all its samples whichever way they were rounded


class Way(NamedTuple):
    """Places of a point, in stretches that each belong to one block.

    Attributes
    ----------
    place_um
        (n, 2) float64.
    ends
        (k, 2) int64, first and last sample of each stretch, in order. Where the next stretch follows at once, it begins
        with the sample that this one ends with.
    boxes_um
        (k, 2, 2) float64, lowest and highest (x, y) of each stretch.
    """

    place_um: Floats
    ends: Ints
    boxes_um: Floats

    def picked(self, which: NDArray[np.bool_]) -> "Way":
        """The way with some of its stretches, (k,) bool."""
        return self._replace(ends=self.ends[which], boxes_um=self.boxes_um[which])


class Touch(NamedTuple):
    """A touch on the move that ends in a sample, at a share of the move from the sample before."""

    sample: int
    share: float


def way_of(place_um: Floats, row: Ints) -> Way:
    """Way through places (n, 2), n ≥ 2; `row` (n,) is that of the move that ends in each place."""
    last = len(row) - 1
    borders = np.flatnonzero(np.diff(row[1:])) + 1
    cuts = np.unique(np.concatenate([np.arange(0, last, STRETCH), borders, [last]]))
    ends = np.stack([cuts[:-1], cuts[1:]], axis=1)
    low = np.minimum(np.minimum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    high = np.maximum(np.maximum.reduceat(place_um, ends[:, 0]), place_um[ends[:, 1]])
    return Way(place_um, ends, np.stack([low, high], axis=1))


def touches(way: Way, pieces: BodyShapes) -> Iterator[Touch]:
    """Every move of a way that touches a body, in order; a move that begins in touch touches at once, at share 0."""
    near = way.picked(_near(way.boxes_um, pieces.boxes_um))
    for (low, high), (lowest, highest) in zip(near.ends.tolist(), near.boxes_um.tolist(), strict=True):
        yield from _halved(pieces.near(lowest, highest), way.place_um, low, high)


def _near(boxes_um: Floats, bodies_um: Floats) -> NDArray[np.bool_]:
    """Which boxes (k, 2, 2) meet one of the bodies (m, 2, 2)."""
    near = _meet(boxes_um, np.stack([bodies_um[:, 0].min(axis=0), bodies_um[:, 1].max(axis=0)]))
    some = boxes_um[near]
    any_ = np.zeros(len(some), dtype=np.bool_)
    for body in bodies_um:
        any_ |= _meet(some, body)
    near[near] = any_
    return near


def _meet(boxes_um: Floats, box_um: Floats) -> NDArray[np.bool_]:
    (left, bottom), (right, top) = box_um
    low, high = boxes_um[:, 0], boxes_um[:, 1]
    meets: NDArray[np.bool_] = (low[:, 0] <= right) & (high[:, 0] >= left) & (low[:, 1] <= top) & (high[:, 1] >= bottom)
    return meets


def _halved(shapes: Sequence[pymunk.Shape], place_um: Floats, low: int, high: int) -> Iterator[Touch]:
    """Touches between two samples, in order: the halves are looked at where the band round the chord meets a body."""
    first, last = place_um[low].tolist(), place_um[high].tolist()
    band = _bulge_um(place_um[low : high + 1]) + _GRACE_UM if high - low > 1 else 0.0
    hits = [hit for shape in shapes if (hit := shape.segment_query(first, last, band)) is not None]
    if not hits:
        return
    if high - low == 1:
        yield Touch(high, min(hit.alpha for hit in hits))
        return
    met = [hit.shape for hit in hits if hit.shape is not None]
    middle = (low + high) // 2
    yield from _halved(met, place_um, low, middle)
    yield from _halved(met, place_um, middle, high)


def _bulge_um(place_um: Floats) -> float:
    """How far places (n, 2) lie from the chord of the first and the last, at most."""
    chord, to = place_um[-1] - place_um[0], place_um - place_um[0]
    square = max(float(chord @ chord), float(np.finfo(np.float64).tiny))
    off = to - np.clip(to @ chord / square, 0.0, 1.0)[:, None] * chord
    return float(np.hypot(off[:, 0], off[:, 1]).max())
