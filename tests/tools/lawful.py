"""What every plan has to keep, checked on the plan alone: no test of a plan goes without."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from plain_planner import plain_duration

from controller.motion.limits import MotionLimits, Path
from controller.motion.plan import Plan
from controller.motion.planner import RowLimits
from parser.geometry.curves import Floats, Ints

RELATIVE = 1e-9
EPS = 2.0**-52


class Pieces(NamedTuple):
    """Stretches of path within one phase and one row: (m,) of each, and the times of both ends since its phase."""

    phase: Ints
    row: Ints
    since_s: Floats
    until_s: Floats


def assert_plan_is_lawful(
    plan: Plan, limits: RowLimits, *, from_um_s: float | None = None, jerk_um_s3: float = math.inf
) -> None:
    """The plan moves as bodies do, keeps every limit to 1e-9, runs the whole path, and in the least time.

    A start that no limit lets pass is not for this: what it may break is for its own test.
    """
    _assert_motion_joins(plan)
    _assert_ends(plan, limits, from_um_s)
    _assert_rows_are_kept(plan, limits)
    _assert_borders_are_kept(plan, limits, from_um_s)
    _assert_waits(plan, limits)
    assert_inverse(plan)
    least = plain_duration(limits, from_um_s)
    if jerk_um_s3 == math.inf:
        assert not plan.jerk_um_s3.any()
        assert plan.duration_s == pytest.approx(least, rel=RELATIVE, abs=1e-12)
    else:
        assert np.abs(plan.jerk_um_s3).max(initial=0.0) <= jerk_um_s3 * (1.0 + RELATIVE)
        _assert_accelerations_join(plan)
        assert plan.duration_s >= least * (1.0 - RELATIVE)


def assert_axes_are_lawful(path: Path, plan: Plan, limits: MotionLimits) -> None:
    """Velocity and acceleration of each axis, and the whole acceleration vector, within the limits to 1e-9."""
    pieces = pieces_of(plan, path.before_um)
    for share in (1e-3, 0.25, 0.5, 0.75, 1.0 - 1e-3):
        dt = pieces.since_s + share * (pieces.until_s - pieces.since_s)
        s, v, a = motion(plan, pieces.phase, dt)
        s = np.clip(s - path.before_um[pieces.row], 0.0, path.length_um[pieces.row])
        tangent, bend = path.direction(pieces.row, s), path.bend(pieces.row, s)
        acceleration = a[:, None] * tangent + (v**2)[:, None] * bend
        assert (np.abs(v[:, None] * tangent) <= np.array(limits.axis_speed_um_s) * (1.0 + RELATIVE)).all()
        assert (np.abs(acceleration) <= np.array(limits.axis_acceleration_um_s2) * (1.0 + RELATIVE)).all()
        assert (np.linalg.norm(acceleration, axis=1) <= limits.acceleration_um_s2 * (1.0 + RELATIVE)).all()


def assert_inverse(plan: Plan) -> None:
    """`time_at` gives times, never falling, at which `at` tells the same lengths again."""
    t = np.sort(np.concatenate([np.linspace(0.0, plan.duration_s, 203), plan.time_s]))
    along = np.maximum.accumulate(plan.at(t).along_um)
    back = plan.time_at(along)
    assert np.diff(back).min(initial=0.0) >= -1e-12 * plan.duration_s
    # A time is known to the last bit of the whole duration, the length by as much as is run in that.
    blur = 8.0 * EPS * (plan.along_um[-1] + plan.duration_s * _fastest(plan))
    assert np.abs(plan.at(back).along_um - along).max() <= 1e-12 * plan.along_um[-1] + blur


def motion(plan: Plan, phase: Ints, dt: Floats) -> tuple[Floats, Floats, Floats]:
    """Length, speed and acceleration at times since phases' starts, by the equations of motion."""
    v, a, j = plan.speed_um_s[phase], plan.acceleration_um_s2[phase], plan.jerk_um_s3[phase]
    return plan.along_um[phase] + v * dt + a * dt**2 / 2 + j * dt**3 / 6, v + a * dt + j * dt**2 / 2, a + j * dt


def pieces_of(plan: Plan, before_um: Floats) -> Pieces:
    """The path cut at all borders of phases and rows; cuts closer than rounding are one."""
    cuts = np.unique(np.concatenate([plan.along_um, before_um]))
    low, high = cuts[:-1], cuts[1:]
    real = high - low > 64.0 * EPS * before_um[-1]
    low, high = low[real], high[real]
    middle = low + (high - low) / 2.0
    phase = np.searchsorted(plan.along_um, middle, side="right") - 1
    row = np.minimum(np.searchsorted(before_um, middle, side="right") - 1, len(before_um) - 2)
    start, takes = plan.time_s[phase], np.diff(plan.time_s)[phase]
    return Pieces(phase, row, *(np.clip(plan.time_at(cut) - start, 0.0, takes) for cut in (low, high)))


def _takes(plan: Plan) -> Floats:
    return np.diff(plan.time_s)


def _speed_blur(plan: Plan) -> float:
    """Rounding of speeds got back from summed times."""
    return (
        RELATIVE * _fastest(plan) + 8.0 * EPS * plan.duration_s * np.abs(np.append(plan.acceleration_um_s2, 0.0)).max()
    )


