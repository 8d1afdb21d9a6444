"""The table as bodies, the state of a slide between two ticks, and the force law of its drive.

The table as bodies in a pymunk space: a saddle on X guides carries a carriage on Y guides, with stops at their ends.

The engine's lengths are µm, its masses kg. Its clock counts ticks, and a velocity is the way in a tick: so each axis
may have ticks of its own.

The force law of a drive: spring and damper of the train across a dead zone, limited in force, against friction.

A tick is one leapfrog kick, second order in the tick and without drift of energy (E. Hairer, C. Lubich, G. Wanner,
"Geometric numerical integration illustrated by the Störmer-Verlet method", Acta Numerica 12, 2003).
"""

import math
from typing import NamedTuple

import pymunk

from controller.compiled.loops import compiled
from parser.controller_words import Axis
from parser.geometry.curves import Floats
from sim.base.units import engine_force, engine_stiffness, engine_viscosity
from sim.setup.machine.machine import TableModel


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


_ITERATIONS = 400  # guides hold at right angles; a stop has to take the velocity of both bodies, whatever their masses


class Bodies:
    """Saddle and carriage, standing at a place; `room_um` (2, 2) are the lowest and the highest place of the travel."""

    def __init__(self, model: TableModel, room_um: Floats, at_um: tuple[float, float]) -> None:
        self._space = pymunk.Space()
        self._space.iterations = _ITERATIONS
        self._saddle = pymunk.Body(model.saddle_mass_kg, float("inf"))
        self._carriage = pymunk.Body(model.carriage_mass_kg, float("inf"))
        self._saddle.position, self._carriage.position = (at_um[0], 0.0), at_um
        self._moved_kg, self._room = model.moved_kg, room_um.tolist()
        (left, bottom), (right, top) = self._room
        ground = self._space.static_body
        self._space.add(
            self._saddle,
            self._carriage,
            pymunk.GrooveJoint(ground, self._saddle, (left, 0.0), (right, 0.0), (0.0, 0.0)),
            pymunk.GrooveJoint(self._saddle, self._carriage, (0.0, bottom), (0.0, top), (0.0, 0.0)),
        )

    def moved_um(self, axis: Axis, slide: Slide, way_um: float) -> float:
        """Where an axis is after a tick in which its drive pushes its slide to go a way; no farther than its stops.

        A step of the engine moves the bodies first and pushes them then. So the slide is put to where it was a tick
        before; it comes from there, and is pushed.
        """
        came_um = slide.velocity * slide.tick_s
        driven = self._saddle if axis is Axis.X else self._carriage
        for body in (self._saddle, self._carriage):
            place, velocity = list(body.position), [0.0, 0.0]
            if body is driven or axis is Axis.X:
                place[axis], velocity[axis] = slide.at_um - came_um, came_um
            body.position, body.velocity = (place[0], place[1]), (velocity[0], velocity[1])
        push = (way_um - came_um) * self._moved_kg[axis]
        driven.force = (push, 0.0) if axis is Axis.X else (0.0, push)
        self._space.step(1.0)
        reached_um = self._carriage.position[axis] + self._carriage.velocity[axis]
        low, high = self._room
        return float(min(max(reached_um, low[axis]), high[axis]))


_STILL_UM = 1e-9


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


@compiled("f8(f8, f8)")
def _past(lag_um: float, slack_um: float) -> float:
    """How far a lag lies past the slack."""
    if lag_um > slack_um:
        return lag_um - slack_um
    return lag_um + slack_um if lag_um < -slack_um else 0.0


@compiled("f8(f8, f8)")
def _rubbed(velocity: float, most: float) -> float:
    """Velocity after Coulomb friction has taken `most` of it, and never more than all: then the slide sticks."""
    if velocity > most:
        return velocity - most
    return velocity + most if velocity < -most else 0.0


@compiled("(f8, f8, f8)")
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


@compiled("(Drive, Kick)", Drive, Kick)
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
