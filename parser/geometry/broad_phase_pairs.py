"""Which blocks of a contour come near each other: the broad phase of the search for crossings.

Every block is cut into pieces about as long as the contour's blocks are on average, every piece is entered in the
cells of a grid that its box touches, and only blocks with pieces in one cell are looked at further.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.boxes import Boxes, chunks, distinct, entered, piece_boxes, reach_um
from parser.geometry.curves import Curves, Floats, Ints

_CELL_PER_BLOCK = 1.5  # cell's edge per mean length of a block; measured: 1 to 2 is fastest


class NearPairs(NamedTuple):
    """Rows (k,) of blocks of one contour whose boxes meet, `early` < `late`; contours not looked at to the end."""

    early: Ints
    late: Ints
    incomplete: Ints


def near_pairs(
    curves: Curves, contour_of_row: Ints, shortest_um: float, most_pairs: int, margin_um: float = 0.0
) -> NearPairs:
    """Pairs of rows that may come within a margin of each other. Blocks of up to `shortest_um` are left out.

    At most `most_pairs` pairs of pieces are looked at; a contour with more to look at is named in `incomplete`.
    """
    reach = reach_um(curves)
    rows = np.flatnonzero((contour_of_row >= 0) & (reach > shortest_um))
    nothing = np.empty(0, dtype=np.int64)
    if len(rows) < 2:
        return NearPairs(nothing, nothing, nothing)
    contour = contour_of_row[rows]
    boxes = piece_boxes(curves, rows, contour, _cells(contour, reach[rows], margin_um), 0.5 * margin_um)
    entry, mates = _entries(boxes)
    total = np.cumsum(mates)
    looked_at = int(np.searchsorted(total, most_pairs, side="right"))
    # Asked for more than the values, `unique` does without numpy.ma, which takes long to import.
    incomplete, _ = np.unique(boxes.contour[entry[looked_at:][mates[looked_at:] > 0]], return_index=True)
    boxes = boxes.take(entry)
    keys = [_meeting(boxes, first, past, mates, len(curves)) for first, past in chunks(total[:looked_at])]
    key = distinct(np.concatenate([nothing, *keys]))
    return NearPairs(key // len(curves), key % len(curves), incomplete)


def _cells(contour: Ints, reach: Floats, margin_um: float) -> Floats:
    number = np.bincount(contour)
    return (_CELL_PER_BLOCK * (np.bincount(contour, reach) / np.maximum(number, 1)) + margin_um)[contour]


def _entries(boxes: Boxes) -> tuple[Ints, Ints]:
    """Pieces by the cells that they touch, cell after cell, and how many more follow each in its cell."""
    piece, key = entered(boxes)
    last = np.flatnonzero(np.append(key[1:] != key[:-1], True))
    sizes = np.diff(last, prepend=-1)
    return piece, np.repeat(last, sizes) - np.arange(len(piece))


def _meeting(boxes: Boxes, first: int, past: int, mates: Ints, base: int) -> Ints:
    """Pairs of rows, as early × base + late, whose boxes meet in a cell, for the entries `first` up to `past`."""
    number = mates[first:past]
    one = np.repeat(np.arange(first, past), number)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(number) - number, number)
    near = (boxes.low_x[one] <= boxes.high_x[other]) & (boxes.low_x[other] <= boxes.high_x[one])
    one, other = one[near], other[near]
    near = (boxes.low_y[one] <= boxes.high_y[other]) & (boxes.low_y[other] <= boxes.high_y[one])
    near &= (boxes.row[one] != boxes.row[other]) & (boxes.contour[one] == boxes.contour[other])
    a, b = boxes.row[one[near]], boxes.row[other[near]]
    keys: Ints = np.minimum(a, b) * base + np.maximum(a, b)
    return keys
