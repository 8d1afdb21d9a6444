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
    PEAKS,
    SWING_TICKS,
    SWINGS,
    VALUES,
    PeakPlace,
    Record,
    Swings,
    Values,
    add_values,
    sampled,
    take_peak,
)
from sim.table.rating import Turn, rated

ALIKE_UM = 1e-8
"""Lags that differ by less begin the same swing: rounding moves one by 1e-9 µm. The lag at which a stored swing ends is
taken as it is, so that what is left out does not add up."""
_CLASSES_PER_UM = 1e7
_ERROR = Values._fields.index("error_um")


class AxisTask(NamedTuple):
    """An axis, what it is asked for, and where what it does is recorded."""

    axis: Axis
    demand: AxisDemand
    record: Record


class Swing(NamedTuple):
    """A swing that begins.

    Attributes
    ----------
    lag_um, step_um
        Lag at which the slide stands, and the step.
    free_until_s
        When anything else is due.
    bin, shake
        Its bin, and the next shake.
    slot
        Where it is stored.
    """

    lag_um: float
    step_um: float
    free_until_s: float
    bin: int
    shake: int
    slot: int


@compiled("(AxisTask, State)", AxisTask, State)
def _next_swing(task: AxisTask, state: State) -> Swing:
    """The swing that begins with the step of a pulse that is due.

    Until it ends no other step, border of bins, shake, change of the step rate or end may come. Pulses are known for
    longer than a step rate holds, so that it may end after the time up to which they are to be followed.
    """
    axis, train, border_s = task.axis, task.demand.train, task.record.bins.border_s
    slide, pulse, number, shake = state.slide, state.turn.begun, state.noted.bin, state.noted.shake
    while number < len(border_s) - 2 and border_s[number + 1] <= slide.t_s:
        number += 1
    while axis.shakes_s[shake] <= slide.t_s:
        shake += 1
    free_until_s = min(train.t_s[pulse + 1], border_s[number + 1], axis.shakes_s[shake], state.rating.until_s)
    free_until_s = min(free_until_s, task.demand.braked_s)
    lag_um = train.place_um[pulse] - slide.lost_um - slide.at_um
    step_um = train.place_um[pulse + 1] - train.place_um[pulse]
    slot = (2 * int(lag_um * _CLASSES_PER_UM) + int(step_um > 0.0)) & (SWINGS - 1)
    return Swing(lag_um, step_um, slide.t_s if shake % 2 else free_until_s, number, shake, slot)


@compiled("b1(Swings, Swing)", Swings, Swing)
def _is_stored(swings: Swings, swing: Swing) -> bool:
    """Whether a swing is stored that begins like this."""
    slot = swing.slot
    return bool(abs(swings.lag_um[slot] - swing.lag_um) < ALIKE_UM and swings.step_um[slot] == swing.step_um)


@compiled("b1(AxisTask, State, Swing)", AxisTask, State, Swing)
def _repeats(task: AxisTask, state: State, swing: Swing) -> bool:
    """Whether a stored swing ends before anything else is due, within the travel and what the motor can do now."""
    axis, swings, slide, slot = task.axis, task.record.swings, state.slide, swing.slot
    lasts_s, reach_um = swings.lasts_s[slot], swings.reach_um[slot]
    force, lag_um = swings.peaks[slot * PEAKS], swings.peaks[slot * PEAKS + 2]
    alone = slide.t_s + lasts_s < swing.free_until_s
    within = axis.low_um < slide.at_um - reach_um and slide.at_um + reach_um < axis.high_um
    strong = force < state.rating.limit and lag_um < min(state.rating.pull_out_um, axis.trip_um)
    return bool(alone and within and strong)


