"""Which blocks of a contour come near each other: the broad phase of the search for crossings.

Every block is cut into pieces about as long as the contour's blocks are on average, every piece is entered in the
cells of a grid that its box touches, and only blocks with pieces in one cell are looked at further.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.toolpath import Floats, Ints, Toolpath

_CELL_PER_BLOCK = 1.5  # cell's edge per mean length of a block; measured: 1 to 2 is fastest
_WIDEST_RAD = np.pi / 2.0  # of a piece of an arc: its sagitta is 0.29 R, so that its box is not much larger than it
_CHUNK = 1 << 18  # pairs looked at in one go: some 20 MB
_HASH = (-7046029254386353131, 7809847782465536322, -4417276706812531889)  # mixes x, y and contour of a cell


class NearPairs(NamedTuple):
    """Rows (k,) of blocks of one contour whose boxes meet, `early` < `late`; contours not looked at to the end."""

    early: Ints
    late: Ints
    incomplete: Ints


class _Boxes(NamedTuple):
    """Pieces (m,): the row that each belongs to, its contour, its box in cells of the contour's own grid."""

    row: Ints
    contour: Ints
    low_x: Floats
    low_y: Floats
    high_x: Floats
    high_y: Floats

    def take(self, at: Ints) -> "_Boxes":
        """The pieces at the indices `at`, one after the other in memory."""
        floats = (column[at] for column in (self.low_x, self.low_y, self.high_x, self.high_y))
        return _Boxes(self.row[at], self.contour[at], *floats)


