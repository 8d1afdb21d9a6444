"""Deviation: how far positions lie from the ideal geometry, and the figures that sum it up.

The deviation of a position is its distance from the ideal curve of the block it belongs to, ends included. A position
past an end of its block may lie on the neighbour there instead; then the nearer of the two counts.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Toolpath

_BINS_PER_E = 1000.0
_SMALLEST_UM = 1e-6
_BINS = 40_000  # from 1e-6 µm in steps of 0.1 % past 1e11 µm


class Where(NamedTuple):
    """Place of the largest deviation: block number from 1, position µm, time s."""

    block: int
    x_um: float
    y_um: float
    t_s: float


class Deviation(NamedTuple):
    """Deviation of all positions of one kind.

    Attributes
    ----------
    max_um, rms_um
        Largest and root mean square.
    p95_um
        95 % of the positions deviate no more than this (to 0.1 %).
    where
        Where the largest was met first; None where there was no position.
    by_row_um
        (n,) float64, largest deviation in each block; NaN where the block had no position.
    """

    max_um: float
    rms_um: float
    p95_um: float
    where: Where | None
    by_row_um: Floats


class DeviationMeter:
    """Sums up deviations as positions stream in, in memory that does not grow with them."""

    def __init__(self, toolpath: Toolpath) -> None:
        self._toolpath = toolpath
        self._by_row = np.full(len(toolpath), np.nan)
        self._square, self._number, self._max = 0.0, 0, -1.0
        self._bins = np.zeros(_BINS, dtype=np.int64)
        self._where: Where | None = None

    def add(self, row: NDArray[np.integer], x_um: Floats, y_um: Floats, t_s: Floats) -> None:
        """Take (m,) positions in program coordinates with the rows they belong to, rows never falling."""
        if not len(row):
            return
        deviation = distance(self._toolpath, row.astype(np.int64), x_um, y_um)
        first = np.flatnonzero(np.diff(row, prepend=-1))
        rows = row[first]
        self._by_row[rows] = np.fmax(self._by_row[rows], np.maximum.reduceat(deviation, first))
        self._square += float(np.dot(deviation, deviation))
        self._number += len(deviation)
        at = int(np.argmax(deviation))
        if deviation[at] > self._max:
            self._max = float(deviation[at])
            self._where = Where(int(row[at]) + 1, float(x_um[at]), float(y_um[at]), float(t_s[at]))
        level = np.log(np.maximum(deviation, _SMALLEST_UM) / _SMALLEST_UM) * _BINS_PER_E
        self._bins += np.bincount(np.minimum(level.astype(np.int64), _BINS - 1), minlength=_BINS)

    def result(self) -> Deviation:
        """All that was taken so far."""
        if not self._number:
            return Deviation(0.0, 0.0, 0.0, None, self._by_row)
        rank = np.searchsorted(np.cumsum(self._bins), 0.95 * self._number)
        p95 = min(self._max, _SMALLEST_UM * float(np.exp((rank + 1) / _BINS_PER_E))) if rank else 0.0
        return Deviation(self._max, (self._square / self._number) ** 0.5, p95, self._where, self._by_row)


def distance(toolpath: Toolpath, row: Ints, x_um: Floats, y_um: Floats) -> Floats:
    """Deviations (m,) µm of (m,) positions that belong to the blocks of `row`."""
    result, beyond = distance_to_curves(toolpath, row, x_um, y_um)
    past = np.flatnonzero(beyond)
    neighbour = np.clip(row[past] + beyond[past], 0, len(toolpath) - 1)
    result[past] = np.minimum(result[past], distance_to_curves(toolpath, neighbour, x_um[past], y_um[past])[0])
    return result
