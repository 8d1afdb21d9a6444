"""The plan: velocity along the path as data, blocks of constant acceleration from rest to rest over each path run.

Motion equations of one phase, from distance s = 0 and time t = 0 at speed v0 with acceleration a:
``s = v0 t + a t² / 2`` and ``v² = v0² + 2 a s``; inverted without loss near a = 0, ``t = 2 s / (v0 + v)``.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from parser.toolpath import Floats, Ints, Toolpath


class Feeds(NamedTuple):
    """How fast the path is run: µm/s for cuts and for jumps, µm/s² along the path; all above 0."""

    cut_um_s: float
    jump_um_s: float
    acceleration_um_s2: float


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Motion along the path in p phases of constant acceleration.

    Attributes
    ----------
    along_um, time_s
        (p + 1,) float64, path length and time at each border of phases, from 0, never falling.
    speed_um_s, acceleration_um_s2
        (p,) float64, speed at the start of each phase and acceleration in it.
    """

    along_um: Floats
    time_s: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats

    @property
    def duration_s(self) -> float:
        """Time of the whole plan."""
        return float(self.time_s[-1])

    def time_at(self, along_um: Floats) -> Floats:
        """Time at which the path length is reached; (n,) never falling µm to (n,) s.

        Lengths past the end by rounding count as the end.
        """
        cuts = np.searchsorted(along_um, self.along_um[1:-1], side="right")
        of = np.diff(cuts, prepend=0, append=len(along_um))
        return np.repeat(self.time_s[:-1], of) + self._since(along_um, of)

    def speed_at(self, along_um: Floats) -> Floats:
        """Speed at which the path length is passed; (n,) µm to (n,) µm/s."""
        phase = np.clip(np.searchsorted(self.along_um, along_um, side="right") - 1, 0, len(self.speed_um_s) - 1)
        s = along_um - self.along_um[phase]
        return np.sqrt(np.maximum(self.speed_um_s[phase] ** 2 + 2.0 * self.acceleration_um_s2[phase] * s, 0.0))

    def _since(self, along_um: Floats, of: Ints) -> Floats:
        """Time since the start of each point's phase; `of` points in each phase, in order."""
        start = np.repeat(self.along_um[:-1], of)
        room = np.repeat(np.diff(self.along_um), of)
        speed = np.repeat(self.speed_um_s, of)
        double_acceleration = np.repeat(2.0 * self.acceleration_um_s2, of)
        s = np.clip(along_um - start, 0.0, room)
        v = np.sqrt(np.maximum(speed * speed + double_acceleration * s, 0.0))
        return np.divide(2.0 * s, speed + v, out=np.zeros_like(s), where=s > 0.0)


def plan_runs(toolpath: Toolpath, feeds: Feeds) -> Plan:
    """Plan that starts and stops at rest at each pause, and where cutting turns to jumping or back."""
    first = run_starts(toolpath)
    if not len(first):
        return Plan(np.zeros(1), np.zeros(1), np.zeros(0), np.zeros(0))
    length = np.add.reduceat(toolpath.length_um, first)
    feed = np.where(toolpath.is_jump[first], feeds.jump_um_s, feeds.cut_um_s)
    a = feeds.acceleration_um_s2
    # A run too short for its feed is a triangle: up to half way, down from there.
    ramp = np.minimum(feed * feed / (2.0 * a), length / 2.0)
    peak = np.sqrt(2.0 * a * ramp)
    spans = np.stack([ramp, length - 2.0 * ramp, ramp], axis=1)
    times = np.stack([peak / a, spans[:, 1] / np.where(peak > 0.0, peak, 1.0), peak / a], axis=1)
    speeds = np.stack([np.zeros_like(peak), peak, peak], axis=1)
    accelerations = np.tile([a, 0.0, -a], (len(first), 1))
    return Plan(_summed(spans), _summed(times), speeds.ravel(), accelerations.ravel())


def run_starts(toolpath: Toolpath) -> Ints:
    """First rows of the path runs: after each pause, and where cutting turns to jumping or back; (r,) int64."""
    n = len(toolpath)
    turns = np.flatnonzero(np.diff(toolpath.is_jump)) + 1
    stops = [stop.after for stop in toolpath.stops]
    starts = np.unique(np.concatenate([[0], turns, np.array(stops, dtype=np.int64)]))
    return starts[starts < n]


def _summed(steps: Floats) -> Floats:
    return np.concatenate([[0.0], np.cumsum(steps)])
