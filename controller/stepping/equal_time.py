"""Equal-time interpolation: at the end of each servo period the plan's place, rounded to whole pulses on each axis.

The rounding error of a period is not lost: pulses are differences of rounded places, so they add up to the rounded
place at any time. Slow cutting has a hundred periods to a pulse, so periods are not visited one by one: on each axis
the path is near enough to half a pulse to be in doubt only over short spans (`half_pulses`), and between
them no rounded place can change. Only the periods that end in a span, and the first one after it, are looked at.

Where a path comes so near to half a pulse on an axis that rounding could change the whole pulse.

On each axis a line is ``p(s) = start + T s`` and an arc ``p(s) = c + A sin(κs − ψ)`` with ``A = sqrt(T² + N²) / κ``,
``c = start + N / κ`` and ``ψ = atan2(N, T)``: the terms of a `Path` put together. Between its extremes an arc
is as monotone as a line, so each half pulse is met once, over the span in which p is within a doubt of it.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from controller.motion.limits import Path
from controller.motion.plan import Plan
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats, Ints

_STANDS = 1e-200
"""Put for a slope or an amplitude of 0: an axis that stands near half a pulse is in doubt all along."""


class Parts(NamedTuple):
    """m parts of rows of a path: (m,) rows, lengths from the rows' starts, and the doubt of places there, µm."""

    row: Ints
    from_um: Floats
    to_um: Floats
    doubt_um: Floats

    def picked(self, which: Ints) -> "Parts":
        """The parts of these indices."""
        return Parts._make(column[which] for column in self)


class Doubts(NamedTuple):
    """(m,) rows, and the lengths (m,) µm from their starts between which an axis is in doubt."""

    row: Ints
    first_um: Floats
    last_um: Floats


def doubts(path: Path, parts: Parts) -> Doubts:
    """Spans of all axes in which places may round either way, in no order."""
    bent = path.curvature[parts.row] > 0.0
    lines = _of_lines(path, parts.picked(np.flatnonzero(~bent)))
    arcs = _of_arcs(path, parts.picked(np.flatnonzero(bent)))
    return Doubts._make(np.concatenate(pair) for pair in zip(lines, arcs, strict=True))


def _of_lines(path: Path, parts: Parts) -> Doubts:
    parts, axis = _each_axis(parts, path.start_um.shape[1])
    start, slope = path.start_um[parts.row, axis], path.tangent[parts.row, axis]
    of, low, high = _levels(start + slope * parts.from_um, start + slope * parts.to_um, parts)
    slope = np.where(slope == 0.0, _STANDS, slope)
    return _spans(parts, of, (low - start[of]) / slope[of], (high - start[of]) / slope[of])


def _of_arcs(path: Path, parts: Parts) -> Doubts:
    parts, axis = _each_axis(parts, path.start_um.shape[1])
    tangent, normal = path.tangent[parts.row, axis], path.normal[parts.row, axis]
    bend = path.curvature[parts.row]
    center = path.start_um[parts.row, axis] + normal / bend
    size, phase = np.hypot(tangent, normal) / bend, np.arctan2(normal, tangent)
    of, half_turn = _half_turns(bend * parts.from_um - phase, bend * parts.to_um - phase)
    parts = _within(parts.picked(of), (half_turn * np.pi + phase[of]) / bend[of], np.pi / 2.0 / bend[of])
    center, size, phase, bend = center[of], size[of], phase[of], bend[of]
    first, last = (center + size * np.sin(bend * s - phase) for s in (parts.from_um, parts.to_um))
    of, low, high = _levels(first, last, parts)
    rising = 1.0 - 2.0 * (half_turn[of] % 2)
    size = np.maximum(size, _STANDS)[of]
    middle = half_turn[of] * np.pi + phase[of]
    angles = (middle + rising * np.arcsin(np.clip((level - center[of]) / size, -1.0, 1.0)) for level in (low, high))
    first, last = (angle / bend[of] for angle in angles)
    return _spans(parts, of, first, last)


def _each_axis(parts: Parts, axes: int) -> tuple[Parts, Ints]:
    """The parts once for each axis, and the axis of each."""
    m = len(parts.row)
    return parts.picked(np.repeat(np.arange(m), axes)), np.tile(np.arange(axes), m)


