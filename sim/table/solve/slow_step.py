"""What a slow step does: the lag at which a slide comes to rest, by the lag that it rested at before."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats

_SAME_UM = 1e-6
_MANY = 1000.0


class SlowStep(NamedTuple):
    """The rest after a slow step of 1 µm in the positive direction, by the rest before it; in the other, mirrored.

    Slides without friction and backlash come to rest where their motors are. Others keep what they were left with: this
    is the play operator of hysteresis (M. Brokate, J. Sprekels, "Hysteresis and Phase Transitions", 1996, ch. 2) with
    what a step throws and drags a slide on besides.

    Attributes
    ----------
    before_um, after_um
        (2, g) float64, lags of X and Y before, rising, and after.
    """

    before_um: Floats
    after_um: Floats

    def rest_um(self, lag_um: Floats, steps: Floats) -> Floats:
        """Lags (2, n) µm at which slides rest after (2, n) slow steps, all of a slide one way, from lags (2, n)."""
        way, left = np.sign(steps), np.abs(steps)
        lag = lag_um * way
        for done in range(int(left.max(initial=0.0))):
            stepped = np.stack([np.interp(*axis) for axis in zip(lag, self.before_um, self.after_um, strict=True)])
            new = np.where(left > done, stepped, lag)
            if np.abs(new - lag).max() < _SAME_UM:
                break
            lag = new
        # Without a step, a slide that a stop let go of is drawn to it again.
        stays = np.clip(lag_um, *(end[:, None] for end in self.before_um[:, [0, -1]].T))
        return np.where(way == 0.0, stays, lag * way)

    @property
    def play_um(self) -> Floats:
        """Lags (2,) that slow steps in one direction come to; without end where each step differs."""
        return self.rest_um(np.zeros((2, 1)), np.full((2, 1), _MANY))[:, 0]


NO_PLAY = SlowStep(np.array([[-1.0, 1.0]] * 2), np.zeros((2, 2)))
"""Of a table without friction and backlash."""
