"""Which curves lie near some places, or near some other curves: the broad phase of the search for distances."""

from typing import NamedTuple

import numpy as np

from parser.geometry.boxes import Boxes, chunks, distinct, entered, piece_boxes, reach_um
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves

_CELL_PER_BLOCK = 1.0  # cell's edge per mean length of a curve, aside from the margin


class Near(NamedTuple):
    """Pairs (k,) in order: which place, or which of the other curves, and the row of a curve near it."""

    other: Ints
    row: Ints

    def take(self, at: Ints) -> "Near":
        """Those at the indices `at`."""
        return Near(self.other[at], self.row[at])


def near_places(curves: Curves, place_um: Floats, margin_um: float) -> Near:
    """All curves that come within a margin of places (m, 2), and some that do not. Curves of no length are left out."""
    cell = _cell(reach_um(curves), margin_um)
    at = place_um / cell
    x, y = np.ascontiguousarray(at[:, 0]), np.ascontiguousarray(at[:, 1])
    index = np.arange(len(place_um))
    return _near(curves, Boxes(index, np.zeros_like(index), x, y, x, y), cell, margin_um)


def near_curves(curves: Curves, others: Curves, margin_um: float) -> Near:
    """All curves that come within a margin of other curves, and some that do not; those of no length are left out."""
    cell = _cell(np.concatenate([reach_um(curves), reach_um(others)]), margin_um)
    return _near(curves, _whole(others, cell, 0.0), cell, margin_um)


def nearest_um(curves: Curves, place_um: Floats, within_um: float) -> Floats:
    """Distances (m,) µm of places (m, 2) from the curve nearest to each; some that lie farther than asked are ∞."""
    near = near_places(curves, place_um, within_um)
    distance, _ = distance_to_curves(curves, near.row, place_um[near.other, 0], place_um[near.other, 1])
    result = np.full(len(place_um), np.inf)
    np.minimum.at(result, near.other, distance)
    return result


def _cell(reach: Floats, margin_um: float) -> float:
    return max(float(_CELL_PER_BLOCK * reach.sum() / max(len(reach), 1) + margin_um), 1.0)


def _whole(curves: Curves, cell: float, margin_um: float) -> Boxes:
    rows = np.flatnonzero(reach_um(curves) > 0.0)
    return piece_boxes(curves, rows, np.zeros_like(rows), np.full(len(rows), cell), margin_um)


def _near(curves: Curves, others: Boxes, cell: float, margin_um: float) -> Near:
    boxes = _whole(curves, cell, margin_um)
    entry, key, _ = entered(boxes)
    piece, wanted, _ = entered(others)
    first = np.searchsorted(key, wanted, side="left")
    number = np.searchsorted(key, wanted, side="right") - first
    boxes, others, base = boxes.take(entry), others.take(piece), len(curves)
    found = [np.empty(0, dtype=np.int64)]
    for begin, end in chunks(np.cumsum(number)):
        count = number[begin:end]
        other = np.repeat(np.arange(begin, end), count)
        this = np.repeat(first[begin:end] - np.cumsum(count) + count, count) + np.arange(len(other))
        found.append(_meeting(boxes, others, this, other, base))
    pair = distinct(np.concatenate(found))
    return Near(pair // base, pair % base)


def _meeting(boxes: Boxes, others: Boxes, this: Ints, other: Ints, base: int) -> Ints:
    """Those of the pairs whose boxes meet, as rows: other × base + row."""
    near = (boxes.low_x[this] <= others.high_x[other]) & (others.low_x[other] <= boxes.high_x[this])
    this, other = this[near], other[near]
    near = (boxes.low_y[this] <= others.high_y[other]) & (others.low_y[other] <= boxes.high_y[this])
    return distinct(others.row[other[near]] * base + boxes.row[this[near]])
