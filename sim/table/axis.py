"""One axis of the table: what it is, what it is asked for, how far it has come, and what a tick does to it."""

import math
from typing import NamedTuple

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from sim.table.drive import Drive, Kick, Kicked, Slide, kicked
from sim.table.history import Limits, Record, Values, binned, peaked, sampled
from sim.table.rating import Rating, Strength, Train, Turn, rated, turned


class Axis(NamedTuple):
    """What an axis is.

    Attributes
    ----------
    drive, strength
        Its drive, and what its motor can do.
    step_time_s
        Time that the motor takes for a step.
    trip_um
        Lag at which a servo trips; infinite for a stepper.
    speed_limit_um_s
        Speed limit, for its peak; infinite where there is none.
    low_um, high_um
        Ends of its travel.
    step_tick_s, steps_tick_s, shaken_tick_s
        Ticks while single steps are felt, while the motor makes several at once, and while the axis is shaken by more.
    shakes_s
        Times at which shakes begin and end in turn, and infinity.
    """

    drive: Drive
    strength: Strength
    step_time_s: float
    trip_um: float
    speed_limit_um_s: float
    low_um: float
    high_um: float
    step_tick_s: float
    steps_tick_s: float
    shaken_tick_s: float
    shakes_s: Floats


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
    """How far the record of an axis is: the next sample, bin, slip and shake, pulses commanded, and ticks in all."""

    sample: int
    bin: int
    slip: int
    shake: int
    commanded: int
    ticks: int


class State(NamedTuple):
    """How far an axis has come; `tripped_s` is when its servo tripped, infinite where it did not."""

    slide: Slide
    turn: Turn
    rating: Rating
    noted: Noted
    tripped_s: float


STILL_UM = 1e-6
"""Without friction a slide counts as resting where its ringing is smaller than this: way, and v / ω."""


class Ahead(NamedTuple):
    """A tick that is about to pass: its length, the kick at its beginning, and its motor after that."""

    tick_s: float
    shake: int
    kick: Kick
    turn: Turn
    rating: Rating


class Passed(NamedTuple):
    """A tick that has passed: what the drive did, where the slide is then, and its velocity meanwhile."""

    force: float
    at_um: float
    velocity: float