def _half_turns(first: Floats, last: Floats) -> tuple[Ints, Ints]:
    """Half turns between extremes of a sine that angles from `first` to `last` touch: number of the part, half turn."""
    low = np.floor(first / np.pi + 0.5).astype(np.int64)
    count = np.floor(last / np.pi + 0.5).astype(np.int64) - low + 1
    of = np.repeat(np.arange(len(first)), count)
    return of, low[of] + _counted(count)


def _within(parts: Parts, middle: Floats, reach: Floats) -> Parts:
    """The parts cut to what lies within a reach of the middle."""
    first = np.maximum(parts.from_um, middle - reach)
    return parts._replace(from_um=first, to_um=np.maximum(np.minimum(parts.to_um, middle + reach), first))


def _levels(first: Floats, last: Floats, parts: Parts) -> tuple[Ints, Floats, Floats]:
    """Half pulses that monotone parts from place `first` to `last` come near: number of the part, level ∓ doubt."""
    doubt = parts.doubt_um
    low = np.ceil(np.minimum(first, last) - doubt - 0.5)
    count = np.maximum(np.floor(np.maximum(first, last) + doubt - 0.5) - low + 1.0, 0.0).astype(np.int64)
    of = np.repeat(np.arange(len(first)), count)
    level = low[of] + _counted(count) + 0.5
    return of, level - doubt[of], level + doubt[of]


def _spans(parts: Parts, of: Ints, one_um: Floats, other_um: Floats) -> Doubts:
    """Spans between two lengths, in either order, as far as the parts go."""
    low, high = parts.from_um[of], parts.to_um[of]
    first, last = np.minimum(one_um, other_um), np.maximum(one_um, other_um)
    return Doubts(parts.row[of], np.clip(first, low, high), np.clip(last, low, high))


def _counted(count: Ints) -> Ints:
    """0, 1, … to each count, strung together."""
    return np.arange(int(count.sum())) - np.repeat(np.cumsum(count) - count, count)


ROUNDING_UM = 1e-6
"""Lengths and places that differ by less may be one: sums over a path of 10 m differ by some 10⁻⁹ µm."""
_AT_ONCE = 1 << 16
"""Periods and µm worked on at once: enough to spread the cost of array calls, and little memory."""
_FEW = 2048
"""Up to so many periods, it takes less time to look at every one than to search for half pulses."""
_ULPS = 8.0 * np.finfo(np.float64).eps  # relative, of a few roundings in a row


class Spans(NamedTuple):
    """m spans of periods, (m,) int64 numbers of the first and the last; both never fall, spans may overlap."""

    first: Ints
    last: Ints

    def apart(self) -> "Spans":
        """The same periods, each in one span only; a span may be empty, its last before its first."""
        return Spans(np.maximum(self.first, np.append(self.first[:1], self.last[:-1] + 1)), self.last)

    def chunks(self) -> Iterator[Ints]:
        """All periods of spans that are apart, in order, at most `_AT_ONCE` at a time."""
        count = np.maximum(self.last - self.first + 1, 0)
        past = np.cumsum(count)
        for since in range(0, int(past[-1]), _AT_ONCE):
            number = np.arange(since, min(since + _AT_ONCE, int(past[-1])))
            span = np.searchsorted(past, number, side="right")
            yield self.last[span] - past[span] + 1 + number


class Clock(NamedTuple):
    """Servo periods: number k ends at ``k · period_s`` of the card's clock; the plan begins at `began_s`."""

    period_s: float
    began_s: float

    def plan_time_s(self, k: Ints) -> Floats:
        """Time of the plan at which periods end."""
        return k.astype(np.float64) * self.period_s - self.began_s

    def first_after(self, t_s: float) -> int:
        """The first period that ends after a time of the card's clock."""
        k = math.floor(t_s / self.period_s) - 1
        while k * self.period_s <= t_s:
            k += 1
        return k

    def first_from(self, plan_s: float) -> int:
        """The first period that ends at a time of the plan or after it."""
        k = math.floor((self.began_s + plan_s) / self.period_s) - 1
        while k * self.period_s - self.began_s < plan_s:
            k += 1
        return k


