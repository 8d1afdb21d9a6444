"""The way of a cut under sparks: the blocks that the control steps, and where a step stands on them."""

from typing import NamedTuple

import numpy as np

from controller.stepping.counters import Counters, counters_after
from controller.stepping.steps import Steps
from parser.controller_words import StepWords
from parser.geometry.curves import Bools, Floats, Ints
from parser.toolpath import Point, Toolpath
from sim.process.ticks.state import Way


class Work(NamedTuple):
    """What is cut.

    Attributes
    ----------
    steps, words, toolpath
        Steps of the path, what it is stepped by, and the path itself, n blocks.
    width_um
        (n,) width of what each block cuts, 0 where it cuts nothing.
    gap_um
        (n,) gap at the walls of each block, at the usual feed.
    height_um, wire_um
        Height of the work and diameter of the wire.
    """

    steps: Steps
    words: StepWords
    toolpath: Toolpath
    width_um: Floats
    gap_um: Floats
    height_um: float
    wire_um: float


class CutRows(NamedTuple):
    """The (k,) rows of a toolpath that the control cuts, and the way along them."""

    row: Ints
    way: Way


class Standing(NamedTuple):
    """Where the wire stands: the counters of the control, and the place in µm."""

    counters: Counters
    place_um: Point


def cut_rows(work: Work) -> CutRows:
    """The rows that step; on jumps the wire is out, and it is threaded behind them."""
    toolpath, count = work.toolpath, work.steps.count
    row = np.flatnonzero((count > 0) & ~toolpath.is_jump)
    along = np.concatenate([[0.0], np.cumsum(toolpath.length_um[row])])
    jumps_before = np.concatenate([[0], np.cumsum(toolpath.is_jump)])[row]
    is_threaded = np.diff(jumps_before, prepend=-1) > 0
    thread = np.maximum.accumulate(np.where(is_threaded, along[:-1], 0.0))
    before = np.concatenate([[0], np.cumsum(count[row])]).astype(np.float64)
    return CutRows(row, Way(before, along, work.width_um[row].astype(np.float64), thread))


def standing(work: Work, rows: CutRows, at: float) -> Standing:
    """Where the wire stands after so many steps of the way."""
    index = min(int(np.searchsorted(rows.way.before, at, side="right")) - 1, len(rows.row) - 1)
    row, step = int(rows.row[index]), int(at - rows.way.before[index])
    counters = counters_after(work.steps, work.words, row, step)
    x0, y0 = np.rint(work.toolpath.start_um[0]).tolist()
    return Standing(counters, Point(counters.x_um + x0, counters.y_um + y0))


def is_cut(toolpath: Toolpath, steps: Steps, block: int) -> bool:
    """Whether a block, from 1, is one that the control cuts."""
    return block <= len(toolpath) and int(steps.count[block - 1]) > 0 and not bool(toolpath.is_jump[block - 1])


def is_cut_again(toolpath: Toolpath) -> Bools:
    """(n,) whether a line lies on one that was cut before, as the lead-out on the lead-in."""
    ends = np.rint(np.concatenate([toolpath.start_um, toolpath.end_um], axis=1)).astype(np.int64)
    is_turned = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    ends[is_turned] = ends[is_turned][:, [2, 3, 0, 1]]
    is_line = np.flatnonzero(~toolpath.is_arc & ~toolpath.is_jump)
    again = np.zeros(len(toolpath), dtype=np.bool_)
    if len(is_line):
        _, first, which = np.unique(ends[is_line], axis=0, return_index=True, return_inverse=True)
        again[is_line] = first[which.ravel()] < np.arange(len(is_line))
    return again
