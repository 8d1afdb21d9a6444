"""Where the wire is threaded, how far it then goes from there in each direction, and where it is taken out again."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, extents
from parser.shape.contours import runs
from parser.toolpath import Point, Toolpath


class Threading(NamedTuple):
    """What is cut between one threading of the wire and the next.

    Attributes
    ----------
    first, last
        Rows of its first and last block; no jump lies between them.
    at_um, out_um
        Where the wire is threaded, and where it is taken out.
    at_s, out_s
        When the cut begins there and ends, s.
    left_um, right_um, down_um, up_um
        How far the wire's path goes from the thread point toward −X, +X, −Y and +Y; 0 where it does not go there.
    """

    first: int
    last: int
    at_um: Point
    out_um: Point
    at_s: float
    out_s: float
    left_um: float
    right_um: float
    down_um: float
    up_um: float


def threadings(toolpath: Toolpath, border_s: Floats) -> tuple[Threading, ...]:
    """Every stretch of cut blocks without a jump, in order; `border_s` (n + 1,) are the times at which blocks begin."""
    bounds = runs(toolpath)
    if not len(bounds):
        return ()
    first, last = bounds[:, 0], bounds[:, 1] - 1
    low, high = extents(toolpath)
    # Rows of jumps between two stretches fall to the one before them, and are left out of its reach.
    jump = toolpath.is_jump
    low, high = np.where(jump[:, None], np.inf, low), np.where(jump[:, None], -np.inf, high)
    at = toolpath.start_um[first]
    back = at - np.minimum.reduceat(low, first)
    on = np.maximum.reduceat(high, first) - at
    columns = (first, last, at, toolpath.end_um[last], border_s[first], border_s[last + 1], back, on)
    return tuple(
        Threading(first, last, Point(*at_um), Point(*out_um), at_s, out_s, left, right, down, up)
        for first, last, at_um, out_um, at_s, out_s, (left, down), (right, up) in zip(
            *(column.tolist() for column in columns), strict=True
        )
    )
