"""Swings: what a step from rest does until the slide rests again, stored, and used where the same begins again.

At the feeds of cutting a motor makes a step, its slide swings by half a period, friction stops it, and it stands until
the next step. What it does depends on the step and on the lag at which it stood. On a straight way both are the same
from step to step, so that nearly all swings of a run are one of a few.

Steps that come while the slide still swings are followed from event to event.
"""

import math
from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from sim.table.axis import Axis, AxisDemand, Leg, Noted, State, next_leg, turned_to
from sim.table.course import LIMITED, Course, Hold, moved
from sim.table.history import PEAKS, VALUES, PeakPlace, Record, take_peak, widened
from sim.table.rating import Rating, rated
from sim.table.recording import Part, bin_at, limits_of, peaked_of, recorded, recorded_part
from sim.table.store import COURSES, FIELDS, SWINGS, Swings
from sim.table.turning import Turn, is_closed, looks_at_s

ALIKE_UM = 1e-8
"""Lags that differ by less begin the same swing: rounding moves one by 1e-9 µm. The lag at which a stored swing ends is
taken as it is, so that what is left out does not add up."""
_CLASSES_PER_UM = 1e7
_ERROR = 3  # of the values of a bin: the following error


class AxisTask(NamedTuple):
    """An axis, what it is asked for, where what it does is recorded, and the swings that it has made so far."""

    axis: Axis
    demand: AxisDemand
    record: Record
    swings: Swings


class Swing(NamedTuple):
    """A swing that begins.

    Attributes
    ----------
    lag_um, step_um
        Lag at which the slide stands, and the step.
    free_until_s
        When another step begins, the step rate is taken anew, or a servo has tripped.
    bin
        Its bin.
    slot
        Where it is stored.
    """

    lag_um: float
    step_um: float
    free_until_s: float
    bin: int
    slot: int


