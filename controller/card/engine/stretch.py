"""A stretch: entries that one interpolator runs, with their path, limits, plan and pulses, and how it is made.

Stretches are made: entries to path, limits, plan, and what hands out the pulses.

Rows: entries that move as columns, their path and what limits them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.card.core.settings import AXES, UM_S3_PER_PULSE_MS3, CardSettings
from controller.card.engine.entries import (
    Entry,
    Pace,
    PathEntry,
    Place,
    Segment,
    Stepped,
    Stepping,
    Wait,
    four,
    steps_made,
    steps_of,
)
from controller.card.engine.speeds import Speeds
from controller.motion.limits import Path
from controller.motion.plan import EMPTY_PLAN, Plan
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping.equal_time import Clock
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


def path_of_segments(rows: Sequence[PathEntry]) -> Path:
    """Path of n lines and arcs in four axes."""
    lines = [row for row in rows if isinstance(row, Segment)]
    start, tangent, normal = (
        np.array([row[field] for row in lines], dtype=np.float64).reshape(-1, AXES)
        for field in (Segment._fields.index(name) for name in ("start", "tangent", "normal"))
    )
    curvature = np.array([row.curvature for row in lines], dtype=np.float64)
    return Path(start, tangent, normal, curvature, np.array([row.length_um for row in lines], dtype=np.float64))


def path_of_blocks(rows: Sequence[PathEntry], steps: Steps, place: Place, at_um: tuple[int, int, int, int]) -> Path:
    """Ideal path of n stepped blocks, each from where the steps of the one before it end, the first as far as left."""
    blocks = [row for row in rows if isinstance(row, Stepped)]
    n = len(blocks)
    extent = np.array([(b.x_um, b.y_um) for b in blocks], dtype=np.float64)
    signs = np.array([_SIGNS[b.quadrant] for b in blocks], dtype=np.float64)
    turn = np.array([b.turn for b in blocks], dtype=np.float64)
    outward = extent * signs / np.hypot(*extent.T)[:, None]
    arc = turn != 0.0
    turned = np.stack([-outward[:, 1], outward[:, 0]], axis=1) * turn[:, None]
    start = np.tile(np.array(place), (n, 1))
    start[:, :2] = steps.corner_um[:-1] + np.array(at_um[:2]) - steps.place_after(blocks[0].done)
    still = np.zeros((n, AXES - 2))
    path = Path(
        start_um=start,
        tangent=np.hstack([np.where(arc[:, None], turned, outward), still]),
        normal=np.hstack([np.where(arc[:, None], -outward, 0.0), still]),
        curvature=np.where(arc, 1.0 / np.hypot(*extent.T), 0.0),
        length_um=np.array([b.length_um for b in blocks]),
    )
    return path.rest(blocks[0].offset_um) if blocks[0].offset_um else path


_SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))
"""Signs of X and Y in quadrants 1 to 4."""


def limits_of(
    rows: Sequence[PathEntry], waits_s: Floats, path: Path, speeds: Speeds, settings: CardSettings
) -> RowLimits:
    """What the plan of the n rows has to keep, with waits (n + 1,) s at their borders.

    The path speed is carried through a junction at the lower of both speeds, or each entry ends at the start speed,
    as the settings say; an end speed set for the entry comes first. The path begins and ends with the start speed.
    """
    paces = [row.pace for row in rows]
    speed = np.array([speeds.run_at(pace) for pace in paces], dtype=np.float64)
    speed = np.minimum(speed, settings.pulse_limit_hz / _fastest_axis(path))
    border = np.full(len(rows) + 1, speeds.start_um_s)
    if rows:
        carried = np.minimum(speed[:-1], speed[1:]) if settings.carries_speed else border[1:-1]
        set_for = np.array([_end_speed(pace) for pace in paces[:-1]], dtype=np.float64)
        border[1:-1] = np.maximum(np.where(np.isnan(set_for), carried, set_for), speeds.start_um_s)
        border[waits_s > 0.0] = speeds.start_um_s
    acceleration = np.array([pace.acceleration_um_s2 for pace in paces], dtype=np.float64)
    return RowLimits(path.length_um, speed, acceleration, border, waits_s)


def _end_speed(pace: Pace) -> float:
    return math.nan if pace.end_um_s is None else pace.end_um_s


def _fastest_axis(path: Path) -> Floats:
    """Most of the path speed that one axis can have (n,): on an arc all of it, which is more than a short arc has."""
    along = np.abs(path.tangent).max(axis=1, initial=0.0)
    return np.where((path.curvature > 0.0) | (along == 0.0), 1.0, along)


_STEADY = 1e-6
"""Share of the acceleration below which there is none, but for the rounding of times."""


def make_stretch(
    entries: Sequence[Entry], start: Start, speeds: Speeds, settings: CardSettings, deceleration_um_s2: float = 0.0
) -> Stretch:
    """Stretch of entries of one kind, run as fast as the limits allow, or braked for a stop where that is asked for."""
    rows = [e for e in entries if isinstance(e, PathEntry) and e.kind is not None]
    steps = steps_of([e for e in rows if isinstance(e, Stepped)]) if rows and rows[0].kind is Stepping.STEPPED else None
    path = path_of_segments(rows) if steps is None else path_of_blocks(rows, steps, start.place, start.at_um)
    row_of = np.cumsum([0, *(isinstance(e, PathEntry) and e.kind is not None for e in entries)])
    waits = np.array([e.seconds if isinstance(e, Wait) else 0.0 for e in entries])
    limits = limits_of(rows, np.bincount(row_of[1:], waits, len(rows) + 1).astype(np.float64), path, speeds, settings)
    plan, deceleration_um_s2 = _planned(limits, start, settings, deceleration_um_s2)
    before = path.before_um
    ends = _ends(waits, row_of, before, plan, deceleration_um_s2 > 0.0) + start.clock_s
    interpolator, end = _interpolator(rows, steps, path, plan, start, settings)
    if not rows and len(ends) and not deceleration_um_s2:
        end = float(ends[-1])
    numbers = np.array([row.number for row in rows], dtype=np.int32)
    return Stretch(
        start, entries, rows, numbers, row_of, path, before, plan, deceleration_um_s2, ends, end, steps, interpolator
    )


def _planned(limits: RowLimits, start: Start, settings: CardSettings, deceleration_um_s2: float) -> tuple[Plan, float]:
    """Plan of the rows, and the deceleration that a stop takes; 0 where none is asked for."""
    if deceleration_um_s2:
        limits.border_um_s[limits.wait_s > 0.0] = 0.0  # a stop runs through no wait
        return _braking(limits, start.speed_um_s, deceleration_um_s2)
    # A jerk-limited plan begins without acceleration; from any other state the rest is planned without the limit.
    steady = abs(start.acceleration_um_s2) <= _STEADY * limits.acceleration_um_s2.max(initial=0.0)
    jerk = settings.jerk_pulse_ms3 * UM_S3_PER_PULSE_MS3 if steady else math.inf
    return plan_rows(limits, start.speed_um_s or None, jerk), 0.0


def _braking(limits: RowLimits, speed_um_s: float, deceleration_um_s2: float) -> tuple[Plan, float]:
    """Plan from `speed_um_s` to rest, and the deceleration it takes.

    That is the least constant one, `deceleration_um_s2` or more, that keeps the speed of every border ahead: with
    ``v² − 2 a s``, a speed w at distance s takes a ≥ (v² − w²) / 2 s. At the end of the rows it stops with what the
    border allows. Which deceleration the card takes where the set one is too weak for a corner is grade C; so is that a
    stop knows no jerk limit.
    """
    ends = np.cumsum(limits.length_um)
    ahead = ends > 0.0
    if speed_um_s <= 0.0 or not ahead.any():
        return EMPTY_PLAN, deceleration_um_s2
    square = speed_um_s**2
    needed = (square - limits.border_um_s[1:][ahead] ** 2) / (2.0 * ends[ahead])
    a = max(deceleration_um_s2, float(needed.max()))
    way = min(square / (2.0 * a), float(ends[-1]))
    last = max(square - 2.0 * a * way, 0.0) ** 0.5
    time = 2.0 * way / (speed_um_s + last)
    columns = ([0.0, way], [0.0, time], [speed_um_s], [-a], [0.0])
    return Plan(*(np.array(column) for column in columns)), a


def _ends(waits_s: Floats, row_of: Ints, before_um: Floats, plan: Plan, stops: bool) -> Floats:
    """Time of the plan (m,) at which each entry is done. A stop leaves undone what lies behind its end, or at a wait.

    The plan tells when a border is reached; the waits at that border follow one after another.
    """
    reached: Floats = np.concatenate([[0.0], plan.time_at(before_um[1:])])
    ends: Floats
    if stops:
        reached[before_um > plan.along_um[-1]] = math.inf
        ends = np.maximum.accumulate(np.where(waits_s > 0.0, math.inf, reached[row_of[1:]]))
        return ends
    waited = np.cumsum(waits_s)
    before_row = np.maximum.accumulate(np.where(np.diff(row_of) > 0, waited, 0.0))
    ends = reached[row_of[1:]] + (waited - before_row)
    return ends


def _interpolator(  # noqa: PLR0913, PLR0917 - what a stretch is made of
    rows: Sequence[PathEntry], steps: Steps | None, path: Path, plan: Plan, start: Start, settings: CardSettings
) -> tuple[Interpolator | None, float]:
    """What makes the pulses, and the clock time at which it has made them."""
    if not rows:
        return None, start.clock_s
    if steps is not None:
        first, at = rows[0], start.at_um[:2]
        offset = first.offset_um if isinstance(first, Stepped) else 0.0
        stepped = PointByPoint(steps, plan, start.clock_s, at, done=steps_made(first), from_um=offset)
        return stepped, start.clock_s + plan.duration_s
    clock = Clock(settings.servo_period_s, start.clock_s)
    last = max(clock.first_from(plan.duration_s), clock.first_after(start.clock_s))
    equal = EqualTime(path, plan, start.clock_s, start.at_um, settings.servo_period_s)
    return equal, last * settings.servo_period_s
