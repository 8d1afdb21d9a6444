"""Joints of loose ends: which two ends are one joint, and joints made one place.

Which loose ends lie near each other, and which two of them are one joint.

Joints made one place: files lose digits, and curves that were drawn end to start come nanometres apart.

Past such a joint a path stands beside itself: what a wire leaves in a corner, and whether it can cut there at all, is
then a matter of the last digit, and another one when the same contour is drawn as one polyline.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.drawing.model import DrawnLoop
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between
from parser.geometry.near import cell_keys

_NEIGHBOURS = ((0, 0), (1, 0), (-1, 1), (0, 1), (1, 1))  # half of the cells round one; the other half look back
_CROWD = 24  # ends in a cell; no contour goes on from there in a way that anyone could tell


class Ends(NamedTuple):
    """Loose ends (e,) of strings of curves; the ends 2k and 2k + 1 are the start and the end of string k.

    Attributes
    ----------
    place_um
        (e, 2).
    out
        (e, 2) unit vectors along the string and out of it.
    length_um
        (e,) of the string.
    """

    place_um: Floats
    out: Floats
    length_um: Floats


class JoinedEnds(NamedTuple):
    """Pairs of ends (j, 2) that are joined; and ends (b,) where more than two meet, or a crowd of them."""

    pair: Ints
    branch: Ints


def joints(ends: Ends, loose: Ints, within_um: float) -> JoinedEnds:
    """Joints between the ends `loose` (l,) that are not farther apart than a distance.

    The nearest two ends are joined first. Of pairs that are equally near, those go first whose strings do not end free
    at the other end, and of these the pair that runs on straightest.
    """
    pair, crowd = near(ends.place_um[loose], within_um)
    pair = loose[pair]
    by = np.hypot(*(ends.place_um[pair[:, 0]] - ends.place_um[pair[:, 1]]).T)
    # A string shorter than the distance does not close upon itself.
    usable = (by <= within_um) & ((pair[:, 0] ^ 1 != pair[:, 1]) | (ends.length_um[pair[:, 0]] > 2.0 * within_um))
    pair, by = pair[usable], by[usable]
    number = np.bincount(pair.ravel(), minlength=len(ends.place_um))
    free = np.zeros(len(number), dtype=np.bool_)
    free[loose] = number[loose] == 0
    branch = np.union1d(np.flatnonzero(number > 1), loose[crowd])
    return JoinedEnds(_matched(pair[_order(ends, pair, by, free)]), branch)


def _order(ends: Ends, pair: Ints, by: Floats, free: NDArray[np.bool_]) -> Ints:
    """Pairs in the order in which they are joined. Where they lie decides at last, never the order of the file."""
    dead = free[pair ^ 1].sum(axis=1)
    bend = np.round((ends.out[pair[:, 0]] * ends.out[pair[:, 1]]).sum(axis=1), 6)
    place = ends.place_um[pair].mean(axis=1)
    far = np.sort((ends.place_um[pair] + ends.out[pair]).sum(axis=1), axis=1)
    return np.lexsort([far[:, 1], far[:, 0], place[:, 1], place[:, 0], bend, dead, np.round(by, 2)])


def _matched(pair: Ints) -> Ints:
    """Pairs whose two ends no earlier pair has; one after the other, as each depends on those before it."""
    taken: set[int] = set()
    matches = []
    for number, (this, other) in enumerate(pair.tolist()):
        if this not in taken and other not in taken:
            taken.update((this, other))
            matches.append(number)
    return pair[matches]


def near(place: Floats, within_um: float) -> tuple[Ints, Ints]:
    """Pairs (k, 2) of places in one cell of a grid or in neighbouring ones, and places (c,) in cells with a crowd."""
    cell = np.floor(place / within_um).astype(np.int64)
    key = cell_keys(*cell.T)  # two cells of one key cost time, not truth
    order = np.argsort(key, kind="stable")
    crowded = _count(key[order], key) > _CROWD
    order = order[~crowded[order]]
    pairs = [np.empty((0, 2), dtype=np.int64)]
    for right, up in _NEIGHBOURS:
        wanted = cell_keys(*(cell[order] + (right, up)).T)
        low, number = np.searchsorted(key[order], wanted), _count(key[order], wanted)
        this = np.repeat(np.arange(len(order)), number)
        other = low[this] + np.arange(len(this)) - (np.cumsum(number) - number)[this]
        if (right, up) == (0, 0):
            this, other = this[this < other], other[this < other]
        pairs.append(np.column_stack([order[this], order[other]]))
    return np.concatenate(pairs), np.flatnonzero(crowded)


def _count(sorted_keys: Ints, wanted: Ints) -> Ints:
    """How often each of the keys wanted occurs."""
    count: Ints = np.searchsorted(sorted_keys, wanted, side="right") - np.searchsorted(sorted_keys, wanted)
    return count


WELDED_WITHIN_UM = 0.1
"""Ends no farther apart are one place: less than any step, and a hundred times what nine digits of a mm lose."""
_LEAST_CHORD_UM = 1.0  # of an arc whose centre may follow its ends; a full turn has none


def welded(curves: Curves, loops: Sequence[DrawnLoop]) -> Curves:
    """The curves, those that follow each other in a loop with their ends in the middle between both.

    Arcs turn about the place nearest to their centres that is as far from both ends.
    """
    start, end = curves.start_um.copy(), curves.end_um.copy()
    for loop in loops:
        _weld(start, end, loop)
    moved = np.flatnonzero(((start != curves.start_um) | (end != curves.end_um)).any(axis=1))
    if not len(moved):
        return curves
    center, sweep = _turned(curves, moved, start, end)
    made = curves_between(start[moved], end[moved], center, sweep)
    columns = {name: getattr(curves, name).copy() for name in Curves.__slots__}
    for name, column in columns.items():
        if name != "kind":
            column[moved] = getattr(made, name)
    return Curves(**columns)


def _weld(start: Floats, end: Floats, loop: DrawnLoop) -> None:
    """Move the ends of the curves of one loop together, in place."""
    row, back = loop.row, loop.backwards
    count = len(row) if loop.closed else len(row) - 1
    if len(row) < 2:
        return
    here, there = np.arange(count), (np.arange(count) + 1) % len(row)
    leaving = np.where(back[here, None], start[row[here]], end[row[here]])
    entering = np.where(back[there, None], end[row[there]], start[row[there]])
    apart = np.hypot(*(entering - leaving).T)
    near = np.flatnonzero((apart > 0.0) & (apart <= WELDED_WITHIN_UM))
    middle = 0.5 * (leaving + entering)[near]
    _put(start, end, row[here[near]], ~back[here[near]], middle)
    _put(start, end, row[there[near]], back[there[near]], middle)


def _put(start: Floats, end: Floats, row: Ints, at_end: Bools, place: Floats) -> None:
    end[row[at_end]] = place[at_end]
    start[row[~at_end]] = place[~at_end]


def _turned(curves: Curves, row: Ints, start: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Centres (m, 2) and sweeps (m,) of rows between their new ends."""
    begin, by = start[row], end[row] - start[row]
    chord = np.hypot(*by.T)
    across = np.stack([-by[:, 1], by[:, 0]], axis=1) / np.where(chord > 0.0, chord, 1.0)[:, None]
    middle, center = begin + 0.5 * by, curves.center_um[row]
    out = ((center - middle) * across).sum(axis=1)
    follows = chord > _LEAST_CHORD_UM
    center = np.where(follows[:, None], middle + out[:, None] * across, center)
    angle = [np.arctan2(*(place - center).T[::-1]) for place in (begin, end[row])]
    sweep = curves.sweep_rad[row]
    turned = np.mod(angle[1] - angle[0] - sweep + np.pi, 2.0 * np.pi) - np.pi + sweep
    return center, np.where(sweep != 0.0, turned, 0.0)
