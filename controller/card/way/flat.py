"""One stretch as X and Y see it: the rows that were run, as lines and arcs in the plane, and phases of motion.

The plan of a stretch goes along a path in four axes. Of a line that climbs, X and Y see a share, the same all along it;
of an arc in X and Y all. Of an arc in another plane they see a line, run with a share that changes: it is cut into
short ones.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from controller.card.engine.motion import Driven
from controller.motion.path import Path
from controller.motion.plan import Plan
from parser.geometry.curves import Floats, Ints

_UPRIGHT_RAD: Final = math.radians(1.0)
"""Longest piece of an arc in another plane: its share changes by 1.7 % of the radius' speed at most."""
_LEVEL: Final = 1e-9
"""Direction cosines below this are rounding."""


class Rows(NamedTuple):
    """n pieces in X and Y, one behind the other.

    Attributes
    ----------
    start_um, end_um, center_um
        (n, 2) float64; centres NaN on lines.
    sweep_rad
        (n,) float64, positive counter-clockwise; 0 on lines.
    length_um
        (n,) float64, in X and Y.
    end_s
        (n,) float64, when each is done, on the card's clock.
    call, number
        (n,) int64, the call that each came from, and its number in the list.
    """

    start_um: Floats
    end_um: Floats
    center_um: Floats
    sweep_rad: Floats
    length_um: Floats
    end_s: Floats
    call: Ints
    number: Ints


class Motions(NamedTuple):
    """m phases, all (m,) float64: begin and end on the clock, way in X and Y, speed and acceleration at first, jerk."""

    begin_s: Floats
    end_s: Floats
    way_um: Floats
    speed_um_s: Floats
    acceleration_um_s2: Floats
    jerk_um_s3: Floats


def flat(driven: Driven) -> tuple[Rows, Motions] | None:
    """Rows and phases of what was run of a stretch; None where it ran nothing."""
    stretch, clock_s = driven.stretch, driven.stretch.start.clock_s
    ran_um = stretch.along(driven.until_s) if stretch.rows else 0.0
    count = int(np.searchsorted(stretch.path.before_um[:-1], ran_um, side="left"))
    if not count:
        return None
    row, since, until = _pieces(stretch.path, count, ran_um)
    rows = _rows(stretch.path, row, since, until)
    done_s = stretch.plan.time_at(stretch.path.before_um[row] + until)
    whole = until - since
    share = np.divide(rows.length_um, whole, out=np.zeros_like(whole), where=whole > 0.0)
    motions = _motions(stretch.plan, driven.until_s - clock_s, done_s, share)
    calls = np.array([getattr(entry, "call", 0) for entry in stretch.rows], dtype=np.int64)
    told = rows._replace(end_s=done_s + clock_s, call=calls[row], number=stretch.numbers.astype(np.int64)[row])
    return told, motions._replace(begin_s=motions.begin_s + clock_s, end_s=motions.end_s + clock_s)


def _pieces(path: Path, count: int, ran_um: float) -> tuple[Ints, Floats, Floats]:
    """Row, begin and end (n,) on it, of the pieces of the first `count` rows."""
    ran = np.minimum(path.length_um[:count], ran_um - path.before_um[:count])
    beside = np.hypot(path.tangent[:count, 2:], path.normal[:count, 2:]).max(axis=1, initial=0.0)
    turn = np.where(beside > _LEVEL, path.curvature[:count] * ran, 0.0)
    parts = np.maximum(np.ceil(turn / _UPRIGHT_RAD), 1.0).astype(np.int64)
    row = np.repeat(np.arange(count), parts)
    part = np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)
    return row, ran[row] * (part / parts[row]), ran[row] * ((part + 1) / parts[row])


def _rows(path: Path, row: Ints, since: Floats, until: Floats) -> Rows:
    start, end = path.place(row, since)[:, :2], path.place(row, until)[:, :2]
    tangent, normal = path.tangent[row, :2], path.normal[row, :2]
    across = tangent[:, 0] * normal[:, 1] - tangent[:, 1] * normal[:, 0]
    is_arc = (path.curvature[row] > 0.0) & (np.abs(across) > 1.0 - _LEVEL)
    radius = np.divide(1.0, path.curvature[row], out=np.zeros(len(row)), where=is_arc)
    center = np.where(is_arc[:, None], path.start_um[row, :2] + normal * radius[:, None], np.nan)
    sweep = np.where(is_arc, np.sign(across) * path.curvature[row] * (until - since), 0.0)
    length = np.where(is_arc, until - since, np.hypot(*(end - start).T))
    none = np.zeros(len(row), dtype=np.int64)
    return Rows(start, end, center, sweep, length, np.zeros(len(row)), none, none)


def _motions(plan: Plan, until_s: float, done_s: Floats, share: Floats) -> Motions:
    """Phases of a plan up to a time, cut where pieces with another share begin; times from the start of the plan."""
    last = min(until_s, plan.duration_s)
    borders = np.concatenate([[0.0, last], plan.time_s, done_s])
    borders = np.unique(borders[(borders >= 0.0) & (borders <= last)])
    begin, end = borders[:-1], borders[1:]
    middle = 0.5 * (begin + end)
    phase = np.clip(np.searchsorted(plan.time_s, middle, side="right") - 1, 0, len(plan.speed_um_s) - 1)
    of = share[np.minimum(np.searchsorted(done_s, middle, side="left"), len(share) - 1)]
    dt = begin - plan.time_s[phase]
    speed, acceleration, jerk = plan.speed_um_s[phase], plan.acceleration_um_s2[phase], plan.jerk_um_s3[phase]
    way = np.diff(plan.at(borders).along_um)
    return Motions(
        begin,
        end,
        way * of,
        np.maximum(speed + dt * (acceleration + dt * jerk / 2.0), 0.0) * of,
        (acceleration + dt * jerk) * of,
        jerk * of,
    )
