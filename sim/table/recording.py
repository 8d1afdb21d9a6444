"""What a course puts into the record of an axis: lowest, highest and mean of each quantity, peaks, and samples.

Each is worked out from the closed form of the course: extremes lie at its ends, or where a slope is 0.
"""

import math
from typing import NamedTuple

from controller.compiled.loops import compiled, loop_part
from sim.table.axis import Axis, AxisDemand, Leg, Noted, State, bounds_of
from sim.table.course import (
    Body,
    Course,
    Form,
    Lagging,
    acceleration_of,
    is_driven,
    lagging_of,
    moved,
    rest_lag,
    slope_in,
    value_in,
    wave_in,
)
from sim.table.forms import Oscillation, coasted_s, coasting, first_zero, pair_at, slope_of, value_of
from sim.table.history import VALUES, Bins, Limits, PeakPlace, Record, is_peak, take_peak, widened
from sim.table.turning import away_um, is_closed


class Range(NamedTuple):
    """Lowest and highest of a quantity in a course, and after how long each comes, s."""

    low: float
    high: float
    low_s: float
    high_s: float


class Ranges(NamedTuple):
    """Ranges of velocity, acceleration, lag and force in a course."""

    velocity: Range
    acceleration: Range
    lag_um: Range
    force: Range


@loop_part("(f8, f8, f8)", Range)
def _between(first: float, last: float, after_s: float) -> Range:
    """Range of what goes one way from its first to its last value."""
    return Range(first, last, 0.0, after_s) if first < last else Range(last, first, after_s, 0.0)


@loop_part("(Range, f8, f8)", Range)
def _with_value(range_: Range, value: float, after_s: float) -> Range:
    """A range that a value is taken into."""
    if value < range_.low:
        return Range(value, range_.high, after_s, range_.high_s)
    return Range(range_.low, value, range_.low_s, after_s) if value > range_.high else range_


class Ends(NamedTuple):
    """How a driven slide lags at both ends of a course, and how long that lasts, s."""

    first: Lagging
    last: Lagging
    after_s: float


@loop_part("(Oscillation, Form, Ends)", Oscillation, Form, Ends, Range)
def _range_of(swings: Oscillation, form: Form, ends: Ends) -> Range:
    """Range of a wave: it decays, so that no extreme behind the first two is farther out."""
    after_s = ends.after_s
    found = _between(value_in(form, ends.first), value_in(form, ends.last), after_s)
    once = swings.creeps or swings.rate * after_s < math.pi
    if once and slope_in(swings, form, ends.first) * slope_in(swings, form, ends.last) >= 0.0:
        return found
    wave = wave_in(swings, form, ends.first)
    turns_s = first_zero(swings, slope_of(swings, wave))
    for _ in range(2):
        if turns_s < after_s:
            found = _with_value(found, value_of(wave, pair_at(swings, turns_s)), turns_s)
        turns_s += math.inf if swings.creeps else math.pi / swings.rate
    return found


class Part(NamedTuple):
    """A part of a course: as it begins and as it ends, when it begins, how long it lasts, and its following error."""

    course: Course
    last: Course
    t_s: float
    after_s: float
    error_um: float


@loop_part("(Body, Part)", Body, Part, Ranges)
def _ranges(body: Body, part: Part) -> Ranges:
    """Ranges in a part of a course."""
    drive, swings, course, last, after_s = body.drive, body.swings, part.course, part.last, part.after_s
    if is_driven(course):
        ends = Ends(lagging_of(body, course), lagging_of(body, last), after_s)
        rest_um = rest_lag(body, course)
        even = drive.spring * (rest_um - course.hold.side * drive.slack_um)
        speed = _range_of(swings, Form(course.motor_um_s, 0.0, -1.0), ends)
        bend = _range_of(swings, Form(0.0, swings.spring, swings.damping), ends)
        lag = _range_of(swings, Form(rest_um, 1.0, 0.0), ends)
        force = _range_of(swings, Form(even, drive.spring, drive.damper), ends)
        return Ranges(speed, bend, lag, force)
    velocity = _between(course.velocity, last.velocity, after_s)
    first, then = acceleration_of(body, course), acceleration_of(body, last)
    lag = _between(course.lag_um, last.lag_um, after_s)
    lag_um_s, last_um_s = course.motor_um_s - course.velocity, course.motor_um_s - last.velocity
    if lag_um_s * last_um_s < 0.0:
        turns_s = min(coasted_s(body.drive.viscous, lag_um_s / first), after_s)  # then it is as fast as its motor
        lag = _with_value(lag, moved(body, course, turns_s).lag_um, turns_s)
    return Ranges(velocity, _between(first, then, after_s), lag, _between(course.force, last.force, after_s))


