"""The reference: an axis in ticks, in Python, with the table as bodies that pymunk moves; ``--engine pymunk``.

A saddle on X guides carries a carriage on Y guides, with stops at their ends. The engine's lengths are µm, its masses
kg. Its clock counts ticks, and a velocity is the way in a tick: so each axis may have ticks of its own.

It is some thousand times slower than the compiled loop, and as exact as its ticks are fine.
"""

import math
from typing import NamedTuple

import numpy as np
import pymunk

from parser.controller_words import Axis as AxisName
from parser.geometry.curves import Floats
from sim.setup.machine.table import TableModel
from sim.table.axis import Axis, AxisDemand, Noted
from sim.table.course import STILL_UM
from sim.table.history import VALUES, Bins, Limits, PeakPlace, Record, take_peak, widened
from sim.table.kicks import Kick, Kicked, kicked
from sim.table.rating import RATE_WINDOW_S, Rating, rated
from sim.table.ticks import Ticks
from sim.table.turning import Train, Turn, away_um, is_closed, is_idle, looks_at_s, steered, turned


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

    def moved_um(self, axis: AxisName, slide: Slide, way_um: float) -> float:
        """Where an axis is after a tick in which its drive pushes its slide to go a way; no farther than its stops.

        A step of the engine moves the bodies first and pushes them then. So the slide is put to where it was a tick
        before; it comes from there, and is pushed.
        """
        came_um = slide.velocity * slide.tick_s
        driven = self._saddle if axis is AxisName.X else self._carriage
        for body in (self._saddle, self._carriage):
            place, velocity = list(body.position), [0.0, 0.0]
            if body is driven or axis is AxisName.X:
                place[axis], velocity[axis] = slide.at_um - came_um, came_um
            body.position, body.velocity = (place[0], place[1]), (velocity[0], velocity[1])
        push = (way_um - came_um) * self._moved_kg[axis]
        driven.force = (push, 0.0) if axis is AxisName.X else (0.0, push)
        self._space.step(1.0)
        reached_um = self._carriage.position[axis] + self._carriage.velocity[axis]
        low, high = self._room
        return float(min(max(reached_um, low[axis]), high[axis]))


class Rhythms(NamedTuple):
    """Ticks of an axis while single steps are felt, while its motor makes several at once, and while it is shaken.

    `shakes_s` are the times at which shakes by more than a step begin and end in turn, and infinity.
    """

    step_tick_s: float
    steps_tick_s: float
    shaken_tick_s: float
    shakes_s: Floats


class BodyState(NamedTuple):
    """How far an axis has come; `shake` is its next shake, `tripped_s` when its servo tripped, infinite else."""

    slide: Slide
    turn: Turn
    rating: Rating
    noted: Noted
    shake: int
    tripped_s: float

    @property
    def t_s(self) -> float:
        """Now."""
        return self.slide.t_s

    @property
    def at_um(self) -> float:
        """Place of the slide."""
        return self.slide.at_um

    @property
    def lag_um(self) -> float:
        """Its lag behind the motor."""
        return self.slide.lag_um


class Values(NamedTuple):
    """What an axis does in a tick: µm/s, µm/s², µm, µm, and the drive's force over the mass, µm/s²."""

    velocity: float
    acceleration: float
    lag_um: float
    error_um: float
    force: float


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


def _turned(axis: Axis, demand: AxisDemand, turn: Turn, slide_um: float, t_s: float) -> Turn:
    """The motor of an axis at a later time: from step to step, or as its loop lets it, which sees the slide there."""
    if is_closed(axis.loop):
        return steered(axis.loop, demand.train, turn, slide_um, t_s)
    return turned(demand.train, axis.step_time_s, turn, t_s)


def _ahead_of(axis: Axis, rhythms: Rhythms, demand: AxisDemand, state: BodyState) -> Ahead:
    """What a tick asks of a drive.

    The kick goes from the middle of the tick before it to the middle of its own. A slide that has rested is kicked by
    the half of its own tick alone.
    """
    slide, shake = state.slide, state.shake
    while rhythms.shakes_s[shake] <= slide.t_s:
        shake += 1
    tick_s = rhythms.steps_tick_s if state.turn.begun - state.turn.done > 1 else rhythms.step_tick_s
    if shake % 2:
        tick_s = rhythms.shaken_tick_s
    rating = state.rating
    if slide.t_s >= rating.until_s:
        rating = rated(axis.strength, demand.train, rating, slide.t_s)
    turn = _turned(axis, demand, state.turn, slide.at_um, slide.t_s + tick_s / 2.0)
    length_s = (slide.tick_s + tick_s) / 2.0
    motor_um = (state.turn.place_um + turn.place_um) / 2.0 - slide.lost_um
    at_um = slide.at_um + slide.velocity * (tick_s - slide.tick_s) / 4.0
    motor_um_s = (turn.place_um - state.turn.place_um) / length_s
    kick = Kick(motor_um - at_um, motor_um_s, slide.velocity, length_s, rating.limit)
    return Ahead(tick_s, shake, kick, turn, rating)


