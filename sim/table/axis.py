"""One axis of the table, from event to event: what it is, what it is asked for, how far it has come, what is next.

Besides the events of its course (`sim.table.events`) something happens where its motor begins or ends a step, where
its step rate is taken anew, and where a servo of the table trips.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import loop_part
from sim.table.course import LIMITED, LOOSE, STILL_UM, Body, Bounds, Course, Hold, anew
from sim.table.events import NOTHING, SLIPS, after_event, end_of
from sim.table.rating import Rating, Strength, rated
from sim.table.turning import Loop, Train, Turn, away_um, corner_s, is_closed, is_idle, steered, turned

_BRAKED_TO = 1e-6
"""A slide that brakes counts as standing once it is this slow, µm/s."""


class Axis(NamedTuple):
    """What an axis is.

    Attributes
    ----------
    body, strength
        Its drive and its travel, and what its motor can do.
    loop
        The position loop that is closed about it, if one is.
    step_time_s
        Time that the motor takes for a step; the period of a loop that is closed.
    trip_um
        Following error at which a servo trips; infinite for a stepper.
    speed_limit_um_s
        Speed limit, for its peak; infinite where there is none.
    """

    body: Body
    strength: Strength
    loop: Loop
    step_time_s: float
    trip_um: float
    speed_limit_um_s: float


class AxisDemand(NamedTuple):
    """What an axis is asked for.

    Attributes
    ----------
    train
        Its pulses, as far as they are known.
    braked_s
        When a servo of the table tripped: then both are braked; infinite where none did.
    until_s
        Time up to which the pulses lead.
    """

    train: Train
    braked_s: float
    until_s: float


class Noted(NamedTuple):
    """How far the record of an axis is: the next sample, bin and slip, pulses commanded, and courses in all."""

    sample: int
    bin: int
    slip: int
    commanded: int
    courses: int


class State(NamedTuple):
    """How far an axis has come.

    Attributes
    ----------
    t_s
        Now.
    course
        Its course from now on.
    lost_um
        Way that the motor has lost so far: how far it stands behind the place commanded.
    rests
        Whether it stands until its motor turns again.
    turn, rating, noted
        Where its motor stands, what it can do, and how far its record is.
    tripped_s
        When its servo tripped; infinite where it did not.
    """

    t_s: float
    course: Course
    lost_um: float
    rests: bool
    turn: Turn
    rating: Rating
    noted: Noted
    tripped_s: float

    @property
    def at_um(self) -> float:
        """Place of the slide."""
        return self.course.at_um

    @property
    def lag_um(self) -> float:
        """Its lag behind the motor."""
        return self.course.lag_um


class Leg(NamedTuple):
    """What an axis does next: its course as it begins and as it ends, for how long, and the state after that."""

    course: Course
    last: Course
    after_s: float
    state: State


def standing(at_um: float) -> Course:
    """The course of a slide that stands at a place, its motor there too."""
    return Course(at_um, 0.0, 0.0, 0.0, Hold(0, LOOSE, 0), 0.0, False)


@loop_part("(Axis, AxisDemand, Rating)", Axis, AxisDemand, Rating)
def bounds_of(axis: Axis, demand: AxisDemand, rating: Rating) -> Bounds:
    """What its motor can do at its step rate. Where a servo is known to have tripped, none trips before it.

    A position loop trips by what it looks at, when it looks.
    """
    trips = demand.braked_s == math.inf and not is_closed(axis.loop)
    trip_um = axis.trip_um if trips else math.inf
    return Bounds(rating.limit, min(rating.pull_out_um, trip_um))


@loop_part("(Axis, Course, f8)", Axis, Course)
def _slipped(axis: Axis, course: Course, pull_out_um: float) -> Course:
    """A course after its motor has slipped: whole electrical periods, until the lag is within the pull-out again."""
    period_um = axis.strength.period_um
    beyond = math.ceil((abs(course.lag_um) - pull_out_um) / period_um)
    lag_um = course.lag_um - math.copysign(max(beyond, 1.0) * period_um, course.lag_um)
    return Course(course.at_um, course.velocity, lag_um, course.motor_um_s, course.hold, course.force, course.braked)


@loop_part("(Course,)", Course)
def _braked(course: Course) -> Course:
    """A course from where a servo has tripped on, or has braked for some time."""
    velocity = course.velocity if abs(course.velocity) > 2.0 * _BRAKED_TO else 0.0
    way = 0 if velocity == 0.0 else (1 if velocity > 0.0 else -1)
    return Course(course.at_um, velocity, course.lag_um, course.motor_um_s, Hold(0, LOOSE, way), 0.0, True)


@loop_part("(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def turned_to(axis: Axis, demand: AxisDemand, state: State) -> State:
    """An axis whose motor has begun and ended the steps that are due, and what it can do is known for now."""
    t_s, course, noted = state.t_s, state.course, state.noted
    rating = state.rating
    if t_s >= rating.until_s:
        rating = rated(axis.strength, demand.train, rating, t_s)
    if is_closed(axis.loop):
        turn = steered(axis.loop, demand.train, state.turn, course.at_um, t_s)
    else:
        turn = turned(demand.train, axis.step_time_s, state.turn, t_s)
    speed = turn.rising_um / axis.step_time_s if turn.rising_um != 0.0 else 0.0
    commanded = noted.commanded
    while demand.train.t_s[commanded] <= t_s:
        commanded += 1
    noted = Noted(noted.sample, noted.bin, noted.slip, commanded, noted.courses)
    if t_s >= demand.braked_s:
        braked = _braked(course)
        return State(t_s, braked, state.lost_um, braked.hold.way == 0, turn, rating, noted, state.tripped_s)
    lag_um = turn.place_um - state.lost_um - course.at_um
    course = Course(course.at_um, course.velocity, lag_um, speed, course.hold, course.force, False)
    bounds, lost_um, tripped_s = bounds_of(axis, demand, rating), state.lost_um, state.tripped_s
    if abs(lag_um) > bounds.lag_um:
        if axis.trip_um < math.inf:
            tripped_s = min(t_s, tripped_s)
        else:
            course = _slipped(axis, course, bounds.lag_um)
            lost_um += lag_um - course.lag_um
    elif is_closed(axis.loop) and abs(away_um(axis.loop, demand.train, turn, course.at_um)) > axis.trip_um:
        tripped_s = min(t_s, tripped_s) if demand.braked_s == math.inf else tripped_s
    following = anew(axis.body, bounds, course)
    return _stilled(axis, demand, State(t_s, following, lost_um, False, turn, rating, noted, tripped_s))


@loop_part("(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def _stilled(axis: Axis, demand: AxisDemand, state: State) -> State:
    """An axis that rests, where its slide stands and its motor does: without friction once it rings ever so little."""
    course, drive = state.course, axis.body.drive
    idle = is_idle(axis.loop, demand.train, state.turn, course.at_um)
    way = course.hold.way
    if idle and way != 0 and drive.friction == 0.0 and course.hold.grip != LIMITED:
        still = abs(course.velocity) < STILL_UM * math.sqrt(drive.spring)
        if still and abs(course.force) < STILL_UM * drive.spring:
            hold = Hold(course.hold.side, course.hold.grip, 0)
            course = Course(course.at_um, 0.0, course.lag_um, course.motor_um_s, hold, course.force, False)
            way = 0
    # At a standstill the motor can do more than at its last step rate.
    may_give_way = abs(course.force) >= state.rating.limit and state.rating.limit < axis.strength.limit[0]
    rests = idle and way == 0 and not may_give_way
    return State(state.t_s, course, state.lost_um, rests, state.turn, state.rating, state.noted, state.tripped_s)


@loop_part("(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def next_leg(axis: Axis, demand: AxisDemand, state: State) -> Leg:
    """What an axis does up to its next event, and its state after that.

    A course that ends between two corners goes on with the next one; at a corner it begins anew.
    """
    course, bounds = state.course, bounds_of(axis, demand, state.rating)
    due_s = min(corner_s(axis.loop, axis.step_time_s, demand.train, state.turn), state.rating.until_s)
    if course.braked:
        slows_s = math.log(abs(course.velocity) / _BRAKED_TO) / (axis.body.drive.damper + axis.body.drive.viscous)
        due_s = state.t_s + slows_s
    else:
        due_s = min(due_s, demand.braked_s)
    (event, last), noted = end_of(axis.body, bounds, course, due_s - state.t_s), state.noted
    noted = Noted(noted.sample, noted.bin, noted.slip, noted.commanded, noted.courses + 1)
    turn, tripped_s, lost_um = state.turn, state.tripped_s, state.lost_um
    if event.kind == NOTHING:
        ended = State(due_s, last, lost_um, False, turn, state.rating, noted, tripped_s)
        return Leg(course, last, event.after_s, turned_to(axis, demand, ended))
    t_s = state.t_s + event.after_s
    if event.kind == SLIPS and axis.trip_um < math.inf:
        tripped = State(t_s, last, lost_um, False, turn, state.rating, noted, min(t_s, tripped_s))
        return Leg(course, last, event.after_s, tripped)
    if event.kind == SLIPS:
        slipped = _slipped(axis, last, bounds.lag_um)
        lost_um += last.lag_um - slipped.lag_um
        following = anew(axis.body, bounds, slipped)
    else:
        following = after_event(axis.body, bounds, last, event)
    ended = State(t_s, following, lost_um, False, turn, state.rating, noted, tripped_s)
    return Leg(course, last, event.after_s, _stilled(axis, demand, ended))
