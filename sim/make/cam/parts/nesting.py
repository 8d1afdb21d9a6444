"""How contours lie within each other."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints
from sim.make.cam.parts.contours import Contours

_PAIRS: Final = 1 << 21  # of curves and places looked at in one go: some 100 MB


class Nesting(NamedTuple):
    """How many contours lie around each one (l,), and the smallest of these, −1 where there is none."""

    depth: Ints
    around: Ints


def nesting(contours: Contours, place_um: Floats, area_um2: Floats) -> Nesting:
    """The nesting of contours by a place (l, 2) of each that lies on no other one, and their areas (l,).

    From each place a ray runs to the left. A contour that it passes downwards once more than upwards, as that runs
    counter-clockwise, lies around the place.
    """
    depth = np.zeros(len(place_um), dtype=np.int64)
    around = np.full(len(place_um), -1)
    least = np.full(len(place_um), np.inf)
    pieces = _pieces(contours)
    for inner, outer in _within(pieces, contours.loop[pieces.row], place_um):
        np.add.at(depth, inner, 1)
        order = np.lexsort([area_um2[outer], inner])
        first = order[np.diff(inner[order], prepend=-1) > 0]
        closer = first[area_um2[outer[first]] < least[inner[first]]]
        around[inner[closer]], least[inner[closer]] = outer[closer], area_um2[outer[closer]]
    return Nesting(depth, around)


class _Pieces(NamedTuple):
    """Lines and arcs (p,) that run up or down all along.

    Attributes
    ----------
    row
        Of the contours' curves.
    low_um, high_um
        (p, 2) lower and upper end.
    center_um, radius_um
        (p, 2), (p,) of an arc; NaN on lines.
    bulge
        (p,) +1 on the right of an arc's centre, −1 on its left, 0 on lines.
    down
        (p,) 1 for a piece that runs down, −1 for one that runs up.
    """

    row: Ints
    low_um: Floats
    high_um: Floats
    center_um: Floats
    radius_um: Floats
    bulge: Floats
    down: Floats

    def take(self, at: Ints | slice) -> "_Pieces":
        """Those at the indices `at`."""
        return _Pieces(self.row[at], *(column[at] for column in self[1:]))


def _pieces(contours: Contours) -> _Pieces:
    """Lines, and arcs cut at their highest and lowest places; what is level is left out."""
    curves = contours.curves
    line, arc = np.flatnonzero(~curves.is_arc), np.flatnonzero(curves.is_arc)
    parts = [_sorted(curves, line, curves.start_um[line], curves.end_um[line], np.zeros(len(line)))]
    sweep = curves.sweep_rad[arc]
    begin = curves.start_angle_rad[arc]
    low, high = np.minimum(begin, begin + sweep), np.maximum(begin, begin + sweep)
    quarter = np.floor((low - 0.5 * np.pi) / np.pi)
    for number in range(3):  # of half-turns from the top to the bottom that an arc of up to a turn lies in
        first = np.maximum(low, 0.5 * np.pi + np.pi * (quarter + number))
        last = np.minimum(high, 0.5 * np.pi + np.pi * (quarter + number + 1))
        on = np.flatnonzero(last > first)
        if len(on):
            parts.append(_arc_pieces(curves, arc[on], first[on], last[on], quarter[on] + number))
    row = np.concatenate([part.row for part in parts])
    order = np.argsort(row, kind="stable")
    joined = _Pieces(row, *(np.concatenate([part[column] for part in parts]) for column in range(1, 7)))
    return joined.take(order[(joined.high_um[:, 1] > joined.low_um[:, 1])[order]])


def _arc_pieces(curves: Curves, arc: Ints, first: Floats, last: Floats, half: Floats) -> _Pieces:
    """Pieces (k,) of arcs from an angle to another one, within half a turn left or right of their centres."""
    ends = [_at(curves, arc, angle) for angle in (first, last)]
    back = curves.sweep_rad[arc] < 0.0
    begin = curves.start_angle_rad[arc]
    low_end = np.where(back[:, None], curves.end_um[arc], curves.start_um[arc])
    high_end = np.where(back[:, None], curves.start_um[arc], curves.end_um[arc])
    lowest = np.minimum(begin, begin + curves.sweep_rad[arc])
    highest = np.maximum(begin, begin + curves.sweep_rad[arc])
    # Ends are those of the curve itself, so that no ray passes between two curves.
    this = np.where((first == lowest)[:, None], low_end, ends[0])
    other = np.where((last == highest)[:, None], high_end, ends[1])
    start, end = np.where(back[:, None], other, this), np.where(back[:, None], this, other)
    bulge = np.where(np.mod(half, 2.0) == 0.0, -1.0, 1.0)
    return _sorted(curves, arc, start, end, bulge)


def _at(curves: Curves, arc: Ints, angle: Floats) -> Floats:
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    # At the very top and bottom the sine is ±1: both pieces that meet there end in one place.
    place: Floats = curves.center_um[arc] + curves.radius_um[arc][:, None] * way
    return place


def _sorted(curves: Curves, row: Ints, start: Floats, end: Floats, bulge: Floats) -> _Pieces:
    down = start[:, 1] > end[:, 1]
    low, high = np.where(down[:, None], end, start), np.where(down[:, None], start, end)
    return _Pieces(row, low, high, curves.center_um[row], curves.radius_um[row], bulge, np.where(down, 1.0, -1.0))


def _within(pieces: _Pieces, loop: Ints, place: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Places and the contours around them, as pairs (k,), all of a contour in one go."""
    order = np.argsort(place[:, 1], kind="stable")
    level = place[order, 1]
    first = np.searchsorted(level, pieces.low_um[:, 1], side="left")
    past = np.searchsorted(level, pieces.high_um[:, 1], side="left")
    for begin, end in _chunks(past - first, loop):
        chunk, number = pieces.take(slice(begin, end)), (past - first)[begin:end]
        of = np.repeat(np.arange(len(number)), number)
        at = order[first[begin:end][of] + np.arange(len(of)) - (np.cumsum(number) - number)[of]]
        left = np.flatnonzero(_is_left(chunk, of, place[at]))
        key = at[left] * (int(loop[-1]) + 1) + loop[begin:end][of[left]]
        pair, which = np.unique(key, return_inverse=True)
        turns = np.bincount(which, chunk.down[of[left]], len(pair))
        inner, outer = np.divmod(pair[turns > 0.5], int(loop[-1]) + 1)
        apart = inner != outer
        yield inner[apart], outer[apart]


