"""One arc told and decoded in plain numbers: to the last bit what `telling` and `moves` give (tests hold it so).

Where each block begins at the decoded end of the last, arcs are told one after the other; an array for every number of
one arc would take thirty times as long.
"""

import math
from typing import NamedTuple

import numpy as np

from parser.told.step_words import Axis
from parser.words.telling import MOST_SHIFT, MOST_SWEEP_RAD

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
    """The way of a centre along the chord to where start and end are equally far from it, as in `telling`."""
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
