"""History: velocity, acceleration, lag, following error and force of each axis over the time of a whole run.

Its memory does not grow with the ticks: time is cut into at most 2000 bins, and each bin keeps the lowest, the highest
and the mean value of the ticks in it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.setup.machine.table_model import TableModel
from sim.table.physics.drive import drives_of
from sim.table.record.bins import Envelope, Share, Tally, share_of
from sim.table.record.ripple import QUANTITIES, ripple
from sim.table.record.travelled import Travelled
from sim.table.solve.lanes import Lanes
from sim.table.solve.slab import Slab
from sim.table.solve.slow_step import SlowStep
from sim.table.when.ticks import Ticks
from sim.units import newtons

BINS: Final = 2000
"""Most bins of a run: about one for each pixel across a picture."""
LEAST_BINS: Final = 100
SAMPLES_A_BIN: Final = 2
"""Samples of the trace in a bin, where a run has too few for `BINS`: between two samples the slide may only creep."""


@dataclass(frozen=True, slots=True, eq=False)
class History:
    """Motion of the table over time, in b bins.

    In long ticks (`Ticks.long`) slow steps are not worked out one by one. There the lowest and the highest value are
    those within one slow step, and the mean is that of a slide that creeps, and of its rests.

    Attributes
    ----------
    t_s
        (b + 1,) float64, borders of the bins, from 0 until the table has come to rest, or a drive tripped.
    velocity_um_s, acceleration_um_s2
        Of the table. The mean velocity is way over time, the mean acceleration is change of velocity over time.
    lag_um
        Of the table behind its motors. A stepper's pull-out and a servo's limit are limits of the lag.
    following_error_um
        Of the table behind the place commanded; way that its motors lost stays in it.
    force_n
        Of the drives.
    """

    t_s: Floats
    velocity_um_s: Envelope
    acceleration_um_s2: Envelope
    lag_um: Envelope
    following_error_um: Envelope
    force_n: Envelope


class SlabRun(NamedTuple):
    """A slab of n ticks that a table has run: its lanes, its ticks in order, and the places (n, 2) commanded then."""

    slab: Slab
    lanes: Lanes
    travelled: Travelled
    commanded_um: Floats


class HistoryMeter:
    """Gathers the history as a table travels, from rest at `origin_um` on; `ticks` tell how long it will."""

    def __init__(self, model: TableModel, slow: SlowStep, ticks: Ticks, origin_um: tuple[int, int]) -> None:
        self._drives, self._step_time_s = drives_of(model), model.motor.step_time_s
        self._ripple = ripple(model, slow)
        bins = min(max(int(ticks.sampled.sum()) // SAMPLES_A_BIN, LEAST_BINS), BINS)
        self._border_s = np.linspace(0.0, ticks.t_s[-1], bins + 1)
        self._until_s = 0.0
        self._commanded_um = np.array([origin_um], dtype=np.float64)
        self._tallies = {name: Tally(bins) for name in QUANTITIES}

    def take(self, run: SlabRun, trip_s: float) -> None:
        """Take the next ticks; ticks after `trip_s`, when a drive tripped, do not count."""
        count = int(np.searchsorted(run.travelled.t_s, trip_s, side="right"))
        if not count:
            return
        border_s = run.slab.t_s[: count + 1]
        share = share_of(self._border_s, border_s)
        for name, values in zip(QUANTITIES, self._values(run), strict=True):
            ends = _at_rest(run, values) if name == "velocity_um_s" else values
            self._tallies[name].take(share, values[:count], ends[:count])
        if run.slab.long.any():
            self._show_steps(share, run)
        self._until_s = float(border_s[-1])
        self._commanded_um = run.commanded_um[-1:]

    def result(self) -> History:
        """The history up to now."""
        bins = int(np.searchsorted(self._border_s, self._until_s))
        t_s = np.append(self._border_s[:bins], self._until_s)
        return History(t_s, **{name: tally.result(np.diff(t_s)) for name, tally in self._tallies.items()})

    def _values(self, run: SlabRun) -> Iterator[Floats]:
        """Values (n, 2) of the ticks, for each of `QUANTITIES` in turn."""
        yield run.travelled.velocity
        yield _acceleration(run)
        yield run.travelled.lag_um
        yield self._error_um(run)
        yield newtons(self._force(run) * self._drives.mass_kg[:, 0])

    def _show_steps(self, share: Share, run: SlabRun) -> None:
        """Widen bins in which slides creep by the ripple of single steps; following errors add the way lost so far."""
        count = len(share.length_s)
        steps = np.rint(run.travelled.velocity[:count] * share.length_s) * run.slab.long[:count, None]
        lost = np.rint(run.commanded_um - run.travelled.place_um - run.travelled.lag_um)[:count]
        for way, low, high in ((1.0, *self._ripple), (-1.0, *self._ripple.backward())):
            goes = way * steps > 0.0
            least = share.reduced(np.minimum, np.where(goes, lost, np.inf))
            most = share.reduced(np.maximum, np.where(goes, lost, -np.inf))
            nowhere = np.where(np.isinf(least), np.inf, 0.0)
            for name, lowest, highest in zip(QUANTITIES, low, high, strict=True):
                about = (least, most) if name == "following_error_um" else (nowhere, -nowhere)
                self._tallies[name].show(share, about[0] + lowest, about[1] + highest)

    def _error_um(self, run: SlabRun) -> Floats:
        """Following error (n, 2); in a long tick its mean.

        On the mean, a motor is late by half the time of a step. A long tick ends at rest, where that does not show.
        """
        long = _long(run)
        before = np.concatenate([self._commanded_um, run.commanded_um[:-1]])
        speed = (run.commanded_um[long] - before[long]) / run.slab.length_s[long, None]
        error: Floats = run.commanded_um - run.travelled.place_um
        error[long] += speed * (self._step_time_s / 2.0)
        return error

    def _force(self, run: SlabRun) -> Floats:
        """Force over mass (n, 2); in a long tick that of the drive train at rest, whose spring stays wound up."""
        long, travelled = _long(run), run.travelled
        slack, spring = self._drives.slack_um[:, 0], self._drives.spring[:, 0]
        lag, limit, force = travelled.lag_um[long], travelled.limit[long], travelled.force.copy()
        force[long] = np.clip(spring * (lag - np.clip(lag, -slack, slack)), -limit, limit)
        return force


def _long(run: SlabRun) -> Ints:
    return np.flatnonzero(run.slab.long[:-1])


def _at_rest(run: SlabRun, velocity: Floats) -> Floats:
    """Velocity (n, 2) at the end of each tick, 0 in a long one: its recorded mean may hold a whole step."""
    after = velocity.copy()
    after[_long(run)] = 0.0
    return after


def _acceleration(run: SlabRun) -> Floats:
    """Acceleration (n, 2); a long tick begins and ends at rest.

    Each lane counts from its own first state: the lane before it may have ended a hair away from that.
    """
    after = _at_rest(run, run.travelled.velocity)
    before = np.concatenate([after[:1], after[:-1]])
    ticks = run.lanes.inside.sum(axis=0)
    before[np.cumsum(ticks) - ticks] = run.lanes.begun.velocity
    acceleration: Floats = (after - before) / run.slab.length_s[:-1, None]
    return acceleration
