"""Loops of a drawing as contours that close to the last bit: each curve starts where the one before it ends."""

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
