"""Closed contours at random for the tests of the maker of programs, and what shapely makes of them."""

import math
import random

import numpy as np
import shapely

from parser.drawing.model import Entity
from parser.geometry.curves import Curves, Floats, curves_between
from sim.make.cam.model import Figure

FLAT_UM = 0.01
"""How far lines lie off the arcs that they stand for at most."""


def contour(corners: list[tuple[float, float]], bulges: list[float] | None = None) -> Curves:
    """A closed contour from corner to corner, µm; a bulge is the tangent of a quarter of a sweep, 0 for a line."""
    start = np.array(corners, dtype=np.float64)
    end = np.roll(start, -1, axis=0)
    bulge = np.array(bulges if bulges is not None else [0.0] * len(corners))
    by = end - start
    across = np.stack([-by[:, 1], by[:, 0]], axis=1)
    arc = bulge != 0.0
    rise = np.where(arc, (1.0 / np.where(arc, bulge, 1.0) - bulge) / 4.0, 0.0)
    return curves_between(start, end, 0.5 * (start + end) + rise[:, None] * across, 4.0 * np.arctan(bulge))


def circle(radius_um: float) -> Curves:
    start = np.array([[radius_um, 0.0]])
    return curves_between(start, start.copy(), np.zeros((1, 2)), np.array([2.0 * math.pi]))


def figure(closed: Curves, *, inside: bool, number: int = 1) -> Figure:
    rows = np.zeros(len(closed), dtype=np.int64)
    return Figure(
        number, "hole" if inside else "outline", 1, int(inside), closed, rows, Entity("LINE", "1", "0", ""), inside
    )


def star(rng: random.Random, count: int, arcs: bool) -> Curves:
    """A contour round (0, 0) whose corners lie nearer and farther; some of its sides are arcs."""
    size = rng.uniform(3000.0, 20_000.0)
    angles = [(number + rng.uniform(-0.3, 0.3)) * 2.0 * math.pi / count for number in range(count)]
    radii = [size * rng.uniform(0.6, 1.0) for _ in angles]
    corners = [(r * math.cos(a), r * math.sin(a)) for r, a in zip(radii, angles, strict=True)]
    bulges = [rng.uniform(-0.25, 0.4) if arcs and rng.random() < 0.5 else 0.0 for _ in corners]
    return contour(corners, bulges)


def rounded(rng: random.Random) -> Curves:
    """A convex contour: a polygon of corners on a circle, some of its sides bent outward, some corners with fillets."""
    count = rng.randint(3, 9)
    size = rng.uniform(1500.0, 10_000.0)
    angles = sorted((number + rng.uniform(-0.3, 0.3)) * 2.0 * math.pi / count for number in range(count))
    corners, bulges = [], []
    for number, angle in enumerate(angles):
        turn = (angles[(number + 1) % count] - angle) % (2.0 * math.pi)
        corners.append((size * math.cos(angle), size * math.sin(angle)))
        bulges.append(rng.choice((0.0, 0.0, 0.8 * math.tan(turn / 4.0), math.tan(turn / 4.0))))
    return contour(corners, bulges)


def fitted_ellipse(count: int, a_um: float = 20_000.0, b_um: float = 10_000.0) -> Curves:
    """Arcs from node to node of an ellipse, through the middle between: they meet at tenths of a degree."""
    places = [(a_um * math.cos(t), b_um * math.sin(t)) for t in np.linspace(0.0, 2.0 * math.pi, 2 * count + 1).tolist()]
    bulges = []
    for early, middle, late in zip(places[:-1:2], places[1::2], places[2::2], strict=True):
        chord = math.dist(early, late)
        area = (middle[0] - early[0]) * (late[1] - early[1]) - (middle[1] - early[1]) * (late[0] - early[0])
        half = math.pi - math.acos(
            (math.dist(early, middle) ** 2 + math.dist(middle, late) ** 2 - chord**2)
            / (2.0 * math.dist(early, middle) * math.dist(middle, late))
        )
        bulges.append(math.copysign(math.tan(half / 2.0), area))
    return contour(places[:-1:2], bulges)


def flat(curves: Curves) -> Floats:
    """Places (m, 2) along curves that follow each other, so near that lines between them lie 0.01 µm off at most."""
    found = []
    for row in range(len(curves)):
        if not curves.is_arc[row]:
            found.append(curves.start_um[row : row + 1])
            continue
        sweep, radius = float(curves.sweep_rad[row]), float(curves.radius_um[row])
        step = 2.0 * math.acos(max(1.0 - FLAT_UM / radius, -0.5))
        angle = (
            float(curves.start_angle_rad[row])
            + sweep * np.linspace(0, 1, max(2, math.ceil(abs(sweep) / step) + 1))[:-1]
        )
        found.append(curves.center_um[row] + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    return np.concatenate([*found, curves.end_um[-1:]])


def region(closed: Curves) -> shapely.Polygon:
    return shapely.Polygon(flat(closed)[:-1])


def grown(whole: shapely.Polygon, by_um: float) -> shapely.Geometry:
    """A region grown by discs, shrunk where the length is negative; exact within 0.01 µm at 0.2 mm."""
    return shapely.buffer(whole, by_um, quad_segs=128)
