"""Deviation: how far positions lie from the ideal geometry, and the figures that sum it up.

The deviation of a position is its distance from the ideal curve of the block it belongs to, ends included. A position
past an end of its block may lie on the neighbour there instead; then the nearer of the two counts.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.toolpath import Floats, Ints, Kind, Toolpath

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
    result, beyond = distance_to_blocks(toolpath, row, x_um, y_um)
    past = np.flatnonzero(beyond)
    neighbour = np.clip(row[past] + beyond[past], 0, len(toolpath) - 1)
    result[past] = np.minimum(result[past], distance_to_blocks(toolpath, neighbour, x_um[past], y_um[past])[0])
    return result


def distance_to_blocks(toolpath: Toolpath, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    """Distances (m,) µm of positions from the curves of the blocks `row`, and −1, 0, +1: before, on, past the curve."""
    result, beyond = np.empty(len(row)), np.empty(len(row), dtype=np.int64)
    arc = toolpath.kind[row] == Kind.ARC
    for which, measure in ((np.flatnonzero(~arc), _from_lines), (np.flatnonzero(arc), _from_arcs)):
        if len(which):
            result[which], beyond[which] = measure(toolpath, row[which], x[which], y[which])
    return result, beyond


def _from_lines(toolpath: Toolpath, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    by_x = toolpath.end_um[:, 0][row] - toolpath.start_um[:, 0][row]
    by_y = toolpath.end_um[:, 1][row] - toolpath.start_um[:, 1][row]
    length = np.hypot(by_x, by_y)
    inverse = 1.0 / np.where(length > 0.0, length, 1.0)
    ux, uy = by_x * inverse, by_y * inverse
    dx, dy = x - toolpath.start_um[:, 0][row], y - toolpath.start_um[:, 1][row]
    along = dx * ux + dy * uy
    across = dx * uy - dy * ux
    excess = along - np.clip(along, 0.0, length)
    return np.hypot(across, excess), np.sign(excess).astype(np.int64)


def _from_arcs(toolpath: Toolpath, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    dx, dy = x - toolpath.center_um[:, 0][row], y - toolpath.center_um[:, 1][row]
    sweep = toolpath.sweep_rad[row]
    reach = np.abs(sweep)
    turned = np.mod((np.arctan2(dy, dx) - toolpath.start_angle_rad[row]) * np.sign(sweep), 2.0 * np.pi)
    result = np.abs(np.hypot(dx, dy) - toolpath.radius_um[row])
    # Outside the sweep, the half of the open sector nearer the end is past it.
    open_ = turned > reach
    past_end = turned - reach < 2.0 * np.pi - turned
    beyond = np.where(open_, np.where(past_end, 1, -1), 0)
    end = np.where(past_end[:, None], toolpath.end_um[row], toolpath.start_um[row])
    return np.where(open_, np.hypot(x - end[:, 0], y - end[:, 1]), result), beyond