class SampledMotion:
    """A path of at least one row, a plan along it and a clock: where the plan is when periods end.

    Attributes
    ----------
    last
        The period at whose end the plan is over.
    """

    def __init__(self, path: Path, plan: Plan, clock: Clock) -> None:
        self.last = max(clock.first_from(plan.duration_s), clock.first_after(clock.began_s))
        self._path, self._plan, self._clock = path, plan, clock
        self._before_um = path.before_um
        self._fastest_um_s = float(np.maximum(plan.speed_um_s, end_speeds(plan)).max(initial=0.0))
        self._doubt_um = _doubt_um(path, plan, self._fastest_um_s * self.last * clock.period_s)
        self._end_row, self._end_um = self._end()

    def commanded(self, k: Ints) -> tuple[Ints, Ints]:
        """Rows (m,) of the path and rounded places (m, d) when periods (m,) end."""
        along = self._along_um(k)
        row = self._row(along)
        place = self._path.place(row, np.minimum(along - self._before_um[row], self._path.length_um[row]))
        over = k >= self.last
        if over.any():
            row[over], place[over] = self._end_row, self._end_um
        return row, whole_pulses(place)

    def spread(self, k: Ints, row: Ints, by: Ints, from_um: tuple[int, int]) -> Pulses:
        """Pulses that move X and Y by (m, 2) whole pulses in the periods (m,), each axis evenly over its period.

        The j-th of n comes when j/n of the period are over; of the period in which the plan begins, what is left of
        it. A pulse belongs to the row in which the plan is then.
        """
        end = k * self._clock.period_s
        spans = end - np.maximum((k - 1) * self._clock.period_s, self._clock.began_s)
        count = np.abs(by)
        period = [np.repeat(np.arange(len(k)), count[:, axis]) for axis in (0, 1)]
        left = np.concatenate([_period_left(count[:, axis], of) for axis, of in enumerate(period)])
        of = np.concatenate(period)
        time = end[of] - spans[of] * left
        order = np.argsort(time, kind="stable")
        of, left, time, is_x = of[order], left[order], time[order], order < len(period[0])
        rows, early = row[of], left > 0.0
        if early.any():
            rows[early] = self._row(self._plan.at(time[early] - self._clock.began_s).along_um)
        step = np.sign(by)[of, np.where(is_x, 0, 1)]
        return Pulses(
            time,
            (from_um[0] + np.cumsum(step * is_x)).astype(np.int32),
            (from_um[1] + np.cumsum(step * ~is_x)).astype(np.int32),
            rows.astype(np.int32),
        )

    def periods(self, since: int, until: int) -> Iterator[Ints]:
        """Periods after `since`, up to `until` or to one before it, in which a rounded place may change, in chunks."""
        until = self._within_reach(since, until)
        if until - since <= _FEW:
            return iter((np.arange(since + 1, until + 1),))
        low, high = self._along_um(np.array([since, until]))
        if until - since <= 2.0 * (high - low):
            return Spans(np.array([since + 1]), np.array([until])).chunks()
        return self._changes(since, until, float(low), float(high)).chunks()

    def _within_reach(self, since: int, until: int) -> int:
        """The period `until`, or one so soon after `since` that about `_AT_ONCE` µm at most lie between them."""
        if self._fastest_um_s * (until - since) * self._clock.period_s < _AT_ONCE:
            return until
        reach = self._along_um(np.array([since])) + _AT_ONCE
        return min(max(int(self._period(reach)[0]), since + 1), until)

    def _changes(self, since: int, until: int, low_um: float, high_um: float) -> Spans:
        """Spans of periods, among them `until`, in which rounded places may change, from length to length."""
        first, last = self._row(np.array([low_um, high_um]))
        row = np.arange(first, last + 1)
        before, length = self._before_um[row], self._path.length_um[row]
        from_um, to_um = np.maximum(low_um - before, 0.0), np.minimum(high_um - before, length)
        found = doubts(self._path, Parts(row, from_um, to_um, self._doubt_um[row]))
        at = self._before_um[found.row]
        # Spans overlap. If begins and ends are sorted separately, the spans still cover the same lengths.
        begins, ends = self._period(np.sort(at + found.first_um)), self._period(np.sort(at + found.last_um))
        begins, ends = np.clip(begins, since + 1, until), np.clip(ends, since, until)
        return Spans(np.append(begins, until), np.append(ends, until)).apart()

    def _along_um(self, k: Ints) -> Floats:
        return self._plan.at(self._clock.plan_time_s(k)).along_um

    def _row(self, along_um: Floats) -> Ints:
        """Rows of the path at lengths along it; a border belongs to the row after it."""
        return np.clip(np.searchsorted(self._before_um, along_um, side="right") - 1, 0, len(self._path) - 1)

    def _period(self, along_um: Floats) -> Ints:
        """The first periods that end at these lengths (never falling) or after them."""
        time = self._plan.time_at(along_um) + self._clock.began_s
        return np.ceil(time / self._clock.period_s).astype(np.int64)

    def _end(self) -> tuple[int, Floats]:
        """Row and place (d,) where the plan ends: the end of the path where they differ by rounding."""
        along = self._plan.along_um[-1:]
        if along[0] > self._before_um[-1] - ROUNDING_UM:
            row = np.array([len(self._path) - 1])
            return int(row[0]), self._path.place(row, self._path.length_um[row])[0]
        row = self._row(along)
        return int(row[0]), self._path.place(row, along - self._before_um[row])[0]


