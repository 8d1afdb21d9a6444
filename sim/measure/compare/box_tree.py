"""Curves in a tree of boxes: every node's box holds the boxes of the two nodes under it, and a leaf a few pieces.

Long curves and arcs are cut into pieces first, since the box about a whole one is mostly empty. Pieces that lie near
each other come to stand near each other by the Z-order of their boxes' middles (G. M. Morton, A computer oriented
geodetic data base, 1966).
"""

from functools import reduce
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

PIECES_OF_LEAF: Final = 4
_WIDEST_RAD: Final = np.pi / 8.0  # of a piece of an arc: its sagitta is 0.02 R
_LONGEST: Final = 2.0  # mean lengths of a curve: so there are no more pieces of lines than 1.5 times the curves
_CELLS: Final = 1 << 16  # along each side, of the Z-order
_SPREAD: Final = ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555))
"""Shifts and masks that move the 16 bits of a number to every other place."""
_SIDES: Final = ((np.minimum, slice(0, 2)), (np.maximum, slice(2, 4)))


class BoxTree(NamedTuple):
    """A tree over the pieces of curves.

    Attributes
    ----------
    box_um
        (2 p, 4) least x and y, largest x and y of each node. Node 1 is the root, 2 k and 2 k + 1 stand under node k,
        and the nodes from p on are leaves; where nothing is in one, the least is ∞.
    row
        (m,) curve of each piece, leaf after leaf, `PIECES_OF_LEAF` in each but the last.
    """

    box_um: Floats
    row: Ints


def box_tree(curves: Curves) -> BoxTree:
    """The tree over n curves, one or more."""
    row, low, high = _pieces(curves)
    order = np.argsort(_z_order(0.5 * (low + high)), kind="stable")
    leaves = 1 << (-(-len(row) // PIECES_OF_LEAF) - 1).bit_length()
    box = np.full((leaves * PIECES_OF_LEAF, 4), np.inf)
    box[:, 2:] = -np.inf
    box[: len(row), :2], box[: len(row), 2:] = low[order], high[order]
    levels = [_around(box, PIECES_OF_LEAF)]
    while len(levels[-1]) > 1:
        levels.append(_around(levels[-1], 2))
    return BoxTree(np.concatenate([levels[-1], *reversed(levels)]), row[order])  # no node is 0


def _pieces(curves: Curves) -> tuple[Ints, Floats, Floats]:
    """Row (m,) of each piece, and the lowest and highest places (m, 2) of its box."""
    turn = np.minimum(np.abs(curves.sweep_rad), 2.0 * np.pi)
    longest = max(_LONGEST * float(curves.length_um.mean()), np.finfo(np.float64).tiny)
    by_length = np.where(curves.is_arc, 0.0, curves.length_um / longest)
    parts = np.maximum(np.ceil(np.maximum(by_length, turn / _WIDEST_RAD)), 1.0).astype(np.int64)
    row = np.repeat(np.arange(len(parts)), parts)
    at = np.arange(len(row)) - (np.cumsum(parts) - parts)[row]
    ends = [places(curves, row, (at + past) / parts[row]) for past in (0, 1)]
    # An arc lies no farther from the box of its ends than its sagitta.
    half_rad = 0.5 * np.abs(curves.sweep_rad / parts)
    sagitta = np.where(curves.is_arc, curves.radius_um * (1.0 - np.cos(np.minimum(half_rad, np.pi))), 0.0)[row, None]
    return row, np.minimum(*ends) - sagitta, np.maximum(*ends) + sagitta


def _z_order(place_um: Floats) -> Ints:
    """Numbers (m,) that tell in which order the places (m, 2) stand."""
    low, size = place_um.min(axis=0), float(np.ptp(place_um, axis=0).max())
    column, line = ((place_um - low) * ((_CELLS - 1) / size if size else 0.0)).astype(np.int64).T
    return _spread_bits(column) | _spread_bits(line) << 1


def _spread_bits(number: Ints) -> Ints:
    for shift, mask in _SPREAD:
        number = (number | number << shift) & mask
    return number


def _around(boxes: Floats, number: int) -> Floats:
    """Boxes about each so many of the boxes (m, 4)."""
    each = [boxes[at::number] for at in range(number)]
    low, high = (reduce(least, (box[:, side] for box in each)) for least, side in _SIDES)
    return np.concatenate([low, high], axis=1)
