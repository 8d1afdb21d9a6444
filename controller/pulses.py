"""Pulses: steps with the time of each, what a card hands to the drives."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.plan import Plan
from controller.steps import StepChunk
from parser.toolpath import Floats


class Pulses(NamedTuple):
    """m pulses in order.

    Attributes
    ----------
    t_s
        (m,) float64, time of each pulse, never falling; two axes may be pulsed at once.
    x_um, y_um
        (m,) int32, position commanded once the pulse is out.
    row
        (m,) int32, row of the toolpath.
    """

    t_s: Floats
    x_um: NDArray[np.int32]
    y_um: NDArray[np.int32]
    row: NDArray[np.int32]


def time_steps(steps: StepChunk, plan: Plan) -> Pulses:
    """Pulses of some steps: each comes when the plan reaches the foot of the step on the path."""
    # Accumulated, so that rounding (10⁻¹² s) puts no pulse before the one it follows.
    return Pulses(np.maximum.accumulate(plan.time_at(steps.along_um)), steps.x_um, steps.y_um, steps.row)