@loop_part("f8(Body, Part)", Body, Part)
def _lag_area(body: Body, part: Part) -> float:
    """Integral of the lag over a part of a course, µm s."""
    course, last, after_s = part.course, part.last, part.after_s
    evenly = course.lag_um * after_s + course.motor_um_s * after_s**2 / 2.0
    if is_driven(course):
        swings = body.swings
        pulled = course.velocity - last.velocity + swings.damping * (last.lag_um - course.lag_um)
        return rest_lag(body, course) * after_s - pulled / swings.spring
    if course.hold.way == 0:
        return evenly
    bend = acceleration_of(body, course) * coasting(body.drive.viscous, after_s).thrice
    return evenly - course.velocity * after_s**2 / 2.0 - bend


@loop_part("(Body, Part, Bins, i8)", Body, Part, Bins, Ranges)
def recorded_part(body: Body, part: Part, bins: Bins, number: int) -> Ranges:
    """Take a part of a course into a bin; its ranges."""
    course, last, _, after_s, error_um = part
    ranges, lag_area, at = _ranges(body, part), _lag_area(body, part), number * VALUES
    way_um, gained = last.at_um - course.at_um, last.velocity - course.velocity
    widened(bins, at, ranges.velocity.low, ranges.velocity.high, way_um)
    widened(bins, at + 1, ranges.acceleration.low, ranges.acceleration.high, gained)
    widened(bins, at + 2, ranges.lag_um.low, ranges.lag_um.high, lag_area)
    last_um = error_um - way_um
    passed = course.motor_um_s * after_s**2 / 2.0 + course.lag_um * after_s - lag_area
    widened(bins, at + 3, min(error_um, last_um), max(error_um, last_um), error_um * after_s - passed)
    if course.hold.way == 0:
        pushed = (course.force + last.force) / 2.0 * after_s
    else:
        pushed = gained + body.drive.viscous * way_um + course.hold.way * body.drive.friction * after_s
    widened(bins, at + 4, ranges.force.low, ranges.force.high, pushed)
    return ranges


class Farthest(NamedTuple):
    """How far a quantity comes from 0 in a course, without its sign, and after how long, s."""

    value: float
    after_s: float


class Peaked(NamedTuple):
    """How far force over mass, µm/s², speed, µm/s, and lag, µm, come from 0 in a course."""

    force: Farthest
    speed: Farthest
    lag_um: Farthest


@loop_part("(Range,)", Range, Farthest)
def _farthest(range_: Range) -> Farthest:
    """How far a range comes from 0."""
    if -range_.low > range_.high:
        return Farthest(-range_.low, range_.low_s)
    return Farthest(range_.high, range_.high_s)


@loop_part("(Ranges,)", Ranges, Peaked)
def peaked_of(ranges: Ranges) -> Peaked:
    """How far force, speed and lag come from 0 in a course, by their ranges."""
    return Peaked(_farthest(ranges.force), _farthest(ranges.velocity), _farthest(ranges.lag_um))


@loop_part("(Axis, AxisDemand, State)", Axis, AxisDemand, State, Limits)
def limits_of(axis: Axis, demand: AxisDemand, state: State) -> Limits:
    """Limits of an axis at its step rate."""
    bounds = bounds_of(axis, demand, state.rating)
    if not is_closed(axis.loop):
        return Limits(bounds.force, axis.speed_limit_um_s, bounds.lag_um, -1.0)
    behind_um = abs(away_um(axis.loop, demand.train, state.turn, state.course.at_um))
    return Limits(bounds.force, axis.speed_limit_um_s, axis.trip_um, behind_um)


class Candidate(NamedTuple):
    """What may be a peak: its number, how far it comes from 0 and after how long, s, and its limit."""

    number: int
    farthest: Farthest
    limit: float


@loop_part("void(Body, Part, Candidate, Record)", Body, Part, Candidate, Record)
def _take_candidate(body: Body, part: Part, candidate: Candidate, record: Record) -> None:
    """Take what may be a peak of a part of a course; where it comes is worked out for a new one alone."""
    number, (value, after_s), limit = candidate
    if is_peak(record, number, value, limit):
        place = PeakPlace(part.t_s + after_s, moved(body, part.course, after_s).at_um)
        take_peak(record, number, value, limit, place)


