"""A course: a stretch of time in which nothing happens to an axis, so that its motion is known in closed form.

Its motor turns evenly; its nut lies on a flank, is lifted from it, or is in the slack between both; its slide moves one
way, or stands; its drive gives what the train takes, or all that the motor can. A course ends with an event, which says
what the next course is.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import compiled
from sim.table.drive import Drive
from sim.table.forms import (
    Coast,
    Oscillation,
    Pair,
    Span,
    Wave,
    coast_rises,
    coasted_s,
    coasting,
    pair_at,
    span_of,
    value_of,
    wave_of,
    wave_rises,
)

STILL_UM = 1e-6
"""Without friction a slide counts as standing where its ringing is smaller than this: way, and v / ω."""
_ROUNDING_UM = 1e-10
"""What passes a border by less than this, in lag, or in force over stiffness, has not passed it."""

LOOSE, DRIVEN, LIMITED = 0, 1, 2
"""Grips: the drive gives nothing, what its train takes, or all that its motor can."""

NOTHING, MEETS, SLACKENS, LIFTS, GRIPS, STANDS, STARTS, LIMITS, UNLIMITS, SLIPS, STOPS = range(11)
"""Events: a flank is met, the nut leaves the place where it lifted from it, lifts from it, is pushed by it again; the
slide comes to a stand, starts, meets a stop of the travel; the motor reaches its limit, comes back from it, or lags so
far that it slips or trips."""


class Body(NamedTuple):
    """What does not change about an axis.

    Attributes
    ----------
    drive, swings
        Its drive, and how its slide answers on it.
    low_um, high_um
        Ends of its travel.
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


class Event(NamedTuple):
    """What ends a course, after how long, s; a positive `way` where it happens towards higher places or lags."""

    after_s: float
    kind: int
    way: int


class End(NamedTuple):
    """How a course ends: by an event, before which it has come so far."""

    event: Event
    last: Course


@compiled("f8(Body)", Body)
def rubs_at(body: Body) -> float:
    """Largest force over the mass that does not move a slide which stands, µm/s²."""
    friction = body.drive.friction
    return friction if friction > 0.0 else STILL_UM * body.drive.spring


@compiled("f8(Body, i8, f8, f8)", Body)
def _train_force(body: Body, side: int, lag_um: float, lag_um_s: float) -> float:
    """What spring and damper of a drive train take, over the mass, while the nut lies on a flank."""
    drive = body.drive
    return drive.spring * (lag_um - side * drive.slack_um) + drive.damper * lag_um_s


@compiled("i8(Body, f8, f8, f8)", Body)
def _way_of(body: Body, at_um: float, velocity: float, force: float) -> int:
    """Which way a slide moves from now on: one that stands goes where it is pushed by more than friction."""
    if velocity != 0.0:
        return 1 if velocity > 0.0 else -1
    if abs(force) <= rubs_at(body):
        return 0
    if force > 0.0:
        return 1 if at_um < body.high_um else 0
    return -1 if at_um > body.low_um else 0


@compiled("(Body, Bounds, Course, i8)", Body, Bounds, Course)
def with_grip(body: Body, bounds: Bounds, course: Course, side: int) -> Course:
    """A course whose nut lies on a flank, or in the slack, with its grip, way and force worked out."""
    at_um, velocity, lag_um, motor_um_s = course.at_um, course.velocity, course.lag_um, course.motor_um_s
    force, grip = 0.0, LOOSE
    if side != 0:
        force, grip = _train_force(body, side, lag_um, motor_um_s - velocity), DRIVEN
        if body.drive.slack_um > 0.0 and force * side <= 0.0:  # a flank pushes, and never pulls
            force, grip = 0.0, LOOSE
        if abs(force) >= bounds.force:
            force, grip = math.copysign(bounds.force, force), LIMITED
    way = _way_of(body, at_um, velocity, force)
    return Course(at_um, velocity, lag_um, motor_um_s, Hold(side, grip, way), force, False)


@compiled("(Body, Bounds, Course)", Body, Bounds, Course)
def anew(body: Body, bounds: Bounds, course: Course) -> Course:
    """A course after something has jumped: speed of the motor, what it can do, or the place where it stands."""
    side, slack_um = 1, body.drive.slack_um
    if slack_um > 0.0:
        side = 0
        if abs(course.lag_um) > slack_um:
            side = 1 if course.lag_um > 0.0 else -1
    return with_grip(body, bounds, course, side)


@compiled("f8(Body, Course)", Body, Course)
def _rub(body: Body, course: Course) -> float:
    """Coulomb friction against the motion, over the mass."""
    return 0.0 if course.braked else course.hold.way * body.drive.friction


