"""One tick of a slide: the force law of its drive, and what a kick of it does.

A tick is one leapfrog kick, second order in the tick and without drift of energy (E. Hairer, C. Lubich, G. Wanner,
"Geometric numerical integration illustrated by the Störmer-Verlet method", Acta Numerica 12, 2003). The table of bodies
goes by ticks; the other one by events (`sim.table.course`).
"""

import math
from typing import NamedTuple

from sim.table.drive import Drive

_STILL_UM = 1e-9


class Kick(NamedTuple):
    """What one tick asks of a drive.

    Attributes
    ----------
    lag_um, motor_um_s
        Of the slide behind the motor, and speed of the motor, in the middle of the kick.
    velocity
        Of the slide before the kick, µm/s.
    length_s
        Time over which the force acts.
    limit
        Largest force over the mass, µm/s².
    """

    lag_um: float
    motor_um_s: float
    velocity: float
    length_s: float
    limit: float


class Kicked(NamedTuple):
    """Velocity after a kick, µm/s, and the drive's force over the mass, µm/s²."""

    velocity: float
    force: float


def _past(lag_um: float, slack_um: float) -> float:
    """How far a lag lies past the slack."""
    if lag_um > slack_um:
        return lag_um - slack_um
    return lag_um + slack_um if lag_um < -slack_um else 0.0


def _rubbed(velocity: float, most: float) -> float:
    """Velocity after Coulomb friction has taken `most` of it, and never more than all: then the slide sticks."""
    if velocity > most:
        return velocity - most
    return velocity + most if velocity < -most else 0.0


def _flank(slack_um: float, lag_um: float, half_um: float) -> tuple[float, float]:
    """Mean way past the slack, and mean share in contact, while the lag goes from `lag - half` to `lag + half`.

    The means over the kick make the nut meet its flank at the right time, also in the middle of a tick.
    """
    if slack_um == 0.0:
        return lag_um, 1.0
    low, high = lag_um - abs(half_um), lag_um + abs(half_um)
    if low >= slack_um:
        return lag_um - slack_um, 1.0
    if high <= -slack_um:
        return lag_um + slack_um, 1.0
    if low >= -slack_um and high <= slack_um:
        return 0.0, 0.0
    if high - low < _STILL_UM:
        return _past(lag_um, slack_um), 1.0
    first, last = _past(low, slack_um), _past(high, slack_um)
    touching = (last - first) / (high - low)
    return touching * (last + first) / 2.0, touching


def kicked(drive: Drive, kick: Kick) -> Kicked:
    """A slide after a kick. Dampers and viscous friction act on the mean of the velocities before and after."""
    half_s, velocity = kick.length_s / 2.0, kick.velocity
    flank, touching = _flank(drive.slack_um, kick.lag_um, (kick.motor_um_s - velocity) * half_s)
    damper, stopped = touching * drive.damper, kick.length_s * drive.friction
    pull = drive.spring * flank + damper * (kick.motor_um_s - velocity / 2.0)
    coasting = velocity * (1.0 - half_s * drive.viscous)
    gain = 1.0 / (1.0 + half_s * (damper + drive.viscous))
    new = gain * _rubbed(coasting + kick.length_s * pull, stopped)
    force = pull - damper * new / 2.0
    given = force
    if abs(force) > kick.limit:
        given = math.copysign(kick.limit, force)
    if drive.slack_um > 0.0 and flank * given < 0.0:  # a flank pushes, and never pulls
        given = 0.0
    if given != force:
        new = _rubbed(coasting + kick.length_s * given, stopped) / (1.0 + half_s * drive.viscous)
    return Kicked(new, given)
