"""One axis over a whole run, stretch by stretch of its pulses, whatever goes through them."""

import copy
import math
from collections.abc import Iterator
from typing import Any, Protocol, Self

import numpy as np

from parser.geometry.curves import Floats
from sim.setup.machine.table import TableModel
from sim.table.axis import Axis, AxisDemand, Noted, State, standing
from sim.table.course import Body
from sim.table.drive import drives_of
from sim.table.forms import oscillation_of
from sim.table.history import PEAKS, VALUES, Bins, Record, borders_s
from sim.table.losses import Slip
from sim.table.rating import RATE_WINDOW_S, Rating, rated, strength_of
from sim.table.recording import recorded
from sim.table.store import no_swings
from sim.table.swings import due_s, followed, waited
from sim.table.ticks import Ticks
from sim.table.turning import Train, Turn, away_um, is_closed, loop_of

_SLIPS = 1024
"""Slips that a record has room for, until they are told."""


class Engine(Protocol):
    """What goes through the pulses of an axis, from state to state; each engine has states of its own."""

    @property
    def ahead_s(self) -> float:
        """How far pulses have to be known beyond the time up to which they are followed."""

    def at_rest(self, train: Train, at_um: float, rating: Rating) -> Any:
        """The state of an axis at rest at a place, its motor there too, at time 0."""

    def due_s(self, demand: AxisDemand, state: Any) -> float:
        """When an axis has something to do."""

    def followed(self, demand: AxisDemand, state: Any, record: Record) -> Any:
        """An axis once it has followed its pulses as far as they lead, its record is full of slips, or it trips."""

    def rested(self, demand: AxisDemand, state: Any, record: Record) -> Any:
        """An axis that rests until the end."""

    def copy(self) -> Self:
        """The same, to go on from here by itself later on."""

    def moved_by(self, state: Any, by_um: float) -> Any:
        """A state whose slide stands so far off, and of which nothing is recorded yet."""


class ByEvents:
    """An axis that goes from event to event, exactly, in a compiled loop."""

    ahead_s = 1.5 * RATE_WINDOW_S

    def __init__(self, axis: Axis) -> None:
        self._axis, self._swings = axis, no_swings()

    def at_rest(self, train: Train, at_um: float, rating: Rating) -> State:
        """At rest at a place, its motor there too, at time 0."""
        turn, noted = Turn(at_um, 0.0, 0.0, 0, 0, 0), Noted(0, 0, 0, 0, 0)
        return State(0.0, standing(at_um), 0.0, True, turn, rating, noted, math.inf)

    def due_s(self, demand: AxisDemand, state: State) -> float:
        """When an axis has something to do: at its next pulse where it rests."""
        return due_s(self._axis, demand, state)

    def followed(self, demand: AxisDemand, state: State, record: Record) -> State:
        """An axis once it has followed its pulses as far as they lead, its record is full of slips, or it trips."""
        return followed(self._axis, demand, state, record, self._swings)

    def rested(self, demand: AxisDemand, state: State, record: Record) -> State:
        """An axis that rests until the end."""
        return recorded(self._axis, demand, state, waited(state, demand.until_s), record)

    def copy(self) -> Self:
        """The same, with swings of its own from here on."""
        other = copy.copy(self)
        other._swings = copy.deepcopy(self._swings)
        return other

    def moved_by(self, state: State, by_um: float) -> State:
        """A state whose slide stands so far off, and of which nothing is recorded yet."""
        course = state.course._replace(at_um=state.course.at_um + by_um, lag_um=state.course.lag_um - by_um)
        return state._replace(course=course, noted=state.noted._replace(sample=0, bin=0))


def axis_of(model: TableModel, number: int, room_um: Floats, speed_limit_um_s: float) -> Axis:
    """An axis of a table, by number; `room_um` (2,) is its travel."""
    drive, motor = drives_of(model)[number], model.motor
    loop = loop_of(motor)
    low, high = room_um.tolist()
    return Axis(
        body=Body(drive, oscillation_of(drive), low, high),
        strength=strength_of(motor, drive),
        loop=loop,
        step_time_s=loop.period_s or motor.step_time_s,
        trip_um=motor.following_error_limit_um,
        speed_limit_um_s=speed_limit_um_s,
    )


