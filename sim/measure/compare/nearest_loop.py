"""The compiled search through a tree of boxes for the curve that lies nearest to a place."""

from typing import Final

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints
from sim.measure.compare.box_tree import PIECES_OF_LEAF
from sim.measure.curve_rows import distance_from

TOO_MANY: Final = -1
"""In place of how many curves were looked at: more than may be."""

_MOST_WAITING = 128  # nodes, two of each level at most: there are no more levels than bits of a number
_SLACK, _SLACK_UM = 1e-12, 1e-9  # the last bits of distances from boxes and circles are granted


@compiled("f8(f8[::1], f8, f8)")
def from_box_squared(box: Floats, x: float, y: float) -> float:
    """Square of the distance of a place from a box, 0 within it."""
    off_x = max(box[0] - x, 0.0, x - box[2])
    off_y = max(box[1] - y, 0.0, y - box[3])
    return float(off_x * off_x + off_y * off_y)


@compiled("i8(f8[:,::1], Tuple((f8[:,::1], i8[::1])), f8[:,::1], i8, Tuple((i8[::1], f8[::1])))")
def search(place_um: Floats, tree: tuple[Floats, Ints], shape: Floats, most: int, found: tuple[Ints, Floats]) -> int:
    """Find the nearest of curves to places (m, 2): fill in its row (m,) and distance (m,), of equally near the first.

    The tree is that of the curves, as a bare tuple, `shape` their rows of numbers. Gives how many curves were looked
    at, or `TOO_MANY` beyond `most`.

    A place begins with the curve that was nearest to the one before it; then nodes are opened, the nearer one of two
    first, whose boxes are not farther off than the nearest curve so far.
    """
    (box_um, piece_row), (row, distance_um) = tree, found
    leaves, looked_at, best_row = len(box_um) // 2, 0, 0
    waiting, squared = np.empty(_MOST_WAITING, np.int64), np.empty(_MOST_WAITING)
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
            for piece in range(first, min(first + PIECES_OF_LEAF, len(piece_row))):
                of = piece_row[piece]
                if of == best_row:
                    continue
                looked_at += 1
                off = distance_from(shape[of], x, y, within)
                if off < best or (off == best and of < best_row):
                    best, best_row = off, of
                    within = best * (1.0 + _SLACK) + _SLACK_UM
        if looked_at > most:
            return TOO_MANY
        row[at], distance_um[at] = best_row, best
    return looked_at
