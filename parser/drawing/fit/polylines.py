"""Dense polylines to arcs through their vertices.

A polyline is what is drawn, and nobody knows the curve that it was made of. So an arc is taken for lines only where all
of each line lies within the tolerance of it, not its ends alone: what is written is then within the tolerance of what
is drawn. Lines too coarse for that stay lines.

Corners stay: vertices that turn by 30° and more, so that polygons of up to twelve sides keep theirs however small they
are, and those that turn far more than their neighbours, by more than the tolerance can tell.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.bulges import best_bulges, centers, off_um
from parser.drawing.fit.fitted import Fitted
from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined

FEWEST_LINES = 4
"""Lines that an arc is taken for; two of a length always lie on one, and three often do by chance."""
_CORNER_RAD = np.radians(30.0) - 1e-9
_CORNER_TIMES = 4.0  # as much as its neighbours turn; lines halved where it needs turn by up to twice as much
_STARTS = 5  # that are compared of a loop without corners: one costs at most one arc more than another
_MOST_COMPARED = 64  # arcs of a loop whose starts are compared: one more than these is little


class _Strokes(NamedTuple):
    """Curves (p,), lines that run straight on as one: rows of the first and last that each is of, ends, whether lines.

    ``corner`` tells of the start of each whether no arc runs through it.
    """

    first: Ints
    last: Ints
    start: Floats
    end: Floats
    is_line: Bools
    corner: Bools

    def rolled(self, by: int) -> "_Strokes":
        """The strokes of a closed loop, begun with another."""
        return _Strokes(*(np.roll(column, -by, axis=0) for column in self))


class _Piece(NamedTuple):
    """Strokes from `begin` up to `past` as one curve: its bulge, and how far off it lies; one stroke stays as it is."""

    begin: int
    past: int
    bulge: float = 0.0
    off_um: float = 0.0


class _Joints(NamedTuple):
    """Starts (p,) of strokes: whether a line runs on there from a line, how far it turns, and how far aside it goes."""

    is_smooth: Bools
    turn_rad: Floats
    aside_um: Floats


def arcs_of_lines(curves: Curves, tolerance_um: float, *, is_closed: bool) -> Fitted:
    """A loop (n,) in running order, runs of short lines in it replaced by arcs that lie within a tolerance of them.

    Each arc begins and ends at a vertex. Lines that run straight on become one. A closed loop may begin with another
    curve than it did. `of` is the row of the first line that each is of.
    """
    within_um = tolerance_um - SAME_WITHIN_UM
    strokes = _strokes(curves, within_um, is_closed=is_closed)
    if is_closed and not strokes.corner.any():
        strokes, pieces = _ring(strokes, within_um)
    else:
        strokes = strokes.rolled(int(np.argmax(strokes.corner))) if is_closed else strokes
        pieces = list(_between_corners(strokes, within_um))
    return _fitted(curves, strokes, pieces)


def _strokes(curves: Curves, within_um: float, *, is_closed: bool) -> _Strokes:
    """Curves with lines that run straight on made one, and the corners between them."""
    row = np.arange(len(curves))
    alone = _Strokes(row, row, curves.start_um, curves.end_um, ~curves.is_arc, row == -1)
    joints = _joints(alone, is_closed=is_closed)
    straight = joints.is_smooth & (joints.aside_um <= SAME_WITHIN_UM) & (np.abs(joints.turn_rad) < _CORNER_RAD)
    begin = int(np.argmin(straight))
    some = straight.any() and not straight.all()  # so short are the lines of a small circle that all seem to run on
    whole = _runs_straight(alone.rolled(begin), np.roll(straight, -begin)) if some else alone
    return whole._replace(corner=_corners(_joints(whole, is_closed=is_closed), within_um))


def _runs_straight(strokes: _Strokes, straight: Bools) -> _Strokes:
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


def _joints(strokes: _Strokes, *, is_closed: bool) -> _Joints:
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
    return ~joints.is_smooth | (turn >= _CORNER_RAD) | stands_out


def _ring(strokes: _Strokes, within_um: float) -> tuple[_Strokes, list[_Piece]]:
    """A loop without corners, begun where it becomes fewest pieces, and of these starts where they lie nearest."""
    vertices = np.concatenate([strokes.start, strokes.start])
    number, tried = len(strokes.start), list[tuple[int, list[_Piece]]]()
    for step in range(_STARTS):
        begin = tried[0][1][0].past * step // _STARTS if tried else 0
        tried.append((begin, _pieces(vertices[begin : begin + number + 1], 0, within_um)))
        if not 2 < len(tried[0][1]) <= _MOST_COMPARED or len(tried[-1][1]) < len(tried[0][1]):
            break
    begin, pieces = min(tried, key=lambda one: (len(one[1]), max(piece.off_um for piece in one[1])))
    return strokes.rolled(begin), pieces


def _between_corners(strokes: _Strokes, within_um: float) -> Iterator[_Piece]:
    """Pieces of strokes of which the first begins at a corner."""
    number = len(strokes.first)
    head = np.flatnonzero(strokes.corner).tolist()
    for begin, past in zip(head, [*head[1:], number], strict=True):
        if past - begin < FEWEST_LINES:
            yield from (_Piece(at, at + 1) for at in range(begin, past))
        else:
            vertices = np.concatenate([strokes.start[begin:past], strokes.end[past - 1 : past]])
            yield from _pieces(vertices, begin, within_um)


def _pieces(vertices: Floats, begin: int, within_um: float) -> list[_Piece]:
    """The fewest pieces of lines between vertices (k + 1, 2), each as long as it can be; the last two evened out."""
    may_begin = _may_begin(vertices, within_um)
    at, most, guess = 0, len(vertices) - 1, FEWEST_LINES
    pieces: list[_Piece] = []
    while at < most:
        found = _longest(vertices, at, guess, within_um) if may_begin[at] else _Piece(at, at + 1)
        pieces.append(found)
        guess = max(found.past - at, FEWEST_LINES)
        at = found.past
    pieces = _evened(vertices, pieces, within_um)
    return [piece._replace(begin=begin + piece.begin, past=begin + piece.past) for piece in pieces]


def _may_begin(vertices: Floats, within_um: float) -> Bools:
    """Whether the fewest lines from each vertex (k + 1,) on lie near an arc: all at once, as most of them fail or hold."""
    may = np.zeros(len(vertices), dtype=np.bool_)
    if len(vertices) > FEWEST_LINES:
        windows = np.lib.stride_tricks.sliding_window_view(vertices, FEWEST_LINES + 1, axis=0).swapaxes(1, 2)
        may[: len(windows)] = off_um(windows, best_bulges(windows, within_um)) <= within_um
    return may


def _longest(vertices: Floats, begin: int, guess: int, within_um: float) -> _Piece:
    """The piece of most lines from a vertex on, from which the fewest lines lie near an arc.

    From as many as are guessed, the step up or down is doubled until it is too far, and then halved.
    """
    most = len(vertices) - 1
    best, fails, step = _Piece(begin, begin + 1), most + 1, 1
    past = min(begin + guess, most)
    while True:
        found = _piece(vertices, begin, past, within_um)
        best, fails = (found, fails) if found else (best, past)
        least = max(best.past, begin + FEWEST_LINES - 1)
        if fails - least <= 1:
            return best
        if fails > most:
            past = min(best.past + step, most)
        elif best.past == begin + 1:
            past = max(fails - step, begin + FEWEST_LINES)
        else:
            past = (best.past + fails) // 2
        step *= 2


def _piece(vertices: Floats, begin: int, past: int, within_um: float) -> _Piece | None:
    """Lines as one curve; None where they lie too far off all."""
    part = vertices[begin : past + 1]
    bulge = best_bulges(part, within_um)
    if np.isnan(bulge):
        return None
    off = float(off_um(part, bulge))
    return _Piece(begin, past, float(bulge), off) if off <= within_um else None


def _evened(vertices: Floats, pieces: list[_Piece], within_um: float) -> list[_Piece]:
    """Pieces with a short last one, or lines left over at the end, made as long as the one before."""
    last = max((at for at, piece in enumerate(pieces) if piece.past - piece.begin > 1), default=-1)
    if last == len(pieces) - 1:
        last -= 1
    if last < 0 or pieces[last].past - pieces[last].begin < FEWEST_LINES or len(pieces) - last > FEWEST_LINES + 1:
        return pieces
    begin, reach, end = pieces[last].begin, pieces[last].past, pieces[-1].past
    for middle in sorted({(begin + end) // 2, (begin + 2 * end) // 3, (begin + 4 * end) // 5, end - FEWEST_LINES}):
        if begin + FEWEST_LINES <= middle <= min(reach, end - FEWEST_LINES):
            one, other = _piece(vertices, begin, middle, within_um), _piece(vertices, middle, end, within_um)
            if one and other:
                return [*pieces[:last], one, other]
    return pieces


def _fitted(curves: Curves, strokes: _Strokes, pieces: list[_Piece]) -> Fitted:
    begin, past = (np.array([piece[at] for piece in pieces], dtype=np.int64) for at in (0, 1))
    bulge = np.array([piece.bulge for piece in pieces])
    first, last = strokes.first[begin], strokes.last[past - 1]
    start, end = curves.start_um[first], curves.end_um[last]
    made = curves_between(start, end, centers(start, end, bulge), 4.0 * np.arctan(bulge))
    as_drawn = first == last
    order = np.argsort(np.concatenate([np.flatnonzero(as_drawn), np.flatnonzero(~as_drawn)]), kind="stable")
    fitted = joined([curves.picked(first[as_drawn]), made.picked(~as_drawn)]).picked(order)
    changed = not as_drawn.all()
    return Fitted(fitted, first, max(piece.off_um for piece in pieces) + SAME_WITHIN_UM if changed else 0.0)
