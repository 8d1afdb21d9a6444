"""Where a depth is largest along lines and arcs, for depths that change no faster than one goes along them."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

_MOST_STRETCHES = 4096
"""Stretches looked at in one go, or four a curve. A curve that runs beside an edge for long would be cut into µm."""


class Deepest(NamedTuple):
    """The largest depth (m,) µm along each curve, and its place (m, 2)."""

    depth_um: Floats
    place_um: Floats


def deepest(curves: Curves, depth_of: Callable[[Ints, Floats], Floats], least_um: float, right_to_um: float) -> Deepest:
    """The largest depth along each of m curves, where it is more than `least_um`, right to `right_to_um`.

    `depth_of` gives the depths at places (k, 2) of the curves `row` (k,). Between two places it is no larger than half
    of both depths and of the way between them, together: stretches that cannot beat what is known are left alone. Where
    more than `_MOST_STRETCHES` could, what is found is right to half of their length.
    """
    row = np.arange(len(curves))
    begin, end = np.zeros(len(row)), np.ones(len(row))
    at_begin, at_end = (depth_of(row, places(curves, row, share)) for share in (begin, end))
    best, fraction = np.maximum(at_begin, at_end), np.where(at_end > at_begin, 1.0, 0.0)
    most = max(_MOST_STRETCHES, 4 * len(curves))
    while 0 < len(row) <= most:
        bound = 0.5 * (at_begin + at_end + curves.length_um[row] * (end - begin))
        deep = np.flatnonzero(bound > np.maximum(best[row], least_um) + right_to_um)
        row = row[deep]
        begin, end, at_begin, at_end = (column[deep] for column in (begin, end, at_begin, at_end))
        middle = 0.5 * (begin + end)
        depth = depth_of(row, places(curves, row, middle))
        order = np.argsort(depth, kind="stable")  # the deepest is entered last
        order = order[depth[order] > best[row[order]]]
        best[row[order]], fraction[row[order]] = depth[order], middle[order]
        row, begin, end = np.tile(row, 2), np.append(begin, middle), np.append(middle, end)
        at_begin, at_end = np.append(at_begin, depth), np.append(depth, at_end)
    return Deepest(best, places(curves, np.arange(len(curves)), fraction))
