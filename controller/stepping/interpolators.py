"""Interpolators: a plan along lines and arcs to pulses, as time passes.

Both hold one stretch of motion. They are asked for the pulses due by a time and hand out each pulse once; how the time
is portioned changes no pulse.
"""

from collections.abc import Iterator
from typing import Protocol

import numpy as np

from controller.motion.limits import Path
from controller.motion.plan import Plan
from controller.stepping.equal_time import ROUNDING_UM, Clock, SampledMotion
from controller.stepping.pulses import Pulses, no_pulses, time_steps
from controller.stepping.steps import Steps

_FIRST_STEPS = 256  # worked out at first: a plan is often replaced before it has run far
_FIRST_PERIODS, _MOST_PERIODS = 32, 2048  # looked at ahead of what is asked for


class Interpolator(Protocol):
    """What a card asks of the motion it runs."""

    @property
    def at_um(self) -> tuple[int, ...]:
        """Where the axes stand after the pulses handed out so far."""

    def pulses(self, until_s: float) -> Iterator[Pulses]:
        """Pulses not yet handed out that are due by a time of the card's clock, in order, in bounded chunks."""


class PointByPoint:
    """Steps of point-by-point comparison, each when the plan reaches its foot on the path.

    Parameters
    ----------
    steps, plan
        The steps, and the plan along their path.
    began_s
        Time of the card's clock at which the plan begins.
    at_um
        Where X and Y stand then.
    done
        Steps made before.
    from_um
        Length of the steps' path at which the plan begins.
    """

    def __init__(  # noqa: PLR0913 - the last two are named
        self,
        steps: Steps,
        plan: Plan,
        began_s: float,
        at_um: tuple[int, int],
        *,
        done: int = 0,
        from_um: float = 0.0,
    ) -> None:
        x, y = steps.place_after(done)
        self._steps, self._plan, self._began_s, self._from_um = steps, plan, began_s, from_um
        self._origin_um = at_um[0] - x, at_um[1] - y
        self._at_um = at_um
        self._done = done
        self._latest_s = began_s
        self._chunk, self._taken, self._size = no_pulses(), 0, _FIRST_STEPS
        self._ends_um = from_um + float(plan.along_um[-1]) + ROUNDING_UM
        self._finishes = self._ends_um >= steps.along_um[-1]
        self._over = done == len(steps) or not len(plan.speed_um_s)

    @property
    def at_um(self) -> tuple[int, int]:
        """Where X and Y stand after the pulses handed out so far."""
        return self._at_um

    @property
    def done(self) -> int:
        """Steps made so far, with those made before the plan began."""
        return self._done

    def pulses(self, until_s: float) -> Iterator[Pulses]:
        """Pulses not yet handed out that are due by a time of the card's clock, in order, in bounded chunks."""
        while self._has_next():
            due = int(np.searchsorted(self._chunk.t_s, until_s, side="right"))
            if due <= self._taken:
                return
            part = self._chunk.part(self._taken, due)
            self._done += due - self._taken
            self._taken = due
            self._at_um = int(part.x_um[-1]), int(part.y_um[-1])
            yield part

    def _has_next(self) -> bool:
        """Whether the plan makes another step; the chunk then holds it."""
        if self._taken == len(self._chunk.t_s) and not self._over:
            self._work_out()
        return self._taken < len(self._chunk.t_s)

    def _work_out(self) -> None:
        """Work out the next chunk, without steps that come after the plan's end."""
        from controller.stepping.chunks import CHUNK_STEPS, chunk_of  # noqa: PLC0415 - loads the compiler

        until = min(self._done + self._size, len(self._steps))
        chunk = chunk_of(self._steps, self._done, until)
        timed = time_steps(chunk, self._plan, self._began_s, self._from_um)
        np.maximum(timed.t_s, self._latest_s, out=timed.t_s)
        x, y = self._origin_um
        timed = timed._replace(x_um=timed.x_um + x, y_um=timed.y_um + y) if x or y else timed
        made = len(timed.t_s) if self._finishes else int(np.searchsorted(chunk.along_um, self._ends_um, side="right"))
        self._latest_s, self._over = float(timed.t_s[-1]), made < len(timed.t_s) or until == len(self._steps)
        self._chunk, self._taken, self._size = timed.part(0, made), 0, min(2 * self._size, CHUNK_STEPS)


