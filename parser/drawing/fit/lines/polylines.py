"""Dense polylines to arcs through their vertices.

A polyline is what is drawn, and nobody knows the curve that it was made of. So an arc is taken for lines only where all
of each line lies within the tolerance of it, not its ends alone: what is written is then within the tolerance of what
is drawn. Lines too coarse for that stay lines.

No arc runs through a corner; what one is says `parser.drawing.fit.lines.strokes`.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.fitted import Fitted
from parser.drawing.fit.lines.bulges import best_bulges, centers, off_um
from parser.drawing.fit.lines.strokes import Strokes, strokes_of
from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Bools, Curves, Floats, curves_between, joined

FEWEST_LINES = 4
"""Lines that an arc is taken for; two of a length always lie on one, and three often do by chance."""
_STARTS = 5  # that are compared of a loop without corners: one costs at most one arc more than another
_MOST_COMPARED = 64  # arcs of a loop whose starts are compared: one more than these is little


class _Piece(NamedTuple):
    """Strokes from `begin` up to `past` as one curve: its bulge, and how far off it lies; one stroke stays as it is."""

    begin: int
    past: int
    bulge: float = 0.0
    off_um: float = 0.0


def arcs_of_lines(curves: Curves, is_drawn: Bools, tolerance_um: float, *, is_closed: bool) -> Fitted:
    """A loop (n,) in running order, runs of short lines in it replaced by arcs that lie within a tolerance of them.

    Curves that are not drawn as they are (n,), but were fitted to others, stay.

    Each arc begins and ends at a vertex. Lines that run straight on become one. A closed loop may begin with another
    curve than it did. `of` is the row of the first line that each is of.
    """
    within_um = tolerance_um - SAME_WITHIN_UM
    strokes = strokes_of(curves, is_drawn, within_um, is_closed=is_closed)
    if is_closed and not strokes.corner.any():
        strokes, pieces = _ring(strokes, within_um)
    else:
        strokes = strokes.rolled(int(np.argmax(strokes.corner))) if is_closed else strokes
        pieces = list(_between_corners(strokes, within_um))
    return _fitted(curves, strokes, pieces)


def _ring(strokes: Strokes, within_um: float) -> tuple[Strokes, list[_Piece]]:
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


def _between_corners(strokes: Strokes, within_um: float) -> Iterator[_Piece]:
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
    pieces = _evened(vertices, pieces, may_begin, within_um)
    return [piece._replace(begin=begin + piece.begin, past=begin + piece.past) for piece in pieces]


def _may_begin(vertices: Floats, within_um: float) -> Bools:
    """Whether the fewest lines from each vertex (k + 1,) on lie near an arc; all at once, as many do not."""
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


def _evened(vertices: Floats, pieces: list[_Piece], may_begin: Bools, within_um: float) -> list[_Piece]:
    """Pieces without a few lines left over behind one of many, and without a short last one.

    Lines left over, too few for an arc, go into two arcs with those before them.
    """
    even: list[_Piece] = []
    at = 0
    while at < len(pieces):
        even.append(pieces[at])
        at += 1
        over = _left_over(pieces, at) if _is_arc(even[-1]) else 0
        for taken in range(over, 0, -1):
            past = pieces[at + taken - 1].past
            two = _two(vertices, even[-1], past, within_um) if may_begin[past - FEWEST_LINES] else None
            if two:
                even[-1:] = two
                at += taken
                break
    if all(map(_is_arc, even[-2:])) and len(even) > 1:
        even[-2:] = _two(vertices, even[-2], even[-1].past, within_um) or even[-2:]
    return even


def _is_arc(piece: _Piece) -> bool:
    return piece.past - piece.begin >= FEWEST_LINES


def _left_over(pieces: list[_Piece], at: int) -> int:
    """How many pieces from one on are single lines, fewer than would make an arc."""
    behind = pieces[at : at + FEWEST_LINES - 1]
    return next((number for number, piece in enumerate(behind) if _is_arc(piece)), len(behind))


def _two(vertices: Floats, first: _Piece, past: int, within_um: float) -> tuple[_Piece, _Piece] | None:
    """The lines of a piece and those up to `past` as two pieces, as even as can be; None where that cannot be."""
    begin, last = first.begin, min(first.past, past - FEWEST_LINES)
    for middle in sorted({(begin + past) // 2, (begin + 2 * past) // 3, (begin + 4 * past) // 5, last}):
        if begin + FEWEST_LINES <= middle <= last:
            one, other = _piece(vertices, begin, middle, within_um), _piece(vertices, middle, past, within_um)
            if one and other:
                return one, other
    return None


def _fitted(curves: Curves, strokes: Strokes, pieces: list[_Piece]) -> Fitted:
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
