"""The motors: where they stand while the pulses come in."""

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats

_GRACE_S = 1e-9  # a pulse due at a time counts as out at that time, whichever way its time was rounded


class Motors:
    """Places of both motors over time, as pulses stream in.

    A motor takes `step_time_s` for a step and turns at constant speed meanwhile; steps that come faster add up. So its
    place is the mean of the commanded place over the last step time.

    Parameters
    ----------
    step_time_s
        Time of a step; 0 for motors that jump.
    origin_um
        Place before the first pulse.
    """

    def __init__(self, step_time_s: float, origin_um: tuple[int, int]) -> None:
        self._step_time_s = step_time_s
        self._t_s = np.empty(0)
        self._place = np.array([origin_um], dtype=np.float64)
        self._moment = np.zeros((1, 2))
        self._whole = True

    @property
    def known_s(self) -> float:
        """Time of the last pulse; 0 before the first."""
        return float(self._t_s[-1]) if len(self._t_s) else 0.0

    def take(self, pulses: Pulses, need_s: float) -> None:
        """Take the next pulses; places before `need_s` will not be asked for again."""
        kept = int(np.searchsorted(self._t_s, need_s - self._step_time_s - _GRACE_S))
        self._whole &= kept == 0
        self._t_s = np.concatenate([self._t_s[kept:], pulses.t_s])
        new = np.stack([pulses.x_um, pulses.y_um], axis=1).astype(np.float64)
        self._place = np.concatenate([self._place[kept:], new])
        # Times are counted from the first pulse that is kept, so that the sum stays small beside its steps.
        moments = np.diff(self._place, axis=0) * (self._t_s - self._t_s[0])[:, None]
        self._moment = np.concatenate([np.zeros((1, 2)), np.cumsum(moments, axis=0)])

    def commanded_um(self, t_s: Floats) -> Floats:
        """Places (n, 2) that the pulses have commanded by rising times (n,)."""
        return self._place[np.searchsorted(self._t_s, t_s + _GRACE_S, side="right")]

    def calm_s(self, t_s: Floats, wait_s: float) -> Floats:
        """For each of (n,) times, the latest time up to it that has no pulse in the `wait_s` before it.

        −inf where no such time is known: the oldest pulses are forgotten.
        """
        before = np.searchsorted(self._t_s, t_s, side="right")
        if not len(self._t_s):
            return t_s
        first = -np.inf if self._whole else self._t_s[0]
        calm = np.diff(self._t_s, prepend=first) >= wait_s
        latest = np.maximum.accumulate(np.where(calm, np.arange(len(calm)), -1))
        last = latest[np.maximum(before - 1, 0)]
        waited = (before == 0) | (t_s - self._t_s[np.maximum(before - 1, 0)] >= wait_s)
        return np.where(waited, t_s, np.where(last >= 0, self._t_s[last] - 2.0 * _GRACE_S, -np.inf))

    def hasty_s(self, felt_s: float) -> Floats:
        """Windows (n, 2) of steps that are not slow, each from before its first step until its last is felt no more.

        A step is slow when it comes `felt_s` or more after the last step of the same motor, in the same direction.
        """
        pulses = len(self._t_s)
        hasty = np.zeros(pulses, dtype=bool)
        for place in self._place.T:
            step = np.diff(place)
            moving = np.flatnonzero(step)
            turned = np.diff(step[moving], prepend=step[moving[:1]]) != 0.0
            hasty[moving] |= turned | (np.diff(self._t_s[moving], prepend=-np.inf) < felt_s)
        first = np.flatnonzero(np.diff(self._t_s, prepend=-np.inf) >= felt_s)
        if not len(first):
            return np.empty((0, 2))
        last = np.append(first[1:], pulses) - 1
        windows = np.stack([self._t_s[first] - 2.0 * _GRACE_S, self._t_s[last] + felt_s], axis=1)
        return windows[np.maximum.reduceat(hasty, first)]

    def at_um(self, t_s: Floats) -> Floats:
        """Places (n, 2) of the motors at (n,) rising times."""
        time = t_s + _GRACE_S
        now = np.searchsorted(self._t_s, time, side="right")
        if self._step_time_s == 0.0 or not len(self._t_s):
            return self._place[now]
        before = np.searchsorted(self._t_s, time - self._step_time_s, side="right")
        moved = (self._place[now] - self._place[before]) * (time - self._t_s[0])[:, None]
        moved -= self._moment[now] - self._moment[before]
        place: Floats = self._place[before] + moved / self._step_time_s
        return place