def _fastest(plan: Plan) -> float:
    return float(max(plan.speed_um_s.max(initial=0.0), _ends(plan)[1].max(initial=0.0)))


def _ends(plan: Plan) -> tuple[Floats, Floats, Floats]:
    return motion(plan, np.arange(len(plan.speed_um_s)), _takes(plan))


def _assert_motion_joins(plan: Plan) -> None:
    """Neither time nor path runs back, phases run their lengths, and each starts at the speed the last one left."""
    assert plan.time_s[0] == plan.along_um[0] == 0.0
    assert np.isfinite(np.concatenate([plan.time_s, plan.along_um])).all()
    assert np.diff(plan.time_s).min(initial=0.0) >= 0.0
    assert np.diff(plan.along_um).min(initial=0.0) >= 0.0
    assert plan.speed_um_s.min(initial=0.0) >= 0.0
    along, speed, _ = _ends(plan)
    blur = 16.0 * EPS * (plan.along_um[-1] + plan.duration_s * _fastest(plan))
    assert np.abs(along - plan.along_um[1:]).max(initial=0.0) <= blur
    waits = _is_wait(plan)
    joined = ~(waits[1:] | waits[:-1])
    assert np.abs(speed[:-1] - plan.speed_um_s[1:])[joined].max(initial=0.0) <= _speed_blur(plan)


def _assert_accelerations_join(plan: Plan) -> None:
    """Under a jerk limit the acceleration never jumps."""
    _, _, acceleration = _ends(plan)
    most = np.abs(np.append(plan.acceleration_um_s2, 0.0)).max()
    blur = RELATIVE * most + 8.0 * EPS * plan.duration_s * np.abs(np.append(plan.jerk_um_s3, 0.0)).max()
    assert np.abs(acceleration[:-1] - plan.acceleration_um_s2[1:]).max(initial=0.0) <= blur
    assert np.abs(np.append(plan.acceleration_um_s2, 0.0)[0]) == 0.0


def _assert_ends(plan: Plan, limits: RowLimits, from_um_s: float | None) -> None:
    assert plan.along_um[-1] == pytest.approx(limits.length_um.sum(), rel=1e-12)
    if not limits.length_um.any():
        return
    first = plan.speed_um_s[~_is_wait(plan)][0]
    if from_um_s is None:
        assert first <= limits.border_um_s[0] * (1.0 + RELATIVE)
    else:
        assert first == pytest.approx(from_um_s, rel=RELATIVE)


def _assert_rows_are_kept(plan: Plan, limits: RowLimits) -> None:
    before = _before(limits)
    pieces = pieces_of(plan, before)
    cap, most = limits.speed_um_s[pieces.row], limits.acceleration_um_s2[pieces.row]
    for dt in (pieces.since_s, pieces.until_s):
        _, v, a = motion(plan, pieces.phase, dt)
        assert (v <= cap * (1.0 + RELATIVE) + 8.0 * EPS * plan.duration_s * most).all()
        assert (np.abs(a) <= most * (1.0 + RELATIVE) + 8.0 * EPS * plan.duration_s * _jerk(plan)).all()


def _assert_borders_are_kept(plan: Plan, limits: RowLimits, from_um_s: float | None) -> None:
    """Speed² either side of each border within its limit, and what the acceleration makes of a rounded place."""
    before = _before(limits)
    allowed = limits.border_um_s.copy()
    if from_um_s is not None:
        allowed[before == 0.0] = math.inf
    pieces = pieces_of(plan, before)
    blur = 256.0 * EPS * before[-1] * limits.acceleration_um_s2.max()
    time_blur = _speed_blur(plan)
    for dt, is_end in ((pieces.since_s, 0), (pieces.until_s, 1)):
        s, v, _ = motion(plan, pieces.phase, dt)
        border = pieces.row + is_end
        here = np.abs(s - before[border]) <= 64.0 * EPS * before[-1]
        assert ((v - time_blur) ** 2 * np.sign(v - time_blur) <= allowed[border] ** 2 * (1.0 + RELATIVE) + blur)[
            here
        ].all()


def _assert_waits(plan: Plan, limits: RowLimits) -> None:
    waits = _is_wait(plan)
    assert _takes(plan)[waits].sum() == pytest.approx(
        limits.wait_s.sum(), rel=RELATIVE, abs=64.0 * EPS * plan.duration_s
    )
    at = np.unique(_before(limits)[limits.wait_s > 0.0])
    places = plan.along_um[:-1][waits]
    nearest = np.abs(places[:, None] - at[None, :]).min(axis=1, initial=math.inf)
    assert (nearest <= 64.0 * EPS * plan.along_um[-1]).all()


def _is_wait(plan: Plan) -> Floats:
    stands = (plan.speed_um_s == 0.0) & (plan.acceleration_um_s2 == 0.0) & (plan.jerk_um_s3 == 0.0)
    return stands & (np.diff(plan.along_um) == 0.0)


def _before(limits: RowLimits) -> Floats:
    return np.concatenate([[0.0], np.cumsum(limits.length_um)])


def _jerk(plan: Plan) -> float:
    return float(np.abs(np.append(plan.jerk_um_s3, 0.0)).max())
