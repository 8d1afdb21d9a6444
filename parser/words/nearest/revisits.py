"""Places to which a path comes again, and the arcs that decide how near it can end to them.

A line goes whole µm, and so does an arc on its count axis, unless it passes an extreme of it. On the other axis an arc
ends anywhere. So the last arc of a way that is free on an axis decides which part of a µm the way has there.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats, Ints

_SAME_UM = 1e-6


class Pin(NamedTuple):
    """An arc ends whole µm from a place, by its number, on an axis: 0 for X, 1 for Y."""

    place: int
    axis: int


class Revisits(NamedTuple):
    """The places of a path of n rows.

    Attributes
    ----------
    first
        Number of the place where it begins.
    place
        (n,) numbers of the places where the rows end; the same number for the same place.
    closing
        Numbers of the rows that end behind each stretch that comes to where the path was before.
    pinned
        Arcs, by their rows, that decide how near the path ends to where it was before.
    """

    first: int
    place: list[int]
    closing: list[int]
    pinned: dict[int, list[Pin]]


def revisits(curves: Curves, counted: Ints, radii: Ints) -> Revisits:
    """The places of a path of one row or more; `counted` and `radii` as in `looked_at`."""
    number = _numbered(np.concatenate([curves.start_um[:1], curves.end_um]))
    _, first, inverse = np.unique(number, return_index=True, return_inverse=True)
    since = first[inverse][1:]  # so many rows end before the path comes to the place of a row for the first time
    is_again = since <= np.arange(len(curves))
    begins = np.flatnonzero(is_again & ~np.append(False, is_again[:-1]))
    place = number[1:].tolist()
    pinned: dict[int, list[Pin]] = {}
    for axis in (0, 1):
        is_free = curves.is_arc & ((counted != axis) | (radii != 0))
        last = np.maximum.accumulate(np.where(is_free, np.arange(len(curves)), -1))
        taken: set[int] = set()
        for row in begins.tolist():
            arc = int(last[row])
            if arc >= since[row] and not is_again[arc] and arc not in taken:
                taken.add(arc)
                pinned.setdefault(arc, []).append(Pin(place[row], axis))
    closing = [past for past in (begins + 1).tolist() if past < len(place)]
    return Revisits(int(number[0]), place, closing, pinned)


def _numbered(places: Floats) -> Ints:
    """(m,) a number for each place (m, 2), the same for the same place but for rounding of its numbers."""
    x, y = (_columns_numbered(column) for column in places.T)
    return x * len(places) + y


def _columns_numbered(column: Floats) -> Ints:
    order = np.argsort(column)
    number = np.empty(len(column), dtype=np.int64)
    number[order] = np.cumsum(np.append(False, np.diff(column[order]) > _SAME_UM))
    return number
