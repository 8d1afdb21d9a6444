"""The motors: where they stand while the pulses come in."""

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats

GRACE_S = 1e-9
"""A pulse due at a time counts as out at that time, whichever way its time was rounded."""


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

    def take(self, pulses: Pulses, need_s: float) -> None:
        """Take the next pulses; places before `need_s` will not be asked for again."""
        kept = int(np.searchsorted(self._t_s, need_s - self._step_time_s - GRACE_S))
        self._t_s = np.concatenate([self._t_s[kept:], pulses.t_s])
        new = np.stack([pulses.x_um, pulses.y_um], axis=1).astype(np.float64)
        self._place = np.concatenate([self._place[kept:], new])
        # Times are counted from the first pulse that is kept, so that the sum stays small beside its steps.
        moments = np.diff(self._place, axis=0) * (self._t_s - self._t_s[0])[:, None]
        self._moment = np.concatenate([np.zeros((1, 2)), np.cumsum(moments, axis=0)])

    def at_um(self, t_s: Floats) -> Floats:
        """Places (n, 2) of the motors at (n,) rising times."""
        time = t_s + GRACE_S
        now = np.searchsorted(self._t_s, time, side="right")
        if self._step_time_s == 0.0 or not len(self._t_s):
            return self._place[now]
        before = np.searchsorted(self._t_s, time - self._step_time_s, side="right")
        moved = (self._place[now] - self._place[before]) * (time - self._t_s[0])[:, None]
        moved -= self._moment[now] - self._moment[before]
        place: Floats = self._place[before] + moved / self._step_time_s
        return place
