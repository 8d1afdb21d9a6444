"""Pulses: steps with the time of each, what a card hands to the drives."""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.motion.plan import Plan
from parser.geometry.curves import Floats

if TYPE_CHECKING:  # a check knows pulses, and loads no compiled loops
    from controller.stepping.chunks import StepChunk

ROUNDING = 1e-13
"""Share of a path by which sums of its parts may differ: √p · 2⁻⁵³ for p parts up to a million."""


class Pulses(NamedTuple):
    """m pulses in order.

    Attributes
    ----------
    t_s
        (m,) float64, time of each pulse, never falling; two axes may be pulsed at once.
    x_um, y_um
        (m,) int32, position commanded once the pulse is out.
    row
        (m,) int32, row of the path.
    """

    t_s: Floats
    x_um: NDArray[np.int32]
    y_um: NDArray[np.int32]
    row: NDArray[np.int32]

    def part(self, since: int, until: int) -> "Pulses":
        """Pulses number since + 1 to until."""
        return Pulses._make(column[since:until] for column in self)


def no_pulses() -> Pulses:
    """Pulses of an axis that stands."""
    none = np.zeros(0, dtype=np.int32)
    return Pulses(np.zeros(0), none, none, none)


def joined(pulses: Iterable[Pulses], number: int) -> Iterator[Pulses]:
    """The same pulses in parts of so many at least, but for the last: each part is taken at some cost."""
    waiting, waits = list[Pulses](), 0
    for part in pulses:
        waiting.append(part)
        waits += len(part.t_s)
        if waits >= number:
            yield _one_of(waiting)
            waiting, waits = [], 0
    if waits:
        yield _one_of(waiting)


def _one_of(parts: list[Pulses]) -> Pulses:
    return parts[0] if len(parts) == 1 else Pulses(*map(np.concatenate, zip(*parts, strict=True)))


def time_steps(steps: "StepChunk", plan: Plan, began_s: float = 0.0, from_um: float = 0.0) -> Pulses:
    """Pulses of some steps: each comes when the plan reaches the foot of the step on the path.

    The plan begins at the time `began_s`, where `from_um` of the steps' path are done.
    """
    # Sums of steps and of phases differ in the last bits; the last step before a wait is not to come after it.
    time = plan.time_at((steps.along_um - from_um) * (1.0 - ROUNDING)) + began_s
    # Accumulated, so that rounding (10⁻¹² s) puts no pulse before the one it follows.
    return Pulses(np.maximum.accumulate(time, out=time), steps.x_um, steps.y_um, steps.row)
