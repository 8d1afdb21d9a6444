"""Events: what ends a course, when the first of them comes, and which course it begins.

An event is the first root of a closed form; those that no form can reach in time are left out by its amplitude.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import loop_part
from sim.table.course import (
    DRIVEN,
    LIMITED,
    LOOSE,
    Body,
    Bounds,
    Course,
    Form,
    Hold,
    acceleration_of,
    anew,
    drag_of,
    driven_to,
    is_driven,
    lagging_of,
    moved,
    rest_lag,
    rubs_at,
    train_force,
    wave_in,
    way_of,
    with_grip,
)
from sim.table.forms import Coast, Span, coast_rises, coasted_s, span_of, wave_rises

NOTHING, MEETS, SLACKENS, LIFTS, GRIPS, STANDS, STARTS, LIMITS, UNLIMITS, SLIPS, STOPS = range(11)
"""Events: a flank is met, the nut leaves the place where it lifted from it, lifts from it, is pushed by it again; the
slide comes to a stand, starts, meets a stop of the travel; the motor reaches its limit, comes back from it, or lags so
far that it slips or trips."""
_ROUNDING_UM = 1e-10
"""What passes a border by less than this, in lag, or in force over stiffness, has not passed it."""


class Event(NamedTuple):
    """What ends a course, after how long, s; a positive `way` where it happens towards higher places or lags."""

    after_s: float
    kind: int
    way: int


class End(NamedTuple):
    """How a course ends: by an event, before which it has come so far."""

    event: Event
    last: Course


@loop_part("(Event, f8, i8, i8)", Event)
def _sooner(event: Event, after_s: float, kind: int, way: int) -> Event:
    """The sooner of two events."""
    return Event(max(after_s, 0.0), kind, way) if after_s < event.after_s else event


@loop_part("f8(f8, f8, f8)")
def _evenly(value: float, to: float, per_s: float) -> float:
    """Time in which a quantity that grows evenly comes to a value; infinite where it never does."""
    if per_s == 0.0 or (to - value) * per_s < 0.0:
        return math.inf
    return (to - value) / per_s


@loop_part("(Body, Bounds, Course, f8)", Body, Bounds, Course, Event)
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
        event = _sooner(event, _evenly(train_force(body, side, lag_um, speed), 0.0, by), GRIPS, side)
    elif grip == LOOSE:
        event = _sooner(event, _evenly(lag_um, side * drive.slack_um, speed), SLACKENS, side)
    elif grip == LIMITED and force * by < 0.0:
        full = math.copysign(bounds.force, force)
        event = _sooner(event, _evenly(train_force(body, side, lag_um, speed), full, by), UNLIMITS, way)
    elif grip == DRIVEN:
        event = _sooner(event, _evenly(force, way * bounds.force, by), LIMITS, way)
        if drive.slack_um > 0.0 and side != way:
            event = _sooner(event, _evenly(force, 0.0, by), LIFTS, side)
        if course.at_um < body.high_um if way > 0 else course.at_um > body.low_um:
            event = _sooner(event, _evenly(force, way * rubs_at(body), by), STARTS, way)
    return event


@loop_part("(Body, Bounds, Course, f8)", Body, Bounds, Course, Event)
def _event_coasting(body: Body, bounds: Bounds, course: Course, until_s: float) -> Event:
    """What ends a course in which a slide coasts, but for the stops of the travel."""
    drive, (side, grip, _), drag = body.drive, course.hold, drag_of(body, course)
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
    force = train_force(body, side, lag_um, lag_um_s)
    by_s, bent = drive.spring * lag_um_s - drive.damper * bend, (drive.damper * drag - drive.spring) * bend
    if grip == LIMITED:
        full = 1 if course.force > 0.0 else -1
        giving = Coast(bounds.force - full * force, -full * by_s, -full * bent)
        return _sooner(event, coast_rises(drag, giving, event.after_s, least * drive.spring), UNLIMITS, full)
    slackening = Coast(slack_um - side * lag_um, -side * lag_um_s, side * bend)
    event = _sooner(event, coast_rises(drag, slackening, event.after_s, 0.0), SLACKENS, side)
    pushing = Coast(side * force, side * by_s, side * bent)
    return _sooner(event, coast_rises(drag, pushing, event.after_s, least * drive.spring), GRIPS, side)


@loop_part("(Body, Bounds, Course, Span)", Body, Bounds, Course, Span, Event)
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


@loop_part("(Body, Course, End)", Body, Course, End)
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


@loop_part("(Body, Bounds, Course, f8)", Body, Bounds, Course, End)
def end_of(body: Body, bounds: Bounds, course: Course, until_s: float) -> End:
    """The end of a course that can last until a time after its beginning."""
    if is_driven(course):
        span = span_of(body.swings, until_s)
        event = _event_driven(body, bounds, course, span)
        if event.kind == NOTHING:
            return _or_stop(body, course, End(event, driven_to(body, course, until_s, span.last)))
    elif course.hold.way != 0:
        event = _event_coasting(body, bounds, course, until_s)
    elif course.braked:
        event = Event(until_s, NOTHING, 0)
    else:
        event = _event_at_rest(body, bounds, course, until_s)
    return _or_stop(body, course, End(event, moved(body, course, event.after_s)))


@loop_part("(Body, Bounds, Course, Event)", Body, Bounds, Course, Event)
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


@loop_part("(Body, Bounds, Course, Event)", Body, Bounds, Course, Event)
def _stood(body: Body, bounds: Bounds, course: Course, event: Event) -> Course:
    """A course whose slide has come to a stand, by itself or at a stop: it stays, or is pushed back."""
    at_um, _, lag_um, motor_um_s, (side, grip, _), force, braked = course
    if braked:
        return Course(at_um, 0.0, lag_um, motor_um_s, Hold(side, grip, 0), 0.0, braked)
    if event.kind == STOPS:
        stop_um = body.high_um if event.way > 0 else body.low_um
        return anew(body, bounds, Course(stop_um, 0.0, lag_um, motor_um_s, Hold(side, grip, 0), force, braked))
    hold = Hold(side, grip, way_of(body, at_um, 0.0, force))
    return Course(at_um, 0.0, lag_um, motor_um_s, hold, force, braked)