class EqualTime:
    """The card's own: at the end of each servo period the plan's place, rounded to whole pulses on each axis.

    Axes beyond Y have no pulses of their own; `at_um` counts them. The places of half a pulse go to the even side.

    Parameters
    ----------
    path, plan
        Lines and arcs in two axes or more, and the plan along them.
    began_s
        Time of the card's clock at which the plan begins.
    at_um
        Where the axes stand then.
    period_s
        Servo period; periods end at whole multiples of it on the card's clock.
    """

    def __init__(self, path: Path, plan: Plan, began_s: float, at_um: tuple[int, ...], period_s: float) -> None:
        self._clock = Clock(period_s, began_s)
        self._motion = SampledMotion(path, plan, self._clock) if len(path) else None
        self._at_um = at_um
        first = self._clock.first_after(began_s)
        self._ticks = iter((np.array([first]),))  # looked at in any case: the axes may stand beside the path
        # Periods looked at last, at first the one in which the plan begins, and the places commanded at their ends.
        self._looked_at, self._places = np.array([first - 1]), np.array([at_um], dtype=np.int64)
        self._ready, self._ahead = no_pulses(), _FIRST_PERIODS

    @property
    def at_um(self) -> tuple[int, ...]:
        """Where the axes stand after the pulses handed out so far."""
        return self._at_um

    def pulses(self, until_s: float) -> Iterator[Pulses]:
        """Pulses not yet handed out that are due by a time of the card's clock, in order, in bounded chunks."""
        while True:
            due = int(np.searchsorted(self._ready.t_s, until_s, side="right"))
            part, self._ready = self._ready.part(0, due), self._ready.part(due, len(self._ready.t_s))
            self._stand(part, until_s)
            if due:
                yield part
            if len(self._ready.t_s) or not self._work_out(until_s):
                return

    def skip(self, until_s: float) -> None:
        """Skip the pulses of all periods that end by a time: nobody gets them, but `at_um` counts them."""
        if self._motion is None:
            return
        period_s = self._clock.period_s
        k = self._clock.first_after(min(until_s, self._motion.last * period_s)) - 1
        if k <= self._looked_at[-1]:
            return
        _, places = self._motion.commanded(np.array([k]))
        self._looked_at, self._places = np.array([k]), places
        self._ticks, self._ready = iter(()), no_pulses()
        self._at_um = tuple(places[0].tolist())

    def _stand(self, part: Pulses, until_s: float) -> None:
        """Keep where the axes stand after some pulses; axes without pulses move at the ends of periods."""
        xy = (int(part.x_um[-1]), int(part.y_um[-1])) if len(part.t_s) else self._at_um[:2]
        self._at_um = xy + (self._others(until_s) if len(self._at_um) > 2 else ())

    def _others(self, until_s: float) -> tuple[int, ...]:
        """Where the axes beyond Y stand at a time in or after the periods looked at last."""
        ended = int(np.searchsorted(self._looked_at * self._clock.period_s, until_s, side="right"))
        return tuple(self._places[ended - 1, 2:].tolist()) if ended else self._at_um[2:]

    def _work_out(self, until_s: float) -> bool:
        """Make ready the pulses of the next periods; False where the plan is over, or a time is reached already."""
        period = int(self._looked_at[-1])
        if self._motion is None or period >= self._motion.last or period * self._clock.period_s >= until_s:
            return False
        ticks = next(self._ticks, None)
        if ticks is None:
            self._ticks = self._motion.periods(period, self._target(period, until_s, self._motion.last))
            ticks = next(self._ticks)
        row, places = self._motion.commanded(ticks)
        before = self._places[-1]
        by = np.diff(places, axis=0, prepend=before[None])
        moved = np.flatnonzero(by[:, :2].any(axis=1))
        if len(moved):
            from_um = int(before[0]), int(before[1])
            self._ready = self._motion.spread(ticks[moved], row[moved], by[moved, :2], from_um)
        self._looked_at, self._places = ticks, places
        return True

    def _target(self, period: int, until_s: float, last: int) -> int:
        """The period to look ahead to: the one that a time lies in, or some more, soon asked for."""
        first = self._clock.first_from(min(until_s, last * self._clock.period_s) - self._clock.began_s)
        ahead = period + self._ahead
        self._ahead = min(2 * self._ahead, _MOST_PERIODS)
        return min(max(first, ahead), last)
