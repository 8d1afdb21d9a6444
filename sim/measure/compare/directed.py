"""How far each of some curves lies from others at most, and where: branch and bound over their length.

A curve is halved wherever it may still lie farther off than anything found on it so far, as `bounds` tells. Where the
others are chains of chords, as an edge as cut, a curve begins in stretches from one corner of theirs to the next.

The compiled bound of a comparison: how far stretches of curves can lie from others at most, by what their ends tell.

For a stretch from p(0) to p(1) and any curve near it, let q(t) run on that curve between the feet of both ends. Then
|p − q| is no more than the larger of its values at the ends plus an eighth of the largest |p″ − q″|: 0 for two lines,
and next to 0 for two arcs about one centre. And no place is farther off than half of what both ends and the stretch's
length add up to.
"""

import math
from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from parser.geometry.along import along_um, places
from parser.geometry.curves import Curves, Floats, Ints
from sim.measure.compare.nearest import Index, nearest
from sim.measure.curve_rows import IS_ARC, LENGTH, RADIUS, angle_at, curve_rows, distance_from, foot_angle, place_at

_FULL_TURN_RAD = 2.0 * math.pi


@loop_part("f8(f8, UniTuple(f8, 2), f8, UniTuple(f8, 2))")
def _bend(own_radius: float, own: tuple[float, float], radius: float, other: tuple[float, float]) -> float:
    """Largest |p″ − q″| of arcs that run from angle to angle evenly, each R φ² toward its centre; R is 0 of a line."""
    p, q = own_radius * (own[1] - own[0]) ** 2, radius * (other[1] - other[0]) ** 2
    apart = (own[0] - other[0] + math.pi) % _FULL_TURN_RAD - math.pi
    turned = (own[1] - other[1]) - (own[0] - other[0])
    return abs(p - q) + min(p, q) * min(max(abs(apart), abs(apart + turned)), 2.0)


@loop_part("f8(f8[::1], f8, f8, f8[::1])")
def _bulge(own: Floats, begin: float, end: float, other: Floats) -> float:
    """How much farther the stretch of a curve between two shares may lie from another curve than its ends do."""
    own_angle, angle = (0.0, 0.0), (0.0, 0.0)
    if own[IS_ARC]:
        own_angle = (angle_at(own, begin), angle_at(own, end))
    if other[IS_ARC]:
        begin_x, begin_y = place_at(own, begin)
        end_x, end_y = place_at(own, end)
        angle = (foot_angle(other, begin_x, begin_y), foot_angle(other, end_x, end_y))
    return _bend(own[RADIUS], own_angle, other[RADIUS], angle) / 8.0


@loop_part("f8(f8[::1], f8, f8[::1])")
def _distance_at(own: Floats, share: float, other: Floats) -> float:
    """Distance of the place at a share of a curve from another curve."""
    x, y = place_at(own, share)
    return distance_from(other, x, y, math.inf)


@compiled("void(f8[:,::1], f8[:,::1], Tuple((i8[::1], f8[::1], f8[::1], f8[::1], f8[::1], i8[::1], i8[::1])), f8[::1])")
def bounds(
    own: Floats,
    others: Floats,
    stretches: tuple[Ints, Floats, Floats, Floats, Floats, Ints, Ints],
    bound_um: Floats,
) -> None:
    """Fill in the bounds (m,) of stretches, the columns of `Stretches`, of curves beside others, by their rows."""
    row, begin, end, begin_um, end_um, begin_other, end_other = stretches
    for at in range(len(row)):
        curve, first, last = own[row[at]], begin_other[at], end_other[at]
        most = 0.5 * (begin_um[at] + end_um[at] + curve[LENGTH] * (end[at] - begin[at]))
        to_end = end_um[at]
        if first != last:
            to_end = _distance_at(curve, end[at], others[first])
            off = max(_distance_at(curve, begin[at], others[last]), end_um[at])
            most = min(most, off + _bulge(curve, begin[at], end[at], others[last]))
        bound_um[at] = min(most, max(begin_um[at], to_end) + _bulge(curve, begin[at], end[at], others[first]))


_RIGHT_TO_UM = 0.01
_ROUNDING_DIGITS = 6  # of µm: what lies below is rounding
_TOGETHER = 1 << 15  # curves looked at in one go: some 30 MB of stretches
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


class Stretches(NamedTuple):
    """Stretches (m,): row, fractions at both ends, distances there, and the nearest other curves."""

    row: Ints
    begin: Floats
    end: Floats
    begin_um: Floats
    end_um: Floats
    begin_other: Ints
    end_other: Ints

    def take(self, at: Ints) -> "Stretches":
        """Those at the indices `at`."""
        return Stretches(
            row=self.row[at],
            begin=self.begin[at],
            end=self.end[at],
            begin_um=self.begin_um[at],
            end_um=self.end_um[at],
            begin_other=self.begin_other[at],
            end_other=self.end_other[at],
        )


class Feet(NamedTuple):
    """Places on curves: row and fraction, (m,) each."""

    row: Ints
    fraction: Floats


_NO_FEET = Feet(np.empty(0, dtype=np.int64), np.empty(0))


