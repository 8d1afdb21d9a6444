"""What a cut under sparks does to the walls: gaps that are wider where sparks had more time, marks of stops.

A wall is within reach for as long as the wire takes to pass it by its own diameter. Where sparks have more time for it
than at the usual feed, the gap there is wider by `sim.process.ticks.walls.side_gap_ratio`, else narrower.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Point
from sim.process.sparks import settled_gap_um, steady
from sim.process.ticks import state as ticks
from sim.process.ticks.state import Records, Walls, Way
from sim.process.ticks.walls import widen
from sim.process.way import CutRows, Work, along_at, standing
from sim.setup.spark import PRESETS, Spark

BREAK_MARK_UM: Final = 12.5, 7.5
"""Depth of the line where a cut goes on behind a broken wire, and half of its range: 5 to 20 µm. US 4 506 129 and Sato
et al., Wire-break Prevention, say that there is one; the figure is assumed."""
_LEAST_MARK_UM: Final = 0.5
_NEAR_MARK_UM: Final = 150.0
_WITHIN: Final = 0.5  # of its depth a mark may be more or less: nobody has measured the law
_MARKING: Final = (ticks.SHORT, ticks.BREAK, ticks.POWER, ticks.PAUSE)


class Mark(NamedTuple):
    """A place where the wall is washed out more than round about, by `depth_um` ± `within_um`."""

    row: int
    place_um: Point
    depth_um: float
    within_um: float


class Widened(NamedTuple):
    """By how much the gap is wider: in each stretch of path, and as the mean of each row."""

    at_um: Floats
    by_row_um: Floats


def usual_gap_um(spark: Spark) -> float:
    """Gap to the front at the usual set value of the law by mean voltage: the gap at the walls is known for its feed.

    A middling gap where the pulses are such that none has this voltage.
    """
    found = settled_gap_um(spark._replace(law="voltage"), PRESETS["voltage"].set_value)
    return ticks.FAR_UM / 4.0 if found is None else found


def walls_of(work: Work, rows: CutRows, spark: Spark, stretch_um: float) -> Walls:
    """What the walls of a cut are held against."""
    feed_um_s = usual_feeds_um_s(spark, rows.way.width_um, work.height_um)
    return Walls(
        usual_s=np.divide(stretch_um, feed_um_s, out=np.zeros(len(feed_um_s)), where=feed_um_s > 0.0),
        gap_um=work.gap_um[rows.row].astype(np.float64),
        start_um=rows.way.thread_um + ticks.FAR_UM + work.wire_um / 2.0,
        stretch_um=stretch_um,
        half=max(int(work.wire_um / stretch_um) // 2, 1),
    )


def widened(walls: Walls, way: Way, records: Records) -> Widened:
    """By how much the gap at the walls is wider than usual, by the time with sparks in each stretch."""
    wider, n = np.zeros(len(records.lit_s)), len(walls.usual_s)
    if not n:
        return Widened(wider, np.zeros(0))
    widen(walls, way.along_um, records.lit_s, wider)
    at_um = np.arange(len(wider)) * walls.stretch_um
    row = np.clip(np.searchsorted(way.along_um, at_um, side="right") - 1, 0, n - 1)
    sums, counts = np.bincount(row, wider, n), np.bincount(row, None, n)
    return Widened(wider, np.divide(sums, counts, out=np.zeros(n), where=counts > 0))


def corner_marks(work: Work, rows: CutRows, walls: Walls, wider: Widened) -> Iterator[Mark]:
    """Marks at corners where the control stands under sparks: a corner is washed out."""
    for index in np.flatnonzero(rows.way.wait_s[:-1] > 0.0).tolist():
        depth_um = _depth_um(float(rows.way.along_um[index + 1]), index, walls, wider)
        if depth_um >= _LEAST_MARK_UM:
            found = standing(work, rows, float(rows.way.before[index + 1]))
            yield Mark(found.counters.row, found.place_um, depth_um, _WITHIN * depth_um)


def _depth_um(along_um: float, index: int, walls: Walls, wider: Widened) -> float:
    """By how much the widest place near one is wider than the mean of its row, µm."""
    middle, near = int(along_um / walls.stretch_um), int(_NEAR_MARK_UM / walls.stretch_um)
    widest = wider.at_um[max(middle - near, 0) : middle + near + 1].max(initial=0.0)
    return float(widest - wider.by_row_um[index])


def usual_feeds_um_s(spark: Spark, width_um: Floats, height_um: float) -> Floats:
    """Feeds (n,) at the usual gap in cuts of widths (n,), no faster than the law goes; 0 where nothing is cut.

    The area rate is the same in all of them: the feed is as 1 / width.
    """
    of_1_um = steady(spark, usual_gap_um(spark), 1.0, height_um).feed_um_s
    feed_um_s = np.divide(of_1_um, width_um, out=np.zeros(len(width_um)), where=width_um > 0.0)
    return np.minimum(feed_um_s, spark.filled.most_um_s)


def marks_of(work: Work, rows: CutRows, log: Sequence[Sequence[float]], walls: Walls, wider: Widened) -> Iterator[Mark]:
    """Marks where a stop or a way back shows: the widest place near it beside the mean of its block.

    Behind a broken wire there is a line of another cause, of which only its usual depth is known. Marks that run into
    one another are one.
    """
    past_um = -math.inf
    for _, at, kind, _ in log:
        if int(kind) not in _MARKING:
            continue
        found = standing(work, rows, at)
        index, along_um = along_at(rows, at)
        if along_um < past_um:
            continue
        if int(kind) == ticks.BREAK:
            past_um = along_um + _NEAR_MARK_UM
            yield Mark(found.counters.row, found.place_um, *BREAK_MARK_UM)
            continue
        depth_um = _depth_um(along_um, index, walls, wider)
        if depth_um >= _LEAST_MARK_UM:
            past_um = along_um + 2.0 * _NEAR_MARK_UM
            yield Mark(found.counters.row, found.place_um, depth_um, _WITHIN * depth_um)
