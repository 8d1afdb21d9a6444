"""Strokes: stretches of steps in which each axis moves one way only, with any step in closed form.

A line is one stroke, an arc one per quadrant. Of the first k steps of a stroke, `firsts` are on its first axis; the
staircase of point-by-point comparison gives that number without walking:

* line, a µm on the first axis to b µm on the second: F ≥ 0 before each first-axis step means
  ``firsts = floor(a (k − 1) / (a + b)) + 1``;
* quadrant of an arc, from (u0, v0), first axis toward the centre: after k steps v − u = c is known, and u is the
  largest with ``u² + (u + c − 1)² < R²``, hence ``u = floor((ceil(sqrt(2R² − (c − 1)²)) − c) / 2)``, but no less than
  u0 − k, which is where it stands while F ≥ 0.

Arcs as a 3B controller walks them: quadrant after quadrant, each in the same canonical frame.

In every quadrant one axis steps toward the centre (coordinate u, falling to 0) and the other away from it (v, rising
from 0): the table of docs/3b.md §3 is one rule seen in eight frames. Counter-clockwise, quadrant q is the first one
turned by (q − 1) · 90°; clockwise is the mirror image of that at the X axis.
"""

from typing import NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Bools, Floats, Ints

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


class Strokes(NamedTuple):
    """m strokes; all (m,) int64 unless said otherwise, µm and steps.

    Attributes
    ----------
    row
        Row of the toolpath.
    base
        Steps of the row before the stroke.
    steps
        Steps of the stroke.
    origin
        (m, 2) where the stroke starts; as made here, relative to the row's start.
    first, second
        (m, 2) unit steps of the first and the second axis.
    is_arc
        (m,) bool.
    a, b
        Lines: extent on the first and second axis. Arcs: u0 and v0.
    radius_sq
        Arcs: R², µm²; 0 on lines.
    lead_um
        (m,) float64, length of the ideal path before the stroke.
    stretch
        (m,) float64, by which lengths along the stroke are multiplied.
    """

    row: Ints
    base: Ints
    steps: Ints
    origin: Ints
    first: Ints
    second: Ints
    is_arc: Bools
    a: Ints
    b: Ints
    radius_sq: Ints
    lead_um: Floats
    stretch: Floats

    def picked(self, order: Ints | Bools) -> "Strokes":
        """The strokes of these indices, in this order, or where the mask is True."""
        return Strokes._make(column[order] for column in self)


class Reached(NamedTuple):
    """After steps of m strokes: places (m, 2) int64 µm, and lengths (m,) float64 µm of the ideal path by then."""

    place_um: Ints
    along_um: Floats


def line_strokes(row: Ints, extent: Ints, sign: Ints, first_is_x: Bools, steps: Ints) -> Strokes:
    """One stroke a line, from the (m, 2) absolute direction, its signs, and whether X is the first axis.

    The signs are those of the quadrant, also on an axis: there a neighbour label shows in one stray step.
    """
    m = len(row)
    unit = np.eye(2, dtype=np.int64)
    on_first = np.where(first_is_x, 0, 1)
    rows = np.arange(m)
    return Strokes(
        row=row,
        base=np.zeros(m, dtype=np.int64),
        steps=steps,
        origin=np.zeros((m, 2), dtype=np.int64),
        first=unit[on_first] * sign,
        second=unit[1 - on_first] * sign,
        is_arc=np.zeros(m, dtype=np.bool_),
        a=extent[rows, on_first],
        b=extent[rows, 1 - on_first],
        radius_sq=np.zeros(m, dtype=np.int64),
        lead_um=np.zeros(m),
        stretch=np.ones(m),
    )


