"""State of a slide between two ticks."""

from typing import NamedTuple


class Slide(NamedTuple):
    """A slide, and what its motor has lost.

    Attributes
    ----------
    t_s
        Now.
    at_um, velocity
        Its place, and its velocity, µm/s, half a tick before.
    tick_s
        Length of the tick that has just passed; 0 after a rest.
    lost_um
        Way that the motor has lost so far: how far it stands behind the place commanded.
    lag_um, force
        Its lag behind the motor, and the force of the drive over the mass, µm/s², in that tick.
    rests
        Whether it stands until its motor turns again.
    """

    t_s: float
    at_um: float
    velocity: float
    tick_s: float
    lost_um: float
    lag_um: float
    force: float
    rests: bool


def resting(at_um: float) -> Slide:
    """A slide at rest at a place, its motor there too, at time 0."""
    return Slide(0.0, at_um, 0.0, 0.0, 0.0, 0.0, 0.0, True)
