"""Which curves lie near which, by the cells of a grid: the broad phase of every search for crossings and distances.

Curves in a grid: pieces of them, the box of each, and the cells that it touches.

Cells of a grid as keys: places that fall into one cell are found by sorting.

Which blocks of a contour come near each other: the broad phase of the search for crossings.

Every block is cut into pieces about as long as the contour's blocks are on average, every piece is entered in the
cells of a grid that its box touches, and only blocks with pieces in one cell are looked at further. Two boxes that
meet may share several cells: they count in the one that holds the lowest and leftmost place of both.

Which curves lie near some places, or near some other curves: the broad phase of the search for distances.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves

_FACTORS: Final = (-7046029254386353131, 7809847782465536322, -4417276706812531889)
"""Mixed bits, signed: 2⁶⁴ over the golden ratio, the upper half of the basis of FNV for 128 bits, a prime of xxHash."""


def cell_keys(column: Ints, row: Ints | int, layer: Ints | int = 0) -> Ints:
    """One key (n,) a cell from its column, row and layer (n,) int64; sums wrap round.

    Keys of two cells may be the same, if seldom. That costs time, not truth, where what shares a key is compared.
    """
    return column * _FACTORS[0] + row * _FACTORS[1] + layer * _FACTORS[2]


Bytes = NDArray[np.uint8]

_WIDEST_RAD = np.pi / 2.0  # of a piece of an arc: its sagitta is 0.29 R, so that its box is not much larger than it
CORNER: Final = 3
_CHUNK = 1 << 18  # pairs looked at in one go: some 20 MB


class Boxes(NamedTuple):
    """Pieces (m,): the row that each belongs to, its contour, its box in cells of the contour's own grid."""

    row: Ints
    contour: Ints
    low_x: Floats
    low_y: Floats
    high_x: Floats
    high_y: Floats

    def take(self, at: Ints) -> "Boxes":
        """The pieces at the indices `at`, one after the other in memory."""
        floats = (column[at] for column in (self.low_x, self.low_y, self.high_x, self.high_y))
        return Boxes(self.row[at], self.contour[at], *floats)


class Entries(NamedTuple):
    """Pieces (m,) in the cells that they touch: the piece, the key of the cell, and where the cell lies in its box.

    `corner` is 1 in the leftmost cells of the box, 2 in its lowest ones, and `CORNER` in the one that is both.
    """

    piece: Ints
    key: Ints
    corner: Bytes


def turn_rad(curves: Curves) -> Floats:
    """Angles (n,) that the arcs cover, unsigned and at most 2π; 0 on lines."""
    return np.minimum(np.abs(curves.sweep_rad), 2.0 * np.pi)


def reach_um(curves: Curves) -> Floats:
    """Lengths (n,) of the curves, of arcs up to one turn."""
    around = turn_rad(curves) * np.where(curves.is_arc, curves.radius_um, 0.0)
    return np.where(curves.is_arc, around, curves.length_um)


def piece_boxes(curves: Curves, rows: Ints, contour: Ints, cell_um: Floats, margin_um: float) -> Boxes:
    """Boxes of pieces up to a cell long, grown by a margin; rows (k,), their contours, and cells of those."""
    turn = turn_rad(curves)[rows]
    parts = np.ceil(np.maximum(reach_um(curves)[rows] / cell_um, turn / _WIDEST_RAD)).astype(np.int64)
    of = np.repeat(np.arange(len(rows)), parts)
    at = np.arange(len(of)) - (np.cumsum(parts) - parts)[of]
    first, past = at / parts[of], (at + 1) / parts[of]
    row, inverse = rows[of], 1.0 / cell_um[of]
    x0, y0 = _places(curves, row, first)
    x1, y1 = _places(curves, row, past)
    # An arc lies no farther from the box of its ends than its sagitta.
    grown = margin_um + np.nan_to_num(curves.radius_um[row]) * (1.0 - np.cos(0.5 * (turn / parts)[of]))
    return Boxes(
        row=row,
        contour=contour[of],
        low_x=(np.minimum(x0, x1) - grown) * inverse,
        low_y=(np.minimum(y0, y1) - grown) * inverse,
        high_x=(np.maximum(x0, x1) + grown) * inverse,
        high_y=(np.maximum(y0, y1) + grown) * inverse,
    )


def _places(curves: Curves, row: Ints, fraction: Floats) -> tuple[Floats, Floats]:
    """Places x, y (m,) µm at a fraction of the blocks; an arc of more than a turn runs round once."""
    start, end = curves.start_um[row], curves.end_um[row]
    x = start[:, 0] + fraction * (end[:, 0] - start[:, 0])
    y = start[:, 1] + fraction * (end[:, 1] - start[:, 1])
    arc = np.flatnonzero(curves.is_arc[row])
    if len(arc):
        on = row[arc]
        sweep = np.clip(curves.sweep_rad[on], -2.0 * np.pi, 2.0 * np.pi)
        angle = curves.start_angle_rad[on] + fraction[arc] * sweep
        x[arc] = curves.center_um[on, 0] + curves.radius_um[on] * np.cos(angle)
        y[arc] = curves.center_um[on, 1] + curves.radius_um[on] * np.sin(angle)
    return x, y


def entered(boxes: Boxes) -> Entries:
    """Pieces by the cells that they touch, cell after cell."""
    left, low = np.floor(boxes.low_x).astype(np.int64), np.floor(boxes.low_y).astype(np.int64)
    wide = np.floor(boxes.high_x).astype(np.int64) - left + 1
    cells = wide * (np.floor(boxes.high_y).astype(np.int64) - low + 1)
    piece = np.repeat(np.arange(len(cells)), cells)
    at = np.arange(len(piece)) - (np.cumsum(cells) - cells)[piece]
    up, right = np.divmod(at, wide[piece])
    # Two cells of one hash cost time, not truth: the boxes are compared.
    key = cell_keys(left[piece] + right, low[piece] + up, boxes.contour[piece])
    order = np.argsort(key)
    corner = (right == 0).astype(np.uint8) | ((up == 0).astype(np.uint8) << 1)
    return Entries(piece[order], key[order], corner[order])


def chunks(total: Ints) -> Iterator[tuple[int, int]]:
    """Ranges of entries with about `_CHUNK` pairs each, from the running total of their pairs."""
    if not len(total):
        return
    edges = np.searchsorted(total, np.arange(_CHUNK, int(total[-1]) + _CHUNK, _CHUNK), side="left") + 1
    edges = np.minimum(np.append(0, edges), len(total))
    edges = edges[np.append(True, np.diff(edges) > 0)]
    yield from zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)


def distinct(numbers: Ints) -> Ints:
    """Numbers from 0 in order, each once; here sorting is ten times as fast as the hashing of `np.unique`."""
    numbers = np.sort(numbers)
    return numbers[np.diff(numbers, prepend=-1) > 0]


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


_CELL_PER_CURVE = 1.0  # cell's edge per mean length of a curve, aside from the margin


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
    return max(float(_CELL_PER_CURVE * reach.sum() / max(len(reach), 1) + margin_um), 1.0)


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