@compiled("f8(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def due_s(axis: Axis, demand: AxisDemand, state: State) -> float:
    """When an axis has something to do: at its next pulse where it rests, or when its loop sees that one."""
    if not state.rests:
        return state.t_s
    if state.t_s >= demand.braked_s:
        return math.inf
    pulse_s = demand.train.t_s[state.turn.begun]
    return max(state.t_s, looks_at_s(axis.loop, pulse_s) if is_closed(axis.loop) else pulse_s)


@compiled("(State, f8)", State, Leg)
def waited(state: State, until_s: float) -> Leg:
    """What an axis does that rests until a time; its step rate is taken anew then."""
    rating, turn = state.rating, state.turn
    aged = Rating(rating.limit, rating.pull_out_um, until_s, rating.first, rating.last)
    still = Turn(turn.place_um, until_s, 0.0, turn.begun, turn.done, turn.look)
    rested = State(until_s, state.course, state.lost_um, True, still, aged, state.noted, state.tripped_s)
    return Leg(state.course, state.course, until_s - state.t_s, rested)


@loop_part("(AxisTask, State)", AxisTask, State, Swing)
def _next_swing(task: AxisTask, state: State) -> Swing:
    """The swing that begins with the step of a pulse that is due.

    Until it ends no other step, border of bins, change of the step rate or end may come. Pulses are known for longer
    than a step rate holds, so that it may end after the time up to which they are to be followed.
    """
    train, pulse, lag_um = task.demand.train, state.turn.begun, state.course.lag_um
    free_until_s = min(train.t_s[pulse + 1], state.rating.until_s, task.demand.braked_s)
    step_um = train.place_um[pulse + 1] - train.place_um[pulse]
    slot = (2 * int(lag_um * _CLASSES_PER_UM) + int(step_um > 0.0)) & (SWINGS - 1)
    return Swing(lag_um, step_um, free_until_s, bin_at(task.record.bins, state.noted.bin, state.t_s), slot)


@loop_part("b1(Swings, Swing)", Swings, Swing)
def _is_stored(swings: Swings, swing: Swing) -> bool:
    """Whether a swing is stored that begins like this."""
    slot = swing.slot
    return bool(abs(swings.lag_um[slot] - swing.lag_um) < ALIKE_UM and swings.step_um[slot] == swing.step_um)


@loop_part("b1(AxisTask, State, Swing)", AxisTask, State, Swing)
def _repeats(task: AxisTask, state: State, swing: Swing) -> bool:
    """Whether a stored swing ends before anything else is due, within the travel and what the motor can do now."""
    body, swings, slot = task.axis.body, task.swings, swing.slot
    border_s, ends_s, at_um = task.record.bins.border_s, state.t_s + swings.lasts_s[slot], state.course.at_um
    force, lag_um = swings.peaks[slot * PEAKS], swings.peaks[slot * PEAKS + 2]
    alone = ends_s < min(swing.free_until_s, border_s[swing.bin + 1])
    within = body.low_um < at_um - swings.reach_um[slot] and at_um + swings.reach_um[slot] < body.high_um
    strong = force < state.rating.limit and lag_um < min(state.rating.pull_out_um, task.axis.trip_um)
    return bool(alone and within and strong)


@loop_part("i8(AxisTask, State, Swing)", AxisTask, State, Swing)
def _sampled(task: AxisTask, first: State, swing: Swing) -> int:
    """Note the samples that come in a stored swing; the first one after that."""
    record, swings, number = task.record, task.swings, first.noted.sample
    ends_s = first.t_s + swings.lasts_s[swing.slot]
    while record.sample_s[number] <= ends_s:
        after_s, course = record.sample_s[number] - first.t_s, swing.slot * COURSES
        while course + 1 < swing.slot * COURSES + swings.courses[swing.slot]:
            if swings.begins_s[course + 1] > after_s:
                break
            course += 1
        stored = moved(task.axis.body, _stored_course(swings, course), after_s - swings.begins_s[course])
        record.sampled_um[number] = first.course.at_um + stored.at_um
        number += 1
    return number


@loop_part("(Swings, i8)", Swings, Course)
def _stored_course(swings: Swings, number: int) -> Course:
    """A stored course; its places are ways from where the swing began."""
    at, first = number * FIELDS, number * 3
    hold = Hold(swings.holds[first], swings.holds[first + 1], swings.holds[first + 2])
    way_um, velocity, lag_um, motor_um_s, force = (
        swings.fields[at],
        swings.fields[at + 1],
        swings.fields[at + 2],
        swings.fields[at + 3],
        swings.fields[at + 4],
    )
    return Course(way_um, velocity, lag_um, motor_um_s, hold, force, False)


@loop_part("void(Swings, i8, Course, f8)", Swings, Course)
def _store_course(swings: Swings, number: int, course: Course, from_um: float) -> None:
    """Store a course of a swing that began at a place."""
    at, hold = number * FIELDS, number * 3
    swings.fields[at], swings.fields[at + 1] = course.at_um - from_um, course.velocity
    swings.fields[at + 2], swings.fields[at + 3] = course.lag_um, course.motor_um_s
    swings.fields[at + 4] = course.force
    swings.holds[hold], swings.holds[hold + 1] = course.hold.side, course.hold.grip
    swings.holds[hold + 2] = course.hold.way


@loop_part("(AxisTask, State, Swing)", AxisTask, State, Swing)
def _repeated(task: AxisTask, first: State, swing: Swing) -> State:
    """An axis after a stored swing."""
    noted, swings, slot = first.noted, task.swings, swing.slot
    t_s, done = first.t_s + swings.lasts_s[slot], first.turn.begun + 1
    rest = _stored_course(swings, slot * COURSES + swings.courses[slot])
    at_um = task.demand.train.place_um[done] - first.lost_um - rest.lag_um
    course = Course(at_um, 0.0, rest.lag_um, 0.0, rest.hold, rest.force, False)
    turn = Turn(task.demand.train.place_um[done], t_s, 0.0, done, done, 0)
    noted = Noted(_sampled(task, first, swing), swing.bin, noted.slip, done, noted.courses)
    return State(t_s, course, first.lost_um, True, turn, first.rating, noted, first.tripped_s)


@loop_part("void(Swings, Swing)", Swings, Swing)
def _clear(swings: Swings, swing: Swing) -> None:
    """Make room for a swing."""
    slot = swing.slot
    swings.lag_um[slot], swings.step_um[slot] = np.nan, swing.step_um
    swings.lasts_s[slot], swings.reach_um[slot], swings.courses[slot] = 0.0, 0.0, 0
    for at in range(slot * VALUES, (slot + 1) * VALUES):
        swings.bins.low[at], swings.bins.high[at], swings.bins.area[at] = np.inf, -np.inf, 0.0
    for at in range(slot * PEAKS, (slot + 1) * PEAKS):
        swings.peaks[at] = -1.0


@loop_part("void(AxisTask, State, State, Leg, Swing)", AxisTask, State, Leg, Swing)
def _store_leg(task: AxisTask, first: State, before: State, leg: Leg, swing: Swing) -> None:
    """Store what an axis does in a course of a swing that began in its first state."""
    body, swings, slot, course = task.axis.body, task.swings, swing.slot, leg.course
    began_s, number = before.t_s - first.t_s, slot * COURSES + swings.courses[slot]
    from_um, noted = first.course.at_um, before.noted
    _store_course(swings, number, course, from_um)
    swings.begins_s[number] = began_s
    error_um = task.demand.train.place_um[noted.commanded] - first.lost_um - course.at_um
    if leg.after_s > 0.0:
        part = Part(course, leg.last, began_s, leg.after_s, error_um)
        peaked, at = peaked_of(recorded_part(body, part, swings.bins, slot)), slot * PEAKS
        for which, (value, after_s) in enumerate(peaked, at):
            if value > swings.peaks[which]:
                swings.peaks[which], swings.peak_s[which] = value, began_s + after_s
                swings.peak_way_um[which] = moved(body, course, after_s).at_um - from_um
    last = leg.state.course
    swings.courses[slot] += 1
    _store_course(swings, number + 1, last, from_um)
    swings.reach_um[slot] = max(swings.reach_um[slot], abs(last.at_um - from_um))
    swings.lasts_s[slot] = leg.state.t_s - first.t_s


@loop_part("b1(AxisTask, State, Leg, Swing)", AxisTask, State, Leg, Swing)
def _disturbed(task: AxisTask, first: State, leg: Leg, swing: Swing) -> bool:
    """Whether something else comes before a course ends: another step, a slip, a limit, a stop of the travel."""
    now, body = leg.state, task.axis.body
    limited = LIMITED in (leg.course.hold.grip, now.course.hold.grip)
    lost = now.lost_um != first.lost_um or now.tripped_s != first.tripped_s
    stopped = now.course.at_um <= body.low_um or now.course.at_um >= body.high_um
    return bool(limited or lost or stopped or now.t_s >= swing.free_until_s)


@loop_part("(AxisTask, State)", AxisTask, State)
def _awoken(task: AxisTask, state: State) -> State:
    """An axis that has rested, as the step that is due begins: its motor may slip at once."""
    begins = Leg(state.course, state.course, 0.0, turned_to(task.axis, task.demand, state))
    return recorded(task.axis, task.demand, state, begins, task.record)


@loop_part("(AxisTask, State, Swing)", AxisTask, State, Swing)
def _followed_swing(task: AxisTask, first: State, swing: Swing) -> State:
    """An axis after the courses of a swing, which is stored once it rests; before the course that is disturbed."""
    _clear(task.swings, swing)
    state = _awoken(task, first)
    while not state.rests and task.swings.courses[swing.slot] < COURSES - 1:
        leg = next_leg(task.axis, task.demand, state)
        if _disturbed(task, first, leg, swing):
            return state
        _store_leg(task, first, state, leg, swing)
        state = recorded(task.axis, task.demand, state, leg, task.record)
    if state.rests and task.swings.courses[swing.slot] > 0:
        task.swings.lag_um[swing.slot] = swing.lag_um
    return state


@loop_part("void(AxisTask, State, State, Swing)", AxisTask, State, Swing)
def _record_swing(task: AxisTask, first: State, now: State, swing: Swing) -> None:
    """Record a stored swing."""
    bins, swings, lost_um = task.record.bins, task.swings, first.lost_um
    for number in range(VALUES):
        into, at = swing.bin * VALUES + number, swing.slot * VALUES + number
        shift_um = lost_um if number == _ERROR else 0.0
        area = swings.bins.area[at] + shift_um * (now.t_s - first.t_s)
        widened(bins, into, swings.bins.low[at] + shift_um, swings.bins.high[at] + shift_um, area)
    limits = limits_of(task.axis, task.demand, first)
    for number, limit in enumerate((limits.force, limits.speed, limits.lag_um)):
        at = swing.slot * PEAKS + number
        place = PeakPlace(first.t_s + swings.peak_s[at], first.course.at_um + swings.peak_way_um[at])
        take_peak(task.record, number, swings.peaks[at], limit, place)


@loop_part("(AxisTask, State)", AxisTask, State)
def _swung(task: AxisTask, state: State) -> State:
    """An axis that has rested until a step is due, after the swing of that step, or after its beginning."""
    rating = rated(task.axis.strength, task.demand.train, state.rating, state.t_s)
    first = State(state.t_s, state.course, state.lost_um, True, state.turn, rating, state.noted, state.tripped_s)
    swing = _next_swing(task, first)
    if not _is_stored(task.swings, swing):
        return _followed_swing(task, first, swing)
    if not _repeats(task, first, swing):
        return _awoken(task, first)
    now = _repeated(task, first, swing)
    _record_swing(task, first, now, swing)
    return now


@compiled("(Axis, AxisDemand, State, Record, Swings)", Axis, AxisDemand, State, Record, Swings)
def followed(axis: Axis, demand: AxisDemand, state: State, record: Record, swings: Swings) -> State:
    """An axis once it has followed its pulses as far as they lead, its record has no room for slips, or it trips."""
    task = AxisTask(axis, demand, record, swings)
    while due_s(axis, demand, state) < demand.until_s and state.noted.slip < len(record.slip_s):
        if state.tripped_s < demand.braked_s:
            break
        if state.rests:
            rested = recorded(axis, demand, state, waited(state, due_s(axis, demand, state)), record)
            state = _awoken(task, rested) if is_closed(axis.loop) else _swung(task, rested)
        else:
            state = recorded(axis, demand, state, next_leg(axis, demand, state), record)
    return state