@compiled("f8(Body, Course)", Body, Course)
def _drag(body: Body, course: Course) -> float:
    """What brakes with speed, 1/s: guides, and the train once a servo has tripped."""
    return body.drive.viscous + (body.drive.damper if course.braked else 0.0)


@compiled("f8(Body, Course)", Body, Course)
def acceleration_of(body: Body, course: Course) -> float:
    """Acceleration at the beginning of a course, µm/s²."""
    if course.hold.way == 0:
        return 0.0
    return course.force - _rub(body, course) - _drag(body, course) * course.velocity


@compiled("f8(Body, Course)", Body, Course)
def rest_lag(body: Body, course: Course) -> float:
    """Lag at which a driven slide would go on evenly, µm."""
    drive = body.drive
    even = drive.viscous * course.motor_um_s + _rub(body, course)
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


@compiled("(Body, Course)", Body, Course, Lagging)
def lagging_of(body: Body, course: Course) -> Lagging:
    """How a driven slide lags at the beginning of a course."""
    return Lagging(course.lag_um - rest_lag(body, course), course.motor_um_s - course.velocity)


@compiled("f8(Form, Lagging)", Form, Lagging)
def value_in(form: Form, lagging: Lagging) -> float:
    """Value of a quantity."""
    return form.level + form.by_lag * lagging.lag_um + form.by_speed * lagging.lag_um_s


@compiled("f8(Oscillation, Form, Lagging)", Oscillation, Form, Lagging)
def slope_in(swings: Oscillation, form: Form, lagging: Lagging) -> float:
    """How fast a quantity grows."""
    bent = -swings.spring * lagging.lag_um - swings.damping * lagging.lag_um_s
    return form.by_lag * lagging.lag_um_s + form.by_speed * bent


@compiled("(Oscillation, Form, Lagging)", Oscillation, Form, Lagging, Wave)
def wave_in(swings: Oscillation, form: Form, lagging: Lagging) -> Wave:
    """A quantity from the beginning of a course on."""
    away = form.by_lag * lagging.lag_um + form.by_speed * lagging.lag_um_s  # levels may be infinite
    return wave_of(swings, form.level, away, slope_in(swings, form, lagging))


@compiled("b1(Course)", Course)
def is_driven(course: Course) -> bool:
    """Whether a slide moves on its train: else it stands, or coasts."""
    return course.hold.way != 0 and course.hold.grip == DRIVEN and not course.braked


@compiled("(Body, Course, f8, Pair)", Body, Course, Pair)
def _driven_to(body: Body, course: Course, after_s: float, pair: Pair) -> Course:
    """A course of a driven slide as it has come to a time, at which both parts of its waves are given."""
    swings, rest_um, lagging, speed = body.swings, rest_lag(body, course), lagging_of(body, course), course.motor_um_s
    lag_um = rest_um + value_of(wave_in(swings, Form(0.0, 1.0, 0.0), lagging), pair)
    lag_um_s = value_of(wave_in(swings, Form(0.0, 0.0, 1.0), lagging), pair)
    at_um = course.at_um + speed * after_s - (lag_um - course.lag_um)
    force = _train_force(body, course.hold.side, lag_um, lag_um_s)
    return Course(at_um, speed - lag_um_s, lag_um, speed, course.hold, force, False)


@compiled("(Body, Course, f8)", Body, Course)
def moved(body: Body, course: Course, after_s: float) -> Course:
    """A course as it has come to a time within it."""
    at_um, velocity, lag_um, motor_um_s, hold, force, braked = course
    if is_driven(course):
        return _driven_to(body, course, after_s, pair_at(body.swings, after_s))
    if hold.way == 0:
        if hold.grip == DRIVEN:
            force += body.drive.spring * motor_um_s * after_s
        return Course(at_um, velocity, lag_um + motor_um_s * after_s, motor_um_s, hold, force, braked)
    passed, acceleration = coasting(_drag(body, course), after_s), acceleration_of(body, course)
    way_um = velocity * after_s + acceleration * passed.twice
    lag_um += motor_um_s * after_s - way_um
    return Course(at_um + way_um, velocity + acceleration * passed.once, lag_um, motor_um_s, hold, force, braked)


@compiled("(Event, f8, i8, i8)", Event)
def _sooner(event: Event, after_s: float, kind: int, way: int) -> Event:
    """The sooner of two events."""
    return Event(max(after_s, 0.0), kind, way) if after_s < event.after_s else event


@compiled("f8(f8, f8, f8)")
def _evenly(value: float, to: float, per_s: float) -> float:
    """Time in which a quantity that grows evenly comes to a value; infinite where it never does."""
    if per_s == 0.0 or (to - value) * per_s < 0.0:
        return math.inf
    return (to - value) / per_s


