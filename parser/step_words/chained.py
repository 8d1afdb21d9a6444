"""Words of a whole path, each block told from where the one before it decodes to, so that rounding does not add up.

So do the CAMs (docs/3b.md §1). The controller's own chain, from stepped end to stepped end, is in
`controller.stepping.steps`.

One arc told and decoded in plain numbers: to the last bit what `words` gives (tests hold it so).

Where each block begins at the decoded end of the last, arcs are told one after the other; an array for every number of
one arc would take thirty times as long.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Bools, Curves, Floats
from parser.step_words.words import (
    MOST_SHIFT,
    MOST_SWEEP_RAD,
    chosen,
    moves,
    words_of_arcs,
    words_of_lines,
    words_of_told_arcs,
)

Place = tuple[float, float]


class OneBlock(NamedTuple):
    """Words of one block as in `StepWords`, without radius and curve mark, and the way that it goes, µm."""

    x_um: int
    y_um: int
    count_um: int
    count_axis: int
    quadrant: int
    turn: int
    by_um: Place


def arc_of(start_um: Place, end_um: Place, sweep_rad: float) -> OneBlock:
    """One of `words_of_arcs`."""
    by = end_um[0] - start_um[0], end_um[1] - start_um[1]
    shift = to_bisector(start_um, end_um, by, sweep_rad)
    if _hypot(*shift) > MOST_SHIFT * _hypot(*start_um):
        return line_of(by)
    return told_arc_of((start_um[0] - shift[0], start_um[1] - shift[1]), by, sweep_rad)


def told_arc_of(start_um: Place, by_um: Place, sweep_rad: float, axis: Axis | None = None) -> OneBlock:
    """One of `words_of_told_arcs`, its start from the centre rounded to whole µm; counted on an axis that is given."""
    x, y = round(start_um[0]), round(start_um[1])
    end = x + by_um[0], y + by_um[1]
    turn, radius = (1 if sweep_rad > 0.0 else -1), _hypot(float(x), float(y))
    low = float(np.arctan2(float(y), float(x)))
    turned = turn * (float(np.arctan2(end[1], end[0])) - low)
    turned += 2.0 * np.pi * round((abs(sweep_rad) - turned) / (2.0 * np.pi))
    on_y = abs(end[0]) > abs(end[1]) if axis is None else axis == Axis.Y
    count = round(_counted(radius, low, turn * turned, end[on_y], on_y=on_y))
    if x * x + y * y <= 1 or turned <= 0.0 or count <= 0:
        return line_of(by_um)
    quadrant = _quadrant(x, y) if turn > 0 else 5 - _quadrant(x, -y)
    by = _arc_by(x, y, count, turn, on_y=on_y)
    return OneBlock(abs(x), abs(y), count, Axis.Y if on_y else Axis.X, quadrant, turn, by)


def line_of(by_um: Place) -> OneBlock:
    """One of `words_of_lines`."""
    x, y = round(by_um[0]), round(by_um[1])
    quadrant = _quadrant(x, y)
    on_x = abs(x) > abs(y) or (abs(x) == abs(y) and quadrant % 2 == 0)
    count = max(abs(x), abs(y))
    return OneBlock(abs(x), abs(y), count, Axis.X if on_x else Axis.Y, quadrant, 0, (float(x), float(y)))


def to_bisector(start: Place, end: Place, by: Place, sweep_rad: float) -> Place:
    """The way of a centre along the chord to where start and end are equally far from it, as in `words`."""
    square = by[0] * by[0] + by[1] * by[1]
    if square == 0.0 or abs(sweep_rad) >= MOST_SWEEP_RAD:
        return 0.0, 0.0
    share = (0.5 * (start[0] + end[0]) * by[0] + 0.5 * (start[1] + end[1]) * by[1]) / square
    return share * by[0], share * by[1]


def _counted(radius: float, low: float, turned: float, end: float, *, on_y: bool) -> float:
    low -= 0.5 * np.pi if on_y else 0.0
    high = low + turned
    turn = _sign(turned)
    count = radius * turn * (_counted_way(high) - _counted_way(low))
    return count - turn * _sign(float(np.sin(high))) * (end - radius * float(np.cos(high)))


def _counted_way(angle_rad: float) -> float:
    halves = math.floor(angle_rad / np.pi)
    return 2.0 * halves + 1.0 - float(np.cos(angle_rad - halves * np.pi))


def _arc_by(x: int, y: int, count: int, turn: int, *, on_y: bool) -> Place:
    """The way of an arc by its words, as of `arc_ends`."""
    radius = math.sqrt(x * x + y * y)
    cosine, sine = (y, -x * turn) if on_y else (x, y * turn)
    near = sine * sine / (radius + cosine) if cosine > 0 else radius - cosine
    rest = ((near if sine >= 0 else 4.0 * radius - near) + count) % (4.0 * radius)
    if rest <= 2.0 * radius:
        end_cosine, end_sine = radius - rest, math.sqrt(max(rest * (2.0 * radius - rest), 0.0))
    else:
        square = (4.0 * radius - rest) * (rest - 2.0 * radius)
        end_cosine, end_sine = rest - 3.0 * radius, -math.sqrt(max(square, 0.0))
    end_sine *= turn
    end = (-end_sine, end_cosine) if on_y else (end_cosine, end_sine)
    return end[0] - x, end[1] - y


def _quadrant(x: int, y: int) -> int:
    if x > 0 and y >= 0:
        return 1
    if x <= 0 and y > 0:
        return 2
    if x < 0 and y <= 0:
        return 3
    return 4 if y < 0 else 1


def _hypot(x: float, y: float) -> float:
    return float(np.hypot(x, y))  # that of `math` is another one, in its last bit


def _sign(number: float) -> float:
    return float((number > 0.0) - (number < 0.0))


_LET_BE_UM = 0.6
"""A block that is told as it is drawn and ends no farther off on either axis is let be. So a CAM wrote the 3B beside
its ISO (docs/iso.md §10): three arcs bring it 0.575 µm off, and the line behind them still says 0."""
_FAR_UM = 1.25
"""An arc that would end farther off gets another centre than the one that it names."""
_TOLD = "x_um", "y_um", "count_um", "count_axis", "quadrant", "turn"


class Chained(NamedTuple):
    """Words of n blocks, and (n, 2) where each ends exactly."""

    words: StepWords
    end_um: Floats


def chained_words(curves: Curves, told_um: Floats, is_placed: Bools) -> Chained:
    """Words of n curves: as they are drawn while that leads near enough to their ends, else from the last decoded end.

    Parameters
    ----------
    curves
        What is to be told; jumps are told as lines.
    told_um
        (n, 2) ways from the starts of arcs to the centres that they name; NaN where any centre will do with which the
        arc ends where it should.
    is_placed
        (n,) rows that end at the very place, however it is reached.
    """
    words = _arcs(curves, told_um)
    again, ends = _told_in_turn(curves, told_um, is_placed, moves(words).by_um)
    if again:
        rows, blocks = list(again), zip(*(of_row[: len(_TOLD)] for of_row in again.values()), strict=True)
        for name, column in zip(_TOLD, blocks, strict=True):
            getattr(words, name)[rows] = column
    lines = words_of_lines(np.diff(ends, axis=0, prepend=curves.start_um[:1]))
    return Chained(chosen(curves.is_arc, words, lines), ends)


def _told_in_turn(
    curves: Curves, told_um: Floats, is_placed: Bools, by_um: Floats
) -> tuple[dict[int, OneBlock], Floats]:
    """The arcs, by their rows, that are told otherwise than drawn, which goes `by_um` (n, 2); and (n, 2) all ends.

    Lines that follow each other are told from where the first of them begins.
    """
    again: dict[int, OneBlock] = {}
    ends: list[Place] = []
    at = _place(curves.start_um[0].tolist() if len(curves) else [0.0, 0.0])
    origin = base = at
    is_behind_line = False
    drawn = zip(*(column.tolist() for column in (curves.start_um, curves.end_um, by_um)), strict=True)
    kinds = zip(curves.is_arc.tolist(), is_placed.tolist(), strict=True)
    for row, ((is_arc, is_named), (start, end, by)) in enumerate(zip(kinds, drawn, strict=True)):
        is_line = not (is_arc or is_named)
        if is_line and not is_behind_line:
            origin, base = at, _place(start) if _off(at, start) <= _LET_BE_UM else at
        is_behind_line = is_line
        if is_line:
            at = origin[0] + round(end[0] - base[0]), origin[1] + round(end[1] - base[1])
        elif is_named:
            at = _place(end)
        else:
            begin, at = at, (at[0] + by[0], at[1] + by[1])
            if _off(at, end) > _LET_BE_UM:
                words = again[row] = _arc_from(curves, told_um, row, begin)
                at = begin[0] + words.by_um[0], begin[1] + words.by_um[1]
        ends.append(at)
    return again, np.array(ends).reshape(-1, 2)


def _arc_from(curves: Curves, told_um: Floats, row: int, at: Place) -> OneBlock:
    """Words of the arc in a row that begins at a place beside its start; about the centre that it names, if it may."""
    (x, y), (told_x, told_y) = curves.end_um[row].tolist(), told_um[row].tolist()
    by, sweep = (x - at[0], y - at[1]), float(curves.sweep_rad[row])
    if not math.isnan(told_x):
        words = told_arc_of((-told_x, -told_y), by, sweep)
        if _off((at[0] + words.by_um[0], at[1] + words.by_um[1]), (x, y)) <= _FAR_UM:
            return words
    center_x, center_y = curves.center_um[row].tolist()
    out = at[0] - center_x, at[1] - center_y
    return arc_of(out, (out[0] + by[0], out[1] + by[1]), sweep)


def _arcs(curves: Curves, told_um: Floats) -> StepWords:
    """Words of all rows as arcs as they are drawn, about the centres that they name where they name one."""
    by = curves.end_um - curves.start_um
    names = ~np.isnan(told_um[:, 0])
    out = curves.start_um - np.where(curves.is_arc[:, None], curves.center_um, 0.0)
    about = words_of_arcs(out, out + by, curves.sweep_rad)
    return chosen(names, words_of_told_arcs(np.rint(-np.nan_to_num(told_um)), by, curves.sweep_rad), about)


def _place(xy: Sequence[float]) -> Place:
    return xy[0], xy[1]


def _off(place_um: Sequence[float], other_um: Sequence[float]) -> float:
    return max(abs(place_um[0] - other_um[0]), abs(place_um[1] - other_um[1]))
