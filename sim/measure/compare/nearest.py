"""Which of many curves lies nearest to a place, exactly, and how many may be looked at for that.

The compiled search through a tree of boxes for the curve that lies nearest to a place.

Curves in a tree of boxes: every node's box holds the boxes of the two nodes under it, and a leaf a few pieces.

Long curves and arcs are cut into pieces first, since the box about a whole one is mostly empty. Pieces that lie near
each other come to stand near each other by the Z-order of their boxes' middles (G. M. Morton, A computer oriented
geodetic data base, 1966).
"""

from dataclasses import dataclass
from functools import reduce
from typing import Final, NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from parser.findings.errors import DrawingError
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints, box_of
from sim.measure.curve_rows import curve_rows, distance_from

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
    low, high = box_of(place_um)
    size = float((high - low).max())
    column, line = ((place_um - low) * ((_CELLS - 1) / size if size else 0.0)).astype(np.int64).T
    return _spread_bits(column) | _spread_bits(line) << 1


def _spread_bits(number: Ints) -> Ints:
    for shift, mask in _SPREAD:
        number = (number | number << shift) & mask
    return number


def _around(boxes: Floats, number: int) -> Floats:
    """Boxes about each so many of the boxes (m, 4)."""
    columns = [boxes[at::number] for at in range(number)]
    low, high = (reduce(least, (box[:, side] for box in columns)) for least, side in _SIDES)
    return np.concatenate([low, high], axis=1)


TOO_MANY: Final = -1
"""In place of how many curves were looked at: more than may be."""

_MOST_WAITING = 128  # nodes, two of each level at most: there are no more levels than bits of a number
_SLACK, _SLACK_UM = 1e-12, 1e-9  # the last bits of distances from boxes and circles are granted


@loop_part("f8(f8[::1], f8, f8)")
def from_box_squared(box: Floats, x: float, y: float) -> float:
    """Square of the distance of a place from a box, 0 within it."""
    off_x = max(box[0] - x, 0.0, x - box[2])
    off_y = max(box[1] - y, 0.0, y - box[3])
    return float(off_x * off_x + off_y * off_y)


@loop_part("Tuple((f8, i8, i8))(i8[::1], f8[:,::1], UniTuple(f8, 2), f8, i8)")
def _nearer_of(
    rows: Ints, shape: Floats, place_um: tuple[float, float], best: float, best_row: int
) -> tuple[float, int, int]:
    """The nearest to a place of the best so far, µm, and some rows; its row, and how many were looked at."""
    (x, y), looked_at = place_um, 0
    for of in rows:
        if of == best_row:
            continue
        looked_at += 1
        off = distance_from(shape[of], x, y, best * (1.0 + _SLACK) + _SLACK_UM)
        if off < best or (off == best and of < best_row):
            best, best_row = off, of
    return best, best_row, looked_at


@compiled(
    "i8(f8[:,::1], Tuple((f8[:,::1], i8[::1])), f8[:,::1], i8, Tuple((i8[::1], f8[::1])), Tuple((i8[::1], f8[::1])))"
)
def _search(  # noqa: PLR0913, PLR0917 - a compiled loop takes arrays one by one
    place_um: Floats,
    tree: tuple[Floats, Ints],
    shape: Floats,
    most: int,
    room: tuple[Ints, Floats],
    found: tuple[Ints, Floats],
) -> int:
    """Find the nearest of curves to places (m, 2): fill in its row (m,) and distance (m,), of equally near the first.

    The tree is that of the curves, as a bare tuple, `shape` their rows of numbers; `room` is for the nodes that wait
    (`_MOST_WAITING`,) and the squares of their distances. Gives how many curves were looked at, or `TOO_MANY` beyond
    `most`.

    A place begins with the curve that was nearest to the one before it; then nodes are opened, the nearer one of two
    first, whose boxes are not farther off than the nearest curve so far.
    """
    (box_um, piece_row), (row, distance_um) = tree, found
    leaves, looked_at, best_row = len(box_um) // 2, 0, 0
    waiting, squared = room
    for at in range(len(place_um)):
        x, y = place_um[at, 0], place_um[at, 1]
        best = distance_from(shape[best_row], x, y, np.inf)
        within = best * (1.0 + _SLACK) + _SLACK_UM
        number, waiting[0], squared[0] = 1, 1, 0.0
        while number:
            number -= 1
            node = waiting[number]
            if squared[number] > within * within:
                continue
            if node < leaves:
                near, far = 2 * node, 2 * node + 1
                to_near, to_far = from_box_squared(box_um[near], x, y), from_box_squared(box_um[far], x, y)
                if to_far < to_near:
                    near, far, to_near, to_far = far, near, to_far, to_near
                waiting[number], squared[number] = far, to_far
                waiting[number + 1], squared[number + 1] = near, to_near
                number += 2
                continue
            first = (node - leaves) * PIECES_OF_LEAF
            rows = piece_row[first : first + PIECES_OF_LEAF]
            best, best_row, looks = _nearer_of(rows, shape, (x, y), best, best_row)
            within, looked_at = best * (1.0 + _SLACK) + _SLACK_UM, looked_at + looks
        if looked_at > most:
            return TOO_MANY
        row[at], distance_um[at] = best_row, best
    return looked_at


MOST_HELD = 300_000_000
"""Curves, or pieces of long ones, that all places asked of one index are held against: some seconds. 50,000 curves laid
on 50,000 others need a tenth of it; thousands of curves at nearly one distance from thousands of places need more."""


@dataclass(slots=True)
class Effort:
    """How many curves have been looked at so far."""

    looked_at: int = 0


class Index(NamedTuple):
    """Curves that can be asked for the nearest one.

    Attributes
    ----------
    curves
        n lines and arcs.
    tree
        Boxes about them.
    shape
        (n, 12), the curves as rows of numbers.
    effort
        How much has been asked of them.
    """

    curves: Curves
    tree: BoxTree
    shape: Floats
    effort: Effort


class Nearest(NamedTuple):
    """Rows (m,) of the nearest curves and the distances (m,) µm from them; of equally near ones the first."""

    row: Ints
    distance_um: Floats


def indexed(curves: Curves) -> Index:
    """The curves, one or more, with the tree over them."""
    return Index(curves, box_tree(curves), curve_rows(curves), Effort())


def nearest(index: Index, place_um: Floats) -> Nearest:
    """The nearest curves to places (m, 2), exactly.

    Raises DrawingError, without the name of the file, where all that were asked of the index take more than
    `MOST_HELD`.
    """
    found = Nearest(np.empty(len(place_um), dtype=np.int64), np.empty(len(place_um)))
    most = MOST_HELD - index.effort.looked_at
    room = np.empty(_MOST_WAITING, dtype=np.int64), np.empty(_MOST_WAITING)
    looked_at = _search(np.ascontiguousarray(place_um), (*index.tree,), index.shape, most, room, (*found,))
    if looked_at == TOO_MANY:
        raise DrawingError("too-much-to-compare", most=MOST_HELD)
    index.effort.looked_at += looked_at
    return found
