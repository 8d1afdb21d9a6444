"""Stretches are made: entries to path, limits, plan, and what hands out the pulses."""

import math
from collections.abc import Sequence

import numpy as np

from controller.card.core.settings import CardSettings
from controller.card.core.units import UM_S3_PER_PULSE_MS3
from controller.card.engine.entries import Entry, PathEntry, Stepped, Stepping, Wait, steps_made
from controller.card.engine.motion_list import steps_of
from controller.card.engine.rows import limits_of, path_of_blocks, path_of_segments
from controller.card.engine.speeds import Speeds
from controller.card.engine.stretch import Start, Stretch
from controller.motion.path import Path
from controller.motion.plan import EMPTY_PLAN, Plan
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping.equal_time import Clock
from controller.stepping.interpolators import EqualTime, Interpolator, PointByPoint
from controller.stepping.steps import Steps
from parser.geometry.curves import Floats, Ints

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