def whole_pulses(place_um: Floats) -> Ints:
    """Places in whole pulses, half a pulse to the even side.

    At half a pulse the last bits would decide, and they depend on how the path was cut. So they are rounded off before.
    """
    return np.rint(np.round(place_um, 6)).astype(np.int64)


def end_speeds(plan: Plan) -> Floats:
    """Speeds (p,) µm/s at the end of each phase."""
    dt = np.diff(plan.time_s)
    return plan.speed_um_s + dt * (plan.acceleration_um_s2 + dt * plan.jerk_um_s3 / 2.0)


def _period_left(count: Ints, of: Ints) -> Floats:
    """What is left of the period at each of its pulses, 0 to 1."""
    past = np.cumsum(count)[of]
    left: Floats = (past - 1 - np.arange(len(of))) / count[of]
    return left


def chord_error_um(path: Path, plan: Plan, period_s: float) -> float:
    """Largest distance from the arcs of a path of the chords between its places at the ends of periods, µm.

    On radius R at speed v the sagitta is ``R (1 − cos(v T / 2R))``, about ``v² T² / 8R``; v is the largest speed in
    each row.
    """
    bent = path.curvature > 0.0
    bend = path.curvature[bent]
    way = np.minimum(_fastest_in_rows(path, plan)[bent] * period_s, path.length_um[bent])
    # 1 − cos, without loss for small angles; past a half turn the chord misses the whole width.
    error = 2.0 * np.sin(np.minimum(bend * way, 2.0 * np.pi) / 4.0) ** 2 / bend
    return float(error.max(initial=0.0))


def _fastest_in_rows(path: Path, plan: Plan) -> Floats:
    """Largest speed (n,) µm/s of the plan in each row."""
    before = path.before_um
    at_border = plan.speed_at(before)
    fastest = np.maximum(at_border[:-1], at_border[1:])
    for row, speed in (
        (np.searchsorted(before, plan.along_um[:-1], side="right"), plan.speed_um_s),
        (np.searchsorted(before, plan.along_um[1:], side="left"), end_speeds(plan)),
    ):
        np.maximum.at(fastest, np.clip(row - 1, 0, len(path) - 1), speed)
    return fastest


def _doubt_um(path: Path, plan: Plan, way_um: float) -> Floats:
    """How far (n,) places may be off by rounding: of lengths, of times (as a way), of coordinates from the centre."""
    size = float(np.abs(path.start_um).max(initial=0.0)) + float(plan.along_um[-1]) + way_um
    radius = np.divide(1.0, path.curvature, out=np.zeros(len(path)), where=path.curvature > 0.0)
    return ROUNDING_UM + _ULPS * (size + 2.0 * radius)
