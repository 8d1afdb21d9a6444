"""Loops of a drawing as contours that close to the last bit, and how they lie within each other.

Loops of a drawing as contours that close to the last bit: each curve starts where the one before it ends.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from parser.drawing.model import SAME_WITHIN_UM, Drawing, DrawnLoop, running
from parser.geometry.along import places, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between
from parser.geometry.distance import prolonged_meet

_FAR: Final = 3.0  # times the gap: curves that meet farther off are not prolonged to there
_SHORTER: Final = 0.4  # of its length: no curve is prolonged or cut at an end by more than that
_STIFF: Final = 10.0  # times the gap: an arc of more than half a turn with ends nearer than that cannot follow them
_FULL: Final = 2.0 * np.pi


class Contours(NamedTuple):
    """Contours, one behind the other.

    Attributes
    ----------
    curves
        n of them, counter-clockwise, none without length.
    loop
        (n,) number of the contour of each, from 0, never decreasing.
    entity
        (n,) number of the drawing's entity of each.
    """

    curves: Curves
    loop: Ints
    entity: Ints

    def contour(self, number: int) -> Curves:
        """The curves of one contour."""
        return self.curves.picked(self.rows(number))

    def rows(self, number: int) -> slice:
        """Its rows."""
        first, past = np.searchsorted(self.loop, (number, number + 1)).tolist()
        return slice(first, past)


def contours_of(drawing: Drawing, loops: list[DrawnLoop]) -> Contours:
    """One or more closed loops of a drawing, their gaps closed.

    Curves with a gap between them are prolonged or cut to where they meet. Those that do not meet near it have both of
    their ends moved to its middle: lines turn a little, arcs of up to half a turn keep how far they turn, others the
    place in their middle. So no curve is moved by more than the gap.
    """
    row = np.concatenate([loop.row for loop in loops])
    ran = running(drawing.curves, row, np.concatenate([loop.backwards for loop in loops]))
    of = np.repeat(np.arange(len(loops)), [len(loop.row) for loop in loops])
    closed = _closed(ran, _after(of))
    is_long = closed.length_um > SAME_WITHIN_UM
    # What closes to a place stays as it is, for others to leave out.
    long = np.flatnonzero(is_long | (np.bincount(of, is_long)[of] == 0))
    left = Contours(closed.picked(long), of[long], drawing.entity[row][long])
    start = left.curves.start_um[_after(left.loop)]
    return left._replace(curves=replace(left.curves, end_um=start))


def _after(of: Ints) -> Ints:
    """The row (n,) that follows each one in its loop."""
    first = np.flatnonzero(np.diff(of, prepend=-1))
    after = np.arange(1, len(of) + 1)
    after[np.append(first[1:], len(of)) - 1] = first
    return after


def _closed(ran: Curves, after: Ints) -> Curves:
    before = np.empty_like(after)
    before[after] = np.arange(len(after))
    gap = np.hypot(*(ran.start_um[after] - ran.end_um).T)
    wide = np.flatnonzero(gap > SAME_WITHIN_UM)
    joint = ran.start_um[after].copy()
    joint[wide] = _joints(ran, wide, after[wide], gap[wide])
    start, end = joint[before], joint
    moved = np.zeros(len(gap), dtype=np.bool_)
    moved[wide] = moved[after[wide]] = True
    arc = np.flatnonzero(moved & ran.is_arc)
    center, sweep = ran.center_um.copy(), ran.sweep_rad.copy()
    center[arc], sweep[arc] = _bent(ran, arc, start[arc], end[arc])
    made = curves_between(start, end, center, sweep)
    return replace(
        made,
        radius_um=np.where(moved, made.radius_um, ran.radius_um),
        start_angle_rad=np.where(moved, made.start_angle_rad, ran.start_angle_rad),
        length_um=np.where(moved, made.length_um, ran.length_um),
    )


def _joints(ran: Curves, row: Ints, after: Ints, gap: Floats) -> Floats:
    """Where the curves of rows (k,) and those after them are to meet."""
    end, start = ran.end_um[row], ran.start_um[after]
    middle = 0.5 * (end + start)
    place = prolonged_meet(ran, row, after).place_um
    off = np.hypot(*np.moveaxis(place - middle[:, None], 2, 0))
    nearest = np.argmin(np.where(np.isnan(off), np.inf, off), axis=1)
    index = np.arange(len(row))
    short = np.minimum(ran.length_um[row], ran.length_um[after])
    near = off[index, nearest] <= np.minimum(_FAR * gap, _SHORTER * short)
    joint = np.where(near[:, None], place[index, nearest], middle)
    for side, at in ((after, start), (row, end)):
        stiff = _is_stiff(ran, side, gap) & ~near
        joint[stiff] = at[stiff]
    return joint


def _is_stiff(ran: Curves, row: Ints, gap: Floats) -> Bools:
    chord = np.hypot(*(ran.end_um[row] - ran.start_um[row]).T)
    stiff: Bools = (np.abs(ran.sweep_rad[row]) > np.pi) & (chord < _STIFF * gap)
    return stiff


def _bent(ran: Curves, arc: Ints, start: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Centres (k, 2) and sweeps (k,) of arcs between other ends than theirs."""
    center, sweep = ran.center_um[arc], ran.sweep_rad[arc]
    off = [np.abs(np.hypot(*(place - center).T) - ran.radius_um[arc]) for place in (start, end)]
    on = np.maximum(*off) <= SAME_WITHIN_UM
    chord = end - start
    few = np.abs(sweep) <= np.pi
    similar = 0.5 * (start + end) + to_left(chord) / (2.0 * np.tan(0.5 * sweep))[:, None]
    middle = places(ran, arc, np.full(len(arc), 0.5))
    center = np.where(on[:, None], center, np.where(few[:, None], similar, _through(start, middle, end)))
    angles = [np.arctan2(*(place - center).T[::-1]) for place in (start, end)]
    turned = np.mod((angles[1] - angles[0]) * np.sign(sweep), _FULL)
    # All round where both ends are one place.
    turned = np.where((turned < 0.5 * np.pi) & (np.abs(sweep) > 1.5 * np.pi), turned + _FULL, turned)
    turned = np.where(np.hypot(chord[:, 0], chord[:, 1]) == 0.0, _FULL, turned)
    return center, np.where(few & ~on, sweep, np.sign(sweep) * turned)


def _through(this: Floats, other: Floats, third: Floats) -> Floats:
    """Centres (k, 2) of the circles through three places (k, 2) each; NaN where they lie on a line."""
    b, c = other - this, third - this
    double = 2.0 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    double[double == 0.0] = np.nan
    bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
    x = (c[:, 1] * bb - b[:, 1] * cc) / double
    y = (b[:, 0] * cc - c[:, 0] * bb) / double
    through: Floats = this + np.stack([x, y], axis=1)
    return through


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
