"""What controllers are told beside the path, a row a block: `StepWords` to count by, and `Compensation`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Literal, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats, Ints

Outer = Literal["lengthen", "arc", "chamfer"]
"""What is done at outer corners: see `CompensationRules`."""


@dataclass(frozen=True, slots=True, eq=False)
class Compensation:
    """What a controller that compensates is told, one row a block: the path is the drawing's contour.

    The block with which compensation begins, the set-up, is the first one with a side behind one without; the block
    with which it ends, the cancel, is the first without a side behind one with.

    Attributes
    ----------
    side
        (n,) int64, +1 left (G41), −1 right (G42), 0 none (G40): what is in force while the block runs.
    by_um
        (n,) float64, value of the register in force; a negative one swaps the side; 0 without a side, NaN where it is
        not known.
    register
        n names of registers without leading zeros, such as ``D1``; empty where there is none.
    rules
        How the controller joins, begins and ends.
    lacking
        Of registers whose value is not known because the program sets them to a sum: the one in it without a value.
    """

    side: Ints
    by_um: Floats
    register: tuple[str, ...]
    rules: "CompensationRules"
    lacking: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Freeze the columns."""
        self.side.setflags(write=False)
        self.by_um.setflags(write=False)

    @property
    def left_um(self) -> Floats:
        """(n,) how far the wire runs to the left of each block, negative to the right; NaN where it is not known."""
        return self.side * self.by_um


class CompensationRules(NamedTuple):
    """How a controller compensates: families differ (docs/iso.md has the table).

    Attributes
    ----------
    outer
        At an outer corner: ``arc`` always goes round it; ``lengthen`` and ``chamfer`` prolong both blocks to where they
        meet, up to 90°, and go round a sharper one by an arc, or by a line between points an offset beyond both ends.
    startup
        The set-up ends on the normal of the block behind it (``next-normal``), or on its own, and goes on from there
        as at any corner (``own-normal``).
    too_small
        An inner arc no larger than the offset vanishes, or stops the machine with an alarm.
    change_on
        A new offset while compensation is on: the block begins at the old one and ends at the new (``wedge``), or
        stops the machine with an alarm.
    """

    outer: Outer = "chamfer"
    startup: Literal["next-normal", "own-normal"] = "next-normal"
    too_small: Literal["vanish", "alarm"] = "vanish"
    change_on: Literal["wedge", "alarm"] = "wedge"


@dataclass(frozen=True, slots=True, eq=False)
class Taper:
    """What a controller that tilts the wire is told, one row a block.

    Attributes
    ----------
    side
        (n,) int64, +1 where the upper end of the wire leans to the left of travel (G51), −1 to the right (G52), 0
        upright (G50): what is in force while the block runs.
    angle_rad
        (n,) float64, the angle in force, 0 or more and less than a right one.
    """

    side: Ints
    angle_rad: Floats

    def __post_init__(self) -> None:
        """Freeze the columns."""
        self.side.setflags(write=False)
        self.angle_rad.setflags(write=False)


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
