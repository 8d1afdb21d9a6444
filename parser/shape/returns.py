"""Where a path comes back to a place that it left: the loops that it closes, one behind the other."""

import numpy as np

from parser.geometry.cells import cell_keys
from parser.geometry.curves import Ints
from parser.shape.closing import CLOSED_WITHIN_UM
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
