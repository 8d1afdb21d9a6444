"""How far places of a trace lie from the ideal path, and from which place on it that is measured.

This is the one answer for all who tell of a deviation: the report, the pictures, the film and the replay.

From which block is a place measured? A sample belongs to the block that its command is running. But table and wire
come after their command, and may still be on a block that the command has left. So the nearest of these blocks counts:

* the block of the sample;
* where the place lies past an end of that block, the neighbour there;
* the blocks that the command left last, as far back along the path as twice the distance from the command to the place.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.geometry.feet import feet
from parser.toolpath import Toolpath
from sim.measure.deviation.deviation import Deviation, Where
from sim.table.trace import Trace

_MOST_BACK = 50
"""Blocks to look back at: work is bounded where a table stays behind for good."""
_NEARER_UM = 1e-6
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


def _measured(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> tuple[Ints, Floats]:
    """Rows (m,) that places are measured from, and the distances (m,), left positive."""
    x, y = np.ascontiguousarray(place_um[:, 0]), np.ascontiguousarray(place_um[:, 1])
    row = trace.row.copy()
    away, beyond = distance_to_curves(toolpath, row, x, y)
    past = np.flatnonzero(beyond)
    _take_nearer(toolpath, past, trace.row[past] + beyond[past], (x, y), (row, away))
    earliest = _earliest(toolpath, trace, place_um, along_um)
    trailing = np.flatnonzero(earliest < trace.row)
    back = 1
    while len(trailing):
        _take_nearer(toolpath, trailing, trace.row[trailing] - back, (x, y), (row, away))
        back += 1
        trailing = trailing[earliest[trailing] <= trace.row[trailing] - back]
    return row, away * _side(toolpath, row, x, y)


def _take_nearer(
    toolpath: Toolpath, samples: Ints, row: Ints, xy: tuple[Floats, Floats], best: tuple[Ints, Floats]
) -> None:
    """Measure some samples from the blocks `row` instead, where those are nearer than the best so far."""
    row = np.clip(row, 0, len(toolpath) - 1)
    away, _ = distance_to_curves(toolpath, row, xy[0][samples], xy[1][samples])
    nearer = away < best[1][samples] - _NEARER_UM
    best[0][samples[nearer]], best[1][samples[nearer]] = row[nearer], away[nearer]


def _earliest(toolpath: Toolpath, trace: Trace, place_um: Floats, along_um: Floats) -> Ints:
    """How far to look back: the first row (m,) from which each place may be measured."""
    before = toolpath.before_um
    off = place_um - trace.commanded_um
    reach = along_um - 2.0 * np.hypot(off[:, 0], off[:, 1])
    first = trace.row.copy()
    left = np.flatnonzero(reach < before[trace.row])
    found = np.searchsorted(before, reach[left], side="right") - 1
    first[left] = np.clip(found, trace.row[left] - _MOST_BACK, trace.row[left]).clip(0)
    return first


def _side(toolpath: Toolpath, row: Ints, x: Floats, y: Floats) -> Floats:
    """+1 left of the blocks `row` and on them, −1 right of them."""
    right = np.empty(len(row), dtype=bool)
    arc = toolpath.is_arc[row]
    line, bent = np.flatnonzero(~arc), np.flatnonzero(arc)
    of = row[line]
    start, by = toolpath.start_um, toolpath.end_um - toolpath.start_um
    right[line] = (x[line] - start[:, 0][of]) * by[:, 1][of] > (y[line] - start[:, 1][of]) * by[:, 0][of]
    of, center = row[bent], toolpath.center_um
    outside = np.hypot(x[bent] - center[:, 0][of], y[bent] - center[:, 1][of]) > toolpath.radius_um[of]
    right[bent] = outside == (toolpath.sweep_rad[of] > 0.0)
    return np.where(right, -1.0, 1.0)


def summed(toolpath: Toolpath, trace: Trace, place_um: Floats, off_um: Floats) -> Deviation:
    """Deviation of the places (m, 2) of all samples of a trace, which lie (m,) from the path, to either side."""
    away = np.abs(off_um)
    first = np.flatnonzero(np.diff(trace.row, prepend=-1))
    by_row = np.full(len(toolpath), np.nan)
    by_row[trace.row[first]] = np.maximum.reduceat(away, first)
    at = int(np.argmax(away))
    return Deviation(
        max_um=float(away[at]),
        rms_um=float(np.dot(away, away) / len(away)) ** 0.5,
        p95_um=float(np.quantile(away, 0.95, method="inverted_cdf")),
        where=where(trace, place_um, at),
        by_row_um=by_row,
    )


def where(trace: Trace, place_um: Floats, at: int) -> Where:
    """A sample of the trace as a place."""
    x, y = place_um[at].tolist()
    return Where(int(trace.row[at]) + 1, x, y, float(trace.t_s[at]))
