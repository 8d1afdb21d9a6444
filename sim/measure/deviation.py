"""Deviation: how far places of a trace lie from the ideal path, from which place that is measured, and its figures.

This is the one answer for all who tell of a deviation: the report, the pictures, the film and the replay.

From which block is a place measured? A sample belongs to the block that its command is running. But table and wire
come after their command, and may still be on a block that the command has left. So the nearest of these blocks counts:

* the block of the sample;
* where the place lies past an end of that block, the neighbour there;
* the blocks that the command left last, as far back along the path as twice the distance from the command to the place;
* while the place itself stands still or moves less, the blocks that counted for it before. In a sharp point the wire
  stands in its own slot, and the command comes back past it: it is near the place then, but ahead of it on the path.

Deviation: how far positions lie from the ideal geometry, and the figures that sum it up.

The deviation of a position is its distance from the ideal curve of the block it belongs to, ends included. A position
past an end of its block may lie on the neighbour there instead; then the nearer of the two counts.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import feet
from parser.toolpath import Toolpath
from sim.measure.curve_rows import away_from, curve_rows, side_of
from sim.table.trace import Trace

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


@loop_part("f8(f8[:, ::1], i8, f8, f8)")
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


_MOST_BACK = 50
"""Blocks to look back at: work is bounded where a table stays behind for good."""
_CATCHES_UP = 2.0
"""How much faster than the place the bound comes on. With 1 it would never catch up with a wire that cuts corners off;
with 2 it has done so after a way as long as the place was behind."""
ROUNDING_UM = 1e-6
"""Another block counts where it is nearer by more than rounding: of two as near, the one that is running."""


class Across(NamedTuple):
    """Places of m samples across the ideal path.

    Attributes
    ----------
    row
        (m,) int64, row of the block that each is measured from.
    foot_um
        (m, 2) float64, the nearest place on that block, its ends included.
    off_um
        (m,) float64, distance from there, left of the direction of travel positive.
    """

    row: Ints
    foot_um: Floats
    off_um: Floats


def across(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> Across:
    """Places (m, 2), one a sample of the trace, across the path.

    `along_um` (m,) is the path length that is planned at each sample.
    """
    row, off = _measured(toolpath, trace, place_um, along_um)
    return Across(row, feet(toolpath, row, place_um).place_um, off)


def across_um(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> Floats:
    """The distances (m,) of `across` alone, without the work that the feet take."""
    return _measured(toolpath, trace, place_um, along_um)[1]


@loop_part("Tuple((i8, f8))(f8[:, ::1], i8, f8, f8, i8, f8)")
def _nearer(  # noqa: PLR0913, PLR0917 - a compiled loop hands over numbers one by one
    blocks: Floats, row: int, x: float, y: float, best: int, away: float
) -> tuple[int, float]:
    """Another block and its distance from a place, where it is nearer than the best so far; else that one."""
    if 0 <= row < len(blocks):
        there, _ = away_from(blocks[row], x, y)
        if there < away - ROUNDING_UM:
            return row, there
    return best, away


@compiled("void(f8[:, ::1], Tuple((i8[::1], i8[::1])), Tuple((f8[::1], f8[::1])), i8[::1], f8[::1])")
def _find_nearest(
    blocks: Floats, rows: tuple[Ints, Ints], place: tuple[Floats, Floats], nearest: Ints, off: Floats
) -> None:
    """Fill in the nearest of the blocks that may count for each place (m,), and how far it is away, left positive.

    `rows` are the block of each place, and the earliest that may count.
    """
    (row, earliest), (x, y) = rows, place
    for i in range(len(row)):
        best = row[i]
        away, beyond = away_from(blocks[best], x[i], y[i])
        if beyond != 0:
            best, away = _nearer(blocks, row[i] + beyond, x[i], y[i], best, away)
        for trailing in range(row[i] - 1, earliest[i] - 1, -1):
            best, away = _nearer(blocks, trailing, x[i], y[i], best, away)
        nearest[i], off[i] = best, away * side_of(blocks[best], x[i], y[i])


def _measured(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> tuple[Ints, Floats]:
    """Rows (m,) that places are measured from, and the distances (m,), left positive."""
    row = trace.row.astype(np.int64)
    x, y = (place_um[:, axis].astype(np.float64) for axis in (0, 1))
    nearest, off = np.empty_like(row), np.empty_like(x)
    _find_nearest(curve_rows(toolpath), (row, _earliest(toolpath, trace, place_um, along_um)), (x, y), nearest, off)
    return nearest, off


def _earliest(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> Ints:
    """How far to look back: the first row (m,) from which each place may be measured.

    What the place could be measured from at one sample it may be at the next, and the bound comes on by at most twice
    the way that the place has made: `behind` is the least of the bounds of all samples so far, moved on by that way.
    """
    before = toolpath.before_um
    off = place_um - trace.commanded_um
    way = _CATCHES_UP * np.hypot(*np.diff(place_um, axis=0, prepend=place_um[:1]).T).cumsum()
    behind = np.minimum.accumulate(along_um - 2.0 * np.hypot(off[:, 0], off[:, 1]) - way)
    reach = behind + way
    first = trace.row.copy()
    left = np.flatnonzero(reach < before[trace.row])
    found = np.searchsorted(before, reach[left], side="right") - 1
    first[left] = np.clip(found, trace.row[left] - _MOST_BACK, trace.row[left]).clip(0)
    return first


def summed(toolpath: Toolpath, trace: Trace, place_um: Floats, off_um: Floats) -> Deviation:
    """Deviation of the places (m, 2) of all samples of a trace, which lie (m,) from the path, to either side."""
    away = np.abs(off_um)
    first = np.flatnonzero(np.diff(trace.row, prepend=-1))
    by_row = np.full(len(toolpath), np.nan)
    by_row[trace.row[first]] = np.maximum.reduceat(away, first)
    at = farthest(away)
    return Deviation(
        max_um=float(away.max()),
        rms_um=float(np.dot(away, away) / len(away)) ** 0.5,
        p95_um=float(np.quantile(away, 0.95, method="inverted_cdf")),
        where=where(trace, place_um, at),
        by_row_um=by_row,
    )


def farthest(away_um: Floats) -> int:
    """The first of the samples (m,) that lie farthest away, but for rounding."""
    return int(np.argmax(away_um >= away_um.max() - ROUNDING_UM))


def where(trace: Trace, place_um: Floats, at: int) -> Where:
    """A sample of the trace as a place."""
    x, y = place_um[at].tolist()
    return Where(int(trace.row[at]) + 1, x, y, float(trace.t_s[at]))