@compiled("(Body, Bounds, Course, f8)", Body, Bounds, Course, Event)
def _event_at_rest(body: Body, bounds: Bounds, course: Course, until_s: float) -> Event:
    """What ends a course in which a slide stands: all grows evenly."""
    drive, (side, grip, _), speed = body.drive, course.hold, course.motor_um_s
    event, lag_um, force = Event(until_s, NOTHING, 0), course.lag_um, course.force
    if speed == 0.0:
        return event
    way, by = (1 if speed > 0.0 else -1), drive.spring * speed
    event = _sooner(event, _evenly(lag_um, way * bounds.lag_um, speed), SLIPS, way)
    if side == 0:
        event = _sooner(event, _evenly(lag_um, way * drive.slack_um, speed), MEETS, way)
    elif grip == LOOSE and side == way:
        event = _sooner(event, _evenly(_train_force(body, side, lag_um, speed), 0.0, by), GRIPS, side)
    elif grip == LOOSE:
        event = _sooner(event, _evenly(lag_um, side * drive.slack_um, speed), SLACKENS, side)
    elif grip == LIMITED and force * by < 0.0:
        full = math.copysign(bounds.force, force)
        event = _sooner(event, _evenly(_train_force(body, side, lag_um, speed), full, by), UNLIMITS, way)
    elif grip == DRIVEN:
        event = _sooner(event, _evenly(force, way * bounds.force, by), LIMITS, way)
        if drive.slack_um > 0.0 and side != way:
            event = _sooner(event, _evenly(force, 0.0, by), LIFTS, side)
        if course.at_um < body.high_um if way > 0 else course.at_um > body.low_um:
            event = _sooner(event, _evenly(force, way * rubs_at(body), by), STARTS, way)
    return event


@compiled("(Body, Bounds, Course, f8)", Body, Bounds, Course, Event)
def _event_coasting(body: Body, bounds: Bounds, course: Course, until_s: float) -> Event:
    """What ends a course in which a slide coasts, but for the stops of the travel."""
    drive, (side, grip, _), drag = body.drive, course.hold, _drag(body, course)
    velocity, lag_um, bend = course.velocity, course.lag_um, acceleration_of(body, course)
    event = Event(until_s, NOTHING, 0)
    if velocity * bend < 0.0:
        event = _sooner(event, coasted_s(drag, -velocity / bend), STANDS, 0)
    if course.braked:
        return event
    lag_um_s, slack_um, least = course.motor_um_s - velocity, drive.slack_um, _ROUNDING_UM
    for way in (1, -1):
        if abs(lag_um) + (abs(lag_um_s) + abs(bend) * until_s) * until_s > bounds.lag_um:
            slipping = Coast(way * lag_um - bounds.lag_um, way * lag_um_s, -way * bend)
            event = _sooner(event, coast_rises(drag, slipping, event.after_s, least), SLIPS, way)
        if side == 0:
            meeting = Coast(way * lag_um - slack_um, way * lag_um_s, -way * bend)
            event = _sooner(event, coast_rises(drag, meeting, event.after_s, 0.0), MEETS, way)
    if side == 0:
        return event
    # Spring on the lag, damper on its speed, which falls by bend · once, where once = t - drag · twice.
    force = _train_force(body, side, lag_um, lag_um_s)
    by_s, bent = drive.spring * lag_um_s - drive.damper * bend, (drive.damper * drag - drive.spring) * bend
    if grip == LIMITED:
        full = 1 if course.force > 0.0 else -1
        giving = Coast(bounds.force - full * force, -full * by_s, -full * bent)
        return _sooner(event, coast_rises(drag, giving, event.after_s, least * drive.spring), UNLIMITS, full)
    slackening = Coast(slack_um - side * lag_um, -side * lag_um_s, side * bend)
    event = _sooner(event, coast_rises(drag, slackening, event.after_s, 0.0), SLACKENS, side)
    pushing = Coast(side * force, side * by_s, side * bent)
    return _sooner(event, coast_rises(drag, pushing, event.after_s, least * drive.spring), GRIPS, side)


