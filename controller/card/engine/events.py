"""The events of a stretch, each with its time: outputs to set, switches to meet, edges to capture, its end.

One more is that the stretch grows: entries pushed behind it have to be taken into its plan.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

from controller.card.core.codes import AxisSts
from controller.card.core.settings import CardSettings, Switches
from controller.card.core.state import AxisState, CardState
from controller.card.core.wiring import is_taken_for_met, sense_of
from controller.card.engine.edges import heads_beyond, heads_short, rises_through
from controller.card.engine.entries import Entry, Output, Stepping
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


class Due(NamedTuple):
    """Outputs are to be set."""

    time_s: float
    output: Output


Event = TypeVar("Event", Due, Trip, Capture)


@dataclass(slots=True)
class Events:
    """What is still to come, the lists in order of time; `grows_s` and `ends_s` are inf where that never comes."""

    outputs: list[Due] = field(default_factory=list)
    trips: list[Trip] = field(default_factory=list)
    captures: list[Capture] = field(default_factory=list)
    ends_s: float = math.inf
    grows_s: float = math.inf

    def next_s(self) -> float:
        """When the first of them happens; inf without any."""
        times = [happens[0].time_s for happens in (self.outputs, self.trips, self.captures) if happens]
        return min(*times, self.ends_s, self.grows_s)


def take_due(events: list[Event], now_s: float) -> Iterator[Event]:
    """Take events that are due from the front of their list."""
    while events and events[0].time_s <= now_s:
        yield events.pop(0)


def events_of(stretch: Stretch, card: CardState, settings: CardSettings) -> Events:
    """What a stretch meets; a limit switch that the axes are beyond is met again wherever they go on that way."""
    due = zip(stretch.ends_s.tolist(), stretch.entries, strict=True)
    outputs = [Due(time, entry) for time, entry in due if isinstance(entry, Output) and time < math.inf]
    if not stretch.rows or not settings.switches:
        return Events(outputs, ends_s=stretch.end_s)
    trips, captures = [], []
    for axis, own in enumerate(card.axes[: settings.axes]):
        switches = settings.switches_of(own.number)
        trips += _trips(stretch, own, switches, axis, card.limit_sense)
        captures += _captures(stretch, own, switches, axis, card.home_sense)
    return Events(outputs, sorted(trips), sorted(captures), stretch.end_s)


def grows_s(stretch: Stretch, entries: Sequence[Entry], now_s: float, settings: CardSettings) -> float:
    """When a stretch has to take the entries behind it in the list into its plan; inf where it ends at rest.

    `entries` are all of the list, the stretch's own in front. A plan that changes at the end of a servo period leaves
    the pulses before as they were.
    """
    planned = len(stretch.entries)
    if len(entries) <= planned or not stretch.rows:
        return math.inf
    kind = stretch.rows[0].kind
    if entries[planned].kind not in (None, kind) or stretch.done(now_s) >= planned:
        return math.inf
    time_s = stretch.grows_s(now_s)
    if kind is Stepping.EQUAL_TIME and settings.jerk_pulse_ms3 == math.inf:
        time_s = math.floor(time_s / settings.servo_period_s) * settings.servo_period_s
    return max(time_s, now_s)


def _trips(stretch: Stretch, own: AxisState, switches: Switches, axis: int, word: int | None) -> list[Trip]:
    """Of an axis; `word` is the sense of the limit switches."""
    if not own.limits_on:
        return []
    sides = ((switches.positive, 1, AxisSts.POSITIVE_LIMIT), (switches.negative, -1, AxisSts.NEGATIVE_LIMIT))
    found: list[Trip] = []
    for bit, (place, way, flag) in enumerate(sides, 2 * axis):
        turned = is_taken_for_met(switches.limit_wiring, sense_of(word, bit))
        if turned or math.isfinite(place):
            along = (heads_short if turned else heads_beyond)(stretch.path, axis, place, way)
            found.append(Trip(stretch.time_s(along), axis, flag))
    return [trip for trip in found if trip.time_s < math.inf]


def _captures(stretch: Stretch, own: AxisState, switches: Switches, axis: int, word: int | None) -> list[Capture]:
    """Of an axis; `word` is the sense of the home switches."""
    edges: list[tuple[AxisSts, float, int]] = []
    if own.home_armed:
        turned = is_taken_for_met(switches.home_wiring, sense_of(word, axis))
        low, high = reversed(switches.home) if turned else switches.home
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
