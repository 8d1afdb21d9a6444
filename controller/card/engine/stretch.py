"""A stretch: entries that one interpolator runs, with their path, limits, plan and pulses."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.card.engine.entries import Entry, PathEntry, Place, Segment, Wait, four, steps_made
from controller.motion.junctions import Path
from controller.motion.plan import Plan
from controller.stepping.interpolators import EqualTime, Interpolator, PointByPoint
from controller.stepping.steps import Steps
from parser.geometry.curves import Floats, Ints

_NO_WAY_UM = 1e-6
"""A phase shorter than this comes from rounding."""


class Start(NamedTuple):
    """How a stretch begins: clock time s, profile place, pulses out, and speed µm/s, acceleration µm/s² on the path."""

    clock_s: float
    place: Place
    at_um: tuple[int, int, int, int]
    speed_um_s: float = 0.0
    acceleration_um_s2: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Stretch:
    """m entries, n of which move: its rows. Times are of the card's clock.

    Attributes
    ----------
    start
        Where and how it begins; the plan begins then.
    entries, rows
        All m, as far as they were left to do, and the n that move.
    numbers
        (n,) int32, the number that each row has in the list.
    row_of
        (m + 1,) int64, rows before each entry and in all.
    path, before_um
        Of the rows; `before_um` (n + 1,) path length before each row and at the end.
    plan, deceleration_um_s2
        Motion in time, and the deceleration where it brakes for a stop; else 0.
    ends_s
        (m,) float64, when each entry is done, never falling; inf where the plan ends before.
    end_s
        When the motion is over: with the servo period in which the plan ends.
    steps
        Of the blocks, where blocks are stepped.
    interpolator
        Hands out the pulses; None where nothing moves.
    """

    start: Start
    entries: Sequence[Entry]
    rows: Sequence[PathEntry]
    numbers: NDArray[np.int32]
    row_of: Ints
    path: Path
    before_um: Floats
    plan: Plan
    deceleration_um_s2: float
    ends_s: Floats
    end_s: float
    steps: Steps | None
    interpolator: Interpolator | None

    def speed(self, now_s: float) -> float:
        """Path speed, µm/s."""
        return float(self.plan.at(now_s - self.start.clock_s).speed_um_s)

    def along(self, now_s: float) -> float:
        """Path length done, µm."""
        return float(self.plan.at(now_s - self.start.clock_s).along_um)

    def done(self, now_s: float) -> int:
        """Entries finished."""
        return int(self.ends_s.searchsorted(now_s, side="right"))

    def number(self, now_s: float) -> int | None:
        """Number of the path entry being executed, the last one once all are; None without any."""
        return self.rows[self.row(now_s)].number if self.rows else None

    def row(self, now_s: float) -> int:
        """Row being executed, the last one once all are; −1 without rows."""
        return min(int(self.row_of[self.done(now_s)]), len(self.rows) - 1)

    def place(self, now_s: float) -> Place:
        """Profile place; where blocks are stepped, that of the steps made."""
        if isinstance(self.interpolator, EqualTime):
            row, s = self._at(now_s)
            if s[0] >= self.path.length_um[row[0]]:
                return self.row_end(now_s)  # without the rounding of its path
            return four(self.path.place(row, s)[0].tolist())
        at = self.interpolator.at_um if self.interpolator else self.start.place
        return four((float(at[0]), float(at[1]), *self.start.place[2:]))

    def velocity(self, now_s: float) -> Place:
        """Profile velocity, µm/s, in the direction of the ideal path."""
        if not self.rows:
            return (0.0, 0.0, 0.0, 0.0)
        return four((self.path.direction(*self._at(now_s))[0] * self.speed(now_s)).tolist())

    def row_end(self, now_s: float) -> Place:
        """End of the row being executed; where it stands without rows."""
        row = self.row(now_s)
        if self.steps is not None:
            (x, y), before = self.steps.corner_um[row + 1].tolist(), self.steps.place_after(steps_made(self.rows[0]))
            at = self.start.at_um
            return four((float(at[0] + x - before[0]), float(at[1] + y - before[1]), *self.start.place[2:]))
        entry = self.rows[row] if self.rows else None
        return entry.end if isinstance(entry, Segment) else self.start.place

    def axes_moved(self, now_s: float) -> list[bool]:
        """Of each axis, whether the rows up to the one being executed, that one too, move it."""
        return self._moves(slice(0, self.row(now_s) + 1))

    def axes_moving(self, now_s: float) -> list[bool]:
        """Of each axis, whether the row being executed moves it."""
        row = self.row(now_s)
        return self._moves(slice(max(row, 0), row + 1))

    def grows_s(self, now_s: float) -> float:
        """When the plan begins to differ from one that takes in entries behind, or soon before that.

        That is where it begins to brake for its end. Under a jerk limit its last S-curve may become part of a longer
        one: then it is where the S-curve begins to rise, if that is still to come.
        """
        plan = self.plan
        span, a, j = np.diff(plan.along_um), plan.acceleration_um_s2, plan.jerk_um_s3
        brakes = (a < 0.0) | ((a == 0.0) & (j < 0.0)) | (span < _NO_WAY_UM)
        phase = len(span) - int(np.argmin(np.append(brakes[::-1], False)))
        rises = np.flatnonzero((a[:phase] == 0.0) & (j[:phase] > 0.0))
        if len(rises) and self.start.clock_s + plan.time_s[rises[-1]] > now_s:
            phase = int(rises[-1])
        return self.start.clock_s + float(plan.time_s[phase])

    def time_s(self, along_um: float) -> float:
        """When a path length is reached; inf beyond the plan's end."""
        if along_um > self.plan.along_um[-1]:
            return math.inf
        return self.start.clock_s + float(self.plan.time_at(np.array([along_um]))[0])

    def unfinished(self, now_s: float) -> list[Entry]:
        """Entries not finished, the first row as far as it is left. Pulses due by now have to be handed out."""
        done, made = self.done(now_s), 0
        if isinstance(self.interpolator, PointByPoint) and self.steps is not None:
            # By rounding the last step of a block may be due just behind its end: then the block is not done.
            made = self.interpolator.done
            blocks = int(np.searchsorted(self.steps.before, made, side="right")) - 1
            done = min(done, int(np.searchsorted(self.row_of, blocks, side="right")) - 1)
        left = list(self.entries[done:])
        first = left[0] if left else None
        if isinstance(first, Wait):
            left[0] = Wait(float(self.ends_s[done]) - now_s if self.ends_s[done] < math.inf else first.seconds)
        elif isinstance(first, PathEntry) and first.kind:
            row = int(self.row_of[done])
            on_row = min(max(self.along(now_s) - float(self.before_um[row]), 0.0), float(self.path.length_um[row]))
            left[0] = self._rest(first, row, on_row, made)
        return left

    def _rest(self, entry: PathEntry, row: int, on_row_um: float, made: int) -> PathEntry:
        if isinstance(entry, Segment) or self.steps is None:
            return entry.rest(on_row_um) if isinstance(entry, Segment) else entry
        return entry._replace(offset_um=entry.offset_um + on_row_um, done=made - int(self.steps.before[row]))

    def _at(self, now_s: float) -> tuple[Ints, Floats]:
        row = self.row(now_s)
        s = min(max(self.along(now_s) - float(self.before_um[row]), 0.0), float(self.path.length_um[row]))
        return np.array([row]), np.array([s])

    def _moves(self, rows: slice) -> list[bool]:
        moves = (self.path.tangent[rows] != 0.0) | (self.path.normal[rows] != 0.0)
        return [bool(axis) for axis in moves.any(axis=0)]