def feet_on(index: Index, place_um: Floats) -> Feet:
    """The places on some curves that are nearest to places (m, 2)."""
    row = nearest(index, place_um.astype(np.float64)).row
    length = index.curves.length_um[row]
    share = along_um(index.curves, row, place_um) / np.where(length > 0.0, length, 1.0)
    return Feet(row, np.clip(share, 0.0, 1.0))


def directed(curves: Curves, index: Index, feet: Feet = _NO_FEET) -> Directed:
    """Distances of the curves, one or more, from those of the index; `feet` on them are looked at first."""
    length, best, squares = float(curves.length_um.sum()), _Best(len(curves)), 0.0
    spacing = max(length * _SPACING_SHARE, _RIGHT_TO_UM)
    order = np.argsort(feet.row, kind="stable")
    feet = Feet(feet.row[order], feet.fraction[order])
    own = curve_rows(curves)
    for first in range(0, len(curves), _TOGETHER):
        rows = np.arange(first, min(first + _TOGETHER, len(curves)))
        low, past = np.searchsorted(feet.row, [first, first + _TOGETHER]).tolist()
        of_rows = Feet(feet.row[low:past], feet.fraction[low:past])
        open_ = _begun(curves, index, _samples(curves, rows, of_rows, spacing), best)
        while len(open_.row):
            bound = np.empty(len(open_.row))
            bounds(own, index.shape, (*open_,), bound)
            deep = bound > best.max_um[open_.row] + _RIGHT_TO_UM
            squares += _squares(curves, open_.take(np.flatnonzero(~deep)))
            open_ = _halved(curves, index, open_.take(np.flatnonzero(deep)), best)
    where = places(curves, np.arange(len(curves)), best.fraction)
    return Directed(best.max_um, best.fraction, where, best.other, float(np.sqrt(squares / length)) if length else 0.0)


def _begun(curves: Curves, index: Index, samples: Feet, best: "_Best") -> Stretches:
    """The stretches between samples of curves; what is met at these is entered."""
    row, fraction = samples
    found = nearest(index, places(curves, row, fraction))
    best.meet(row, fraction, found.distance_um, found.row)
    at = np.flatnonzero(row[1:] == row[:-1])
    return Stretches(
        row[at],
        *(fraction[at], fraction[at + 1]),
        *(found.distance_um[at], found.distance_um[at + 1]),
        *(found.row[at], found.row[at + 1]),
    )


class _Best:
    """The largest distance met so far on each of n curves, where, and from which other curve."""

    def __init__(self, n: int) -> None:
        self.max_um, self.fraction, self.other = np.full(n, -1.0), np.zeros(n), np.zeros(n, dtype=np.int64)

    def meet(self, row: Ints, fraction: Floats, distance: Floats, other: Ints) -> None:
        """Enter distances of places; of those that differ by rounding alone that nearest to the middle."""
        rounded = np.round(distance, _ROUNDING_DIGITS)
        most = self.max_um + 10.0**-_ROUNDING_DIGITS
        np.maximum.at(most, row, rounded)
        larger = np.flatnonzero((rounded == most[row]) & (rounded > self.max_um[row] + 10.0**-_ROUNDING_DIGITS))
        order = larger[np.lexsort((fraction[larger], np.abs(fraction[larger] - 0.5), row[larger]))]
        first = order[np.diff(row[order], prepend=-1) > 0]
        at = row[first]
        self.max_um[at], self.fraction[at], self.other[at] = distance[first], fraction[first], other[first]


def _samples(curves: Curves, rows: Ints, feet: Feet, spacing_um: float) -> Feet:
    """Where some curves are looked at to begin with, in order: at their ends, no farther apart, and at feet on them."""
    parts = np.maximum(np.ceil(curves.length_um[rows] / spacing_um), _FEWEST).astype(np.int64)
    nth = np.repeat(np.arange(len(rows)), parts + 1)
    at = np.arange(len(nth)) - (np.cumsum(parts + 1) - parts - 1)[nth]
    row, fraction = np.concatenate([rows[nth], feet.row]), np.concatenate([at / parts[nth], feet.fraction])
    order = np.lexsort((fraction, row))
    row, fraction = row[order], fraction[order]
    is_new = np.append(True, (np.diff(row) != 0) | (np.diff(fraction) > 0.0))
    return Feet(row[is_new], fraction[is_new])


def _halved(curves: Curves, index: Index, whole: Stretches, best: _Best) -> Stretches:
    """Both halves of stretches; what is met in their middles is entered."""
    if not len(whole.row):
        return whole
    middle = 0.5 * (whole.begin + whole.end)
    found = nearest(index, places(curves, whole.row, middle))
    best.meet(whole.row, middle, found.distance_um, found.row)
    first = whole._replace(end=middle, end_um=found.distance_um, end_other=found.row)
    second = whole._replace(begin=middle, begin_um=found.distance_um, begin_other=found.row)
    return Stretches(*(np.concatenate(pair) for pair in zip(first, second, strict=True)))


def _squares(curves: Curves, at: Stretches) -> float:
    """Integral of the square of the distance, taken as straight between the ends."""
    length = curves.length_um[at.row] * (at.end - at.begin)
    a, b = at.begin_um, at.end_um
    return float((length * (a * a + a * b + b * b)).sum() / 3.0)
