"""What a controller is told of the offset: how far, to which side, and along which blocks."""

from enum import IntEnum
from typing import NamedTuple


class Side(IntEnum):
    """Side of the contour on which the wire's centre runs, along the cutting direction: G41 left, G42 right."""

    LEFT = 1
    RIGHT = -1


class Section(NamedTuple):
    """Blocks along the drawing's contour, offset, as between G41 and G40; those before and behind lead in and out.

    Attributes
    ----------
    first, last
        Rows of the toolpath, both included.
    closed
        Whether the last one ends where the first begins, so that they are joined there as any two blocks are.
    """

    first: int
    last: int
    closed: bool
