"""Swings: what a step from rest does until the slide rests again, stored, and used where the same begins again.

At the feeds of cutting a motor makes a step, its slide swings by half a period, friction stops it, and it stands until
the next step. What it does depends on the step and on the lag at which it stood. On a straight way both are the same
from step to step, so that nearly all swings of a run are one of a few.

Steps that come while the slide still swings are followed tick by tick.
"""

from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled
from sim.table.axis import Axis, AxisDemand, Noted, State, due_s, limits_of, recorded, ticked, values_of, waited
from sim.table.drive import Slide
from sim.table.history import (
    SWING_ENDS,
    SWING_PEAKS,
    SWING_TICKS,
    SWINGS,
    VALUES,
    Record,
    Swings,
    Values,
    add,
    sampled,
    take_peak,
)
from sim.table.rating import Turn, rated

ALIKE_UM = 1e-8
"""Lags that differ by less begin the same swing: rounding moves one by 1e-9 µm. The lag at which a stored swing ends is
taken as it is, so that what is left out does not add up."""
_CLASSES_PER_UM = 1e7
_ERROR = Values._fields.index("error_um")


class Course(NamedTuple):
    """An axis, what it is asked for, and where what it does is recorded."""

    axis: Axis
    demand: AxisDemand
    record: Record


class Begun(NamedTuple):
    """A swing that begins: its lag and step, when anything else is due, the bin it is in, and where it is stored."""

    lag_um: float
    step_um: float
    free_until_s: float
    bin: int
    slot: int


@compiled("(Course, State)", Course, State)
def _begun(course: Course, state: State) -> Begun:
    """The swing that begins with the step of a pulse that is due.

    Until it ends no other step, border of bins, shake, change of the step rate or end may come. Pulses are known for
    longer than a step rate holds, so that it may end after the time up to which they are to be followed.
    """
    axis, train, border_s = course.axis, course.demand.train, course.record.bins.border_s
    slide, begun, number, shake = state.slide, state.turn.begun, state.noted.bin, state.noted.shake
    while number < len(border_s) - 2 and border_s[number + 1] <= slide.t_s:
        number += 1
    while axis.shakes_s[shake] <= slide.t_s:
        shake += 1
    free_until_s = min(train.t_s[begun + 1], border_s[number + 1], axis.shakes_s[shake], state.rating.until_s)
    free_until_s = min(free_until_s, course.demand.braked_s)
    lag_um = train.place_um[begun] - slide.lost_um - slide.at_um
    step_um = train.place_um[begun + 1] - train.place_um[begun]
    slot = (2 * int(lag_um * _CLASSES_PER_UM) + int(step_um > 0.0)) & (SWINGS - 1)
    return Begun(lag_um, step_um, slide.t_s if shake % 2 else free_until_s, number, slot)


@compiled("b1(Swings, Begun)", Swings, Begun)
def _known(swings: Swings, begun: Begun) -> bool:
    """Whether a swing is stored that begins like this."""
    slot = begun.slot
    return bool(abs(swings.lag_um[slot] - begun.lag_um) < ALIKE_UM and swings.step_um[slot] == begun.step_um)


@compiled("b1(Course, State, Begun)", Course, State, Begun)
def _repeats(course: Course, state: State, begun: Begun) -> bool:
    """Whether a stored swing ends before anything else is due, within the travel and what the motor can do now."""
    axis, swings, slide, slot = course.axis, course.record.swings, state.slide, begun.slot
    lasts_s, reach_um = swings.ends[slot * SWING_ENDS], swings.ends[slot * SWING_ENDS + 2]
    force, lag_um = swings.peaks[slot * SWING_PEAKS], swings.peaks[slot * SWING_PEAKS + 6]
    alone = slide.t_s + lasts_s < begun.free_until_s
    within = axis.low_um < slide.at_um - reach_um and slide.at_um + reach_um < axis.high_um
    strong = force < state.rating.limit and lag_um < min(state.rating.pull_out_um, axis.trip_um)
    return bool(alone and within and strong)


