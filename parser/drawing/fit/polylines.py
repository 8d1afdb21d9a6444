"""Dense polylines to arcs through their vertices.

A polyline is what is drawn, and nobody knows the curve that it was made of. So an arc is taken for lines only where all
of each line lies within the tolerance of it, not its ends alone: what is written is then within the tolerance of what
is drawn. Lines too coarse for that stay lines.

No arc runs through a corner: what one is stands with the strokes below.

Arcs between two vertices of a polyline: which of them run near all of it, and how near.

All arcs from one place to another differ by their bulge alone, the tangent of a quarter of the sweep. A greater bulge
lies farther to the right everywhere, so that each place which an arc must pass within a distance leaves a range of
bulges, and those places together the range that all of these share.

With X along the chord from its middle, Y to the right, h half the chord and b the bulge, the centre is at
Y = h (b² − 1) / 2b and the radius is h (1 + b²) / 2b. That the distance of (x, y) from the centre is R + t or R − t
gives, with q = x² + y² − h² − t² and D = q² + 4 h² (y² − t²), the bulges 2h (y ∓ t) / (√D − q).

Curves of a loop as strokes, lines that run straight on made one, and the corners between them.

Corners are vertices that turn by 30° and more, so that polygons of up to twelve sides keep theirs however small they
are, and those that turn far more than their neighbours, by more than the tolerance can tell.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.pieces import FLATTEST_UM, Fitted
from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined

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
    around = np.median([np.roll(turn, step) for step in (-2, -1, 1, 2)], axis=0)
    stands_out = (turn > _CORNER_TIMES * around) & (joints.aside_um > 0.5 * within_um)
    corner: Bools = ~joints.is_smooth | (turn >= _CORNER_RAD) | stands_out
    return corner


MOST_BULGE = np.tan(3.0 / 8.0 * np.pi)
"""Of three quarters of a circle: the ends of more lie so near each other that they hardly tell where the arc is."""
_STRAIGHT = 0.25  # of the tolerance, by which the middle of an arc lies off its chord
_BESIDE_END = 1.5  # tolerances: all arcs that come into question run by so near an end


def best_bulges(vertices: Floats, within_um: float) -> Floats:
    """Bulges (...) of arcs from the first to the last of vertices (..., k, 2) that run near all of them; nan for none.

    The middle of the range; 0, a line, where the range has it, and the middle is nearly straight or of a radius that
    controllers do not count. The middles of the lines between the vertices
    are looked at too, but not all of each line: `off_um` tells.
    """
    x, y, half = _beside_chord(vertices, _with_middles(vertices))
    q = x**2 + y**2 - half**2 - within_um**2
    square = q**2 + 4.0 * half**2 * (y**2 - within_um**2)
    under = np.sqrt(np.maximum(square, 0.0)) - q
    free = (np.abs(x) - half) ** 2 + y**2 <= (_BESIDE_END * within_um) ** 2
    none = ~free & ~((under > 0.0) & (square >= 0.0))
    scale = 2.0 * half / np.where(under > 0.0, under, 1.0)
    low = np.where(free, -MOST_BULGE, np.where(none, np.inf, scale * (y - within_um))).max(axis=-1)
    high = np.where(free, MOST_BULGE, np.where(none, -np.inf, scale * (y + within_um))).min(axis=-1)
    low, high = np.maximum(low, -MOST_BULGE), np.minimum(high, MOST_BULGE)
    low, high = (np.where(low <= high, side, np.nan) for side in (low, high))
    middle, slack = 0.5 * (low + high), 0.5 * (high - low)
    straight = (np.abs(middle) <= slack) & (
        (np.abs(middle) <= _STRAIGHT * slack) | (half[..., 0] > 2.0 * FLATTEST_UM * np.abs(middle))
    )
    best: Floats = np.where(straight, 0.0, middle)
    return best


def off_um(vertices: Floats, bulge: Floats) -> Floats:
    """How far (...) lines through vertices (..., k, 2), and the arcs of bulges (...) between their ends, lie apart.

    It is the farthest that a place on either lies off the other along a radius: at a vertex, or where a line comes
    nearest to the centre. Infinite where the lines do not run on round the centre, or not just once.
    """
    x, y, half = _beside_chord(vertices, vertices)
    flat = bulge == 0.0
    b = np.where(flat, 1.0, bulge)[..., None]
    height = half * (b**2 - 1.0) / (2.0 * b)
    radius = half * (1.0 + b**2) / (2.0 * np.abs(b))
    # Places from the centre, x ahead and y to the right: of an arc of a bulge above 0 they turn to the left.
    y = y - height
    at_vertices = np.abs(np.hypot(x, y) - radius).max(axis=-1)
    along, across = np.diff(x), np.diff(y)
    length = np.hypot(along, across)
    share = -(x[..., :-1] * along + y[..., :-1] * across) / np.where(length > 0.0, length**2, 1.0)
    turned = y[..., :-1] * x[..., 1:] - x[..., :-1] * y[..., 1:]
    nearest = np.abs(turned) / np.where(length > 0.0, length, 1.0)
    at_feet = np.where((share > 0.0) & (share < 1.0), radius - nearest, 0.0).max(axis=-1)
    steps = np.arctan2(turned, x[..., :-1] * x[..., 1:] + y[..., :-1] * y[..., 1:]) * np.sign(b)
    once = np.abs(steps.sum(axis=-1) - 4.0 * np.arctan(np.abs(b[..., 0]))) < 1.0
    runs_on = (steps > 0.0).all(axis=-1) & once
    of_arc = np.where(runs_on, np.maximum(at_vertices, at_feet), np.inf)
    return np.where(np.isnan(bulge), np.inf, np.where(flat, _off_chord(vertices), of_arc))


def _off_chord(vertices: Floats) -> Floats:
    """How far (...) lines through vertices lie off the line between their ends; infinite where they do not run on."""
    x, y, half = _beside_chord(vertices, vertices)
    runs_on = (np.diff(x) > 0.0).all(axis=-1) & (half[..., 0] > 0.0)
    return np.where(runs_on, np.abs(y).max(axis=-1), np.inf)


def centers(start: Floats, end: Floats, bulge: Floats) -> Floats:
    """Centres (n, 2) of arcs of bulges (n,) between places (n, 2); no numbers of lines."""
    by = end - start
    right = np.column_stack([by[:, 1], -by[:, 0]])
    b = np.where(bulge == 0.0, np.nan, bulge)[:, None]
    center: Floats = 0.5 * (start + end) + right * (b**2 - 1.0) / (4.0 * b)
    return center


def _with_middles(vertices: Floats) -> Floats:
    """Vertices but the two ends, and the middles of the lines between them all."""
    middles = 0.5 * (vertices[..., 1:, :] + vertices[..., :-1, :])
    return np.concatenate([vertices[..., 1:-1, :], middles], axis=-2)


def _beside_chord(vertices: Floats, places: Floats) -> tuple[Floats, Floats, Floats]:
    """X and Y (..., p) of places (..., p, 2) along and to the right of the chord, and half the chord (..., 1)."""
    first, last = vertices[..., 0, :], vertices[..., -1, :]
    by = (last - first)[..., None, :]
    length = np.hypot(by[..., 0], by[..., 1])
    way = by / np.where(length > 0.0, length, 1.0)[..., None]
    out = places - 0.5 * (first + last)[..., None, :]
    ahead = (out * way).sum(axis=-1)
    right = out[..., 0] * way[..., 1] - out[..., 1] * way[..., 0]
    return ahead, right, 0.5 * length


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
    begin, pieces = min(tried, key=lambda each: (len(each[1]), max(piece.off_um for piece in each[1])))
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
            this, other = _piece(vertices, begin, middle, within_um), _piece(vertices, middle, past, within_um)
            if this and other:
                return this, other
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
