"""The force law of the drives: spring and damper of the train across a dead zone, limited in force, against friction.

A tick is one leapfrog kick, second order in the tick and without drift of energy (E. Hairer, C. Lubich, G. Wanner,
"Geometric numerical integration illustrated by the Störmer-Verlet method", Acta Numerica 12, 2003).
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.setup.machine.table_model import TableModel
from sim.units import engine_force, engine_stiffness, engine_viscosity

_STILL_UM = 1e-9


class Drives(NamedTuple):
    """The drives by what they do to the mass they move; each (2, 1) float64, X and Y.

    Attributes
    ----------
    mass_kg
        Moved mass m.
    spring, damper
        Of the drive train over the mass: k/m = ω², 1/s², and 2ζω, 1/s.
    friction, viscous
        Of the guides over the mass: Coulomb µm/s², viscous 1/s.
    slack_um
        Half the backlash: the motor is this far from either flank of the nut.
    """

    mass_kg: Floats
    spring: Floats
    damper: Floats
    friction: Floats
    viscous: Floats
    slack_um: Floats


class Kick(NamedTuple):
    """What one tick of n tables asks of their drives.

    Attributes
    ----------
    place_um, speed_um_s
        (2, n), of the motors, in the middle of the kick.
    length_s
        (n,), time over which the force acts.
    limit
        (2, n), largest force over the mass, µm/s².
    """

    place_um: Floats
    speed_um_s: Floats
    length_s: Floats
    limit: Floats


def drives_of(model: TableModel) -> Drives:
    """Drives of a table; the damping ratio is that of the axis' moved mass on its spring."""
    mass = _column(model.moved_kg)
    spring = engine_stiffness(model.drive_stiffness_n_um) / mass
    return Drives(
        mass_kg=mass,
        spring=spring,
        damper=2.0 * model.drive_damping_ratio * np.sqrt(spring),
        friction=engine_force(_column(model.friction_n)) / mass,
        viscous=engine_viscosity(_column(model.viscous_n_s_mm)) / mass,
        slack_um=_column(model.backlash_um) / 2.0,
    )


def _column(pair: tuple[float, float]) -> Floats:
    return np.array(pair)[:, None]


def kicked(drives: Drives, at_um: Floats, velocity: Floats, kick: Kick) -> tuple[Floats, Floats]:
    """Velocities after a kick, µm/s, and the drives' force over mass, µm/s²; each (2, n).

    `at_um` and `velocity` (2, n) are places and velocities before it. Dampers and viscous friction act on the mean of
    the velocities before and after.
    """
    half = kick.length_s / 2.0
    flank, touching = _flanks(drives, kick.place_um - at_um, (kick.speed_um_s - velocity) * half)
    damper, stopped = touching * drives.damper, kick.length_s * drives.friction
    pull = drives.spring * flank + damper * (kick.speed_um_s - velocity / 2.0)
    coasting = velocity * (1.0 - half * drives.viscous)
    new = _rubbed(coasting + kick.length_s * pull, stopped) / (1.0 + half * (damper + drives.viscous))
    asked = pull - damper * new / 2.0
    given = np.minimum(np.maximum(asked, -kick.limit), kick.limit)
    if drives.slack_um.any():  # a flank pushes, and never pulls
        given *= (flank * given >= 0.0) | (drives.slack_um == 0.0)
    cut = given != asked
    if cut.any():
        new = np.where(cut, _rubbed(coasting + kick.length_s * given, stopped) / (1.0 + half * drives.viscous), new)
    return new, given


def _flanks(drives: Drives, lag: Floats, half: Floats) -> tuple[Floats, Floats]:
    """Mean way past the slack, and mean share in contact, while the lag goes from `lag - half` to `lag + half`.

    The means over the kick make the nut meet its flank at the right time, also in the middle of a tick.
    """
    slack = drives.slack_um
    if not slack.any():
        return lag, np.ones_like(lag)
    first, last, way = _past(lag - half, slack), _past(lag + half, slack), 2.0 * half
    still = np.abs(way) < _STILL_UM
    if still.any():
        past, way = _past(lag, slack), np.where(still, 1.0, way)
        flank = np.where(still, past, (last + first) * (last - first) / (2.0 * way))
        touching = np.where(still, past != 0.0, (last - first) / way)
    else:
        touching = (last - first) / way
        flank = touching * (last + first) / 2.0
    return flank, np.where(slack > 0.0, touching, 1.0)


def _past(lag: Floats, slack: Floats) -> Floats:
    """How far lags lie past the slack."""
    return lag - np.minimum(np.maximum(lag, -slack), slack)


def _rubbed(velocity: Floats, most: Floats) -> Floats:
    """Velocities after Coulomb friction has taken `most` of them, and never more than all: then the slide sticks."""
    return velocity - np.minimum(np.maximum(velocity, -most), most)
