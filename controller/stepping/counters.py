"""What a controller has in its counters at any step of a program: X and Y, F, and the J that is left.

A control remembers these through a power loss, shows them to the operator, and counts them back when it undoes steps.
"""

from typing import NamedTuple

import numpy as np

from controller.stepping.steps import Steps
from controller.stepping.strokes import firsts_among
from parser.controller_words import Axis, StepWords


class Counters(NamedTuple):
    """The counters after some steps of a block.

    Attributes
    ----------
    row, made
        Row of the toolpath, and steps made of it.
    x_um, y_um
        Where the table stands, from where the program's steps begin.
    deviation
        F, by which the next step is chosen (docs/3b.md, section 3), µm of lines times µm, of arcs µm².
    count_left_um
        J that is still to be counted off.
    """

    row: int
    made: int
    x_um: int
    y_um: int
    deviation: int
    count_left_um: int


def counters_after(steps: Steps, words: StepWords, row: int, made: int) -> Counters:
    """The counters after so many steps of a row; the work does not grow with them. ValueError for more than it has."""
    if not 0 <= made <= int(steps.count[row]):
        raise ValueError(f"row {row} has {int(steps.count[row])} steps, not {made}")
    before, count_um = int(steps.before[row]), int(words.count_um[row]) if steps.count[row] else 0
    if made == 0:
        x, y = steps.corner_um[row].tolist()
        return Counters(row, 0, x, y, 0, count_um)
    strokes = steps.strokes_of(before, before + made)
    taken = np.minimum(strokes.steps, made - strokes.base)
    firsts = firsts_among(strokes, taken)
    is_counted_first = (strokes.first[:, 0] != 0) == (int(words.count_axis[row]) == Axis.X)
    counted = int(np.where(is_counted_first, firsts, taken - firsts).sum())
    x, y = steps.place_after(before + made)
    u, v = int(firsts[-1]), int(taken[-1] - firsts[-1])
    a, b = int(strokes.a[-1]), int(strokes.b[-1])
    deviation = (a - u) ** 2 + (b + v) ** 2 - int(strokes.radius_sq[-1]) if strokes.is_arc[-1] else a * v - b * u
    return Counters(row, made, x, y, deviation, count_um - counted)


def made_by(steps: Steps, words: StepWords, counters: Counters) -> int:
    """Steps of its row after which a controller has these counters, by them alone: how it goes on after a power loss.

    J falls as steps are made; those with one J all go one way along the other axis, and the place tells them apart.
    ValueError where the row never has such counters.
    """
    low, high = 0, int(steps.count[counters.row])
    while low < high:
        middle = (low + high) // 2
        if counters_after(steps, words, counters.row, middle).count_left_um > counters.count_left_um:
            low = middle + 1
        else:
            high = middle
    first = counters_after(steps, words, counters.row, low)
    made = low + abs(counters.x_um - first.x_um) + abs(counters.y_um - first.y_um)
    if made > steps.count[counters.row] or counters_after(steps, words, counters.row, made)[2:] != counters[2:]:
        raise ValueError(f"row {counters.row} has no step with these counters")
    return made