def _driven(axis: Axis, demand: AxisDemand, slide: Slide, ahead: Ahead) -> Kicked:
    """What a drive does in a tick: once a servo has tripped, nothing drives, and both axes brake."""
    drive = axis.body.drive
    if slide.t_s < demand.braked_s:
        return kicked(drive, ahead.kick)
    return Kicked(slide.velocity / (1.0 + ahead.kick.length_s * (drive.damper + drive.viscous)), 0.0)


def _slip_of(ahead: Ahead, period_um: float) -> float:
    """Way that a motor loses: whole electrical periods, until the lag is within the pull-out again."""
    beyond_um = abs(ahead.kick.lag_um) - ahead.rating.pull_out_um
    if beyond_um <= 0.0:
        return 0.0
    return math.copysign(math.ceil(beyond_um / period_um) * period_um, ahead.kick.lag_um)


def _stands(axis: Axis, demand: AxisDemand, ahead: Ahead, passed: Passed) -> bool:
    """Whether a slide stands from now on while its motor does: the next tick would be like this one.

    Friction stops a slide for good. Without friction it rings ever less, and counts as resting within `STILL_UM`.
    """
    drive, kick = axis.body.drive, ahead.kick
    if kick.motor_um_s != 0.0 or not is_idle(axis.loop, demand.train, ahead.turn, passed.at_um):
        return False
    if abs(passed.force) >= kick.limit and kick.limit < axis.strength.limit[0]:  # the motor can do more at a standstill
        return False
    if kick.velocity == 0.0 and passed.velocity == 0.0:
        return True
    still = max(abs(kick.velocity), abs(passed.velocity)) < STILL_UM * math.sqrt(drive.spring)
    return still and drive.friction == 0.0 and abs(passed.force) < STILL_UM * drive.spring


def _after(axis: Axis, demand: AxisDemand, state: BodyState, ahead: Ahead, passed: Passed) -> BodyState:
    """An axis after a tick."""
    slide, noted, lag_um = state.slide, state.noted, ahead.kick.lag_um
    t_s, braked = slide.t_s + ahead.tick_s, slide.t_s >= demand.braked_s
    slip_um = 0.0 if braked else _slip_of(ahead, axis.strength.period_um)
    rests = slip_um == 0.0 and _stands(axis, demand, ahead, passed)
    velocity = 0.0 if rests else passed.velocity
    error_um = away_um(axis.loop, demand.train, ahead.turn, passed.at_um) if is_closed(axis.loop) else lag_um
    tripped_s = t_s if abs(error_um) > axis.trip_um and not braked else math.inf
    commanded = noted.commanded
    while demand.train.t_s[commanded] <= t_s:
        commanded += 1
    now = Slide(t_s, passed.at_um, velocity, ahead.tick_s, slide.lost_um + slip_um, lag_um, passed.force, rests)
    noted = noted._replace(commanded=commanded, courses=noted.courses + 1)
    return BodyState(now, ahead.turn, ahead.rating, noted, ahead.shake, min(tripped_s, state.tripped_s))


def _values_of(demand: AxisDemand, before: BodyState, now: BodyState) -> Values:
    """What an axis did from one state to the next, which is a tick later, or a rest."""
    since, slide = before.slide, now.slide
    length_s, velocity = slide.t_s - since.t_s, slide.velocity
    error_um = demand.train.place_um[now.noted.commanded] - slide.at_um
    # Where ticks become shorter, the kick is longer than the tick that it begins.
    acceleration = (velocity - since.velocity) / max(length_s, (since.tick_s + length_s) / 2.0)
    return Values(velocity, acceleration, slide.lag_um, error_um, slide.force)


def binned(bins: Bins, number: int, since_s: float, until_s: float, values: Values) -> int:
    """Take values that lasted from a time to another into bins, none before a number; the bin where they ended."""
    border_s, last = bins.border_s, len(bins.border_s) - 2
    while number < last and border_s[number + 1] <= since_s:
        number += 1
    while True:
        end_s = border_s[number + 1] if number < last else border_s[last + 1]
        length_s = min(until_s, end_s) - since_s
        for at, value in enumerate(values, number * VALUES):
            widened(bins, at, value, value, value * length_s)
        if number == last or end_s >= until_s:
            return number
        number, since_s = number + 1, end_s


def _behind_um(axis: Axis, demand: AxisDemand, state: BodyState) -> float:
    """How far what a position loop looks at is behind its command; below 0 where no loop is closed."""
    if not is_closed(axis.loop):
        return -1.0
    return abs(float(away_um(axis.loop, demand.train, state.turn, state.slide.at_um)))


def _peaked(record: Record, values: Values, limits: Limits, slide: Slide) -> None:
    """Take a tick for the peaks; `slide` is that at its end."""
    place = PeakPlace(slide.t_s, slide.at_um)
    take_peak(record, 0, abs(values.force), limits.force, place)
    take_peak(record, 1, abs(values.velocity), limits.speed, place)
    lag_um = abs(values.lag_um) if limits.behind_um < 0.0 else limits.behind_um
    take_peak(record, 2, lag_um, limits.lag_um, place)


