"""How far each of some curves lies from others at most, and where: branch and bound over their length.

A curve is halved wherever it may still lie farther off than anything found on it so far, as `stretch_loop` bounds it.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints
from sim.measure.compare.nearest import Index, nearest
from sim.measure.compare.stretch_loop import bounds
from sim.measure.curve_rows import curve_rows

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


def directed(curves: Curves, index: Index) -> Directed:
    """Distances of the curves, one or more, from those of the index."""
    row, fraction = _samples(curves)
    found = nearest(index, places(curves, row, fraction))
    at = np.flatnonzero(row[1:] == row[:-1])
    best = _Best(len(curves))
    best.meet(row, fraction, found.distance_um, found.row)
    open_ = Stretches(
        row[at],
        *(fraction[at], fraction[at + 1]),
        *(found.distance_um[at], found.distance_um[at + 1]),
        *(found.row[at], found.row[at + 1]),
    )
    own, squares = curve_rows(curves), 0.0
    while len(open_.row):
        bound = np.empty(len(open_.row))
        bounds(own, index.shape, (*open_,), bound)
        deep = bound > best.max_um[open_.row] + _RIGHT_TO_UM
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
        most = self.max_um + 10.0**-_ROUNDING_DIGITS
        np.maximum.at(most, row, rounded)
        larger = np.flatnonzero((rounded == most[row]) & (rounded > self.max_um[row] + 10.0**-_ROUNDING_DIGITS))
        order = larger[np.lexsort((fraction[larger], np.abs(fraction[larger] - 0.5), row[larger]))]
        first = order[np.diff(row[order], prepend=-1) > 0]
        at = row[first]
        self.max_um[at], self.fraction[at], self.other[at] = distance[first], fraction[first], other[first]


def _samples(curves: Curves) -> tuple[Ints, Floats]:
    """Rows and fractions to begin with, ends included."""
    spacing = max(float(curves.length_um.sum()) * _SPACING_SHARE, _RIGHT_TO_UM)
    parts = np.maximum(np.ceil(curves.length_um / spacing), _FEWEST).astype(np.int64)
    row = np.repeat(np.arange(len(curves)), parts + 1)
    at = np.arange(len(row)) - (np.cumsum(parts + 1) - parts - 1)[row]
    return row, at / parts[row]


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
