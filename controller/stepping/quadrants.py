"""Arcs as a 3B controller walks them: quadrant after quadrant, each in the same canonical frame.

In every quadrant one axis steps toward the centre (coordinate u, falling to 0) and the other away from it (v, rising
from 0): the table of docs/3b.md §3 is one rule seen in eight frames. Counter-clockwise, quadrant q is the first one
turned by (q − 1) · 90°; clockwise is the mirror image of that at the X axis.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.told.step_words import Axis

# Rows: quarter turns 0..3. Columns: dx, dy of a step toward the centre (u falls) and of a step away from it (v rises).
TOWARD = np.array([[-1, 0], [0, -1], [1, 0], [0, 1]], dtype=np.int64)
AWAY = np.array([[0, 1], [-1, 0], [0, -1], [1, 0]], dtype=np.int64)


_FLOAT_EXACT = 2**52
"""Below it a float64 root of a whole number is never rounded onto a whole number."""


class ArcWalk(NamedTuple):
    """n arcs as walks through quadrants; all (n,) int64.

    Attributes
    ----------
    radius_sq
        R² = X² + Y², µm².
    quarter
        Quarter turns of the first quadrant's frame, 0..3.
    u0, v0
        Start in that frame, µm: u0 ≥ 1, v0 ≥ 0.
    top
        v at which every quadrant is left, and u at which the next one is entered: ceil(sqrt(R² − 1)), µm.
    steps
        Steps in all.
    """

    radius_sq: Ints
    quarter: Ints
    u0: Ints
    v0: Ints
    top: Ints
    steps: Ints


def walk_arcs(x_um: Ints, y_um: Ints, count_um: Ints, count_axis: Ints, turn: Ints) -> ArcWalk:
    """Walks of n arcs of R² > 1 from their signed start relative to the centre, count length, axis and sense."""
    radius_sq = x_um**2 + y_um**2
    y = y_um * turn
    quarter = np.select([(x_um > 0) & (y >= 0), (x_um <= 0) & (y > 0), (x_um < 0) & (y <= 0)], [0, 1, 2], 3)
    u0 = np.choose(quarter, [x_um, y, -x_um, -y])
    v0 = np.choose(quarter, [y, -x_um, -y, x_um])
    top = ceil_sqrt(radius_sq - 1)
    uncounted = ArcWalk(radius_sq, quarter, u0, v0, top, np.zeros_like(top))
    return uncounted._replace(steps=_count_steps(uncounted, count_um, count_axis))


def _count_steps(walk: ArcWalk, count_um: Ints, count_axis: Ints) -> Ints:
    """Steps until `count_um` of them were on the counted axis, in closed form."""
    counts_u = (walk.quarter % 2 == 0) == (count_axis == Axis.X)
    in_first = np.where(counts_u, walk.u0, walk.top - walk.v0)
    stays = count_um <= in_first
    later = np.maximum(count_um - in_first - 1, 0)
    full = later // walk.top
    left = np.where(stays, count_um, later - full * walk.top + 1)
    # Axes swap from one quadrant to the next; the last one is number full + 1.
    counts_u = np.where(stays, counts_u, counts_u ^ ((full + 1) % 2 == 1))
    u0, v0 = np.where(stays, walk.u0, walk.top), np.where(stays, walk.v0, 0)
    last = np.where(counts_u, _until_u(walk.radius_sq, u0, v0, left), _until_v(walk.radius_sq, u0, v0, left))
    before = np.where(stays, 0, walk.u0 + walk.top - walk.v0 + full * 2 * walk.top)
    return np.where(count_um > 0, before + last, 0)


def _until_u(radius_sq: Ints, u0: Ints, v0: Ints, left: Ints) -> Ints:
    """Steps until u was stepped `left` times: the last of them waits for F ≥ 0 at u0 − left + 1."""
    v = ceil_sqrt(radius_sq - (u0 - left + 1) ** 2)
    waits: Ints = np.maximum(v - v0, 0)
    return left + waits


def _until_v(radius_sq: Ints, u0: Ints, v0: Ints, left: Ints) -> Ints:
    """Steps until v was stepped `left` times: the last of them waits for F < 0 at v0 + left − 1."""
    u = ceil_sqrt(radius_sq - (v0 + left - 1) ** 2) - 1
    waits: Ints = np.maximum(u0 - u, 0)
    return left + waits


def ceil_sqrt(square: Ints) -> Ints:
    """Smallest n ≥ 0 with n² ≥ square, exact for int64 below 2⁶²; 0 for negative ones."""
    square = np.maximum(square, 0)
    # Never too large: rounding takes no square above n² so far that its root is rounded above n.
    root = np.ceil(np.sqrt(square)).astype(np.int64)
    if square.size and square.max() >= _FLOAT_EXACT:
        root += root**2 < square
    return root