def _chunks(pairs: Ints, loop: Ints) -> Iterator[tuple[int, int]]:
    """Ranges of pieces with some `_PAIRS` pairs each, that end where a contour does."""
    ends = np.append(np.flatnonzero(np.diff(loop)) + 1, len(loop))
    total = np.cumsum(pairs)[ends - 1] if len(loop) else np.empty(0, dtype=np.int64)
    begin = done = 0
    while begin < len(loop):
        at = max(int(np.searchsorted(total, done + _PAIRS, side="right")) - 1, int(np.searchsorted(ends, begin + 1)))
        yield begin, int(ends[at])
        begin, done = int(ends[at]), int(total[at])


def _is_left(pieces: _Pieces, of: Ints, place: Floats) -> Bools:
    """Whether pieces of numbers (k,) pass on the left of places (k, 2) of heights between their ends."""
    low, high = pieces.low_um[of], pieces.high_um[of]
    share = (place[:, 1] - low[:, 1]) / (high[:, 1] - low[:, 1])
    rise = place[:, 1] - pieces.center_um[of, 1]
    half = np.sqrt(np.maximum(pieces.radius_um[of] ** 2 - rise**2, 0.0))
    on_arc = pieces.center_um[of, 0] + pieces.bulge[of] * half
    on_line = low[:, 0] + share * (high[:, 0] - low[:, 0])
    left: Bools = np.where(pieces.bulge[of] == 0.0, on_line, on_arc) < place[:, 0]
    return left
