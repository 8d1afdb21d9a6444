"""Playing a run: forward at any speed, by blocks and by single steps, to any moment."""

import math
from dataclasses import dataclass
from itertools import count
from typing import Final

import numpy as np

from sim.run.course import Course
from sim.show.draw.layout import nice_below

SPEEDS: Final = (0.01, 10_000.0)
"""Slowest and fastest, in seconds of the run to the second."""


@dataclass(slots=True)
class Playback:
    """Where a run stands, and how fast it goes on.

    Attributes
    ----------
    course
        The run.
    speed
        Seconds of the run in each second.
    t_s
        The moment that shows; past the end of the run pieces go on to fall.
    playing
        Whether time passes.
    """

    course: Course
    speed: float
    t_s: float = 0.0
    playing: bool = True

    def pass_time(self, seconds: float) -> None:
        """Let so much time of those who watch pass."""
        if self.playing:
            self.t_s += seconds * self.speed
            self.playing = self.t_s < self.course.duration_s + self.speed

    def toggle(self) -> None:
        """Play or pause; from the end on it begins anew."""
        if not self.playing and self.t_s >= self.course.duration_s:
            self.t_s = 0.0
        self.playing = not self.playing

    def seek(self, t_s: float) -> None:
        """Go to a moment."""
        self.t_s = min(max(t_s, 0.0), self.course.duration_s)

    def by_block(self, forward: bool) -> None:
        """Pause at the next begin of a block, or at the one before."""
        begins = self.course.border_s[:-1]
        if forward:
            later = begins[np.searchsorted(begins, self.t_s, side="right") :]
            self._stop_at(float(later[0]) if len(later) else self.course.duration_s)
        else:
            earlier = begins[: np.searchsorted(begins, self._shown_s, side="left")]
            self._stop_at(float(earlier[-1]) if len(earlier) else 0.0)

    def by_step(self, forward: bool) -> None:
        """Pause at the next step, or at the one before; two axes may step at once."""
        times = self.course.steps.t_s
        done = self.course.steps_by(self._shown_s)
        if forward:
            self._stop_at(float(times[done]) if done < len(times) else self.course.duration_s)
        elif done:
            before = int(np.searchsorted(times, times[done - 1], side="left"))
            self._stop_at(float(times[before - 1]) if before else 0.0)

    def change_speed(self, faster: bool) -> None:
        """Go on at the next of … 1, 2, 5, 10 … times the true speed."""
        self.speed = min(max(_next_nice(self.speed, faster), SPEEDS[0]), max(SPEEDS[1], self.speed))

    @property
    def _shown_s(self) -> float:
        return min(self.t_s, self.course.duration_s)

    def _stop_at(self, t_s: float) -> None:
        self.playing = False
        self.seek(t_s)


def _next_nice(value: float, above: bool) -> float:
    """Nearest of … 1, 2, 5, 10 … above or below a value that is above 0."""
    if not above:
        return nice_below(value * (1.0 - 1e-9))
    power = 10.0 ** math.floor(math.log10(value))
    return next(nice for digit in count(1) if (nice := nice_below(digit * power)) > value * (1.0 + 1e-9))
