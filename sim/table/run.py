"""One axis over a whole run, stretch by stretch of its pulses, in the compiled loop or in the reference.

The reference: the same ticks in Python, with the table as bodies that pymunk moves; ``--engine pymunk``.

It is some thousand times slower than the compiled loop, which tests hold against it.
"""

import copy
import math
from collections.abc import Callable, Iterator

import numpy as np

from parser.controller_words import Axis as AxisName
from parser.geometry.curves import Floats
from sim.setup.machine.machine import TableModel
from sim.table.axis import (
    Axis,
    AxisDemand,
    Noted,
    Passed,
    State,
    after,
    ahead_of,
    driven,
    due_s,
    recorded,
    waited,
)
from sim.table.drive import Bodies, drives_of, resting
from sim.table.history import PEAKS, VALUES, Bins, Record, borders_s, no_swings
from sim.table.losses import Slip
from sim.table.rating import RATE_WINDOW_S, Rating, Train, Turn, rated, strength_of
from sim.table.ticks import Ticks

Engine = Callable[[Axis, AxisDemand, State, Record], State]
"""What goes through the ticks of an axis."""

_SLIPS = 1024
"""Slips that a record has room for, until they are told."""


def axis_of(model: TableModel, number: int, ticks: Ticks, room_um: Floats, speed_limit_um_s: float) -> Axis:
    """An axis of a table, by number; `room_um` (2,) is its travel."""
    drive, motor = drives_of(model)[number], model.motor
    low, high = room_um.tolist()
    return Axis(
        drive=drive,
        strength=strength_of(motor, drive),
        step_time_s=motor.step_time_s,
        trip_um=motor.following_error_limit_um,
        speed_limit_um_s=speed_limit_um_s,
        low_um=low,
        high_um=high,
        step_tick_s=ticks.step_tick_s[number],
        steps_tick_s=ticks.steps_tick_s[number],
        shaken_tick_s=ticks.shaken_tick_s[number],
        shakes_s=np.append(ticks.shaken_s.ravel(), np.inf),
    )


class AxisRun:
    """An axis that follows its pulses, from rest at a place on; `engine` goes through its ticks."""

    def __init__(self, axis: Axis, origin_um: int, ticks: Ticks, engine: Engine) -> None:
        place = float(origin_um)
        self.axis, self.record, self._engine = axis, _record_of(ticks, place), engine
        self._train = Train(np.array([np.inf]), np.array([place]))
        self._state = State(
            slide=resting(place),
            turn=Turn(place, 0.0, 0.0, 0, 0),
            rating=rated(axis.strength, self._train, Rating(0.0, 0.0, 0.0, 0, 0), -RATE_WINDOW_S),
            noted=Noted(0, 0, 0, 0, 0, 0),
            tripped_s=math.inf,
        )

    @property
    def state(self) -> State:
        """How far it has come."""
        return self._state

    @property
    def ahead_s(self) -> float:
        """How far its pulses have to be known beyond the time to which it is to follow them."""
        return 1.5 * RATE_WINDOW_S + self.axis.step_tick_s

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
        while due_s(axis_demand, self._state) < until_s and self._state.tripped_s >= braked_s:
            state = self._engine(self.axis, axis_demand, self._state, record)
            slips = state.noted.slip
            self._state = state._replace(noted=state.noted._replace(slip=0))
            columns = (column[:slips].tolist() for column in (record.slip_s, record.slip_um, record.slip_at_um))
            yield from map(Slip, *columns)

    def rest(self, until_s: float, braked_s: float) -> None:
        """Rest until a time, once all pulses have been followed."""
        if self._state.slide.t_s < until_s:
            axis_demand = AxisDemand(self._train, braked_s, until_s)
            self._state = recorded(self.axis, axis_demand, self._state, waited(self._state, until_s), self.record)

    def copy(self) -> "AxisRun":
        """The same, to go on from here by itself later on.

        Both write their samples and slips into one place: who goes on later writes over what the other one wrote.
        """
        other, record = copy.copy(self), self.record
        bins, peaks, swings = copy.deepcopy((record.bins, record.peaks, record.swings))
        other.record = record._replace(bins=bins, peaks=peaks, swings=swings)
        return other


def _record_of(ticks: Ticks, place_um: float) -> Record:
    """The record of a run that has not begun, from a place on."""
    border_s = borders_s(ticks)
    cells, peak = (len(border_s) - 1) * VALUES, [-1.0, 0.0, 0.0, 0.0, place_um]
    return Record(
        bins=Bins(border_s, np.full(cells, np.inf), np.full(cells, -np.inf), np.zeros(cells)),
        peaks=np.array(PEAKS * peak),
        sample_s=np.append(ticks.t_s, np.inf),
        sampled_um=np.zeros(len(ticks.t_s)),
        slip_s=np.zeros(_SLIPS),
        slip_um=np.zeros(_SLIPS),
        slip_at_um=np.zeros(_SLIPS),
        swings=no_swings(),
    )


class InBodies:
    """An axis of a table of bodies: what `sim.table.swings.followed` is to a compiled one."""

    def __init__(self, bodies: Bodies, name: AxisName) -> None:
        self._bodies, self._name = bodies, name

    def followed(self, axis: Axis, demand: AxisDemand, state: State, record: Record) -> State:
        """An axis that has followed its pulses to their end, has no room for slips in its record, or has tripped."""
        while (until_s := due_s(demand, state)) < demand.until_s and state.noted.slip < len(record.slip_s):
            if state.tripped_s < demand.braked_s:
                break
            waits = until_s > state.slide.t_s
            now = waited(state, until_s) if waits else self._ticked(axis, demand, state)
            state = recorded(axis, demand, state, now, record)
        return state

    def _ticked(self, axis: Axis, demand: AxisDemand, state: State) -> State:
        """An axis after a tick."""
        slide, ahead = state.slide, ahead_of(axis, demand, state)
        now = driven(axis, demand, slide, ahead)
        at_um = self._bodies.moved_um(self._name, slide, now.velocity * ahead.tick_s)
        velocity = (at_um - slide.at_um) / ahead.tick_s
        return after(axis, demand, state, ahead, Passed(now.force, at_um, velocity))