@compiled("i8(Course, State, Begun)", Course, State, Begun)
def _sampled(course: Course, first: State, begun: Begun) -> int:
    """Note the samples that come in a stored swing; the first one after that."""
    record, swings, slide, number = course.record, course.record.swings, first.slide, first.noted.sample
    ways, ends_s = begun.slot * SWING_TICKS, slide.t_s + swings.ends[begun.slot * SWING_ENDS]
    while record.sample_s[number] <= ends_s:
        passed = (record.sample_s[number] - slide.t_s) / course.axis.step_tick_s
        tick = min(int(passed), SWING_TICKS - 1)
        before_um = swings.way_um[ways + tick - 1] if tick > 0 else 0.0
        way_um = before_um + (swings.way_um[ways + tick] - before_um) * (passed - tick)
        record.sampled_um[number] = slide.at_um + way_um
        number += 1
    return number


@compiled("(Course, State, Begun)", Course, State, Begun)
def _repeated(course: Course, first: State, begun: Begun) -> State:
    """An axis after a stored swing."""
    slide, noted, ends, at = first.slide, first.noted, course.record.swings.ends, begun.slot * SWING_ENDS
    t_s, done = slide.t_s + ends[at], first.turn.begun + 1
    place_um = course.demand.train.place_um[done]
    at_um = place_um - slide.lost_um - ends[at + 1]
    rested = Slide(t_s, at_um, 0.0, 0.0, slide.lost_um, ends[at + 3], ends[at + 4], True)
    turn = Turn(place_um, t_s, 0.0, done, done)
    noted = Noted(_sampled(course, first, begun), noted.bin, noted.slip, noted.shake, done, noted.ticks)
    return State(rested, turn, first.rating, noted, first.tripped_s)


@compiled("void(Swings, Begun)", Swings, Begun)
def _cleared(swings: Swings, begun: Begun) -> None:
    """Make room for a swing."""
    slot = begun.slot
    swings.lag_um[slot], swings.step_um[slot] = np.nan, begun.step_um
    for at in range(slot * SWING_ENDS, (slot + 1) * SWING_ENDS):
        swings.ends[at] = 0.0
    for at in range(slot * VALUES, (slot + 1) * VALUES):
        swings.bins.low[at], swings.bins.high[at], swings.bins.area[at] = np.inf, -np.inf, 0.0
    for at in range(slot * SWING_PEAKS, (slot + 1) * SWING_PEAKS):
        swings.peaks[at] = -1.0


@compiled("void(Swings, i8, f8, f8, f8)", Swings)
def _peaked(swings: Swings, at: int, value: float, after_s: float, way_um: float) -> None:
    """Take a value of a swing for one of its peaks."""
    if value > swings.peaks[at]:
        swings.peaks[at], swings.peaks[at + 1], swings.peaks[at + 2] = value, after_s, way_um


@compiled("void(Course, State, State, State, Begun)", Course, State, Begun)
def _stored(course: Course, first: State, before: State, now: State, begun: Begun) -> None:
    """Store what an axis did in a tick of a swing that began in its first state."""
    swings, slide, slot = course.record.swings, now.slide, begun.slot
    did = values_of(course.demand, before, now)
    after_s, way_um, ends = slide.t_s - first.slide.t_s, slide.at_um - first.slide.at_um, slot * SWING_ENDS
    less = Values(did.velocity, did.acceleration, did.lag_um, did.error_um - slide.lost_um, did.force)
    add(swings.bins, slot, slide.t_s - before.slide.t_s, less)
    _peaked(swings, slot * SWING_PEAKS, abs(did.force), after_s, way_um)
    _peaked(swings, slot * SWING_PEAKS + 3, abs(did.velocity), after_s, way_um)
    _peaked(swings, slot * SWING_PEAKS + 6, abs(did.lag_um), after_s, way_um)
    swings.way_um[slot * SWING_TICKS + before.noted.ticks - first.noted.ticks] = way_um
    swings.ends[ends], swings.ends[ends + 1] = after_s, begun.lag_um + begun.step_um - way_um
    swings.ends[ends + 2] = max(swings.ends[ends + 2], abs(way_um))
    swings.ends[ends + 3], swings.ends[ends + 4] = slide.lag_um, slide.force


