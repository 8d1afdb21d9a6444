"""The events of a stretch, each with its time: outputs to set, switches to meet, edges to capture, its end.

One more is that the stretch grows: entries pushed behind it have to be taken into its plan.

Edges: where along a path an axis passes a place, in closed form.

On a row of curvature κ, with u = κ s, one coordinate is ``c + A sin(u − δ)``: c that of the centre, A = R hypot(T, N)
and δ = atan2(N, T) from the row's tangent and normal on that axis. It rises through a place q where
u = δ + asin((q − c) / A), and turns from falling to rising at u = δ − π/2.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

import numpy as np

from controller.card.core.call import AxisSts
from controller.card.core.settings import CardSettings, Switches, is_taken_for_met, sense_of
from controller.card.core.state import AxisState, CardState
from controller.card.engine.entries import Entry, Output, Stepping
from controller.card.engine.stretch import Stretch
from controller.motion.limits import Path
from parser.geometry.curves import Floats

_TURN = 2.0 * math.pi
_LEVEL = 1e-9
"""Direction cosines below this are rounding: the axis stands."""
_JOINT_UM = 1e-6
"""A place on the joint of two rows is looked for this far behind the first: rounding may leave a gap."""


def rises_through(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first passes the place upward (`sense` 1) or downward (−1); else inf.

    A path that starts at the place passes it where it comes back to it from below.
    """
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    way = sense * place - start
    level = np.abs(tangent) <= _LEVEL
    on_line = np.divide(way, tangent, out=np.full_like(way, np.inf), where=~level)
    sine = np.divide(sense * place - centre, reach, out=np.full_like(way, 2.0), where=reach > 0.0)
    at = np.mod(lead + np.arcsin(np.clip(sine, -1.0, 1.0)), _TURN)
    on_arc = np.where(np.abs(sine) < 1.0, at, np.inf) / np.where(bent, path.curvature, 1.0)
    along = np.where(bent, on_arc, np.where(tangent > _LEVEL, on_line, np.inf))
    return _first(path, np.where(along > 0.0, along, np.inf))


def heads_beyond(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first goes on in `sense` at or beyond the place; else inf."""
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    limit = sense * place
    at_start = np.where((start >= limit) & (tangent > _LEVEL), 0.0, np.inf)
    turns = np.mod(lead - math.pi / 2.0, _TURN) / np.where(bent, path.curvature, 1.0)
    turning = np.where(bent & (reach > 0.0) & (centre - reach >= limit), turns, np.inf)
    return min(_first(path, np.minimum(at_start, turning)), rises_through(path, axis, place, sense))


def heads_short(path: Path, axis: int, place: float, sense: int) -> float:
    """Path length at which axis (from 0) first goes on in `sense` short of the place, which it may never reach."""
    start, tangent, centre, reach, lead = _columns(path, axis, sense)
    bent = path.curvature > 0.0
    limit = sense * place
    at_start = np.where((start < limit) & (tangent > _LEVEL), 0.0, np.inf)
    turns = np.mod(lead - math.pi / 2.0, _TURN) / np.where(bent, path.curvature, 1.0)
    turning = np.where(bent & (reach > 0.0) & (centre - reach < limit), turns, np.inf)
    return _first(path, np.minimum(at_start, turning))


def _columns(path: Path, axis: int, sense: int) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Start, tangent, centre, reach A and lead δ (n,) of an axis, turned so that `sense` is upward."""
    start, tangent, normal = (sense * column[:, axis] for column in (path.start_um, path.tangent, path.normal))
    radius = np.divide(1.0, path.curvature, out=np.zeros(len(path)), where=path.curvature > 0.0)
    return start, tangent, start + radius * normal, radius * np.hypot(tangent, normal), np.arctan2(normal, tangent)


def _first(path: Path, along: Floats) -> float:
    """The first of the lengths (n,) along each row that lies on its row, from the start of the path; else inf."""
    on_row = np.flatnonzero(along <= path.length_um + _JOINT_UM)
    if not len(on_row):
        return math.inf
    row = on_row[0]
    return float(path.before_um[row] + min(along[row], path.length_um[row]))


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