@compiled("(Body, Bounds, Course, Span)", Body, Bounds, Course, Span, Event)
def _event_driven(body: Body, bounds: Bounds, course: Course, span: Span) -> Event:
    """What ends a course in which a slide moves on its train, but for the stops of the travel."""
    drive, swings, (side, _, way) = body.drive, body.swings, course.hold
    event, least, lagging = Event(span.until_s, NOTHING, 0), _ROUNDING_UM * drive.spring, lagging_of(body, course)
    rest_um = rest_lag(body, course)
    stopping = wave_in(swings, Form(-way * course.motor_um_s, 0.0, float(way)), lagging)
    event = _sooner(event, wave_rises(swings, stopping, span, _ROUNDING_UM * swings.rate), STANDS, 0)
    even = drive.spring * (rest_um - side * drive.slack_um)
    if drive.slack_um > 0.0:
        lifting = wave_in(swings, Form(-side * even, -side * drive.spring, -side * drive.damper), lagging)
        event = _sooner(event, wave_rises(swings, lifting, span, least), LIFTS, side)
    for full in (1, -1):
        limited = wave_in(swings, Form(full * even - bounds.force, full * drive.spring, full * drive.damper), lagging)
        event = _sooner(event, wave_rises(swings, limited, span, least), LIMITS, full)
        slipping = wave_in(swings, Form(full * rest_um - bounds.lag_um, float(full), 0.0), lagging)
        event = _sooner(event, wave_rises(swings, slipping, span, _ROUNDING_UM), SLIPS, full)
    return event


@compiled("(Body, Course, End)", Body, Course, End)
def _or_stop(body: Body, course: Course, end: End) -> End:
    """An end, or that a slide meets a stop of its travel before: until it stands it goes one way."""
    at_um = end.last.at_um
    if body.low_um <= at_um <= body.high_um:
        return end
    way = 1 if at_um > body.high_um else -1
    stop_um, low_s, high_s = (body.high_um if way > 0 else body.low_um), 0.0, end.event.after_s
    while low_s < (low_s + high_s) / 2.0 < high_s:
        middle_s = (low_s + high_s) / 2.0
        if (moved(body, course, middle_s).at_um - stop_um) * way > 0.0:
            high_s = middle_s
        else:
            low_s = middle_s
    return End(Event(high_s, STOPS, way), moved(body, course, high_s))


@compiled("(Body, Bounds, Course, f8)", Body, Bounds, Course, End)
def end_of(body: Body, bounds: Bounds, course: Course, until_s: float) -> End:
    """The end of a course that can last until a time after its beginning."""
    if is_driven(course):
        span = span_of(body.swings, until_s)
        event = _event_driven(body, bounds, course, span)
        if event.kind == NOTHING:
            return _or_stop(body, course, End(event, _driven_to(body, course, until_s, span.last)))
    elif course.hold.way != 0:
        event = _event_coasting(body, bounds, course, until_s)
    elif course.braked:
        event = Event(until_s, NOTHING, 0)
    else:
        event = _event_at_rest(body, bounds, course, until_s)
    return _or_stop(body, course, End(event, moved(body, course, event.after_s)))


@compiled("(Body, Bounds, Course, Event)", Body, Bounds, Course, Event)
def after_event(body: Body, bounds: Bounds, course: Course, event: Event) -> Course:
    """The course that an event begins; `course` is the one before it as it has come to the event."""
    at_um, velocity, lag_um, motor_um_s, (side, grip, way), force, braked = course
    kind, slack_um = event.kind, body.drive.slack_um
    if kind in (STANDS, STOPS):
        return _stood(body, bounds, course, event)
    if kind == MEETS:
        meets = Course(at_um, velocity, event.way * slack_um, motor_um_s, Hold(event.way, grip, way), force, braked)
        return with_grip(body, bounds, meets, event.way)
    if kind == STARTS:
        velocity, way = 0.0, event.way
    elif kind == SLACKENS:
        lag_um, side, grip, force = side * slack_um, 0, LOOSE, 0.0
    elif kind == LIFTS:
        grip, force = LOOSE, 0.0
    elif kind == LIMITS:
        grip, force = LIMITED, math.copysign(bounds.force, force)
    elif kind == UNLIMITS:
        grip = DRIVEN
    elif kind == GRIPS:
        grip, force = DRIVEN, 0.0
    return Course(at_um, velocity, lag_um, motor_um_s, Hold(side, grip, way), force, braked)


@compiled("(Body, Bounds, Course, Event)", Body, Bounds, Course, Event)
def _stood(body: Body, bounds: Bounds, course: Course, event: Event) -> Course:
    """A course whose slide has come to a stand, by itself or at a stop: it stays, or is pushed back."""
    at_um, _, lag_um, motor_um_s, (side, grip, _), force, braked = course
    if braked:
        return Course(at_um, 0.0, lag_um, motor_um_s, Hold(side, grip, 0), 0.0, braked)
    if event.kind == STOPS:
        stop_um = body.high_um if event.way > 0 else body.low_um
        return anew(body, bounds, Course(stop_um, 0.0, lag_um, motor_um_s, Hold(side, grip, 0), force, braked))
    hold = Hold(side, grip, _way_of(body, at_um, 0.0, force))
    return Course(at_um, 0.0, lag_um, motor_um_s, hold, force, braked)
