"""The step interface, ours and not the library's: 3B blocks that the card steps point by point."""

import math

from controller.card.calls.path_base import PathBase
from controller.card.core.call import Double, Long, gt
from controller.card.core.codes import Code, Refused
from controller.card.engine.entries import Stepped

_LARGEST_UM = 1 << 30
"""Words up to this keep squares of radii within whole numbers of 64 bit."""


class StepCalls(PathBase):
    """Stepped blocks."""

    @gt()
    def step_block(
        self, x_um: Long, y_um: Long, count_um: Long, axis: Long, quadrant: Long, turn: Long, length_um: Double
    ) -> None:
        """Put one 3B block into the open list, as a path entry; refused with 1 where the list is closed or full.

        Parameters
        ----------
        x_um, y_um, count_um, quadrant, turn
            Its words, as in `StepWords`; refused with 7 where there are none like them.
        axis
            Counted axis: 0 X, 1 Y.
        length_um
            Length of its ideal line or arc. Refused with 3 where it has none, is endless or too long, or where the
            count is more than double what the length can hold.
        """
        if x_um < 0 or y_um < 0 or count_um < 0 or axis not in (0, 1) or turn not in (-1, 0, 1):
            raise Refused(Code.PARAMETER)
        if quadrant not in (1, 2, 3, 4):
            raise Refused(Code.PARAMETER)
        counted, radius = (x_um, y_um)[axis], math.hypot(x_um, y_um)
        # The way of a line is its count times its length over its counted extent; an arc is as long as its count.
        least = count_um if turn else count_um * radius / counted if counted else math.inf
        runs = count_um > 0 and length_um > 0.0 and (not turn or radius > 1.0)
        if not runs or max(x_um, y_um) > _LARGEST_UM or least > 2.0 * length_um + 4.0 or length_um > _LARGEST_UM:
            raise Refused(Code.LENGTH)
        engine = self._engine
        number, pace = max(1, engine.list.number), engine.speeds.pace(rapid=False)
        self._submit(Stepped(number, pace, x_um, y_um, count_um, axis, quadrant, turn, length_um))
