"""Four axes along a tilted path: X and Y move the lower guide, U and V the upper one against it, all in even shares.

One plan leads them: along the longer of the two contours of each row, so that no place of the work is cut faster than
the feed. Each axis is asked for its own share of the row, and pulsed where that comes to the middle between two steps:
all axes end a row together, and none is ever more than half a step from its share.
"""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np

from controller.motion.limits import Feeds, MotionLimits, path_limits, path_of
from controller.motion.plan import Plan
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping.pulses import Pulses
from controller.taper.tilted import TiltedPath
from parser.geometry.curves import Floats, Ints, total_before

_PER_UM: Final = 2.5
"""Places looked at in each µm that an axis moves. Its highest speed in a row is known within 1 % (`_ways_um`): no axis
comes to two steps between two places."""
_AT_ONCE: Final = 1 << 18
_SAMPLES: Final = 17
_DIGITS: Final = 6


class AxisLimits(NamedTuple):
    """Highest speeds µm/s and accelerations µm/s² of X, Y, U and V; infinite where there is none."""

    speed_um_s: tuple[float, float, float, float]
    acceleration_um_s2: tuple[float, float, float, float]


class GuidePlan(NamedTuple):
    """How the guides are moved along a tilted path of m rows.

    Attributes
    ----------
    limits
        What the plan keeps to, by the rows of the path.
    plan
        Motion along the rows, each as long as the longer of its contours.
    ways_um
        (m, 4) how far X, Y, U and V would go in each row at the speed of its fastest place.
    """

    limits: RowLimits
    plan: Plan
    ways_um: Floats


def plan_guides(path: TiltedPath, feeds: Feeds, motion: MotionLimits, axes: AxisLimits, rests: Ints) -> GuidePlan:
    """The plan of a tilted path; `feeds` of cuts are for all rows or one for each, and it rests before rows `rests`."""
    ruled = path.ruled
    length = ruled.length_um
    feed = np.where(ruled.is_jump, feeds.jump_um_s, feeds.cut_um_s)
    free = motion._replace(axis_speed_um_s=(np.inf, np.inf), axis_acceleration_um_s2=(np.inf, np.inf))
    faces = [_of_face(path_limits(path_of(of), feed, rests, free), length) for of in (ruled.lower, ruled.upper)]
    speeds, accelerations, borders, waits = zip(*faces, strict=True)
    ways = _ways_um(path)
    share = ways / np.where(length > 0.0, length, 1.0)[:, None]
    limits = RowLimits(
        length,
        np.minimum.reduce([*speeds, feed, _allowed(share, axes.speed_um_s)]),
        np.minimum.reduce([*accelerations, _allowed(share, axes.acceleration_um_s2)]),
        np.minimum.reduce(borders),
        np.maximum.reduce(waits),
    )
    return GuidePlan(limits, plan_rows(limits, jerk_um_s3=motion.jerk_um_s3), ways)


def guide_pulses(path: TiltedPath, planned: GuidePlan) -> Iterator[tuple[Pulses, Pulses]]:
    """Pulses of X and Y, and of U and V, in the same stretches of time; places are whole µm.

    X and Y are the place of the lower guide, U and V that of the upper guide against it.
    """
    plan, length = planned.plan, planned.limits.length_um
    before = total_before(length)
    count = np.maximum(np.ceil(_PER_UM * planned.ways_um.max(axis=1)), 1.0).astype(np.int64)
    past = np.cumsum(count)
    at = path.axes_um(np.zeros(1, dtype=np.int64), np.zeros(1))
    for since in range(0, int(past[-1]) if len(past) else 0, _AT_ONCE):
        number = np.arange(since, min(since + _AT_ONCE, int(past[-1])))
        row = np.searchsorted(past, number, side="right")
        share = (number - past[row] + count[row] + 1) / count[row]
        place = np.concatenate([at, path.axes_um(row, share)])
        at = place[-1:]
        along = np.concatenate([[0.0], before[row] + share * length[row]])
        along[0] = along[1] - length[row[0]] / count[row[0]]
        yield _pair(place[:, :2], along, row, plan), _pair(place[:, 2:], along, row, plan)


def _of_face(limits: RowLimits, length_um: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Speed, acceleration and border speeds of a contour as those of the longer one, and its waits."""
    stands = np.where(length_um > 0.0, np.inf, 1.0)
    ratio = np.divide(length_um, limits.length_um, out=stands, where=limits.length_um > 0.0)
    around = np.fmin(np.append(ratio, np.inf), np.insert(ratio, 0, np.inf))
    around[~np.isfinite(around)] = 1.0
    return limits.speed_um_s * ratio, limits.acceleration_um_s2 * ratio, limits.border_um_s * around, limits.wait_s


def _ways_um(path: TiltedPath) -> Floats:
    """(m, 4) how far each axis would go in each row at the speed of its fastest place.

    That is the mean speed of a sixteenth of the row: of a whole turn 0.6 % less than the highest.
    """
    edges, rows = np.linspace(0.0, 1.0, _SAMPLES), len(path.ruled)
    place = path.axes_um(np.repeat(np.arange(rows), _SAMPLES), np.tile(edges, rows)).reshape(rows, _SAMPLES, 4)
    ways: Floats = np.abs(np.diff(place, axis=1)).max(axis=1, initial=0.0) * (_SAMPLES - 1)
    return ways


def _allowed(share: Floats, most: tuple[float, ...]) -> Floats:
    """(m,) what axes allow along the plan that move by `share` (m, 4) for each µm of it, in the unit of `most`."""
    of_axes = np.divide(np.broadcast_to(most, share.shape), share, out=np.full_like(share, np.inf), where=share > 0.0)
    least: Floats = of_axes.min(axis=1, initial=np.inf)
    return least


def whole_um(place_um: Floats) -> Ints:
    """Places in the whole µm at which axes stand; of two that are as near, the even one."""
    return np.rint(np.round(place_um, _DIGITS)).astype(np.int64)


def _pair(place_um: Floats, along_um: Floats, row: Ints, plan: Plan) -> Pulses:
    """Pulses of two axes whose places (k + 1, 2) are known where so much of the plan is done."""
    whole = whole_um(place_um)
    found = [_crossings(place_um[:, axis], whole[:, axis], along_um) for axis in (0, 1)]
    along = np.concatenate([of[1] for of in found])
    order = np.argsort(along, kind="stable")
    at = np.concatenate([of[0] for of in found])[order]
    is_x = order < len(found[0][0])
    step = np.concatenate([of[2] for of in found])[order]
    x = whole[0, 0] + np.cumsum(step * is_x)
    y = whole[0, 1] + np.cumsum(step * ~is_x)
    time = np.maximum.accumulate(plan.time_at(along[order])) if len(order) else np.zeros(0)
    return Pulses(time, x.astype(np.int32), y.astype(np.int32), row[at].astype(np.int32))


def _crossings(place: Floats, whole: Ints, along: Floats) -> tuple[Ints, Floats, Ints]:
    """Where an axis comes to the middle between two steps: number of the stretch, length done, and the step."""
    by = np.diff(whole)
    at = np.flatnonzero(by)
    middle = 0.5 * (whole[at] + whole[at + 1])
    way = place[at + 1] - place[at]
    share = np.clip((middle - place[at]) / np.where(way == 0.0, 1.0, way), 0.0, 1.0)
    return at, along[at] + share * (along[at + 1] - along[at]), by[at]
