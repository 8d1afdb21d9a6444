"""Closed outlines with fewer corners, each of those left out within a stated distance of the side that replaces it.

From a corner that stays, a side may run to a later one as long as it passes all corners between within that distance:
each of them leaves open a sector of directions, and the side has to run within them all (Z. Zhao and A. Saalfeld,
Linear-time sleeve-fitting polyline simplification algorithms, 1997).
"""

import math

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints

_FULL_TURN_RAD = 2.0 * math.pi


@compiled("i8(f8[:,::1], i8, f8)")
def _farthest(corner_um: Floats, from_: int, within_um: float) -> int:
    """The last corner that a side from the corner `from_` may run to; corners go away from that one all the way."""
    x, y, reached = corner_um[from_, 0], corner_um[from_, 1], from_ + 1
    ahead, low, high, farthest_um = 0.0, -math.pi, math.pi, 0.0
    for at in range(from_ + 1, len(corner_um)):
        by_x, by_y = corner_um[at, 0] - x, corner_um[at, 1] - y
        away_um = math.hypot(by_x, by_y)
        if away_um < farthest_um:
            break
        if away_um > within_um:
            if farthest_um <= within_um:
                ahead = math.atan2(by_y, by_x)
            turned = (math.atan2(by_y, by_x) - ahead + math.pi) % _FULL_TURN_RAD - math.pi
            if not low <= turned <= high:
                break
            aside = math.asin(within_um / away_um)
            low, high = max(low, turned - aside), min(high, turned + aside)
        reached, farthest_um = at, away_um
    return reached


@compiled("i8(f8[:,::1], f8, i8[::1])")
def _stay(corner_um: Floats, within_um: float, kept: Ints) -> int:
    """Fill in which corners stay, and give how many."""
    number, from_, last = 0, 0, len(corner_um) - 1
    while from_ < last:
        kept[number], number = from_, number + 1
        from_ = _farthest(corner_um, from_, within_um)
    kept[number] = last
    return number + 1


def coarser(corner_um: Floats, within_um: float) -> Floats:
    """The corners (k, 2) that stay of a chain of corners (m, 2), the first and the last among them."""
    kept = np.empty(len(corner_um), dtype=np.int64)
    number = _stay(np.ascontiguousarray(corner_um), within_um, kept)
    return corner_um[kept[:number]]