def _recorded(axis: Axis, demand: AxisDemand, before: BodyState, now: BodyState, record: Record) -> BodyState:
    """Record what an axis did from one state to the next; the next one, with how far the record is."""
    since, slide, noted = before.slide, now.slide, before.noted
    slip_um, sample, number, slip = slide.lost_um - since.lost_um, noted.sample, noted.bin, noted.slip
    while record.sample_s[sample] <= slide.t_s:
        record.sampled_um[sample] = since.at_um + slide.velocity * (record.sample_s[sample] - since.t_s)
        sample += 1
    if since.t_s < demand.braked_s:
        values, rating = _values_of(demand, before, now), now.rating
        number = binned(record.bins, number, since.t_s, min(slide.t_s, demand.braked_s), values)
        limit_um = min(rating.pull_out_um, axis.trip_um)
        limits = Limits(rating.limit, axis.speed_limit_um_s, limit_um, _behind_um(axis, demand, now))
        _peaked(record, values, limits, slide)
    if slip_um != 0.0:
        record.slip_s[slip], record.slip_um[slip], record.slip_at_um[slip] = slide.t_s, slip_um, slide.at_um
        slip += 1
    return now._replace(noted=now.noted._replace(sample=sample, bin=number, slip=slip))


def _waited(state: BodyState, until_s: float) -> BodyState:
    """An axis that has rested until a time; its step rate is taken anew then."""
    rested = state.slide._replace(t_s=until_s, velocity=0.0, tick_s=0.0, rests=False)
    still = state.turn._replace(t_s=until_s, rising_um=0.0)
    return state._replace(slide=rested, turn=still, rating=state.rating._replace(until_s=until_s))


class InBodies:
    """An axis of a table of bodies: what `sim.table.run.ByEvents` is to one that goes from event to event."""

    def __init__(self, bodies: Bodies, name: AxisName, axis: Axis, ticks: Ticks) -> None:
        self._bodies, self._name, self._axis = bodies, name, axis
        shakes_s = np.append(ticks.shaken_s.ravel(), np.inf)
        tick_s = (ticks.step_tick_s[name], ticks.steps_tick_s[name], ticks.shaken_tick_s[name])
        self._rhythms = Rhythms(*tick_s, shakes_s)

    @property
    def ahead_s(self) -> float:
        """How far pulses have to be known beyond the time up to which they are followed."""
        return 1.5 * RATE_WINDOW_S + self._rhythms.step_tick_s

    def at_rest(self, train: Train, at_um: float, rating: Rating) -> BodyState:
        """At rest at a place, its motor there too, at time 0."""
        slide = Slide(0.0, at_um, 0.0, 0.0, 0.0, 0.0, 0.0, True)
        return BodyState(slide, Turn(at_um, 0.0, 0.0, 0, 0, 0), rating, Noted(0, 0, 0, 0, 0), 0, math.inf)

    def due_s(self, demand: AxisDemand, state: BodyState) -> float:
        """When an axis has something to do: at its next pulse where it rests."""
        slide, loop = state.slide, self._axis.loop
        if not slide.rests:
            return slide.t_s
        if slide.t_s >= demand.braked_s:
            return math.inf
        pulse_s = float(demand.train.t_s[state.turn.begun])
        return max(slide.t_s, looks_at_s(loop, pulse_s) if is_closed(loop) else pulse_s)

    def followed(self, demand: AxisDemand, state: BodyState, record: Record) -> BodyState:
        """An axis that has followed its pulses to their end, has no room for slips in its record, or has tripped."""
        while (until_s := self.due_s(demand, state)) < demand.until_s and state.noted.slip < len(record.slip_s):
            if state.tripped_s < demand.braked_s:
                break
            now = _waited(state, until_s) if until_s > state.slide.t_s else self._ticked(demand, state)
            state = _recorded(self._axis, demand, state, now, record)
        return state

    def rested(self, demand: AxisDemand, state: BodyState, record: Record) -> BodyState:
        """An axis that rests until the end."""
        return _recorded(self._axis, demand, state, _waited(state, demand.until_s), record)

    def _ticked(self, demand: AxisDemand, state: BodyState) -> BodyState:
        """An axis after a tick."""
        slide, ahead = state.slide, _ahead_of(self._axis, self._rhythms, demand, state)
        now = _driven(self._axis, demand, slide, ahead)
        at_um = self._bodies.moved_um(self._name, slide, now.velocity * ahead.tick_s)
        velocity = (at_um - slide.at_um) / ahead.tick_s
        return _after(self._axis, demand, state, ahead, Passed(now.force, at_um, velocity))

    def copy(self) -> "InBodies":
        """What goes on from here by itself: bodies stand wherever a state says."""
        return self

    def moved_by(self, state: BodyState, by_um: float) -> BodyState:
        """A state whose slide stands so far off, and of which nothing is recorded yet."""
        slide = state.slide._replace(at_um=state.slide.at_um + by_um, lag_um=state.slide.lag_um - by_um)
        return state._replace(slide=slide, noted=state.noted._replace(sample=0, bin=0))
