"""What a controller is told of the offset: how far, to which side, and along which blocks."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from parser.shape.closing import CLOSED_WITHIN_UM
from parser.shape.contours import contour_rows, runs
from parser.shape.loops import find_loops
from parser.toolpath import Toolpath


class Side(IntEnum):
    """Side of the contour on which the wire's centre runs, along the cutting direction: G41 left, G42 right."""

    LEFT = 1
    RIGHT = -1


class OffsetSection(NamedTuple):
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


def sections_of(toolpath: Toolpath) -> tuple[OffsetSection, ...]:
    """The blocks of each contour that run along the drawing: its loop, without the lead-in and the lead-out.

    As many blocks as lead in, at least one, may lead out behind the loop. If there are more blocks, they run along the
    contour again, and only the last ones, as many as lead in, lead out. A contour without a loop, such as a parting
    cut, is drawn from its first block to its last.
    """
    contours: list[list[int]] = runs(toolpath).tolist()
    loops = find_loops(toolpath, contour_rows(toolpath), np.arange(len(contours)))
    loop_of = {number: at for at, number in enumerate(loops.contour.tolist())}
    found = []
    for number, (begin, past) in enumerate(contours):
        end, at = past - 1, loop_of.get(number)
        if at is None:
            found.append(OffsetSection(begin, end, closed=False))
            continue
        first, last = int(loops.first[at]), int(loops.last[at])
        leads = first - begin
        again = end - last > max(leads, 1)
        closes = np.hypot(*(toolpath.end_um[last] - toolpath.start_um[first])) <= CLOSED_WITHIN_UM
        found.append(OffsetSection(first, end - leads if again else last, closed=bool(closes and not again)))
    return tuple(found)