@compiled("(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def ahead_of(axis: Axis, demand: AxisDemand, state: State) -> Ahead:
    """What a tick asks of a drive.

    The kick goes from the middle of the tick before it to the middle of its own. A slide that has rested is kicked by
    the half of its own tick alone.
    """
    slide, shake = state.slide, state.noted.shake
    while axis.shakes_s[shake] <= slide.t_s:
        shake += 1
    tick_s = axis.steps_tick_s if state.turn.begun - state.turn.done > 1 else axis.step_tick_s
    if shake % 2:
        tick_s = axis.shaken_tick_s
    rating = state.rating
    if slide.t_s >= rating.until_s:
        rating = rated(axis.strength, demand.train, rating, slide.t_s)
    turn = turned(demand.train, axis.step_time_s, state.turn, slide.t_s + tick_s / 2.0)
    length_s = (slide.tick_s + tick_s) / 2.0
    motor_um = (state.turn.place_um + turn.place_um) / 2.0 - slide.lost_um
    at_um = slide.at_um + slide.velocity * (tick_s - slide.tick_s) / 4.0
    motor_um_s = (turn.place_um - state.turn.place_um) / length_s
    kick = Kick(motor_um - at_um, motor_um_s, slide.velocity, length_s, rating.limit)
    return Ahead(tick_s, shake, kick, turn, rating)


@compiled("(Axis, AxisDemand, Slide, Ahead)", Axis, AxisDemand, Slide, Ahead)
def driven(axis: Axis, demand: AxisDemand, slide: Slide, ahead: Ahead) -> Kicked:
    """What a drive does in a tick: once a servo has tripped, nothing drives, and both axes brake."""
    if slide.t_s < demand.braked_s:
        return kicked(axis.drive, ahead.kick)
    braking = ahead.kick.length_s * (axis.drive.damper + axis.drive.viscous)
    return Kicked(slide.velocity / (1.0 + braking), 0.0)


@compiled("f8(Ahead, f8)", Ahead)
def slip_of(ahead: Ahead, period_um: float) -> float:
    """Way that a motor loses: whole electrical periods, until the lag is within the pull-out again."""
    beyond_um = abs(ahead.kick.lag_um) - ahead.rating.pull_out_um
    if beyond_um <= 0.0:
        return 0.0
    return math.copysign(math.ceil(beyond_um / period_um) * period_um, ahead.kick.lag_um)


@compiled("b1(Axis, Ahead, Passed)", Axis, Ahead, Passed)
def stands(axis: Axis, ahead: Ahead, passed: Passed) -> bool:
    """Whether a slide stands from now on while its motor does: the next tick would be like this one.

    Friction stops a slide for good. Without friction it rings ever less, and counts as resting within `STILL_UM`.
    """
    drive, kick = axis.drive, ahead.kick
    if kick.motor_um_s != 0.0 or ahead.turn.done < ahead.turn.begun:
        return False
    if abs(passed.force) >= kick.limit and kick.limit < axis.strength.limit[0]:  # the motor can do more at a standstill
        return False
    if kick.velocity == 0.0 and passed.velocity == 0.0:
        return True
    still = max(abs(kick.velocity), abs(passed.velocity)) < STILL_UM * math.sqrt(drive.spring)
    return still and drive.friction == 0.0 and abs(passed.force) < STILL_UM * drive.spring


@compiled("(Axis, AxisDemand, State, Ahead, Passed)", Axis, AxisDemand, State, Ahead, Passed)
def after(axis: Axis, demand: AxisDemand, state: State, ahead: Ahead, passed: Passed) -> State:
    """An axis after a tick."""
    slide, noted, lag_um = state.slide, state.noted, ahead.kick.lag_um
    t_s, braked = slide.t_s + ahead.tick_s, slide.t_s >= demand.braked_s
    slip_um = 0.0 if braked else slip_of(ahead, axis.strength.period_um)
    rests = slip_um == 0.0 and stands(axis, ahead, passed)
    velocity = 0.0 if rests else passed.velocity
    tripped_s = t_s if abs(lag_um) > axis.trip_um and not braked else math.inf
    commanded = noted.commanded
    while demand.train.t_s[commanded] <= t_s:
        commanded += 1
    now = Slide(t_s, passed.at_um, velocity, ahead.tick_s, slide.lost_um + slip_um, lag_um, passed.force, rests)
    noted = Noted(noted.sample, noted.bin, noted.slip, ahead.shake, commanded, noted.ticks + 1)
    return State(now, ahead.turn, ahead.rating, noted, min(tripped_s, state.tripped_s))


@compiled("(AxisDemand, State, State)", AxisDemand, State)
def values_of(demand: AxisDemand, before: State, now: State) -> Values:
    """What an axis did from one state to the next, which is a tick later, or a rest."""
    since, slide = before.slide, now.slide
    length_s, velocity = slide.t_s - since.t_s, slide.velocity
    error_um = demand.train.place_um[now.noted.commanded] - slide.at_um
    # Where ticks become shorter, the kick is longer than the tick that it begins.
    acceleration = (velocity - since.velocity) / max(length_s, (since.tick_s + length_s) / 2.0)
    return Values(velocity, acceleration, slide.lag_um, error_um, slide.force)


@compiled("(Axis, Rating)", Axis, Rating)
def limits_of(axis: Axis, rating: Rating) -> Limits:
    """Limits of an axis at its step rate."""
    return Limits(rating.limit, axis.speed_limit_um_s, min(rating.pull_out_um, axis.trip_um))


@compiled("(Axis, AxisDemand, State, State, Record)", Axis, AxisDemand, State, Record)
def recorded(axis: Axis, demand: AxisDemand, before: State, now: State, record: Record) -> State:
    """Record what an axis did from one state to the next; the next one, with how far the record is."""
    since, slide, noted = before.slide, now.slide, before.noted
    slip_um = slide.lost_um - since.lost_um
    sample = sampled(record, noted.sample, since, slide.velocity, slide.t_s)
    number, slip = noted.bin, noted.slip
    if since.t_s < demand.braked_s:
        values = values_of(demand, before, now)
        number = binned(record.bins, number, since.t_s, min(slide.t_s, demand.braked_s), values)
        peaked(record, values, limits_of(axis, now.rating), slide)
    if slip_um != 0.0:
        record.slip_s[slip], record.slip_um[slip], record.slip_at_um[slip] = slide.t_s, slip_um, slide.at_um
        slip += 1
    noted = Noted(sample, number, slip, now.noted.shake, now.noted.commanded, now.noted.ticks)
    return State(slide, now.turn, now.rating, noted, now.tripped_s)


@compiled("f8(AxisDemand, State)", AxisDemand, State)
def due_s(demand: AxisDemand, state: State) -> float:
    """When an axis has something to do: at its next pulse where it rests."""
    slide = state.slide
    if not slide.rests:
        return slide.t_s
    return math.inf if slide.t_s >= demand.braked_s else max(slide.t_s, demand.train.t_s[state.turn.begun])


@compiled("(State, f8)", State)
def waited(state: State, until_s: float) -> State:
    """An axis that has rested until a time; its step rate is taken anew then."""
    slide, turn, rating = state.slide, state.turn, state.rating
    rested = Slide(until_s, slide.at_um, 0.0, 0.0, slide.lost_um, slide.lag_um, slide.force, False)
    still = Turn(turn.place_um, until_s, 0.0, turn.begun, turn.done)
    aged = Rating(rating.limit, rating.pull_out_um, until_s, rating.first, rating.last)
    return State(rested, still, aged, state.noted, state.tripped_s)


@compiled("(Axis, AxisDemand, State)", Axis, AxisDemand, State)
def ticked(axis: Axis, demand: AxisDemand, state: State) -> State:
    """An axis after a tick; its slide goes no farther than the stops of the travel, which take its velocity."""
    slide, ahead = state.slide, ahead_of(axis, demand, state)
    now = driven(axis, demand, slide, ahead)
    at_um = slide.at_um + now.velocity * ahead.tick_s
    if axis.low_um <= at_um <= axis.high_um:
        return after(axis, demand, state, ahead, Passed(now.force, at_um, now.velocity))
    stop_um = min(max(at_um, axis.low_um), axis.high_um)
    velocity = (stop_um - slide.at_um) / ahead.tick_s
    return after(axis, demand, state, ahead, Passed(now.force, stop_um, velocity))