def near_pairs(toolpath: Toolpath, contour_of_row: Ints, shortest_um: float, most_pairs: int) -> NearPairs:
    """Pairs of rows that may meet. Blocks of up to `shortest_um` are left out.

    At most `most_pairs` pairs of pieces are looked at; a contour with more to look at is named in `incomplete`.
    """
    reach = turn_rad(toolpath) * np.where(toolpath.is_arc, toolpath.radius_um, 0.0)
    reach = np.where(toolpath.is_arc, reach, toolpath.length_um)
    rows = np.flatnonzero((contour_of_row >= 0) & (reach > shortest_um))
    nothing = np.empty(0, dtype=np.int64)
    if len(rows) < 2:
        return NearPairs(nothing, nothing, nothing)
    boxes = _boxes(toolpath, rows, contour_of_row[rows], reach[rows])
    entry, mates = _entries(boxes)
    total = np.cumsum(mates)
    looked_at = int(np.searchsorted(total, most_pairs, side="right"))
    # Asked for more than the values, `unique` does without numpy.ma, which takes long to import.
    incomplete, _ = np.unique(boxes.contour[entry[looked_at:][mates[looked_at:] > 0]], return_index=True)
    boxes = boxes.take(entry)
    keys = [_meeting(boxes, first, past, mates, len(toolpath)) for first, past in _chunks(total[:looked_at])]
    key = _distinct(np.concatenate([nothing, *keys]))
    return NearPairs(key // len(toolpath), key % len(toolpath), incomplete)


def turn_rad(toolpath: Toolpath) -> Floats:
    """Angles (n,) that the arcs cover, unsigned and at most 2π; 0 on lines."""
    return np.minimum(np.abs(toolpath.sweep_rad), 2.0 * np.pi)


def _boxes(toolpath: Toolpath, rows: Ints, contour: Ints, reach: Floats) -> _Boxes:
    number = np.bincount(contour)
    cell = _CELL_PER_BLOCK * (np.bincount(contour, reach) / np.maximum(number, 1))[contour]
    turn = turn_rad(toolpath)[rows]
    parts = np.ceil(np.maximum(reach / cell, turn / _WIDEST_RAD)).astype(np.int64)
    of = np.repeat(np.arange(len(rows)), parts)
    at = np.arange(len(of)) - (np.cumsum(parts) - parts)[of]
    first, past = at / parts[of], (at + 1) / parts[of]
    row, inverse = rows[of], 1.0 / cell[of]
    x0, y0 = _places(toolpath, row, first)
    x1, y1 = _places(toolpath, row, past)
    # An arc lies no farther from the box of its ends than its sagitta.
    sagitta = np.nan_to_num(toolpath.radius_um[row]) * (1.0 - np.cos(0.5 * (turn / parts)[of]))
    return _Boxes(
        row=row,
        contour=contour[of],
        low_x=(np.minimum(x0, x1) - sagitta) * inverse,
        low_y=(np.minimum(y0, y1) - sagitta) * inverse,
        high_x=(np.maximum(x0, x1) + sagitta) * inverse,
        high_y=(np.maximum(y0, y1) + sagitta) * inverse,
    )


def _places(toolpath: Toolpath, row: Ints, fraction: Floats) -> tuple[Floats, Floats]:
    """Places x, y (m,) µm at a fraction of the blocks; an arc of more than a turn runs round once."""
    start, end = toolpath.start_um[row], toolpath.end_um[row]
    x = start[:, 0] + fraction * (end[:, 0] - start[:, 0])
    y = start[:, 1] + fraction * (end[:, 1] - start[:, 1])
    arc = np.flatnonzero(toolpath.is_arc[row])
    if len(arc):
        on = row[arc]
        sweep = np.clip(toolpath.sweep_rad[on], -2.0 * np.pi, 2.0 * np.pi)
        angle = toolpath.start_angle_rad[on] + fraction[arc] * sweep
        x[arc] = toolpath.center_um[on, 0] + toolpath.radius_um[on] * np.cos(angle)
        y[arc] = toolpath.center_um[on, 1] + toolpath.radius_um[on] * np.sin(angle)
    return x, y


def _entries(boxes: _Boxes) -> tuple[Ints, Ints]:
    """Pieces by the cells that they touch, cell after cell, and how many more follow each in its cell."""
    left, low = np.floor(boxes.low_x).astype(np.int64), np.floor(boxes.low_y).astype(np.int64)
    wide = np.floor(boxes.high_x).astype(np.int64) - left + 1
    cells = wide * (np.floor(boxes.high_y).astype(np.int64) - low + 1)
    piece = np.repeat(np.arange(len(cells)), cells)
    at = np.arange(len(piece)) - (np.cumsum(cells) - cells)[piece]
    up, right = np.divmod(at, wide[piece])
    # Two cells of one hash cost time, not truth: the boxes are compared.
    key = (left[piece] + right) * _HASH[0] + (low[piece] + up) * _HASH[1] + boxes.contour[piece] * _HASH[2]
    order = np.argsort(key)
    key = key[order]
    last = np.flatnonzero(np.append(key[1:] != key[:-1], True))
    sizes = np.diff(last, prepend=-1)
    return piece[order], np.repeat(last, sizes) - np.arange(len(order))


def _chunks(total: Ints) -> Iterator[tuple[int, int]]:
    """Ranges of entries with about `_CHUNK` pairs each, from the running total of their pairs."""
    if not len(total):
        return
    edges = np.searchsorted(total, np.arange(_CHUNK, int(total[-1]) + _CHUNK, _CHUNK), side="left") + 1
    edges = np.minimum(np.append(0, edges), len(total))
    edges = edges[np.append(True, np.diff(edges) > 0)]
    yield from zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)


def _meeting(boxes: _Boxes, first: int, past: int, mates: Ints, base: int) -> Ints:
    """Pairs of rows, as early × base + late, whose boxes meet in a cell, for the entries `first` up to `past`."""
    number = mates[first:past]
    one = np.repeat(np.arange(first, past), number)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(number) - number, number)
    near = (boxes.low_x[one] <= boxes.high_x[other]) & (boxes.low_x[other] <= boxes.high_x[one])
    one, other = one[near], other[near]
    near = (boxes.low_y[one] <= boxes.high_y[other]) & (boxes.low_y[other] <= boxes.high_y[one])
    near &= (boxes.row[one] != boxes.row[other]) & (boxes.contour[one] == boxes.contour[other])
    a, b = boxes.row[one[near]], boxes.row[other[near]]
    return _distinct(np.minimum(a, b) * base + np.maximum(a, b))


def _distinct(numbers: Ints) -> Ints:
    """Numbers in order, each once; here sorting is ten times as fast as the hashing of `np.unique`."""
    numbers = np.sort(numbers)
    return numbers[np.diff(numbers, prepend=-1) > 0]
