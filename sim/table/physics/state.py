"""State of tables between two ticks."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints


class State(NamedTuple):
    """State of n tables.

    Attributes
    ----------
    at_um, velocity
        (n, 2), places, µm, and velocities, µm/s.
    lost_um
        (n, 2), way that the motors have lost so far: how far each stands behind the place commanded.
    tripped
        (n,), whether a servo has given up.
    """

    at_um: Floats
    velocity: Floats
    lost_um: Floats
    tripped: NDArray[np.bool_]

    def of(self, tables: Ints) -> "State":
        """State of some of them."""
        return State(self.at_um[tables], self.velocity[tables], self.lost_um[tables], self.tripped[tables])

    def put(self, tables: Ints, state: "State") -> None:
        """Overwrite the state of some of them."""
        self.at_um[tables], self.velocity[tables] = state.at_um, state.velocity
        self.lost_um[tables], self.tripped[tables] = state.lost_um, state.tripped

    def copy(self) -> "State":
        """The same, to be changed."""
        return self.of(np.arange(len(self.tripped)))
