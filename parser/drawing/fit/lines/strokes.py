"""Curves of a loop as strokes, lines that run straight on made one, and the corners between them.

Corners are vertices that turn by 30° and more, so that polygons of up to twelve sides keep theirs however small they
are, and those that turn far more than their neighbours, by more than the tolerance can tell.
"""

from typing import NamedTuple

import numpy as np

from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Bools, Curves, Floats, Ints

_CORNER_RAD = np.radians(30.0) - 1e-9
_CORNER_TIMES = 4.0  # as much as its neighbours turn; lines halved where it needs turn by up to twice as much


class Strokes(NamedTuple):
    """Curves (p,), lines that run straight on as one: rows of the first and last that each is of, ends, whether lines.

    ``corner`` tells of the start of each whether no arc runs through it.
    """

    first: Ints
    last: Ints
    start: Floats
    end: Floats
    is_line: Bools
    corner: Bools

    def rolled(self, by: int) -> "Strokes":
        """The strokes of a closed loop, begun with another."""
        return self._replace(**{name: np.roll(column, -by, axis=0) for name, column in self._asdict().items()})


class _Joints(NamedTuple):
    """Starts (p,) of strokes: whether a line runs on there from a line, how far it turns, and how far aside it goes."""

    is_smooth: Bools
    turn_rad: Floats
    aside_um: Floats


def strokes_of(curves: Curves, is_drawn: Bools, within_um: float, *, is_closed: bool) -> Strokes:
    """Curves with lines that run straight on made one, and the corners between them."""
    row = np.arange(len(curves))
    alone = Strokes(row, row, curves.start_um, curves.end_um, ~curves.is_arc & is_drawn, row == -1)
    joints = _joints(alone, is_closed=is_closed)
    straight = joints.is_smooth & (joints.aside_um <= SAME_WITHIN_UM) & (np.abs(joints.turn_rad) < _CORNER_RAD)
    begin = int(np.argmin(straight))
    some = straight.any() and not straight.all()  # so short are the lines of a small circle that all seem to run on
    whole = _runs_straight(alone.rolled(begin), np.roll(straight, -begin)) if some else alone
    return whole._replace(corner=_corners(_joints(whole, is_closed=is_closed), within_um))


def _runs_straight(strokes: Strokes, straight: Bools) -> Strokes:
    """Strokes that go on straight at their start joined to the ones before, where all of them lie on one line."""
    head = np.flatnonzero(~straight)
    of = np.cumsum(~straight) - 1
    tail = np.append(head[1:], len(straight)) - 1
    by = strokes.end[tail] - strokes.start[head]
    out = strokes.start - strokes.start[head][of]
    length = np.hypot(by[:, 0], by[:, 1])
    across = np.abs(out[:, 0] * by[of, 1] - out[:, 1] * by[of, 0]) / np.where(length > 0.0, length, 1.0)[of]
    is_one = np.maximum.reduceat(across, head) <= SAME_WITHIN_UM
    first = np.flatnonzero(~straight | ~is_one[of])
    last = np.append(first[1:], len(straight)) - 1
    return strokes._replace(
        first=strokes.first[first],
        last=strokes.last[last],
        start=strokes.start[first],
        end=strokes.end[last],
        is_line=strokes.is_line[first],
        corner=strokes.corner[first],
    )


def _joints(strokes: Strokes, *, is_closed: bool) -> _Joints:
    by = strokes.end - strokes.start
    before, size = np.roll(by, 1, axis=0), np.hypot(by[:, 0], by[:, 1])
    gap = np.hypot(*(strokes.start - np.roll(strokes.end, 1, axis=0)).T)
    is_smooth = strokes.is_line & np.roll(strokes.is_line, 1) & (gap <= SAME_WITHIN_UM)
    is_smooth[0] &= is_closed
    crossed = before[:, 0] * by[:, 1] - before[:, 1] * by[:, 0]
    turn = np.arctan2(crossed, (before * by).sum(axis=1))
    chord = np.maximum(np.hypot(*(before + by).T), np.maximum(size, np.roll(size, 1)) * 1e-9)
    return _Joints(is_smooth, turn, np.abs(crossed) / chord)


def _corners(joints: _Joints, within_um: float) -> Bools:
    """Starts (p,) of strokes through which no arc runs."""
    turn = np.where(joints.is_smooth, np.abs(joints.turn_rad), 0.0)
    beside = np.median([np.roll(turn, step) for step in (-2, -1, 1, 2)], axis=0)
    stands_out = (turn > _CORNER_TIMES * beside) & (joints.aside_um > 0.5 * within_um)
    corner: Bools = ~joints.is_smooth | (turn >= _CORNER_RAD) | stands_out
    return corner
