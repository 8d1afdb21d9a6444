"""The words of one line, for tests that write blocks one by one."""

from typing import NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.step_words.words import words_of_lines


class LineWords(NamedTuple):
    """X, Y, J in µm, counted axis and quadrant of one line."""

    x_um: int
    y_um: int
    count_um: int
    count_axis: Axis
    quadrant: int


def line_words(dx_um: float, dy_um: float) -> LineWords:
    """Words of the line (dx, dy), rounded to whole µm; quadrant 1 and J = 0 where both round to 0."""
    words = words_of_lines(np.array([[dx_um, dy_um]]))
    x, y, count, axis, quadrant = (
        int(column[0]) for column in (words.x_um, words.y_um, words.count_um, words.count_axis, words.quadrant)
    )
    return LineWords(x, y, count, Axis(axis), quadrant)
