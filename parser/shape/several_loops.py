"""Loops of contours that close more than one: by their corners, and where these miss, by the places that they pass.

Where a path comes back to a place that it left: the loops that it closes, one behind the other.
"""

import numpy as np

from parser.geometry.boxes import cell_keys
from parser.geometry.curves import Bools, Ints
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import runs
from parser.shape.loops import find_loops
from parser.toolpath import Toolpath

_CELLS = 1 << 31  # more cells than any path has across


def loops_in_order(toolpath: Toolpath, contour: Ints) -> tuple[Ints, Ints]:
    """First and last rows (m,) of loops that follow each other: each ends where one of its rows began.

    `contour` (n,) is each row's contour, −1 where it has none.
    """
    back = latest_return(toolpath, contour)
    first, last = [], []
    free = 0  # first row that no loop holds yet
    for row in np.flatnonzero(back >= 0).tolist():
        if back[row] >= free:
            first.append(int(back[row]))
            last.append(row)
            free = row + 1
    return np.array(first, dtype=np.int64), np.array(last, dtype=np.int64)


def latest_return(toolpath: Toolpath, contour: Ints) -> Ints:
    """(n,) for each row the latest row of its contour that starts where it ends; itself for a circle, −1 for none.

    Corners within 5 µm of each other share a cell of one of four grids of 10 µm that lie 5 µm apart.
    """
    back = np.full(len(toolpath), -1, dtype=np.int64)
    full = np.flatnonzero(toolpath.is_arc & (np.abs(toolpath.sweep_rad) > np.pi))
    near = np.hypot(*(toolpath.end_um[full] - toolpath.start_um[full]).T) <= CLOSED_WITHIN_UM
    back[full[near]] = full[near]
    # Each row ends where the next one starts.
    corner = np.concatenate([toolpath.start_um[:1], toolpath.end_um])
    for shift in np.ndindex(2, 2):
        cells = np.floor(corner / (2.0 * CLOSED_WITHIN_UM) + np.array(shift) / 2.0).astype(np.int64)
        key = cells[:, 0] * _CELLS + cells[:, 1]
        shared = _may_share(key)
        order = shared[np.argsort(key[shared], kind="stable")]
        before = np.append(-1, order[:-1])
        # The corner before one in its cell may be the start of the same row; then it is the one before that.
        before = np.where(before == order - 1, np.append([-1, -1], order[:-2])[: len(order)], before)
        at = np.flatnonzero((before >= 0) & (key[before] == key[order]))
        row, earlier = order[at] - 1, before[at]
        gap = corner[order[at]] - corner[earlier]
        hit = (row > earlier) & (contour[row] >= 0) & (contour[earlier] == contour[row])
        hit &= np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM
        back[row[hit]] = np.maximum(back[row[hit]], earlier[hit])
    return back


def _may_share(key: Ints) -> Ints:
    """Which of the keys (m,) may occur more than once, in order: the others need not be sorted."""
    bits = len(key).bit_length() + 1
    tally = cell_keys(key, 0) >> (63 - bits) & ((1 << bits) - 1)  # the upper bits are mixed best
    return np.flatnonzero(np.bincount(tally)[tally] > 1)


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
    is_kept = ~out_and_back & (before[first] == before[last + 1])
    return first[is_kept], last[is_kept]


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
