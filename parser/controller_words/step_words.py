"""What a controller that counts steps is told of each block."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from parser.geometry.curves import Bools, Ints

# Signs of (X, Y) in quadrants 1..4; there is no quadrant 0.
_SIGNS = np.array([[0, 0], [1, 1], [-1, 1], [-1, -1], [1, -1]], dtype=np.int64)


class Axis(IntEnum):
    """A table axis."""

    X = 0
    Y = 1


@dataclass(frozen=True, slots=True, eq=False)
class StepWords:
    """What a controller that counts steps is told, one row a block, all arrays shape (n,) int64.

    Attributes
    ----------
    x_um, y_um
        Lines: direction as absolute values, only the ratio matters. Arcs: start relative to the centre, absolute
        values.
    count_um
        Count length J.
    count_axis
        Counted axis G: 0 X, 1 Y.
    quadrant
        1..4. Lines: of the direction. Arcs: the one the first step enters.
    turn
        +1 counter-clockwise (NR), −1 clockwise (SR), 0 line.
    radius_um
        4B: radius R as written, 0 on lines; −1 in 3B blocks, which have none.
    curve
        4B: the curve mark, 1 convex (D), 2 concave (DD), 0 none.
    """

    x_um: Ints
    y_um: Ints
    count_um: Ints
    count_axis: Ints
    quadrant: Ints
    turn: Ints
    radius_um: Ints
    curve: Ints

    @property
    def signs(self) -> Ints:
        """(n, 2) int64, signs of X and Y in each block's quadrant."""
        return _SIGNS[self.quadrant]

    @property
    def is_endless(self) -> Bools:
        """(n,) True on blocks that a controller would never count out.

        An arc needs a radius of more than 1 µm (at 1 µm the step-by-step rule swings between two points), a line a
        component on its counted axis.
        """
        counted = np.where(self.count_axis == Axis.X, self.x_um, self.y_um)
        no_radius = self.x_um**2 + self.y_um**2 <= 1
        return np.where(self.turn != 0, no_radius, (counted == 0) & (self.count_um > 0))
