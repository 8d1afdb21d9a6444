"""Rhythm: how the axes of a table answer, which says how finely and for how long they have to be watched."""

import math
from typing import NamedTuple

import numpy as np

from sim.setup.machine.table_model import TableModel
from sim.table.physics.drive import drives_of

STEP_RAD = 0.125
"""Phase of the ringing in one tick while single steps are felt: fifty ticks to the period."""
GONE = 0.05
"""Share of a step's ringing that is left where it counts as dead: 0.05 µm."""
DIED = 6.0
"""Decay times after which a shake counts as dead: e⁻⁶ is 0.25 %."""


class Rhythm(NamedTuple):
    """How the axes answer.

    Attributes
    ----------
    frequency, decay
        Natural frequency and decay rate of the slower axis, 1/s.
    fastest
        Natural frequency of the faster axis, 1/s.
    felt_s
        How long a step is felt: from its start until its ringing has died, or until friction has caught the slide half
        a period after the step.
    """

    frequency: float
    decay: float
    fastest: float
    felt_s: float

    @property
    def step_tick_s(self) -> float:
        """Longest tick while steps are felt."""
        return STEP_RAD / self.fastest

    @property
    def died_s(self) -> float:
        """Time after which a shake has died."""
        return DIED / self.decay


def rhythm(model: TableModel) -> Rhythm:
    """Rhythm of the slower axis: ω = sqrt(k / m), decay ζω, or that of the slow root where ζ > 1."""
    frequency, ratio = float(np.sqrt(drives_of(model).spring.min())), model.drive_damping_ratio
    slow = ratio - (ratio**2 - 1.0) ** 0.5 if ratio > 1.0 else ratio
    rubbed = min(model.friction_n) > 0.0
    died_s = -math.log(GONE) / (slow * frequency)
    return Rhythm(
        frequency,
        slow * frequency,
        fastest=float(np.sqrt(drives_of(model).spring.max())),
        felt_s=model.motor.step_time_s + min(died_s, math.pi / frequency if rubbed else math.inf),
    )
