"""Loops of contours that close more than one: by their corners, and where these miss, by the places that they pass."""

import numpy as np

from parser.geometry.curves import Bools, Ints
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import runs
from parser.shape.loops import find_loops
from parser.shape.returns import loops_in_order
from parser.toolpath import Toolpath

_NEAR_START_UM = 12.0  # ends of many arcs in a row drift so far; passes over one edge may begin nearer to each other
_MOST_ROUNDS = 6  # loops behind each other that end at no corner where they began


def several_loops(toolpath: Toolpath, contour: Ints) -> tuple[Ints, Ints, Bools]:
    """First and last rows (k,) of the loops of contours that close several, and whether they end at a corner.

    `contour` (n,) is each row's, −1 on jumps. A way from the start hole back to it is looked at within.
    """
    at_hole = _at_hole(toolpath, contour)
    first, last = _by_corners(toolpath, contour, at_hole)
    by_corner = len(first)
    count = np.bincount(contour[np.concatenate([first, np.flatnonzero(at_hole)])], minlength=1)
    sought = (contour >= 0) & (count > 1)[contour]
    for _ in range(_MOST_ROUNDS):
        gap = _gaps(contour, at_hole, sought & ~_inside(first, last, len(toolpath)))
        found = find_loops(toolpath, gap, np.arange(gap.max(initial=-1) + 1), _NEAR_START_UM)
        if not len(found.first):
            break
        first, last = np.append(first, found.first), np.append(last, found.last)
        sought &= np.isin(gap, found.contour)
    is_sure = np.arange(len(first)) < by_corner
    several = np.bincount(contour[first], minlength=1)[contour[first]] > 1
    order = np.argsort(first[several])
    return first[several][order], last[several][order], is_sure[several][order]


def _at_hole(toolpath: Toolpath, contour: Ints) -> Bools:
    """(n,) True on rows that start where their contour begins: in the start hole, where there is a lead-in."""
    begin = toolpath.start_um[runs(toolpath)[:, 0]]
    row = np.flatnonzero(contour >= 0)
    result = np.zeros(len(toolpath), dtype=np.bool_)
    result[row] = np.hypot(*(toolpath.start_um[row] - begin[contour[row]]).T) <= CLOSED_WITHIN_UM
    return result


def _by_corners(toolpath: Toolpath, contour: Ints, at_hole: Bools) -> tuple[Ints, Ints]:
    """First and last rows (k,) of loops that end at a corner where they began.

    A way out and back by two blocks is none, nor is one by the start hole.
    """
    first, last = loops_in_order(toolpath, contour)
    row = last - 1
    arcs = toolpath.is_arc[row] & toolpath.is_arc[last]
    lines = ~toolpath.is_arc[row] & ~toolpath.is_arc[last]
    back = np.sign(toolpath.sweep_rad[row]) * np.sign(toolpath.sweep_rad[last]) < 0.0
    center = np.hypot(*(toolpath.center_um[row] - toolpath.center_um[last]).T)
    out_and_back = (first == row) & (lines | (arcs & back & (center <= CLOSED_WITHIN_UM)))
    before = np.append(0, np.cumsum(at_hole))
    kept = ~out_and_back & (before[first] == before[last + 1])
    return first[kept], last[kept]


def _inside(first: Ints, last: Ints, rows: int) -> Bools:
    """(n,) True on the rows of loops."""
    steps = np.zeros(rows + 1, dtype=np.int64)
    np.add.at(steps, first, 1)
    np.add.at(steps, last + 1, -1)
    inside: Bools = np.cumsum(steps[:-1]) > 0
    return inside


def _gaps(contour: Ints, at_hole: Bools, sought: Bools) -> Ints:
    """(n,) number from 0 of each stretch of `sought` rows (n,) of one contour, those at the hole first; else −1."""
    begins = sought & (np.append(True, ~sought[:-1]) | (np.diff(contour, prepend=-1) != 0) | at_hole)
    return np.where(sought, np.cumsum(begins) - 1, -1)
