"""Ripple: what a slow step does to a slide that creeps. One step is tried, since a run does not work out each."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.setup.machine.table_model import TableModel
from sim.table.physics.drive import drives_of
from sim.table.solve.slow_step import SlowStep
from sim.table.solve.trial import after_a_step
from sim.table.when.rhythm import rhythm
from sim.units import newtons

QUANTITIES: Final = ("velocity_um_s", "acceleration_um_s2", "lag_um", "following_error_um", "force_n")
"""What is gathered over time, as `sim.table.record.history.History` has it."""


class Ripple(NamedTuple):
    """Lowest and highest of each of `QUANTITIES` in a step in the positive direction, (5, 2) for X and Y."""

    low: Floats
    high: Floats

    def backward(self) -> "Ripple":
        """The same of a step in the negative direction."""
        return Ripple(-self.high, -self.low)


def ripple(model: TableModel, slow: SlowStep) -> Ripple:
    """Ripple of slides that rest between slow steps, each at the lag at which such steps leave it."""
    lag_um = slow.play_um[:, None]
    slab, record, end = after_a_step(model, rhythm(model), lag_um)
    velocity = record.velocity[:, :, 0]
    acceleration = np.diff(velocity, axis=0, prepend=0.0) / slab.length_s[:-1, None]
    behind = 1.0 - np.concatenate([record.place_um[:, :, 0], end.at_um])  # the step as soon as it is commanded
    error = np.concatenate([behind, lag_um.T])
    force_n = newtons(record.force[:, :, 0] * drives_of(model).mass_kg[:, 0])
    courses = (velocity, acceleration, record.lag_um[:, :, 0], error, force_n)
    low, high = (np.stack([of(course, axis=0) for course in courses]) for of in (np.min, np.max))
    return Ripple(low, high)
