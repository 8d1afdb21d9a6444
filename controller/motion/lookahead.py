"""Look-ahead: the highest speeds at the borders of rows from which every limit ahead and behind can be kept.

With constant acceleration a along a row of length L, v² can grow or fall by the row's room 2aL, no more. So the
highest lawful v² at a border is the least, over all borders k, of the limit at k plus the room between: a backward pass
(what is ahead can still be braked for) and a forward pass (no more than can have been reached).
"""

import numpy as np

from parser.geometry.curves import Floats


def reachable(limit_sq: Floats, room_sq: Floats) -> Floats:
    """Highest v² (n + 1,) at the borders of n rows under limits (n + 1,) and rooms 2aL (n,); all µm²/s², ≥ 0.

    The minimum over all distances is taken by windows that double (as in a sparse table), not over cumulated room:
    sums then stay as short as the ramps, and rounding stays relative to v² however long the path is.
    """
    backward = _backward(limit_sq, room_sq)
    return _backward(backward[::-1], room_sq[::-1])[::-1]


def _backward(limit_sq: Floats, room_sq: Floats) -> Floats:
    best, room, window = limit_sq.copy(), room_sq, 1
    while len(room) and room.min() < best.max():
        np.minimum(best[:-window], best[window:] + room, out=best[:-window])
        room = room[:-window] + room[window:]
        window *= 2
    return best
