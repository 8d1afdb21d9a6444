"""Ways cut from one closed figure to another, where a pause and a jump were meant."""

import numpy as np

from parser.dialect.at_block import at_block
from parser.findings.facts import WrongBlock
from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath

_APART_UM = 1000.0
"""Passes of one cut lie within the kerf of each other; figures this far apart are two."""
_CELLS = 1 << 31  # more cells than any path has across


def uncut_jump_findings(program: Program, contour: Ints) -> list[Finding]:
    """Finding 3B310 at the first line cut on the way from a closed figure to the next one.

    `contour` (n,) is each row's contour, −1 where it has none.
    """
    toolpath = program.toolpath
    first, last = _loops(toolpath, contour)
    found = []
    for here, there in zip(range(len(first) - 1), range(1, len(first)), strict=True):
        begin, arrival = int(last[here]) + 1, int(first[there])
        if contour[begin - 1] != contour[arrival] or arrival <= begin or toolpath.is_arc[begin:arrival].any():
            continue
        if _distance(toolpath, arrival, np.arange(first[here], begin)) > _APART_UM:
            way = float(toolpath.length_um[begin:arrival].sum())
            found.append(at_block(toolpath, program.lines, "3B310", begin, length=way).with_fact(WrongBlock()))
    return found


def _loops(toolpath: Toolpath, contour: Ints) -> tuple[Ints, Ints]:
    """First and last rows (m,) of loops that follow each other: each ends where one of its rows began."""
    back = _latest_return(toolpath, contour)
    first, last = [], []
    free = 0  # first row that no loop holds yet
    for row in np.flatnonzero(back >= 0).tolist():
        if back[row] >= free:
            first.append(int(back[row]))
            last.append(row)
            free = row + 1
    return np.array(first, dtype=np.int64), np.array(last, dtype=np.int64)


def _latest_return(toolpath: Toolpath, contour: Ints) -> Ints:
    """(n,) for each row the latest row of its contour that starts where it ends; itself for a circle, −1 for none.

    Places within 5 µm of each other share a cell of one of four grids of 10 µm that lie 5 µm apart.
    """
    n, row = len(toolpath), np.arange(len(toolpath))
    back = np.full(n, -1, dtype=np.int64)
    full = np.flatnonzero(toolpath.is_arc & (np.abs(toolpath.sweep_rad) > np.pi))
    near = np.hypot(*(toolpath.end_um[full] - toolpath.start_um[full]).T) <= CLOSED_WITHIN_UM
    back[full[near]] = full[near]
    places = np.concatenate([toolpath.start_um, toolpath.end_um]) / (2.0 * CLOSED_WITHIN_UM)
    for shift in np.ndindex(2, 2):
        cells = np.floor(places + np.array(shift) / 2.0).astype(np.int64)
        _, cell = np.unique(cells[:, 0] * _CELLS + cells[:, 1], return_inverse=True)
        key = cell.reshape(-1) * n
        starts = np.sort(key[:n] + row)
        at = np.maximum(np.searchsorted(starts, key[n:] + row) - 1, 0)  # the latest start before its own row
        earlier = starts[at] % n
        gap = toolpath.end_um - toolpath.start_um[earlier]
        hit = (starts[at] // n == cell.reshape(-1)[n:]) & (earlier < row) & (contour >= 0)
        hit &= (contour[earlier] == contour) & (np.hypot(gap[:, 0], gap[:, 1]) <= CLOSED_WITHIN_UM)
        back = np.where(hit, np.maximum(back, earlier), back)
    return back


def _distance(toolpath: Toolpath, row: int, figure: Ints) -> float:
    """Distance µm of a row's start from the blocks of a figure."""
    x, y = toolpath.start_um[row]
    off, _ = distance_to_curves(toolpath, figure, np.full(len(figure), x), np.full(len(figure), y))
    return float(off.min())