@compiled("i8(AxisTask, State, Swing)", AxisTask, State, Swing)
def _sampled(task: AxisTask, first: State, swing: Swing) -> int:
    """Note the samples that come in a stored swing; the first one after that."""
    record, swings, slide, number = task.record, task.record.swings, first.slide, first.noted.sample
    ways, ends_s = swing.slot * SWING_TICKS, slide.t_s + swings.lasts_s[swing.slot]
    while record.sample_s[number] <= ends_s:
        passed = (record.sample_s[number] - slide.t_s) / task.axis.step_tick_s
        tick = min(int(passed), SWING_TICKS - 1)
        before_um = swings.way_um[ways + tick - 1] if tick > 0 else 0.0
        way_um = before_um + (swings.way_um[ways + tick] - before_um) * (passed - tick)
        record.sampled_um[number] = slide.at_um + way_um
        number += 1
    return number


@compiled("(AxisTask, State, Swing)", AxisTask, State, Swing)
def _repeated(task: AxisTask, first: State, swing: Swing) -> State:
    """An axis after a stored swing."""
    slide, noted, swings, slot = first.slide, first.noted, task.record.swings, swing.slot
    t_s, done = slide.t_s + swings.lasts_s[slot], first.turn.begun + 1
    place_um = task.demand.train.place_um[done]
    at_um = place_um - slide.lost_um - swings.rest_lag_um[slot]
    rested = Slide(t_s, at_um, 0.0, 0.0, slide.lost_um, swings.last_lag_um[slot], swings.last_force[slot], True)
    turn = Turn(place_um, t_s, 0.0, done, done)
    noted = Noted(_sampled(task, first, swing), swing.bin, noted.slip, swing.shake, done, noted.ticks)
    return State(rested, turn, first.rating, noted, first.tripped_s)


@compiled("void(Swings, Swing)", Swings, Swing)
def _clear(swings: Swings, swing: Swing) -> None:
    """Make room for a swing."""
    slot = swing.slot
    swings.lag_um[slot], swings.step_um[slot] = np.nan, swing.step_um
    swings.lasts_s[slot], swings.reach_um[slot] = 0.0, 0.0
    for at in range(slot * VALUES, (slot + 1) * VALUES):
        swings.bins.low[at], swings.bins.high[at], swings.bins.area[at] = np.inf, -np.inf, 0.0
    for at in range(slot * PEAKS, (slot + 1) * PEAKS):
        swings.peaks[at] = -1.0


@compiled("void(AxisTask, State, State, State, Swing)", AxisTask, State, Swing)
def _store_tick(task: AxisTask, first: State, before: State, now: State, swing: Swing) -> None:
    """Store what an axis did in a tick of a swing that began in its first state."""
    swings, slide, slot = task.record.swings, now.slide, swing.slot
    values = values_of(task.demand, before, now)
    after_s, way_um = slide.t_s - first.slide.t_s, slide.at_um - first.slide.at_um
    error_um = values.error_um - slide.lost_um
    without_lost = Values(values.velocity, values.acceleration, values.lag_um, error_um, values.force)
    add_values(swings.bins, slot, slide.t_s - before.slide.t_s, without_lost)
    for number, value in enumerate((abs(values.force), abs(values.velocity), abs(values.lag_um))):
        at = slot * PEAKS + number
        if value > swings.peaks[at]:
            swings.peaks[at], swings.peak_s[at], swings.peak_way_um[at] = value, after_s, way_um
    swings.way_um[slot * SWING_TICKS + before.noted.ticks - first.noted.ticks] = way_um
    swings.lasts_s[slot], swings.rest_lag_um[slot] = after_s, swing.lag_um + swing.step_um - way_um
    swings.reach_um[slot] = max(swings.reach_um[slot], abs(way_um))
    swings.last_lag_um[slot], swings.last_force[slot] = slide.lag_um, slide.force


@compiled("b1(AxisTask, State, State)", AxisTask, State)
def _disturbed(task: AxisTask, first: State, now: State) -> bool:
    """Whether in a tick of a swing a motor slipped, tripped, or reached its limit, or the slide met a stop."""
    slide, axis = now.slide, task.axis
    lost = slide.lost_um != first.slide.lost_um or now.tripped_s != first.tripped_s
    stopped = slide.at_um <= axis.low_um or slide.at_um >= axis.high_um
    return bool(lost or stopped or abs(slide.force) >= first.rating.limit)


