"""Arcs between two vertices of a polyline: which of them run near all of it, and how near.

All arcs from one place to another differ by their bulge alone, the tangent of a quarter of the sweep. A greater bulge
lies farther to the right everywhere, so that each place which an arc must pass within a distance leaves a range of
bulges, and those places together the range that all of these share.

With X along the chord from its middle, Y to the right, h half the chord and b the bulge, the centre is at
Y = h (b² − 1) / 2b and the radius is h (1 + b²) / 2b. That the distance of (x, y) from the centre is R + t or R − t
gives, with q = x² + y² − h² − t² and D = q² + 4 h² (y² − t²), the bulges 2h (y ∓ t) / (√D − q).
"""

import numpy as np

from parser.drawing.fit.fitted import FLATTEST_UM
from parser.geometry.curves import Floats

MOST_BULGE = np.tan(3.0 / 8.0 * np.pi)
"""Of three quarters of a circle: the ends of more lie so near each other that they hardly tell where the arc is."""
_STRAIGHT = 0.25  # of the tolerance, by which the middle of an arc lies off its chord
_BESIDE_END = 1.5  # tolerances: all arcs that come into question run by so near an end


def best_bulges(vertices: Floats, within_um: float) -> Floats:
    """Bulges (...) of arcs from the first to the last of vertices (..., k, 2) that run near all of them; nan for none.

    The middle of the range; 0, a line, where the range has it, and the middle is nearly straight or of a radius that
    controllers do not count. The middles of the lines between the vertices
    are looked at too, but not all of each line: `off_um` tells.
    """
    x, y, half = _beside_chord(vertices, _with_middles(vertices))
    q = x**2 + y**2 - half**2 - within_um**2
    square = q**2 + 4.0 * half**2 * (y**2 - within_um**2)
    under = np.sqrt(np.maximum(square, 0.0)) - q
    free = (np.abs(x) - half) ** 2 + y**2 <= (_BESIDE_END * within_um) ** 2
    none = ~free & ~((under > 0.0) & (square >= 0.0))
    scale = 2.0 * half / np.where(under > 0.0, under, 1.0)
    low = np.where(free, -MOST_BULGE, np.where(none, np.inf, scale * (y - within_um))).max(axis=-1)
    high = np.where(free, MOST_BULGE, np.where(none, -np.inf, scale * (y + within_um))).min(axis=-1)
    low, high = np.maximum(low, -MOST_BULGE), np.minimum(high, MOST_BULGE)
    low, high = (np.where(low <= high, side, np.nan) for side in (low, high))
    middle, slack = 0.5 * (low + high), 0.5 * (high - low)
    straight = (np.abs(middle) <= slack) & (
        (np.abs(middle) <= _STRAIGHT * slack) | (half[..., 0] > 2.0 * FLATTEST_UM * np.abs(middle))
    )
    best: Floats = np.where(straight, 0.0, middle)
    return best


def off_um(vertices: Floats, bulge: Floats) -> Floats:
    """How far (...) lines through vertices (..., k, 2), and the arcs of bulges (...) between their ends, lie apart.

    It is the farthest that a place on either lies off the other along a radius: at a vertex, or where a line comes
    nearest to the centre. Infinite where the lines do not run on round the centre, or not just once.
    """
    x, y, half = _beside_chord(vertices, vertices)
    flat = bulge == 0.0
    b = np.where(flat, 1.0, bulge)[..., None]
    height = half * (b**2 - 1.0) / (2.0 * b)
    radius = half * (1.0 + b**2) / (2.0 * np.abs(b))
    # Places from the centre, x ahead and y to the right: of an arc of a bulge above 0 they turn to the left.
    y = y - height
    at_vertices = np.abs(np.hypot(x, y) - radius).max(axis=-1)
    along, across = np.diff(x), np.diff(y)
    length = np.hypot(along, across)
    share = -(x[..., :-1] * along + y[..., :-1] * across) / np.where(length > 0.0, length**2, 1.0)
    turned = y[..., :-1] * x[..., 1:] - x[..., :-1] * y[..., 1:]
    nearest = np.abs(turned) / np.where(length > 0.0, length, 1.0)
    at_feet = np.where((share > 0.0) & (share < 1.0), radius - nearest, 0.0).max(axis=-1)
    steps = np.arctan2(turned, x[..., :-1] * x[..., 1:] + y[..., :-1] * y[..., 1:]) * np.sign(b)
    once = np.abs(steps.sum(axis=-1) - 4.0 * np.arctan(np.abs(b[..., 0]))) < 1.0
    runs_on = (steps > 0.0).all(axis=-1) & once
    of_arc = np.where(runs_on, np.maximum(at_vertices, at_feet), np.inf)
    return np.where(np.isnan(bulge), np.inf, np.where(flat, _off_chord(vertices), of_arc))


def _off_chord(vertices: Floats) -> Floats:
    """How far (...) lines through vertices lie off the line between their ends; infinite where they do not run on."""
    x, y, half = _beside_chord(vertices, vertices)
    runs_on = (np.diff(x) > 0.0).all(axis=-1) & (half[..., 0] > 0.0)
    return np.where(runs_on, np.abs(y).max(axis=-1), np.inf)


def centers(start: Floats, end: Floats, bulge: Floats) -> Floats:
    """Centres (n, 2) of arcs of bulges (n,) between places (n, 2); no numbers of lines."""
    by = end - start
    right = np.column_stack([by[:, 1], -by[:, 0]])
    b = np.where(bulge == 0.0, np.nan, bulge)[:, None]
    center: Floats = 0.5 * (start + end) + right * (b**2 - 1.0) / (4.0 * b)
    return center


def _with_middles(vertices: Floats) -> Floats:
    """Vertices but the two ends, and the middles of the lines between them all."""
    middles = 0.5 * (vertices[..., 1:, :] + vertices[..., :-1, :])
    return np.concatenate([vertices[..., 1:-1, :], middles], axis=-2)


def _beside_chord(vertices: Floats, places: Floats) -> tuple[Floats, Floats, Floats]:
    """X and Y (..., p) of places (..., p, 2) along and to the right of the chord, and half the chord (..., 1)."""
    first, last = vertices[..., 0, :], vertices[..., -1, :]
    by = (last - first)[..., None, :]
    length = np.hypot(by[..., 0], by[..., 1])
    way = by / np.where(length > 0.0, length, 1.0)[..., None]
    out = places - 0.5 * (first + last)[..., None, :]
    ahead = (out * way).sum(axis=-1)
    right = out[..., 0] * way[..., 1] - out[..., 1] * way[..., 0]
    return ahead, right, 0.5 * length
