"""Rhythm: how the axes of a table answer, which says how finely and for how long they have to be watched."""

from typing import NamedTuple

from sim.setup.machine.table_model import TableModel
from sim.table.physics.drive import drives_of

STEP_RAD = 0.125
"""Phase of the ringing in one tick while single steps are felt: fifty ticks to the period."""
STEPS_RAD = 0.1
"""The same while a motor makes several steps at once: their sum has corners within a tick."""
SHAKEN_RAD = 0.05
"""Phase of the ringing in one tick while the axes are shaken by more than a step."""
DIED = 6.0
"""Decay times after which a shake counts as dead: e⁻⁶ is 0.25 %."""


class Rhythm(NamedTuple):
    """How the axes answer.

    Attributes
    ----------
    frequencies
        Natural frequencies of X and Y, 1/s.
    decay
        Decay rate of the slower axis, 1/s.
    """

    frequencies: tuple[float, float]
    decay: float

    @property
    def frequency(self) -> float:
        """Natural frequency of the slower axis, 1/s."""
        return min(self.frequencies)

    def tick_s(self, phase_rad: float) -> tuple[float, float]:
        """Time in which X and Y go through a phase of their ringing."""
        x, y = self.frequencies
        return phase_rad / x, phase_rad / y

    @property
    def died_s(self) -> float:
        """Time after which a shake has died."""
        return DIED / self.decay


def rhythm(model: TableModel) -> Rhythm:
    """Rhythm of a table: ω = sqrt(k / m) of each axis, decay ζω of the slower, or that of the slow root where ζ > 1."""
    x, y = (drive.frequency for drive in drives_of(model))
    ratio = model.drive_damping_ratio
    slow = ratio - (ratio**2 - 1.0) ** 0.5 if ratio > 1.0 else ratio
    return Rhythm((x, y), slow * min(x, y))