@compiled("(AxisTask, State, Swing)", AxisTask, State, Swing)
def _swing_ticked(task: AxisTask, first: State, swing: Swing) -> State:
    """An axis after the ticks of a swing, which is stored once it rests; before the tick that something disturbs."""
    _clear(task.record.swings, swing)
    state, until_s = first, swing.free_until_s - task.axis.step_tick_s
    while state.slide.t_s < until_s and not state.slide.rests and state.noted.ticks - first.noted.ticks < SWING_TICKS:
        now = ticked(task.axis, task.demand, state)
        if _disturbed(task, first, now):
            break
        _store_tick(task, first, state, now, swing)
        sample = sampled(task.record, state.noted.sample, state.slide, now.slide.velocity, now.slide.t_s)
        noted = Noted(sample, state.noted.bin, now.noted.slip, now.noted.shake, now.noted.commanded, now.noted.ticks)
        state = State(now.slide, now.turn, now.rating, noted, now.tripped_s)
    if state.slide.rests:
        task.record.swings.lag_um[swing.slot] = swing.lag_um
    return state


@compiled("void(AxisTask, State, State, Swing)", AxisTask, State, Swing)
def _record_swing(task: AxisTask, first: State, now: State, swing: Swing) -> None:
    """Record a swing, as far as it is stored."""
    bins, swings, slide, lost_um = task.record.bins, task.record.swings, first.slide, first.slide.lost_um
    for number in range(VALUES):
        into, at = swing.bin * VALUES + number, swing.slot * VALUES + number
        shift_um = lost_um if number == _ERROR else 0.0
        bins.low[into] = min(bins.low[into], swings.bins.low[at] + shift_um)
        bins.high[into] = max(bins.high[into], swings.bins.high[at] + shift_um)
        bins.area[into] += swings.bins.area[at] + shift_um * (now.slide.t_s - slide.t_s)
    limits = limits_of(task.axis, first.rating)
    for number, limit in enumerate((limits.force, limits.speed, limits.lag_um)):
        at = swing.slot * PEAKS + number
        place = PeakPlace(slide.t_s + swings.peak_s[at], slide.at_um + swings.peak_way_um[at])
        take_peak(task.record, number, swings.peaks[at], limit, place)


@compiled("(AxisTask, State)", AxisTask, State)
def _swung(task: AxisTask, state: State) -> State:
    """An axis that has stood, after the swing of the step that is due, or after as much of it as comes by itself."""
    rating = rated(task.axis.strength, task.demand.train, state.rating, state.slide.t_s)
    first = State(state.slide, state.turn, rating, state.noted, state.tripped_s)
    swing = _next_swing(task, first)
    stored = _is_stored(task.record.swings, swing)
    if swing.free_until_s <= first.slide.t_s or (stored and not _repeats(task, first, swing)):
        return first
    now = _repeated(task, first, swing) if stored else _swing_ticked(task, first, swing)
    _record_swing(task, first, now, swing)
    noted = Noted(now.noted.sample, swing.bin, now.noted.slip, now.noted.shake, now.noted.commanded, now.noted.ticks)
    return State(now.slide, now.turn, now.rating, noted, now.tripped_s)


@compiled("(Axis, AxisDemand, State, Record)", Axis, AxisDemand, State, Record)
def followed(axis: Axis, demand: AxisDemand, state: State, record: Record) -> State:
    """An axis once it has followed its pulses as far as they lead, its record has no room for slips, or it trips."""
    task = AxisTask(axis, demand, record)
    while due_s(demand, state) < demand.until_s and state.noted.slip < len(record.slip_s):
        if state.tripped_s < demand.braked_s:
            break
        until_s = due_s(demand, state)
        if until_s > state.slide.t_s:
            state = _swung(task, recorded(axis, demand, state, waited(state, until_s), record))
        else:
            state = recorded(axis, demand, state, ticked(axis, demand, state), record)
    return state
