"""The march: many tables in step, each through ticks of its own. The hot path; all of it in whole arrays of tables."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.setup.machine.table_model import TableModel
from sim.table.physics.bodies import Engines
from sim.table.physics.drive import Drives, Kick, drives_of, kicked
from sim.table.physics.state import State
from sim.table.solve.slab import Slab
from sim.table.solve.slow_step import SlowStep


class RunTable(NamedTuple):
    """A table with its place, and the engines that run it.

    Attributes
    ----------
    model
        Masses, drives, guides.
    room_um
        Lowest and highest place of its travel, (2, 2) in program coordinates.
    slow
        What slow steps do to its slides.
    engines
        Engines with such tables.
    """

    model: TableModel
    room_um: Floats
    slow: SlowStep
    engines: Engines


class Record(NamedTuple):
    """What n tables did in l ticks, each (l, 2, n): place before a tick, the rest after it; force over mass."""

    place_um: Floats
    velocity: Floats
    force: Floats
    lag_um: Floats
    lost_um: Floats


class March:
    """Tables on their way through ticks (l, n) of a slab; where a table has fewer, the last is one without length."""

    def __init__(self, slab: Slab, tick: Ints, table: RunTable) -> None:
        self._table, self._drives = table, drives_of(table.model)
        self._low, self._high = (place[:, None] for place in table.room_um)
        self._length, self._divisor = slab.length_s[tick], slab.divisor_s[tick]
        self._long, self._standing = slab.long[tick], slab.from_rest[tick]
        self._any_long = np.any(self._long, axis=1).tolist()
        self._tick_of, self._steps, self._chained = tick, slab.steps, slab.chained
        self._place, self._speed, self._limit = (
            np.ascontiguousarray(column[tick].transpose(0, 2, 1))
            for column in (slab.place_um, slab.speed_um_s, slab.limit)
        )
        self._least_pull_out = float(pull_out_um(self._drives, table.model, self._limit).min())
        self._record = Record(*(np.zeros(self._place.shape) for _ in Record._fields))

    def run(self, begin: State) -> tuple[Record, State]:
        """Let all ticks pass; what the tables did, and their state then."""
        self._tables = self._table.engines.of(len(begin.tripped))
        self._tables.put(begin.at_um.T)
        self._velocity, self._lost = begin.velocity.T.copy(), begin.lost_um.T.copy()
        self._tripped = begin.tripped.copy()
        self._rested = self._place[0] - self._lost - begin.at_um.T
        for number in range(len(self._length)):
            self._tick(number)
        return self._record, State(self._reached().T.copy(), self._velocity.T, self._lost.T, self._tripped)

    def _reached(self) -> Floats:
        """Where the tables (2, n) are once they have made their last move; none gets past a stop."""
        reached: Floats = np.minimum(np.maximum(self._tables.at_um + self._tables.move_um, self._low), self._high)
        return reached

    def _tick(self, number: int) -> None:
        tables, length, at = self._tables, self._length[number], self._reached()
        kick = Kick(self._place[number] - self._lost, self._speed[number], length, self._limit[number])
        velocity = np.where(self._standing[number], 0.0, self._velocity)
        new, force = kicked(self._drives, at, velocity, kick)
        lag = kick.place_um - at
        if self._any_long[number]:
            self._creep(number, at, kick, (new, force, lag))
        if self._tripped.any():
            braked = velocity / (1.0 + length * (self._drives.damper + self._drives.viscous))
            new, force, lag = (np.where(self._tripped, *pair) for pair in ((braked, new), (0.0, force), (0.0, lag)))
        tables.step(new * length - tables.move_um)
        goes = length > 0.0
        self._velocity = np.where(goes, tables.move_um / self._divisor[number], velocity)
        self._note(number, at, force, lag * goes)

    def _creep(self, number: int, at: Floats, kick: Kick, ways: tuple[Floats, Floats, Floats]) -> None:
        """Write velocity, force and lag of a tick into `ways` for the tables to which it is a long one.

        A motor too weak for the friction draws nothing.
        """
        velocity, force, lag = ways
        which = np.flatnonzero(self._long[number])
        tick, place = self._tick_of[number, which], kick.place_um[:, which]
        steps, before = self._steps[tick].T, at[:, which]
        begin = np.where(self._chained[tick], self._rested[:, which], place - steps - before)
        weak = kick.limit[:, which] <= self._drives.friction
        rest = np.where(weak, begin + steps, self._table.slow.rest_um(begin, steps))
        drawn = np.minimum(np.maximum(place - rest, self._low), self._high)
        self._rested[:, which] = lag[:, which] = place - drawn
        velocity[:, which] = (drawn - before) / self._divisor[number, which]
        force[:, which] = 0.0

    def _note(self, number: int, at: Floats, force: Floats, lag: Floats) -> None:
        """Write down a tick, and what the motors lose in it."""
        record = self._record
        record.place_um[number], record.velocity[number] = at, self._velocity
        record.force[number], record.lag_um[number] = force, lag
        most = np.abs(lag).max()
        if most > self._least_pull_out:
            slip = self._slip(lag, self._limit[number])
            record.lost_um[number] = slip
            self._lost += slip
            self._rested -= slip
        if most > self._table.model.motor.following_error_limit_um:
            self._tripped |= (np.abs(lag) > self._table.model.motor.following_error_limit_um).any(axis=0)

    def _slip(self, lag_um: Floats, limit: Floats) -> Floats:
        """Way (2, n) that the motors lose: whole electrical periods, until the lag is within the pull-out again."""
        period = self._table.model.motor.electrical_period_um
        beyond = np.abs(lag_um) - pull_out_um(self._drives, self._table.model, limit)
        return np.sign(lag_um) * np.ceil(np.maximum(beyond, 0.0) / period) * period


def pull_out_um(drives: Drives, model: TableModel, limit: Floats) -> Floats:
    """Lag at which a stepper slips: its train wound up by its largest force, slack, half a period. Infinite for servos.

    `limit` (..., 2, n) is the largest force over the mass. Half a period from where it belongs a rotor stands between
    two places alike: the unstable balance of its torque over its angle, past which it falls to the next.
    """
    if model.motor.kind == "servo":
        return np.full_like(limit, np.inf)
    return limit / drives.spring + drives.slack_um + model.motor.electrical_period_um / 2.0