class AxisRun:
    """One axis of a run: it takes pulses, and follows them as far as it is let.

    Attributes
    ----------
    record
        What is kept of it.
    """

    def __init__(self, axis: Axis, at_um: int, ticks: Ticks, engine: Engine) -> None:
        place = float(at_um)
        self._engine, self._loop = engine, axis.loop
        self.record = _record_of(borders_s(ticks), ticks.looks[0], place)
        self._train = Train(np.array([np.inf]), np.array([place]))
        rating = rated(axis.strength, self._train, Rating(0.0, 0.0, 0.0, 0, 0), -RATE_WINDOW_S)
        self._state = engine.at_rest(self._train, place, rating)

    @property
    def state(self) -> Any:
        """How far it has come."""
        return self._state

    @property
    def trip(self) -> Slip:
        """Where it stands as its servo trips, and by what: its lag, or how far what its loop looks at is behind."""
        state, loop = self._state, self._loop
        error_um = away_um(loop, self._train, state.turn, state.at_um) if is_closed(loop) else state.lag_um
        return Slip(state.tripped_s, error_um, state.at_um)

    @property
    def ahead_s(self) -> float:
        """How far its pulses have to be known beyond the time to which it is to follow them."""
        return self._engine.ahead_s

    def take(self, t_s: Floats, place_um: Floats) -> None:
        """Take the next pulses, n of them: when they come, and the places (n,) that they command."""
        state, train = self._state, self._train
        done = min(state.turn.done, state.rating.first, state.noted.commanded)
        self._train = Train(
            np.concatenate([train.t_s[done:-1], t_s, [np.inf]]), np.concatenate([train.place_um[done:], place_um])
        )
        turn, rating, noted = state.turn, state.rating, state.noted
        self._state = state._replace(
            turn=turn._replace(begun=turn.begun - done, done=turn.done - done),
            rating=rating._replace(first=rating.first - done, last=rating.last - done),
            noted=noted._replace(commanded=noted.commanded - done),
        )

    def follow(self, until_s: float, braked_s: float) -> Iterator[Slip]:
        """Follow the pulses up to a time, and brake from another on; yields the slips of the motor."""
        axis_demand, record = AxisDemand(self._train, braked_s, until_s), self.record
        while self._engine.due_s(axis_demand, self._state) < until_s and self._state.tripped_s >= braked_s:
            state = self._engine.followed(axis_demand, self._state, record)
            slips = state.noted.slip
            self._state = state._replace(noted=state.noted._replace(slip=0))
            columns = (column[:slips].tolist() for column in (record.slip_s, record.slip_um, record.slip_at_um))
            yield from map(Slip, *columns)

    def rest(self, until_s: float, braked_s: float) -> None:
        """Rest until a time, once all pulses have been followed."""
        if self._state.t_s < until_s:
            self._state = self._engine.rested(AxisDemand(self._train, braked_s, until_s), self._state, self.record)

    def copy(self) -> "AxisRun":
        """The same, to go on from here by itself later on.

        Both write their samples and slips into one place: who goes on later writes over what the other one wrote.
        """
        other, record = copy.copy(self), self.record
        bins, peaks = copy.deepcopy((record.bins, record.peaks))
        other.record, other._engine = record._replace(bins=bins, peaks=peaks), self._engine.copy()
        return other

    def neighbour(self, state: Any, by_um: float) -> "AxisRun":
        """A run that goes on by itself from a state of this one, its slide so far off; it keeps nothing but slips."""
        other = copy.copy(self)
        other.record = _record_of(self.record.bins.border_s[[0, -1]], np.empty(0), state.at_um)
        other._engine = self._engine.copy()
        other._state = self._engine.moved_by(state, by_um)
        return other


def _record_of(border_s: Floats, sample_s: Floats, place_um: float) -> Record:
    """The record of a run that has not begun, from a place on, with bins and samples."""
    cells, peak = (len(border_s) - 1) * VALUES, [-1.0, 0.0, 0.0, 0.0, place_um]
    return Record(
        bins=Bins(border_s, np.full(cells, np.inf), np.full(cells, -np.inf), np.zeros(cells)),
        peaks=np.array(PEAKS * peak),
        sample_s=np.append(sample_s, np.inf),
        sampled_um=np.zeros(len(sample_s)),
        slip_s=np.zeros(_SLIPS),
        slip_um=np.zeros(_SLIPS),
        slip_at_um=np.zeros(_SLIPS),
    )
