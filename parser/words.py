"""3B words of a line from its displacement, by the trade's rules for labels and count axis (docs/3b.md §1)."""

from typing import NamedTuple

from parser.toolpath import Axis


class LineWords(NamedTuple):
    """X, Y, J in µm, counted axis and quadrant of one line."""

    x_um: int
    y_um: int
    count_um: int
    count_axis: Axis
    quadrant: int


def line_words(dx_um: float, dy_um: float) -> LineWords:
    """Words of the line (dx, dy), rounded to whole µm; quadrant 1 and J = 0 where both round to 0."""
    dx, dy = round(dx_um), round(dy_um)
    quadrant = _quadrant(dx, dy)
    x, y = abs(dx), abs(dy)
    # At 45° GY in quadrants 1 and 3, GX in 2 and 4: the axis that is stepped last.
    on_x = x > y or (x == y and quadrant in (2, 4))
    return LineWords(x, y, max(x, y), Axis.X if on_x else Axis.Y, quadrant)


def _quadrant(dx: int, dy: int) -> int:
    """Quadrant of a direction; on an axis the one entered counter-clockwise: +X 1, +Y 2, −X 3, −Y 4."""
    if dx > 0 and dy >= 0:
        return 1
    if dx <= 0 and dy > 0:
        return 2
    if dx < 0 and dy <= 0:
        return 3
    return 4 if dy < 0 else 1
