"""The clock of a film: which moment of the run each frame shows."""

from fractions import Fraction
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats

HOLD_S: Final = 1.0
"""The end stands as long as this, or a tenth of a shorter film."""


class FilmClock(NamedTuple):
    """How a run of `duration_s` becomes a film of `seconds` with `fps` frames in each.

    The run goes by at one speed, jumps and pauses too; then its last moment stands for a while.
    """

    seconds: float
    fps: int
    duration_s: float

    @property
    def frames(self) -> int:
        """Number of frames, 2 or more."""
        return max(round(self.seconds * self.fps), 2)

    @property
    def speed(self) -> float:
        """Seconds of the run in each second of the film."""
        return self.duration_s / (self.seconds - min(HOLD_S, self.seconds / 10.0))

    @property
    def times_s(self) -> Floats:
        """(frames,) moments of the run from 0 on, past its end where that stands."""
        return np.asarray(np.arange(self.frames) * (self.speed / self.fps), dtype=np.float64)

    def delays_ms(self, grain_ms: int) -> list[int]:
        """How long each frame stands, in whole grains of so many ms that add up to the film's length."""
        frame_ms = Fraction(1000, self.fps * grain_ms)
        ends = [round(frame * frame_ms) * grain_ms for frame in range(self.frames + 1)]
        return [past - first for first, past in pairwise(ends)]