@loop_part("void(Body, Part, Peaked, Limits, Record)", Body, Part, Peaked, Limits, Record)
def _take_peaks(body: Body, part: Part, peaked: Peaked, limits: Limits, record: Record) -> None:
    """Take the peaks of a part of a course."""
    _take_candidate(body, part, Candidate(0, peaked.force, limits.force), record)
    _take_candidate(body, part, Candidate(1, peaked.speed, limits.speed), record)
    lag_um = peaked.lag_um if limits.behind_um < 0.0 else Farthest(limits.behind_um, 0.0)
    _take_candidate(body, part, Candidate(2, lag_um, limits.lag_um), record)


@loop_part("i8(Bins, i8, f8)", Bins)
def bin_at(bins: Bins, number: int, t_s: float) -> int:
    """The bin of a time, none before a number."""
    while number < len(bins.border_s) - 2 and bins.border_s[number + 1] <= t_s:
        number += 1
    return number


@loop_part("i8(Body, Part, Record, i8)", Body, Part, Record)
def _sampled(body: Body, part: Part, record: Record, number: int) -> int:
    """Note the samples of a course, from one on; the first one after its end."""
    while record.sample_s[number] <= part.t_s + part.after_s:
        record.sampled_um[number] = moved(body, part.course, record.sample_s[number] - part.t_s).at_um
        number += 1
    return number


@loop_part("void(Bins, i8, Course, f8, f8)", Bins, Course)
def _record_rest(bins: Bins, number: int, course: Course, after_s: float, error_um: float) -> None:
    """Take a rest into a bin. It has no peak: what stands was as far off as the course before it came to its end."""
    at, lag_um, force = number * VALUES, course.lag_um, course.force
    widened(bins, at, 0.0, 0.0, 0.0)
    widened(bins, at + 1, 0.0, 0.0, 0.0)
    widened(bins, at + 2, lag_um, lag_um, lag_um * after_s)
    widened(bins, at + 3, error_um, error_um, error_um * after_s)
    widened(bins, at + 4, force, force, force * after_s)


@loop_part("i8(Body, Part, Limits, Record, i8)", Body, Part, Limits, Record)
def _binned(body: Body, whole: Part, limits: Limits, record: Record, number: int) -> int:
    """Take a course into bins and peaks; the bin where it ended."""
    border_s, (course, _, t_s, _, error_um) = record.bins.border_s, whole
    left_s = min(whole.after_s, border_s[len(border_s) - 1] - t_s)
    stands = course.hold.way == 0 and course.motor_um_s == 0.0
    while left_s > 0.0:
        number = bin_at(record.bins, number, t_s)
        part_s = left_s if number == len(border_s) - 2 else min(left_s, border_s[number + 1] - t_s)
        if stands:
            _record_rest(record.bins, number, course, part_s, error_um)
            if record.peaks[0] < 0.0:  # nothing has moved yet
                peaked = Peaked(Farthest(abs(course.force), 0.0), Farthest(0.0, 0.0), Farthest(abs(course.lag_um), 0.0))
                _take_peaks(body, Part(course, course, t_s, part_s, error_um), peaked, limits, record)
            t_s, left_s = t_s + part_s, left_s - part_s
            continue
        last = whole.last if part_s == whole.after_s else moved(body, course, part_s)
        part = Part(course, last, t_s, part_s, error_um)
        _take_peaks(body, part, peaked_of(recorded_part(body, part, record.bins, number)), limits, record)
        error_um -= last.at_um - course.at_um
        course, t_s, left_s = last, t_s + part_s, left_s - part_s
    return number


@compiled("(Axis, AxisDemand, State, Leg, Record)", Axis, AxisDemand, State, Leg, Record)
def recorded(axis: Axis, demand: AxisDemand, before: State, leg: Leg, record: Record) -> State:
    """Record what an axis did in a leg; its state after it, with how far the record is."""
    now, noted, course = leg.state, before.noted, leg.course
    error_um = demand.train.place_um[noted.commanded] - course.at_um
    whole = Part(course, leg.last, before.t_s, now.t_s - before.t_s, error_um)
    sample = _sampled(axis.body, whole, record, noted.sample)
    number, slip = noted.bin, noted.slip
    if before.t_s < demand.braked_s and leg.after_s > 0.0:
        number = _binned(axis.body, whole, limits_of(axis, demand, before), record, number)
    slip_um = now.lost_um - before.lost_um
    if slip_um != 0.0:
        record.slip_s[slip], record.slip_um[slip], record.slip_at_um[slip] = now.t_s, slip_um, now.course.at_um
        slip += 1
    noted = Noted(sample, number, slip, now.noted.commanded, now.noted.courses)
    return State(now.t_s, now.course, now.lost_um, now.rests, now.turn, now.rating, noted, now.tripped_s)
