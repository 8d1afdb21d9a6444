"""The way of a cut under sparks: the blocks that the control steps, and where a step stands on them."""

from typing import Final, NamedTuple

import numpy as np
import shapely

from controller.stepping.counters import Counters, counters_after
from controller.stepping.steps import Steps
from parser.controller_words import StepWords
from parser.geometry.along import places
from parser.geometry.curves import Bools, Floats, Ints
from parser.toolpath import Point, Toolpath
from sim.process.ticks.state import Way

_SPACING_UM: Final = 20.0


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
    wait_s
        (n,) how long the control stands at the end of each block, under sparks.
    height_um, wire_um
        Height of the work and diameter of the wire.
    rows
        How many of the blocks run: a table that stops early cuts nothing of those behind.
    """

    steps: Steps
    words: StepWords
    toolpath: Toolpath
    width_um: Floats
    gap_um: Floats
    wait_s: Floats
    height_um: float
    wire_um: float
    rows: int


class CutRows(NamedTuple):
    """The (k,) rows of a toolpath that the control cuts, and the way along them.

    `is_back` where it goes along them from their ends, of the last of them only by so many steps as the way has.
    """

    row: Ints
    way: Way
    is_back: bool = False


class Standing(NamedTuple):
    """Where the wire stands: the counters of the control, and the place in µm."""

    counters: Counters
    place_um: Point


def cut_rows(work: Work) -> CutRows:
    """The rows that step; on jumps the wire is out, and it is threaded behind them."""
    toolpath, count = work.toolpath, work.steps.count
    row = np.flatnonzero((count > 0) & ~toolpath.is_jump & (np.arange(len(toolpath)) < work.rows))
    along = np.concatenate([[0.0], np.cumsum(toolpath.length_um[row])])
    jumps_before = np.concatenate([[0], np.cumsum(toolpath.is_jump)])[row]
    is_threaded = np.diff(jumps_before, prepend=-1) > 0
    thread = np.maximum.accumulate(np.where(is_threaded, along[:-1], 0.0))
    before = np.concatenate([[0], np.cumsum(count[row])]).astype(np.float64)
    columns = (work.width_um[row].astype(np.float64), thread, work.wait_s[row].astype(np.float64))
    return CutRows(row, Way(before, along, *columns))


def along_at(rows: CutRows, at: float) -> tuple[int, float]:
    """Which of the rows holds a step of the way, and the path by then, µm."""
    way = rows.way
    index = min(int(np.searchsorted(way.before, at, side="right")) - 1, len(rows.row) - 1)
    (first, last), (low, high) = way.before[index : index + 2].tolist(), way.along_um[index : index + 2].tolist()
    return index, low + (high - low) * (at - first) / (last - first)


def standing(work: Work, rows: CutRows, at: float) -> Standing:
    """Where the wire stands after so many steps of the way."""
    index, _ = along_at(rows, at)
    row, step = int(rows.row[index]), int(at - rows.way.before[index])
    step = int(work.steps.count[row]) - step if rows.is_back else step
    counters = counters_after(work.steps, work.words, row, step)
    x0, y0 = np.rint(work.toolpath.start_um[0]).tolist()
    return Standing(counters, Point(counters.x_um + x0, counters.y_um + y0))


def rest_reversed(rows: CutRows, at: float) -> CutRows:
    """The rows behind a step, and the rest of the one that it is in, from the end of the path back to it."""
    way = rows.way
    index, here_um = along_at(rows, at)
    before = way.before[-1] - np.concatenate([way.before[:index:-1], [at]])
    along = way.along_um[-1] - np.concatenate([way.along_um[:index:-1], [here_um]])
    row = rows.row[index:][::-1].copy()
    width = way.width_um[index:][::-1].copy()
    wait = np.concatenate([way.wait_s[index:-1][::-1], [0.0]])  # at the borders that they were at
    return CutRows(row, Way(before, along, width, np.zeros(len(row)), wait), is_back=True)


class Slot(NamedTuple):
    """What a wire has cut: places (m, 2) that it went through, and how far it reached to all sides, µm."""

    places_um: Floats
    reach_um: float

    def covers_um(self, places_um: Floats) -> Bools:
        """(k,) whether places (k, 2) lie in it."""
        line = shapely.LineString(self.places_um)
        shapely.prepare(line)
        return np.asarray(shapely.dwithin(line, shapely.points(places_um), self.reach_um))


def slot_of(work: Work, rows: CutRows, farthest: float) -> Slot:
    """What a wire has cut that came so many steps far; its reach is that of the gap at the walls."""
    way = rows.way
    ends = np.minimum(way.before[1:], farthest)
    share = np.clip((ends - way.before[:-1]) / np.diff(way.before), 0.0, 1.0)
    parts = np.maximum(np.ceil(np.diff(way.along_um) * share / _SPACING_UM), 1.0).astype(np.int64)
    last = np.cumsum(parts + 1)
    part = (np.arange(last[-1]) - np.repeat(last - parts - 1, parts + 1)) / np.repeat(parts, parts + 1)
    row = np.repeat(np.arange(len(rows.row)), parts + 1)
    is_cut_row = share[row] > 0.0
    found = places(work.toolpath, rows.row[row], part * share[row])[is_cut_row]
    return Slot(found, work.wire_um / 2.0 + float(work.gap_um[rows.row].max()))


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
