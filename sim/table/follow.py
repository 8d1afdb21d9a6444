"""The table follows the pulses as they stream in; what it keeps does not grow with the ticks."""

from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from typing import NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.controller_words import Axis
from parser.geometry.curves import Floats, Ints
from parser.units import from_mm
from sim.setup.machine.table import Geometry, TableEngine, TableModel
from sim.table.bodies import Bodies, InBodies
from sim.table.drive import drives_of
from sim.table.history import History, history_of
from sim.table.losses import (
    Loss,
    Peak,
    Slip,
    in_order,
    peaks_of,
    trip_loss,
)
from sim.table.neighbours import AxisWithNeighbours
from sim.table.run import AxisRun, ByEvents, axis_of
from sim.table.ticks import Ticks
from sim.table.trace import Trace

_SIDE_BY_SIDE = 1 << 13
"""Pulses from which a second core is worth its while: to hand them over takes as long as some hundred."""
_GRACE_S = 1e-9
"""A pulse due at a time counts as out at that time, whichever way its time was rounded."""


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
    speed_limit_um_s
        Speed limits of X and Y, for their peaks; infinite where there is none.
    engine
        What goes through it: from event to event in one compiled loop, or by ticks with bodies that pymunk moves.
    """

    model: TableModel
    start_um: tuple[float, float]
    origin_um: tuple[int, int]
    speed_limit_um_s: tuple[float, float] = (np.inf, np.inf)
    engine: TableEngine = "compiled"

    @property
    def room_um(self) -> Floats:
        """Lowest and highest place of the travel, (2, 2) in program coordinates."""
        travel = from_mm(np.array([[0.0, 0.0], [self.model.travel_x_mm, self.model.travel_y_mm]]))
        room: Floats = travel - np.array(self.start_um) + np.array(self.origin_um)
        return room


def _runs(setup: Setup, ticks: Ticks) -> list[AxisRun]:
    """Runs of X and of Y that have not begun."""
    room, limits, origin = setup.room_um, setup.speed_limit_um_s, setup.origin_um
    axes = [axis_of(setup.model, axis, room[:, axis], limits[axis]) for axis in Axis]
    if setup.engine == "compiled":
        return [AxisRun(axes[axis], origin[axis], ticks, ByEvents(axes[axis])) for axis in Axis]
    bodies = Bodies(setup.model, room, (float(origin[0]), float(origin[1])))
    return [AxisRun(axes[axis], origin[axis], ticks, InBodies(bodies, axis, axes[axis], ticks)) for axis in Axis]


class Following:
    """A table that follows pulses, from rest at the program's start; `ticks` tell how finely it is watched."""

    def __init__(self, setup: Setup, ticks: Ticks) -> None:
        self._setup, self._ticks = setup, ticks
        self._axes = [AxisWithNeighbours(run, ticks) for run in _runs(setup, ticks)]
        self._trip: tuple[Axis, Slip] | None = None
        self._last_um = np.array([setup.origin_um], dtype=np.int64)
        self._known_s = self._followed_s = 0.0
        self._sample_s, self._is_probe = ticks.looks
        self._commanded_um = np.zeros((len(self._sample_s), 2))
        self._commanded = 0

    @property
    def _runs(self) -> list[AxisRun]:
        """Runs of X and of Y."""
        return [axis.run for axis in self._axes]

    @property
    def followed_s(self) -> float:
        """Time up to which the table has followed."""
        return self._followed_s

    @property
    def tripped_s(self) -> float:
        """When a drive tripped, as far as the table has followed; infinite where none did."""
        return self._trip[1].t_s if self._trip else np.inf

    @property
    def courses(self) -> int:
        """Courses that both axes have gone through; those of swings that were repeated do not count."""
        return sum(run.state.noted.courses for run in self._runs)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates, and let the table follow as far as they lead."""
        places = np.concatenate([self._last_um, np.stack([pulses.x_um, pulses.y_um], axis=1)])
        for axis, column in zip(self._axes, places.T, strict=True):
            steps = np.flatnonzero(np.diff(column))
            axis.take(pulses.t_s[steps], column[steps + 1])
        self._last_um, self._known_s = places[-1:], float(pulses.t_s[-1])
        self._sample(pulses.t_s, places)
        self._follow(self._known_s - max(run.ahead_s for run in self._runs), len(pulses.t_s))

    def finish(self) -> tuple[Trace, Trace, tuple[Loss, ...], tuple[Peak, ...], History]:
        """Let the table come to rest, and sum up: its trace, its places at the pulses that are looked at, and more."""
        ticks, end_s = self._ticks, float(self._ticks.t_s[-1])
        self._follow(end_s)
        for run in self._runs:
            run.rest(end_s, self.tripped_s)
        self._commanded_um[self._commanded :] = self._last_um
        trace, probes = self._traces()
        losses = [loss for axis in Axis for loss in self._axes[axis].losses(axis, trace)]
        if self._trip:
            losses.append(trip_loss(*self._trip, trace, ticks))
        (x, y), drives = (run.record for run in self._runs), drives_of(self._setup.model)
        history = history_of((x, y), drives, min(end_s, self.tripped_s))
        return trace, probes, in_order(losses), peaks_of((x, y), drives, trace, ticks), history

    def _follow(self, until_s: float, pulses: int = 0) -> None:
        """Follow up to a time, so many pulses. Where a servo trips, both axes go there again, braking from then on."""
        before = [run.copy() for run in self._runs] if self._trip is None and self._setup.model.motor.may_trip else []
        self._followed_s = max(until_s, self._followed_s)
        self._let(until_s, pulses)
        first = min(Axis, key=lambda axis: self._runs[axis].state.tripped_s)
        trip = self._runs[first].trip
        if before and trip.t_s < np.inf:
            self._trip = first, trip
            for axis, run in zip(self._axes, before, strict=True):
                axis.run = run
            self._let(until_s, pulses)

    def _let(self, until_s: float, pulses: int) -> None:
        """Let the axes follow up to a time: where that are many pulses, one axis beside the other on a second core."""
        if pulses < _SIDE_BY_SIDE or self._setup.engine != "compiled":  # bodies are moved by one thread alone
            for axis in Axis:
                self._let_axis(axis, until_s)
            return
        of_x = self._second_core.submit(self._let_axis, Axis.X, until_s)
        self._let_axis(Axis.Y, until_s)
        of_x.result()

    def _let_axis(self, axis: Axis, until_s: float) -> None:
        """Let one axis follow up to a time."""
        self._axes[axis].follow(until_s, self.tripped_s)

    @cached_property
    def _second_core(self) -> ThreadPoolExecutor:
        """A thread beside this one: loops hold no lock of Python."""
        return ThreadPoolExecutor(1)

    def _sample(self, t_s: Floats, places_um: Ints) -> None:
        """Note what is commanded at the samples before the last of some pulses, whose places are (n + 1, 2)."""
        sample_s = self._sample_s
        until = int(np.searchsorted(sample_s, t_s[-1] - _GRACE_S))
        pulse = np.searchsorted(t_s, sample_s[self._commanded : until] + _GRACE_S, side="right")
        self._commanded_um[self._commanded : until] = places_um[pulse]
        self._commanded = max(until, self._commanded)

    def _traces(self) -> tuple[Trace, Trace]:
        """The trace, the start and all samples; and the same at pulses, without the start."""
        origin = np.array([self._setup.origin_um], dtype=np.float64)
        place = np.stack([run.record.sampled_um for run in self._runs], axis=1)
        ticks, is_probe = self._ticks, self._is_probe
        commanded = np.concatenate([origin, self._commanded_um[~is_probe]])
        sampled = self._placed(np.concatenate([origin, place[~is_probe]]))
        row = np.concatenate([ticks.row[:1], ticks.row])
        trace = Trace(np.append(0.0, ticks.t_s), commanded, sampled, sampled, row)
        at_pulses = self._placed(place[is_probe])
        return trace, Trace(ticks.probe_s, self._commanded_um[is_probe], at_pulses, at_pulses, ticks.probe_row)

    def _placed(self, place_um: Floats) -> Floats:
        """Where the slides are that stand at places (n, 2) by their screws, in program coordinates."""
        geometry, start = self._setup.model.geometry, np.array(self._setup.start_um)
        if geometry == Geometry():
            return place_um
        corner = start - np.array(self._setup.origin_um)
        placed: Floats = geometry.placed(place_um + corner, start) - corner
        return placed
