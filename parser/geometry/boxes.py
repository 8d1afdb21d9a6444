"""Curves in a grid: pieces of them, the box of each, and the cells that it touches.

Cells of a grid as keys: places that fall into one cell are found by sorting.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Curves, Floats, Ints

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