def arc_strokes(row: Ints, walk: ArcWalk, turn: Ints, since: Ints, until: Ints) -> Strokes:
    """Strokes of arcs that hold any of the steps after `since` up to `until` (per arc, counted from its start).

    Only these are made, so that a program of many turns costs no more than the steps asked for.
    """
    whole = walk.u0 + walk.top - walk.v0
    lowest = _visit(since, whole, walk.top)
    visits = np.maximum(_visit(until - 1, whole, walk.top) - lowest + 1, 0) * (until > since)
    arc = np.repeat(np.arange(len(row)), visits)
    visit = np.arange(len(arc)) - np.repeat(np.cumsum(visits) - visits - lowest, visits)
    opening = visit == 0
    u0, v0 = np.where(opening, walk.u0[arc], walk.top[arc]), np.where(opening, walk.v0[arc], 0)
    base = np.where(opening, 0, whole[arc] + (visit - 1) * 2 * walk.top[arc])
    quarter = (walk.quarter[arc] + visit) % 4
    mirror = np.stack([np.ones_like(arc), turn[arc]], axis=1)
    toward, away = TOWARD[quarter] * mirror, AWAY[quarter] * mirror
    opened = np.arctan2(walk.v0, walk.u0)[arc]
    start = TOWARD[walk.quarter] * -walk.u0[:, None] + AWAY[walk.quarter] * walk.v0[:, None]
    return Strokes(
        row=row[arc],
        base=base,
        steps=np.minimum(u0 + walk.top[arc] - v0, walk.steps[arc] - base),
        origin=toward * -u0[:, None] + away * v0[:, None] - start[arc] * mirror,
        first=toward,
        second=away,
        is_arc=np.ones(len(arc), dtype=np.bool_),
        a=u0,
        b=v0,
        radius_sq=walk.radius_sq[arc],
        lead_um=np.sqrt(walk.radius_sq[arc]) * (visit * (np.pi / 2) - opened * ~opening),
        stretch=np.ones(len(arc)),
    )


def _visit(step: Ints, whole: Ints, top: Ints) -> Ints:
    """Number of the quadrant visit, from 0, that holds the step with this number (from 0) of an arc."""
    return np.where(step < whole, 0, 1 + (step - whole) // (2 * top))


def firsts_of_line(a: Ints, a_and_b: Ints, k: Ints) -> Ints:
    """First-axis steps among the first k ≥ 1 of a line from a and a + b > 0, (n,) int64."""
    return a * (k - 1) // a_and_b + 1


def firsts_of_arc(u0: Ints, v0: Ints, radius_sq: Ints, k: Ints) -> Ints:
    """Steps toward the centre among the first k of a quadrant, (n,) int64; k ≥ 0."""
    c = k + (v0 - u0)
    u = (ceil_sqrt(2 * radius_sq - (c - 1) ** 2) - c) >> 1
    return np.minimum(k, u0 - u)


def firsts_among(strokes: Strokes, k: Ints) -> Ints:
    """First-axis steps among the first k (m,) ≥ 0 of each stroke, (m,) int64."""
    on_first = np.where(k > 0, firsts_of_line(strokes.a, np.maximum(strokes.a + strokes.b, 1), k), 0)
    arc = np.flatnonzero(strokes.is_arc)
    on_first[arc] = firsts_of_arc(strokes.a[arc], strokes.b[arc], strokes.radius_sq[arc], k[arc])
    return on_first


def lengths_of_lines(strokes: Strokes) -> Floats:
    """Lengths (m, 3) µm of the ideal path: for each step on the first axis, besides for each step, and before the line.

    The foot of a step on a line lies where its share in the direction is.
    """
    extent = np.maximum(np.hypot(strokes.a, strokes.b), 1.0) / strokes.stretch
    return np.column_stack([(strokes.a - strokes.b) / extent, strokes.b / extent, strokes.lead_um])


def lengths_of_arcs(strokes: Strokes) -> tuple[Floats, Floats]:
    """Lengths (m,) µm of the ideal path: by the angle 0 of the arc's frame, and for each rad from there.

    The foot of a step on an arc lies where its angle from the centre is.
    """
    radius = np.sqrt(strokes.radius_sq) * strokes.stretch
    return strokes.lead_um - radius * np.arctan2(strokes.b, strokes.a), radius


def reached(strokes: Strokes, k: Ints) -> Reached:
    """Where the k-th (m,) ≥ 1 step of each stroke ends."""
    on_first = firsts_among(strokes, k)
    on_second = k - on_first
    place = strokes.origin + strokes.first * on_first[:, None] + strokes.second * on_second[:, None]
    by_first, by_step, before = lengths_of_lines(strokes).T
    along = by_first * on_first + by_step * k + before
    arc = np.flatnonzero(strokes.is_arc)
    arcs = strokes.picked(arc)
    lead, radius = lengths_of_arcs(arcs)
    along[arc] = lead + radius * np.arctan2(arcs.b + on_second[arc], arcs.a - on_first[arc])
    return Reached(place, along)