@compiled("b1(Course, State, State)", Course, State)
def _disturbed(course: Course, first: State, now: State) -> bool:
    """Whether in a tick of a swing a motor slipped, tripped, or reached its limit, or the slide met a stop."""
    slide, axis = now.slide, course.axis
    lost = slide.lost_um != first.slide.lost_um or now.tripped_s != first.tripped_s
    stopped = slide.at_um <= axis.low_um or slide.at_um >= axis.high_um
    return bool(lost or stopped or abs(slide.force) >= first.rating.limit)


@compiled("(Course, State, Begun)", Course, State, Begun)
def _swing_ticked(course: Course, first: State, begun: Begun) -> State:
    """An axis after the ticks of a swing, which is stored once it rests; before the tick that something disturbs."""
    _cleared(course.record.swings, begun)
    state, until_s = first, begun.free_until_s - course.axis.step_tick_s
    while state.slide.t_s < until_s and not state.slide.rests and state.noted.ticks - first.noted.ticks < SWING_TICKS:
        now = ticked(course.axis, course.demand, state)
        if _disturbed(course, first, now):
            break
        _stored(course, first, state, now, begun)
        sample = sampled(course.record, state.noted.sample, state.slide, now.slide.velocity, now.slide.t_s)
        noted = Noted(sample, state.noted.bin, now.noted.slip, now.noted.shake, now.noted.commanded, now.noted.ticks)
        state = State(now.slide, now.turn, now.rating, noted, now.tripped_s)
    if state.slide.rests:
        course.record.swings.lag_um[begun.slot] = begun.lag_um
    return state


@compiled("void(Course, State, State, Begun)", Course, State, Begun)
def _recorded(course: Course, first: State, now: State, begun: Begun) -> None:
    """Record a swing, as far as it is stored."""
    bins, swings, slide, lost_um = course.record.bins, course.record.swings, first.slide, first.slide.lost_um
    for number in range(VALUES):
        into, at = begun.bin * VALUES + number, begun.slot * VALUES + number
        shift_um = lost_um if number == _ERROR else 0.0
        bins.low[into] = min(bins.low[into], swings.bins.low[at] + shift_um)
        bins.high[into] = max(bins.high[into], swings.bins.high[at] + shift_um)
        bins.area[into] += swings.bins.area[at] + shift_um * (now.slide.t_s - slide.t_s)
    limits = limits_of(course.axis, first.rating)
    for number, limit in enumerate((limits.force, limits.speed, limits.lag_um)):
        at = begun.slot * SWING_PEAKS + 3 * number
        t_s, at_um = slide.t_s + swings.peaks[at + 1], slide.at_um + swings.peaks[at + 2]
        take_peak(course.record, number, swings.peaks[at], limit, Slide(t_s, at_um, 0.0, 0.0, 0.0, 0.0, 0.0, False))


@compiled("(Course, State)", Course, State)
def _swung(course: Course, state: State) -> State:
    """An axis that has stood, after the swing of the step that is due, or after as much of it as comes by itself."""
    rating = rated(course.axis.strength, course.demand.train, state.rating, state.slide.t_s)
    first = State(state.slide, state.turn, rating, state.noted, state.tripped_s)
    begun = _begun(course, first)
    known = _known(course.record.swings, begun)
    if begun.free_until_s <= first.slide.t_s or (known and not _repeats(course, first, begun)):
        return first
    now = _repeated(course, first, begun) if known else _swing_ticked(course, first, begun)
    _recorded(course, first, now, begun)
    noted = Noted(now.noted.sample, begun.bin, now.noted.slip, now.noted.shake, now.noted.commanded, now.noted.ticks)
    return State(now.slide, now.turn, now.rating, noted, now.tripped_s)


@compiled("(Axis, AxisDemand, State, Record)", Axis, AxisDemand, State, Record)
def followed(axis: Axis, demand: AxisDemand, state: State, record: Record) -> State:
    """An axis once it has followed its pulses as far as they lead, its record has no room for slips, or it trips."""
    course = Course(axis, demand, record)
    while due_s(demand, state) < demand.until_s and state.noted.slip < len(record.slip_s):
        if state.tripped_s < demand.braked_s:
            break
        until_s = due_s(demand, state)
        if until_s > state.slide.t_s:
            state = _swung(course, recorded(axis, demand, state, waited(state, until_s), record))
        else:
            state = recorded(axis, demand, state, ticked(axis, demand, state), record)
    return state
