"""A course: a stretch of time in which nothing happens to an axis, so that its motion is known in closed form.

Its motor turns evenly; its nut lies on a flank, is lifted from it, or is in the slack between both; its slide moves one
way, or stands; its drive gives what the train takes, or all that the motor can. `sim.table.events` knows what ends it.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import loop_part
from sim.table.drive import Drive
from sim.table.forms import Oscillation, Pair, Wave, coasting, pair_at, value_of, wave_of

STILL_UM = 1e-6
"""Without friction a slide counts as standing where its ringing is smaller than this: way, and v / ω."""
LOOSE, DRIVEN, LIMITED = 0, 1, 2
"""Grips: the drive gives nothing, what its train takes, or all that its motor can."""


class Body(NamedTuple):
    """What does not change about an axis.

    Attributes
    ----------
    drive, swings
        Its drive, and how its slide answers on it.
    low_um, high_um
        Ends of its travel, µm.
    """

    drive: Drive
    swings: Oscillation
    low_um: float
    high_um: float


class Bounds(NamedTuple):
    """What a motor can do for now: largest force over the mass, µm/s², and the lag at which it slips or trips, µm."""

    force: float
    lag_um: float


class Hold(NamedTuple):
    """How a slide is held.

    Attributes
    ----------
    side
        Flank on which the nut lies, or from which it was lifted: 1 where the slide lags, -1, 0 between both.
    grip
        What the drive gives.
    way
        Which way the slide moves, 0 where it stands.
    """

    side: int
    grip: int
    way: int


class Course(NamedTuple):
    """A course as it begins.

    Attributes
    ----------
    at_um, velocity
        Place of the slide, and its velocity, µm/s.
    lag_um, motor_um_s
        Its lag behind the motor, and the speed of the motor.
    hold
        How it is held.
    force
        Of the drive over the mass, µm/s².
    braked
        Whether a servo has tripped: nothing drives, and the axis brakes.
    """

    at_um: float
    velocity: float
    lag_um: float
    motor_um_s: float
    hold: Hold
    force: float
    braked: bool


@loop_part("f8(Body)", Body)
def rubs_at(body: Body) -> float:
    """Largest force over the mass that does not move a slide which stands, µm/s²."""
    friction = body.drive.friction
    return friction if friction > 0.0 else STILL_UM * body.drive.spring


@loop_part("f8(Body, i8, f8, f8)", Body)
def train_force(body: Body, side: int, lag_um: float, lag_um_s: float) -> float:
    """What spring and damper of a drive train take, over the mass, µm/s², while the nut lies on a flank."""
    drive = body.drive
    return drive.spring * (lag_um - side * drive.slack_um) + drive.damper * lag_um_s


@loop_part("i8(Body, f8, f8, f8)", Body)
def way_of(body: Body, at_um: float, velocity: float, force: float) -> int:
    """Which way a slide moves from now on: one that stands goes where it is pushed by more than friction."""
    if velocity != 0.0:
        return 1 if velocity > 0.0 else -1
    if abs(force) <= rubs_at(body):
        return 0
    if force > 0.0:
        return 1 if at_um < body.high_um else 0
    return -1 if at_um > body.low_um else 0


@loop_part("(Body, Bounds, Course, i8)", Body, Bounds, Course)
def with_grip(body: Body, bounds: Bounds, course: Course, side: int) -> Course:
    """A course whose nut lies on a flank, or in the slack, with its grip, way and force worked out."""
    at_um, velocity, lag_um, motor_um_s = course.at_um, course.velocity, course.lag_um, course.motor_um_s
    force, grip = 0.0, LOOSE
    if side != 0:
        force, grip = train_force(body, side, lag_um, motor_um_s - velocity), DRIVEN
        if body.drive.slack_um > 0.0 and force * side <= 0.0:  # a flank pushes, and never pulls
            force, grip = 0.0, LOOSE
        if abs(force) >= bounds.force:
            force, grip = math.copysign(bounds.force, force), LIMITED
    way = way_of(body, at_um, velocity, force)
    return Course(at_um, velocity, lag_um, motor_um_s, Hold(side, grip, way), force, False)


@loop_part("(Body, Bounds, Course)", Body, Bounds, Course)
def anew(body: Body, bounds: Bounds, course: Course) -> Course:
    """A course after something has jumped: speed of the motor, what it can do, or the place where it stands."""
    side, slack_um = 1, body.drive.slack_um
    if slack_um > 0.0:
        side = 0
        if abs(course.lag_um) > slack_um:
            side = 1 if course.lag_um > 0.0 else -1
    return with_grip(body, bounds, course, side)


@loop_part("f8(Body, Course)", Body, Course)
def rub_of(body: Body, course: Course) -> float:
    """Coulomb friction against the motion, over the mass, µm/s²."""
    return 0.0 if course.braked else course.hold.way * body.drive.friction


@loop_part("f8(Body, Course)", Body, Course)
def drag_of(body: Body, course: Course) -> float:
    """What brakes with speed, 1/s: guides, and the train once a servo has tripped."""
    return body.drive.viscous + (body.drive.damper if course.braked else 0.0)


@loop_part("f8(Body, Course)", Body, Course)
def acceleration_of(body: Body, course: Course) -> float:
    """Acceleration at the beginning of a course, µm/s²."""
    if course.hold.way == 0:
        return 0.0
    return course.force - rub_of(body, course) - drag_of(body, course) * course.velocity


@loop_part("f8(Body, Course)", Body, Course)
def rest_lag(body: Body, course: Course) -> float:
    """Lag at which a driven slide would go on evenly, µm."""
    drive = body.drive
    even = drive.viscous * course.motor_um_s + rub_of(body, course)
    return course.hold.side * drive.slack_um + even / drive.spring


class Form(NamedTuple):
    """A quantity of a driven slide: level + by_lag · (lag less that at which it rests) + by_speed · (its speed)."""

    level: float
    by_lag: float
    by_speed: float


class Lagging(NamedTuple):
    """Lag of a driven slide less that at which it would go on evenly, µm, and the speed of its lag, µm/s."""

    lag_um: float
    lag_um_s: float


@loop_part("(Body, Course)", Body, Course, Lagging)
def lagging_of(body: Body, course: Course) -> Lagging:
    """How a driven slide lags at the beginning of a course."""
    return Lagging(course.lag_um - rest_lag(body, course), course.motor_um_s - course.velocity)


@loop_part("f8(Form, Lagging)", Form, Lagging)
def value_in(form: Form, lagging: Lagging) -> float:
    """Value of a quantity."""
    return form.level + form.by_lag * lagging.lag_um + form.by_speed * lagging.lag_um_s


@loop_part("f8(Oscillation, Form, Lagging)", Oscillation, Form, Lagging)
def slope_in(swings: Oscillation, form: Form, lagging: Lagging) -> float:
    """How fast a quantity grows."""
    bent = -swings.spring * lagging.lag_um - swings.damping * lagging.lag_um_s
    return form.by_lag * lagging.lag_um_s + form.by_speed * bent


@loop_part("(Oscillation, Form, Lagging)", Oscillation, Form, Lagging, Wave)
def wave_in(swings: Oscillation, form: Form, lagging: Lagging) -> Wave:
    """A quantity from the beginning of a course on."""
    away = form.by_lag * lagging.lag_um + form.by_speed * lagging.lag_um_s  # levels may be infinite
    return wave_of(swings, form.level, away, slope_in(swings, form, lagging))


@loop_part("b1(Course)", Course)
def is_driven(course: Course) -> bool:
    """Whether a slide moves on its train: else it stands, or coasts."""
    return course.hold.way != 0 and course.hold.grip == DRIVEN and not course.braked


@loop_part("(Body, Course, f8, Pair)", Body, Course, Pair)
def driven_to(body: Body, course: Course, after_s: float, pair: Pair) -> Course:
    """A course of a driven slide as it has come to a time, at which both parts of its waves are given."""
    swings, rest_um, lagging, speed = body.swings, rest_lag(body, course), lagging_of(body, course), course.motor_um_s
    lag_um = rest_um + value_of(wave_in(swings, Form(0.0, 1.0, 0.0), lagging), pair)
    lag_um_s = value_of(wave_in(swings, Form(0.0, 0.0, 1.0), lagging), pair)
    at_um = course.at_um + speed * after_s - (lag_um - course.lag_um)
    force = train_force(body, course.hold.side, lag_um, lag_um_s)
    return Course(at_um, speed - lag_um_s, lag_um, speed, course.hold, force, False)


@loop_part("(Body, Course, f8)", Body, Course)
def moved(body: Body, course: Course, after_s: float) -> Course:
    """A course as it has come to a time within it."""
    at_um, velocity, lag_um, motor_um_s, hold, force, braked = course
    if is_driven(course):
        return driven_to(body, course, after_s, pair_at(body.swings, after_s))
    if hold.way == 0:
        if hold.grip == DRIVEN:
            force += body.drive.spring * motor_um_s * after_s
        return Course(at_um, velocity, lag_um + motor_um_s * after_s, motor_um_s, hold, force, braked)
    passed, acceleration = coasting(drag_of(body, course), after_s), acceleration_of(body, course)
    way_um = velocity * after_s + acceleration * passed.twice
    lag_um += motor_um_s * after_s - way_um
    return Course(at_um + way_um, velocity + acceleration * passed.once, lag_um, motor_um_s, hold, force, braked)
