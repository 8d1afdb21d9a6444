"""Joints made one place: files lose digits, and curves that were drawn end to start come nanometres apart.

Past such a joint a path stands beside itself: what a wire leaves in a corner, and whether it can cut there at all, is
then a matter of the last digit, and another one when the same contour is drawn as one polyline.
"""

from collections.abc import Sequence

import numpy as np

from parser.drawing.model import DrawnLoop
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between

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
