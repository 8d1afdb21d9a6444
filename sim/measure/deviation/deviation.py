"""Deviation: how far positions lie from the ideal geometry, and the figures that sum it up.

The deviation of a position is its distance from the ideal curve of the block it belongs to, ends included. A position
past an end of its block may lie on the neighbour there instead; then the nearer of the two counts.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from sim.measure.curve_rows import away_from, curve_rows

_BINS_PER_E = 1000.0
_SMALLEST_UM = 1e-6
_BINS = 40_000  # from 1e-6 µm in steps of 0.1 % past 1e11 µm

Column = NDArray[np.int32] | NDArray[np.float64]
"""One coordinate of positions, µm."""


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


@compiled("f8(f8[:, ::1], i8, f8, f8)")
def away_from_path(blocks: Floats, row: int, x: float, y: float) -> float:
    """Distance µm of a place that belongs to a block; past an end the neighbour there counts where it is nearer."""
    away, beyond = away_from(blocks[row], x, y)
    neighbour = row + beyond
    if beyond != 0 and 0 <= neighbour < len(blocks):
        return min(away, away_from(blocks[neighbour], x, y)[0])
    return away


@compiled("Tuple((f8, i8, f8, i8))(f8[:, ::1], f8[:, ::1], f8[::1], i4[::1], f8[::1], f8[::1], f8[::1], i8[::1])")
def _sum_up(  # noqa: PLR0913, PLR0917 - a compiled loop is handed its columns one by one
    blocks: Floats,
    drift_um: Floats,
    t_s: Floats,
    row: NDArray[np.int32],
    x_um: Floats,
    y_um: Floats,
    by_row_um: Floats,
    bins: Ints,
) -> tuple[float, int, float, int]:
    """Put the deviations of (m,) positions into `by_row_um` and `bins`, columns as `DeviationMeter` has them.

    Gives the sum of their squares, their number, the largest, and the first position that has it; −1 without any.
    """
    square, number, most, at = 0.0, 0, -1.0, -1
    for i in range(len(t_s)):
        if i + 1 < len(t_s) and t_s[i + 1] <= t_s[i]:
            continue
        own = row[i]
        off = away_from_path(blocks, own, x_um[i] - drift_um[own, 0], y_um[i] - drift_um[own, 1])
        square += off * off
        number += 1
        if not by_row_um[own] >= off:  # NaN before the first
            by_row_um[own] = off
        level = int(math.log(max(off, _SMALLEST_UM) / _SMALLEST_UM) * _BINS_PER_E)
        bins[min(level, _BINS - 1)] += 1
        if off > most:
            most, at = off, i
    return square, number, most, at


class DeviationMeter:
    """Sums up deviations as positions stream in, in memory that does not grow with them.

    Parameters
    ----------
    toolpath
        What they deviate from.
    drift_um
        (n, 2), or what broadcasts to it: by how much the positions of each block are moved back before.
    """

    def __init__(self, toolpath: Toolpath, drift_um: Floats | float = 0.0) -> None:
        self._blocks, self._drift = curve_rows(toolpath), np.empty((len(toolpath), 2))
        self._drift[:] = drift_um
        self._by_row = np.full(len(toolpath), np.nan)
        self._square, self._number, self._max = 0.0, 0, -1.0
        self._bins = np.zeros(_BINS, dtype=np.int64)
        self._where: Where | None = None

    def add(self, row: NDArray[np.integer], x_um: Column, y_um: Column, t_s: Floats) -> None:
        """Take (m,) positions in program coordinates with rows and times, both never falling.

        Of positions at the same time the last one counts: where two axes are pulsed at once, the place after both.
        """
        # Copies all, since a compiled loop takes no column that is read-only or strided.
        time, x, y = (column.astype(np.float64) for column in (t_s, x_um, y_um))
        rows = row.astype(np.int32)
        square, number, most, at = _sum_up(self._blocks, self._drift, time, rows, x, y, self._by_row, self._bins)
        self._square += square
        self._number += number
        if most > self._max:
            self._max = most
            x_off, y_off = self._drift[row[at]].tolist()
            self._where = Where(int(row[at]) + 1, float(x[at]) - x_off, float(y[at]) - y_off, float(time[at]))

    def result(self) -> Deviation:
        """All that was taken so far."""
        if not self._number:
            return Deviation(0.0, 0.0, 0.0, None, self._by_row)
        rank = np.searchsorted(np.cumsum(self._bins), 0.95 * self._number)
        p95 = min(self._max, _SMALLEST_UM * float(np.exp((rank + 1) / _BINS_PER_E))) if rank else 0.0
        return Deviation(self._max, (self._square / self._number) ** 0.5, p95, self._where, self._by_row)
