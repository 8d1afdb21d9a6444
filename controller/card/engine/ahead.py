"""What lies ahead of the axes on a stretch: outputs to set, switches to meet, edges to capture, each with its time."""

import math
from typing import NamedTuple

from controller.card.core.codes import AxisSts
from controller.card.core.settings import CardSettings, Switches
from controller.card.core.state import AxisState, CardState
from controller.card.engine.edges import heads_beyond, heads_short, rises_through
from controller.card.engine.entries import Output
from controller.card.engine.stretch import Stretch
from controller.motion.path import Path


class Trip(NamedTuple):
    """An axis (from 0) meets a limit switch; `bit` is the one of its status word."""

    time_s: float
    axis: int
    bit: AxisSts


class Capture(NamedTuple):
    """An axis (from 0) meets an edge it waits for, at a place in whole pulses; `armed` is the bit it waited with."""

    time_s: float
    axis: int
    armed: AxisSts
    place: int


class Ahead(NamedTuple):
    """All of a stretch in order of time."""

    outputs: list[tuple[float, Output]]
    trips: list[Trip]
    captures: list[Capture]

    def next_s(self) -> float:
        """When the first of them happens; inf without any."""
        times = [self.outputs[0][0]] if self.outputs else []
        times += [happens[0].time_s for happens in (self.trips, self.captures) if happens]
        return min(times, default=math.inf)


def look_ahead(stretch: Stretch, state: CardState, settings: CardSettings) -> Ahead:
    """What a stretch meets; a limit switch that the axes are beyond is met again wherever they go on that way."""
    due = zip(stretch.ends_s.tolist(), stretch.entries, strict=True)
    outputs = [(time, entry) for time, entry in due if isinstance(entry, Output) and time < math.inf]
    if not stretch.rows or not (settings.switches or state.limit_sense):
        return Ahead(outputs, [], [])
    trips, captures = [], []
    for axis, own in enumerate(state.axes[: settings.axes]):
        switches = settings.switches_of(own.number)
        trips += _trips(stretch, own, switches, axis, state.limit_sense >> 2 * axis)
        captures += _captures(stretch, own, switches, axis, state.home_sense >> axis & 1)
    return Ahead(outputs, sorted(trips), sorted(captures))


def _trips(stretch: Stretch, own: AxisState, switches: Switches, axis: int, inverted: int) -> list[Trip]:
    """Of an axis; bit 0 of `inverted` is that of its positive switch, bit 1 that of its negative one."""
    if not own.limits_on:
        return []
    sides = (
        (switches.positive, 1, AxisSts.POSITIVE_LIMIT, heads_short if inverted & 1 else heads_beyond),
        (switches.negative, -1, AxisSts.NEGATIVE_LIMIT, heads_short if inverted & 2 else heads_beyond),
    )
    found = [
        Trip(stretch.time_s(meets(stretch.path, axis, place, sense)), axis, bit)
        for place, sense, bit, meets in sides
        if math.isfinite(place) or meets is heads_short
    ]
    return [trip for trip in found if trip.time_s < math.inf]


def _captures(stretch: Stretch, own: AxisState, switches: Switches, axis: int, inverted: int) -> list[Capture]:
    edges: list[tuple[AxisSts, float, int]] = []
    if own.home_armed:
        low, high = reversed(switches.home) if inverted else switches.home
        edges += [(AxisSts.HOME_ARMED, low, 1), (AxisSts.HOME_ARMED, high, -1)]
    if own.index_armed and switches.index_every > 0.0:
        below, above = _marks_around(stretch.path, axis, switches.index_every)
        edges += [(AxisSts.INDEX_ARMED, below, -1), (AxisSts.INDEX_ARMED, above, 1)]
    found = [
        Capture(stretch.time_s(rises_through(stretch.path, axis, place, sense)), axis, armed, round(place))
        for armed, place, sense in edges
        if math.isfinite(place)
    ]
    first = {capture.armed: capture for capture in sorted(found, reverse=True)}
    return [capture for capture in first.values() if capture.time_s < math.inf]


def _marks_around(path: Path, axis: int, every: float) -> tuple[float, float]:
    """Index marks next below and next above the start of a path: it meets one of them before any other."""
    at = float(path.start_um[0, axis]) / every
    return (math.ceil(at) - 1) * every, (math.floor(at) + 1) * every
