"""The table follows the pulses as they stream in, slab by slab; what it keeps does not grow with the ticks."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from parser.units import from_mm
from sim.setup.machine.table_model import TableModel
from sim.table.physics.bodies import Engines
from sim.table.physics.motor import Motors
from sim.table.physics.state import State
from sim.table.record.history import History, HistoryMeter, SlabRun
from sim.table.record.losses import Loss, LossTally
from sim.table.record.peaks import Peak, PeakMeter
from sim.table.record.travelled import Travelled, travelled_of
from sim.table.solve.march import RunTable
from sim.table.solve.passes import run_slab
from sim.table.solve.slab import RATE_WINDOW_S, Slab, slab_of
from sim.table.solve.slow_step import NO_PLAY, SlowStep
from sim.table.trace import Trace
from sim.table.when.rhythm import Rhythm, rhythm
from sim.table.when.ticks import Ticks

SLAB_TICKS = 1 << 18


class Setup(NamedTuple):
    """A table set up for a program.

    Attributes
    ----------
    model
        The table.
    start_um
        Place of the program's start on the table, from the corner of the travel.
    origin_um
        The same place in program coordinates, where the pulses begin.
    slow
        What slow steps do to its slides (`sim.table.solve.trial`).
    speed_limit_um_s
        Speed limits of X and Y, for their peaks; infinite where there is none.
    """

    model: TableModel
    start_um: tuple[float, float]
    origin_um: tuple[int, int]
    slow: SlowStep = NO_PLAY
    speed_limit_um_s: tuple[float, float] = (np.inf, np.inf)

    @property
    def room_um(self) -> Floats:
        """Lowest and highest place of the travel, (2, 2) in program coordinates."""
        travel = from_mm(np.array([[0.0, 0.0], [self.model.travel_x_mm, self.model.travel_y_mm]]))
        room: Floats = travel - np.array(self.start_um) + np.array(self.origin_um)
        return room


class Following:
    """A table that follows pulses, from rest at the program's start; `ticks` tell when its motion is worked out."""

    def __init__(self, setup: Setup, ticks: Ticks) -> None:
        self._setup, self._ticks = setup, ticks
        engines = Engines(setup.model, setup.room_um)
        self._table = RunTable(setup.model, setup.room_um, setup.slow, engines)
        self._felt_s = rhythm(setup.model).felt_s
        self._motors = Motors(setup.model.motor.step_time_s, setup.origin_um)
        origin = np.array([setup.origin_um], dtype=np.float64)
        self._state = State(origin, np.zeros((1, 2)), np.zeros((1, 2)), np.zeros(1, dtype=bool))
        self._losses, self._peaks = LossTally(setup.model), PeakMeter(setup.model, setup.speed_limit_um_s)
        self._history = HistoryMeter(setup.model, setup.slow, ticks, setup.origin_um)
        # Slabs end where the trace has a sample, so that no long tick is cut off from what follows it.
        self._ends = np.flatnonzero(ticks.sampled) + 1
        self._ticks_before = np.concatenate([[0], np.cumsum(_likely_parts(ticks, rhythm(setup.model)))])
        self._share = 1.0  # of the likely ticks: how many of them the last slab really had
        self._done = 0
        samples = len(self._ends) + 1
        self._t_s, self._row = np.zeros(samples), np.zeros(samples, dtype=np.int64)
        self._place, self._commanded = np.repeat(origin, samples, axis=0), np.repeat(origin, samples, axis=0)
        self._row[0] = ticks.row[0]
        self._sampled = 1

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates, and let the table follow as far as they lead."""
        self._motors.take(pulses, self._needed_s())
        self._advance(self._motors.known_s - RATE_WINDOW_S, whole=False)

    def finish(self) -> tuple[Trace, tuple[Loss, ...], tuple[Peak, ...], History]:
        """Let the table come to rest, and sum up."""
        self._advance(np.inf, whole=True)
        trace = Trace(self._t_s, self._commanded, self._place, self._place, self._row)
        return trace, self._losses.result(), self._peaks.result(), self._history.result()

    def _needed_s(self) -> float:
        """Time from which on pulses are still needed."""
        if self._done == len(self._ticks.t_s):
            return float(self._ticks.t_s[-1])
        return self.followed_s - max(RATE_WINDOW_S, float(self._ticks.t_s[self._done]) - self.followed_s)

    @property
    def followed_s(self) -> float:
        """Time up to which the table has followed."""
        return float(self._ticks.t_s[self._done - 1]) if self._done else 0.0

    @property
    def tripped_s(self) -> float:
        """When a drive tripped, as far as the table has followed; infinite where none did."""
        return min((loss.t_s for loss in self._losses.result() if loss.kind == "trip"), default=np.inf)

    def _advance(self, until_s: float, *, whole: bool) -> None:
        """Follow up to a time; the last slab waits while it is not full, unless `whole` asks for all of it."""
        setup = self._setup
        for part in self._slabs(until_s, whole=whole):
            slab = slab_of(self._ticks, part, self._motors, setup.model, self._felt_s)
            lanes = run_slab(slab, self._state, self._table)
            self._state = lanes.end.of(np.array([-1]))
            travelled = travelled_of(slab, lanes, self._ticks.row)
            self._losses.take(travelled)
            self._peaks.take(travelled.until(self.tripped_s))
            commanded_um = self._motors.commanded_um(travelled.t_s)
            self._history.take(SlabRun(slab, lanes, travelled, commanded_um), self.tripped_s)
            self._sample(slab, part, travelled)
            likely = self._ticks_before[part.stop] - self._ticks_before[part.start]
            self._share = min(max(len(slab) / likely, 0.1), 1.0)
            self._done = part.stop

    def _slabs(self, until_s: float, *, whole: bool) -> Iterator[slice]:
        """Cut the stretches up to a time into slabs of about `SLAB_TICKS` ticks."""
        last = int(np.searchsorted(self._ticks.t_s[self._ends - 1], until_s, side="right"))
        ends = self._ends[:last]
        while self._done < (ends[-1] if last else 0):
            full = self._ticks_before[self._done] + SLAB_TICKS / self._share
            if self._ticks_before[ends[-1]] < full and not whole:
                return
            first = int(np.searchsorted(ends, self._done, side="right"))
            fit = int(np.searchsorted(self._ticks_before[ends], full, side="right")) - 1
            yield slice(self._done, int(ends[max(first, fit)]))

    def _sample(self, slab: Slab, part: slice, travelled: Travelled) -> None:
        """Keep what the trace samples: the ends of some stretches."""
        last = np.append(np.flatnonzero(np.diff(slab.stretch)), len(slab) - 1)
        last = last[self._ticks.sampled[part]]
        kept = slice(self._sampled, self._sampled + len(last))
        self._t_s[kept], self._row[kept] = travelled.t_s[last], travelled.row[last]
        self._place[kept] = travelled.place_um[last]
        self._commanded[kept] = self._motors.commanded_um(travelled.t_s[last])
        self._sampled = kept.stop


def _likely_parts(ticks: Ticks, rhythm: Rhythm) -> Floats:
    """About how many ticks (n,) each stretch makes: a long tick gets short ones at both ends, while steps are felt."""
    waiting = np.minimum(np.diff(ticks.t_s, prepend=0.0), 2.0 * rhythm.felt_s) / rhythm.step_tick_s
    return np.where(ticks.long, waiting, ticks.parts)
