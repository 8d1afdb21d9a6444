"""The plan: velocity along the path as data, phases of constant acceleration (or, under a jerk limit, constant jerk).

Motion equations of one phase, from distance s = 0 and time t = 0 at speed v0 with acceleration a and jerk j:
``s = v0 t + a t² / 2 + j t³ / 6``, ``v = v0 + a t + j t² / 2``. Without jerk ``v² = v0² + 2 a s``; inverted without
loss near a = 0, ``t = 2 s / (v0 + v)``.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from controller.motion.s_curve import Phases, times_of_lengths
from parser.geometry.curves import Floats, Ints, total_before


class Instant(NamedTuple):
    """Motion along the path at one time, or (m,) at many: length done µm, speed µm/s, acceleration µm/s²."""

    along_um: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Motion along the path in p phases; a wait is a phase without length.

    Attributes
    ----------
    along_um, time_s
        (p + 1,) float64, path length and time at each border of phases, from 0, never falling.
    speed_um_s, acceleration_um_s2
        (p,) float64, at the start of each phase.
    jerk_um_s3
        (p,) float64, in each phase; 0 throughout where no jerk limit is set.
    """

    along_um: Floats
    time_s: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats
    jerk_um_s3: Floats

    def __post_init__(self) -> None:
        """Freeze the columns, and raise ValueError with their lengths where they do not fit."""
        lengths = [len(column) for column in (self.speed_um_s, self.acceleration_um_s2, self.jerk_um_s3)]
        if len({len(self.along_um), len(self.time_s), *(length + 1 for length in lengths)}) > 1:
            raise ValueError(f"{len(self.along_um)} lengths and {len(self.time_s)} times border phases of {lengths}")
        for column in (self.along_um, self.time_s, self.speed_um_s, self.acceleration_um_s2, self.jerk_um_s3):
            column.setflags(write=False)

    @property
    def duration_s(self) -> float:
        """Time of the whole plan."""
        return float(self.time_s[-1])

    def at(self, t_s: float | Floats) -> Instant:
        """Motion at a time, or at (m,) times; before the plan at its start, after it at rest at its end."""
        t = np.minimum(np.maximum(t_s, 0.0), self.duration_s)  # of one time a sixth of what np.clip takes
        if not len(self.speed_um_s):
            return Instant(np.zeros_like(t), np.zeros_like(t), np.zeros_like(t))
        phase = np.minimum(self.time_s.searchsorted(t, side="right") - 1, len(self.speed_um_s) - 1)
        dt = t - self.time_s[phase]
        v, a, j = self.speed_um_s[phase], self.acceleration_um_s2[phase], self.jerk_um_s3[phase]
        along = self.along_um[phase] + dt * (v + dt * (a / 2.0 + dt * j / 6.0))
        over = np.asarray(t_s) > self.duration_s
        return Instant(
            np.minimum(np.maximum(along, self.along_um[phase]), self.along_um[phase + 1]),
            np.where(over, 0.0, np.maximum(v + dt * (a + dt * j / 2.0), 0.0))[()],  # of one time a number, no array
            np.where(over, 0.0, a + dt * j)[()],
        )

    def border_s(self, before_um: Floats) -> Floats:
        """Times (n + 1,) s at which blocks begin, and the last one ends; `before_um` (n + 1,) is the path by then."""
        reached = self.time_at(before_um)
        reached[-1] = self.duration_s
        return reached

    def time_at(self, along_um: Floats) -> Floats:
        """Time at which the path length is reached; (n,) never falling µm to (n,) s.

        A length at which the plan waits is reached when the wait begins. Lengths past either end by rounding count as
        that end.
        """
        if not len(self.speed_um_s) or not len(along_um):
            return np.zeros_like(along_um)
        if along_um[0] < 0.0 or along_um[-1] > self.along_um[-1]:
            along_um = np.clip(along_um, 0.0, self.along_um[-1])
        inner = self.along_um[1:-1]
        low, high = np.searchsorted(inner, along_um[[0, -1]]).tolist()
        cuts = np.searchsorted(along_um, inner[low:high], side="right")
        of = np.diff(cuts, prepend=0, append=len(along_um))
        phases = slice(low, high + 1)
        since = self._since(along_um, phases, of)
        if self.jerk_um_s3[phases].any():
            self._invert_jerked(np.repeat(np.arange(low, high + 1), of), along_um, since)
        since += np.repeat(self.time_s[phases], of)
        # A place rounded up where the speed comes to 0 would be reached late.
        return np.minimum(since, np.repeat(self.time_s[low + 1 : high + 2], of), out=since)

    def speed_at(self, along_um: Floats) -> Floats:
        """Speed at which the path length is passed; (n,) never falling µm to (n,) µm/s."""
        return self.at(self.time_at(along_um)).speed_um_s

    def _since(self, along_um: Floats, phases: slice, of: Ints) -> Floats:
        """Time since the start of each point's phase, without jerk; `of` points in each phase, in order."""
        s = along_um - np.repeat(self.along_um[phases], of)
        speed = np.repeat(self.speed_um_s[phases], of)
        # In place, since millions of points pass here: v² = v0² + 2 a s, t = 2 s / (v0 + v).
        both = np.repeat(2.0 * self.acceleration_um_s2[phases], of)
        both *= s
        both += speed * speed
        np.sqrt(np.maximum(both, 0.0, out=both), out=both)
        both += speed
        s *= 2.0
        return np.divide(s, both, out=s, where=both > 0.0)

    def _invert_jerked(self, phase: Ints, along_um: Floats, since_s: Floats) -> None:
        """Overwrite the times since the phase's start, for points in phases with jerk."""
        points = np.flatnonzero(self.jerk_um_s3[phase])
        of = phase[points]
        span, time = np.diff(self.along_um)[of], np.diff(self.time_s)[of]
        phases = Phases(span, time, self.speed_um_s[of], self.acceleration_um_s2[of], self.jerk_um_s3[of])
        since_s[points] = times_of_lengths(phases, along_um[points] - self.along_um[of])


