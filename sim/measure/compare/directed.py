"""How far each of some curves lies from others at most, and where: branch and bound over their length.

A curve is halved wherever it may still lie farther off than anything found on it so far. For a stretch from p(0) to
p(1) and any curve near it, let q(t) run on that curve between the feet of both ends. Then |p − q| is no more than the
larger of its values at the ends plus an eighth of the largest |p″ − q″|: 0 for two lines, and next to 0 for two arcs
about one centre. And no place is farther off than half of what both ends and the stretch's length add up to.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.feet import Feet, angles, feet
from sim.measure.compare.nearest import Index, nearest

_RIGHT_TO_UM = 0.01
_ROUNDING_DIGITS = 6  # of µm: what lies below is rounding
_FEWEST = 2  # stretches of a curve to begin with
_SPACING_SHARE = 2e-4  # of all length: no stretch is longer to begin with


class Directed(NamedTuple):
    """Distances of n curves from others.

    Attributes
    ----------
    max_um, fraction
        (n,) the largest distance of each curve, right to 0.01 µm, and at which fraction of its length.
    where_um
        (n, 2) the place of it.
    other
        (n,) row of the other curves that is nearest there.
    rms_um
        Root of the mean square of the distance along all the curves.
    """

    max_um: Floats
    fraction: Floats
    where_um: Floats
    other: Ints
    rms_um: float


class _Stretches(NamedTuple):
    """Stretches (m,): row, fractions at both ends, distances there, and the nearest other curves."""

    row: Ints
    begin: Floats
    end: Floats
    begin_um: Floats
    end_um: Floats
    begin_other: Ints
    end_other: Ints

    def take(self, at: Ints) -> "_Stretches":
        """Those at the indices `at`."""
        return _Stretches(
            row=self.row[at],
            begin=self.begin[at],
            end=self.end[at],
            begin_um=self.begin_um[at],
            end_um=self.end_um[at],
            begin_other=self.begin_other[at],
            end_other=self.end_other[at],
        )


def directed(curves: Curves, index: Index) -> Directed:
    """Distances of the curves, one or more, from those of the index."""
    row, fraction = _samples(curves)
    found = nearest(index, places(curves, row, fraction))
    at = np.flatnonzero(row[1:] == row[:-1])
    best = _Best(len(curves))
    best.meet(row, fraction, found.distance_um, found.row)
    open_ = _Stretches(
        row[at],
        *(fraction[at], fraction[at + 1]),
        *(found.distance_um[at], found.distance_um[at + 1]),
        *(found.row[at], found.row[at + 1]),
    )
    squares = 0.0
    while len(open_.row):
        deep = _bound(curves, index.curves, open_) > best.max_um[open_.row] + _RIGHT_TO_UM
        squares += _squares(curves, open_.take(np.flatnonzero(~deep)))
        open_ = _halved(curves, index, open_.take(np.flatnonzero(deep)), best)
    length = float(curves.length_um.sum())
    where = places(curves, np.arange(len(curves)), best.fraction)
    return Directed(best.max_um, best.fraction, where, best.other, float(np.sqrt(squares / length)) if length else 0.0)


class _Best:
    """The largest distance met so far on each of n curves, where, and from which other curve."""

    def __init__(self, n: int) -> None:
        self.max_um, self.fraction, self.other = np.full(n, -1.0), np.zeros(n), np.zeros(n, dtype=np.int64)

    def meet(self, row: Ints, fraction: Floats, distance: Floats, other: Ints) -> None:
        """Enter distances of places; of those that differ by rounding alone that nearest to the middle."""
        rounded = np.round(distance, _ROUNDING_DIGITS)
        order = np.lexsort((fraction, np.abs(fraction - 0.5), -rounded, row))
        first = order[np.diff(row[order], prepend=-1) > 0]
        first = first[rounded[first] > self.max_um[row[first]] + 10.0**-_ROUNDING_DIGITS]
        at = row[first]
        self.max_um[at], self.fraction[at], self.other[at] = distance[first], fraction[first], other[first]


def _samples(curves: Curves) -> tuple[Ints, Floats]:
    """Rows and fractions to begin with, ends included."""
    spacing = max(float(curves.length_um.sum()) * _SPACING_SHARE, _RIGHT_TO_UM)
    parts = np.maximum(np.ceil(curves.length_um / spacing), _FEWEST).astype(np.int64)
    row = np.repeat(np.arange(len(curves)), parts + 1)
    at = np.arange(len(row)) - (np.cumsum(parts + 1) - parts - 1)[row]
    return row, at / parts[row]


def _halved(curves: Curves, index: Index, whole: _Stretches, best: _Best) -> _Stretches:
    """Both halves of stretches; what is met in their middles is entered."""
    if not len(whole.row):
        return whole
    middle = 0.5 * (whole.begin + whole.end)
    found = nearest(index, places(curves, whole.row, middle))
    best.meet(whole.row, middle, found.distance_um, found.row)
    first = whole._replace(end=middle, end_um=found.distance_um, end_other=found.row)
    second = whole._replace(begin=middle, begin_um=found.distance_um, begin_other=found.row)
    return _Stretches(*(np.concatenate(pair) for pair in zip(first, second, strict=True)))


def _squares(curves: Curves, at: _Stretches) -> float:
    """Integral of the square of the distance, taken as straight between the ends."""
    length = curves.length_um[at.row] * (at.end - at.begin)
    a, b = at.begin_um, at.end_um
    return float((length * (a * a + a * b + b * b)).sum() / 3.0)


def _bound(curves: Curves, others: Curves, at: _Stretches) -> Floats:
    """What the distance of stretches (m,) cannot exceed."""
    by_length = 0.5 * (at.begin_um + at.end_um + curves.length_um[at.row] * (at.end - at.begin))
    ends = places(curves, at.row, at.begin), places(curves, at.row, at.end)
    own = angles(curves, at.row, at.begin), angles(curves, at.row, at.end)
    result = by_length
    for other in (at.begin_other, at.end_other):
        at_ends = feet(others, other, ends[0]), feet(others, other, ends[1])
        off = np.maximum(*(np.hypot(*(end - foot.place_um).T) for end, foot in zip(ends, at_ends, strict=True)))
        result = np.minimum(result, off + _bend(_radius(curves, at.row), own, _radius(others, other), at_ends) / 8.0)
    return result


def _radius(curves: Curves, row: Ints) -> Floats:
    """Radii (m,), 0 of lines: these do not bend."""
    return np.where(curves.is_arc[row], curves.radius_um[row], 0.0)


def _bend(own_radius: Floats, own: tuple[Floats, Floats], radius: Floats, at_ends: tuple[Feet, Feet]) -> Floats:
    """Largest |p″ − q″| (m,) of arcs that run between angles evenly, each R φ² toward its centre."""
    other = at_ends[0].angle_rad, at_ends[1].angle_rad
    p = own_radius * (own[1] - own[0]) ** 2
    q = radius * (other[1] - other[0]) ** 2
    first, turned = own[0] - other[0], (own[1] - other[1]) - (own[0] - other[0])
    first = np.mod(first + np.pi, 2.0 * np.pi) - np.pi
    apart = np.minimum(np.maximum(np.abs(first), np.abs(first + turned)), 2.0)
    bend: Floats = np.abs(p - q) + np.minimum(p, q) * apart
    return bend
