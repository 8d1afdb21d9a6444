"""The drive of an axis by what it does to the mass that it moves, worked out from the table's model.

Spring and damper of the train act across a dead zone, limited in force, against friction.
"""

import math
from typing import NamedTuple

from sim.base.units import engine_force, engine_stiffness, engine_viscosity
from sim.setup.machine.table import TableModel


class Drive(NamedTuple):
    """The drive of one axis by what it does to the mass it moves.

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

    mass_kg: float
    spring: float
    damper: float
    friction: float
    viscous: float
    slack_um: float

    @property
    def frequency(self) -> float:
        """Natural frequency of the mass on the drive train, ω = sqrt(k / m), 1/s."""
        return math.sqrt(self.spring)


def drives_of(model: TableModel) -> tuple[Drive, Drive]:
    """Drives of X and Y; the damping ratio is that of the axis' moved mass on its spring."""
    x, y = (_drive(model, axis) for axis in (0, 1))
    return x, y


def _drive(model: TableModel, axis: int) -> Drive:
    mass = model.moved_kg[axis]
    spring = engine_stiffness(model.drive_stiffness_n_um) / mass
    return Drive(
        mass_kg=mass,
        spring=spring,
        damper=2.0 * model.drive_damping_ratio * math.sqrt(spring),
        friction=engine_force(model.friction_n[axis]) / mass,
        viscous=engine_viscosity(model.viscous_n_s_mm[axis]) / mass,
        slack_um=model.backlash_um[axis] / 2.0,
    )
