"""Which blocks of a contour come near each other: the broad phase of the search for crossings.

Every block is cut into pieces about as long as the contour's blocks are on average, every piece is entered in the
cells of a grid that its box touches, and only blocks with pieces in one cell are looked at further. Two boxes that
meet may share several cells: they count in the one that holds the lowest and leftmost place of both.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.boxes import CORNER, Boxes, Bytes, distinct, entered, piece_boxes, reach_um
from parser.geometry.curves import Bools, Curves, Floats, Ints

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
    cells = entered(boxes)
    boxes, mates = boxes.take(cells.piece), _mates(cells.key)
    looked_at = int(np.searchsorted(np.cumsum(mates), most_pairs, side="right"))
    # Asked for more than the values, `unique` does without numpy.ma, which takes long to import.
    incomplete, _ = np.unique(boxes.contour[looked_at:][mates[looked_at:] > 0], return_index=True)
    whole, corner = len(mates), cells.corner
    if looked_at < whole:  # where a cell is left out, its pairs count in any other one that they share
        whole, corner = _first_of_cell(mates, looked_at), np.full_like(corner, CORNER)
    found = _in_whole_cells(boxes, corner, mates[:whole]), _in_cut_cell(boxes, corner, mates, whole, looked_at)
    this, other = (np.concatenate(rows) for rows in zip(*found, strict=True))
    # Rows of several pieces may meet in more than one; in order, rows of one place lie in one place of the memory.
    key = distinct(np.minimum(this, other) * len(curves) + np.maximum(this, other))
    early = key // len(curves)
    return NearPairs(early, key - early * len(curves), incomplete)


def _cells(contour: Ints, reach: Floats, margin_um: float) -> Floats:
    number = np.bincount(contour)
    return (_CELL_PER_BLOCK * (np.bincount(contour, reach) / np.maximum(number, 1)) + margin_um)[contour]


def _mates(key: Ints) -> Ints:
    """How many more entries follow each in its cell; `key` is that of the cell, cell after cell."""
    last = np.flatnonzero(np.append(key[1:] != key[:-1], True))
    sizes = np.diff(last, prepend=-1)
    mates: Ints = np.repeat(last, sizes) - np.arange(len(key))
    return mates


def _first_of_cell(mates: Ints, entry: int) -> int:
    """The first entry of the cell that an entry is in; the last one of each cell has no mates."""
    ends = np.flatnonzero(mates[:entry] == 0)
    return int(ends[-1]) + 1 if len(ends) else 0


def _in_whole_cells(boxes: Boxes, corner: Bytes, mates: Ints) -> tuple[Ints, Ints]:
    """Pairs of rows whose boxes meet; `mates` (m,) tells how many of the entries behind each are in its cell.

    Each entry is held against the one that follows it by 1, 2, 3 ... places, all entries at once. With the fullest
    cells first, those that still have mates are the first ones.
    """
    m = len(mates)
    begins = np.append(True, mates[:-1] == 0)[:m]
    fullest = mates[begins][np.cumsum(begins) - 1]
    order = np.sort((fullest.max(initial=0) - fullest) * m + np.arange(m)) % max(m, 1)
    number = m - np.cumsum(np.bincount(fullest, minlength=1))  # of entries in cells where one has more mates than this
    boxes, corner, mates = boxes.take(order), corner[order], mates[order]
    found = [(order[:0], order[:0])]
    for step, past in enumerate(number[:-1].tolist(), start=1):
        this, other = slice(0, past - step), slice(step, past)
        at = np.flatnonzero((mates[this] >= step) & _meet(boxes, corner, this, other))
        found.append((boxes.row[at], boxes.row[at + step]))
    early, late = (np.concatenate(rows) for rows in zip(*found, strict=True))
    return early, late


def _in_cut_cell(boxes: Boxes, corner: Bytes, mates: Ints, first: int, past: int) -> tuple[Ints, Ints]:
    """Pairs of rows whose boxes meet, of the entries from `first` up to `past` with their mates, all in one cell."""
    count = mates[first:past]
    this = np.repeat(np.arange(first, past), count)
    other = this + 1 + np.arange(len(this)) - np.repeat(np.cumsum(count) - count, count)
    near = _meet(boxes, corner, this, other)
    return boxes.row[this[near]], boxes.row[other[near]]


def _meet(boxes: Boxes, corner: Bytes, this: Ints | slice, other: Ints | slice) -> Bools:
    """Which entries of one cell are boxes of two rows of one contour that meet, and count in this cell."""
    near: Bools = (corner[this] | corner[other]) == CORNER
    near &= (boxes.low_x[this] <= boxes.high_x[other]) & (boxes.low_x[other] <= boxes.high_x[this])
    near &= (boxes.low_y[this] <= boxes.high_y[other]) & (boxes.low_y[other] <= boxes.high_y[this])
    near &= (boxes.row[this] != boxes.row[other]) & (boxes.contour[this] == boxes.contour[other])
    return near