EMPTY_PLAN = Plan(np.zeros(1), np.zeros(1), np.zeros(0), np.zeros(0), np.zeros(0))
"""The plan of a path without motion."""


def plan_of(phases: Phases, wait_s: Floats) -> Plan:
    """Plan of phases (n, k) of n rows with waits (n + 1,) s at their borders, save phases of no length and no time."""
    runs = np.flatnonzero((phases.span_um > 0.0) | (phases.time_s > 0.0))
    columns = [column.ravel()[runs] for column in phases]
    waits = np.flatnonzero(wait_s)
    if len(waits):
        at = np.searchsorted(runs, waits * phases.span_um.shape[1])
        fills = [wait_s[waits] * is_time for is_time in (False, True, False, False, False)]
        columns = [np.insert(column, at, fill) for column, fill in zip(columns, fills, strict=True)]
    span, time, speed, acceleration, jerk = columns
    return Plan(total_before(span), total_before(time), speed, acceleration, jerk)


def on_borders(plan: Plan, border_um: Floats) -> Plan:
    """The plan with its waits and its end exactly at borders (n + 1,) µm of rows.

    Sums of phases differ from sums of rows in the last bits, and a border that the plan reaches behind its wait would
    count as reached after it.
    """
    if not len(plan.speed_um_s):
        return plan
    along = plan.along_um.copy()
    waits = np.flatnonzero((plan.speed_um_s == 0.0) & (plan.acceleration_um_s2 == 0.0) & (plan.jerk_um_s3 == 0.0))
    above = np.clip(np.searchsorted(border_um, along[waits]), 1, len(border_um) - 1)
    nearer = np.abs(border_um[above - 1] - along[waits]) < np.abs(border_um[above] - along[waits])
    along[waits] = along[waits + 1] = border_um[above - nearer]
    along[-1] = border_um[-1]
    return replace(plan, along_um=np.maximum.accumulate(along))
