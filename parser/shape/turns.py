"""Where a path turns back: at once, or behind a short step aside, as from one pass to the next one."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints, total_before
from parser.geometry.directions import directions
from parser.toolpath import Toolpath

_BACK = -0.96  # cosine of the angle between the ways there and back; whole µm tilt short blocks
_MOST_STEP_UM = 400.0
_MOST_STEPS = 3  # blocks of a step aside


class Turns(NamedTuple):
    """Turns (k,) in the order they are met.

    Attributes
    ----------
    arrive, leave
        Rows up to but without `arrive` run there, those from `leave` on back; rows between them are the step.
    aside_um
        How far the way back lies to the left of the way there.
    """

    arrive: Ints
    leave: Ints
    aside_um: Floats

    def take(self, at: Ints | slice) -> "Turns":
        """Those at the indices `at`."""
        return Turns(self.arrive[at], self.leave[at], self.aside_um[at])


def find_turns(toolpath: Toolpath, contour: Ints) -> Turns:
    """Turns within contours; `contour` (n,) is each row's, −1 on jumps."""
    n = len(toolpath)
    ways, before = directions(toolpath), total_before(toolpath.length_um)
    leave = np.full(n, -1, dtype=np.int64)
    for blocks in range(min(_MOST_STEPS, n - 1), -1, -1):
        arriving, leaving = ways.arriving[: n - blocks - 1], ways.leaving[blocks + 1 :]
        turned = arriving[:, 0] * leaving[:, 0] + arriving[:, 1] * leaving[:, 1] <= _BACK
        turned &= (contour[: n - blocks - 1] >= 0) & (contour[: n - blocks - 1] == contour[blocks + 1 :])
        turned &= before[blocks + 1 : n] - before[1 : n - blocks] <= _MOST_STEP_UM
        row = np.flatnonzero(turned)
        leave[row] = row + blocks + 1
    there = np.flatnonzero(leave >= 0)
    # Blocks may be shorter than a step: of turns that leave by one row, the last one is no step longer than it must be.
    there = there[np.diff(leave[there], append=n) != 0]
    there = _apart(there, leave[there], before)
    back = leave[there]
    by = toolpath.start_um[back] - toolpath.end_um[there]
    way = ways.arriving[there]
    return Turns(there + 1, back, way[:, 0] * by[:, 1] - way[:, 1] * by[:, 0])


def _apart(there: Ints, back: Ints, before_um: Floats) -> Ints:
    """Rows (k,) that turn back, without those whose way back would be the step of another one: of two the shorter step.

    Behind a corner the step itself runs back beside the side before it.
    """
    step_um = before_um[back] - before_um[there + 1]
    meets = back[:-1] >= there[1:] + 1
    gone = np.zeros(len(there), dtype=np.bool_)
    gone[:-1] |= meets & (step_um[:-1] > step_um[1:])
    gone[1:] |= meets & (step_um[:-1] <= step_um[1:])
    return there[~gone]
