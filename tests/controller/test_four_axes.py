"""X, Y, U and V along a wire that leans: even shares, one plan, limits of each axis, and the surface they make."""

import math

import numpy as np
import pytest
from depth import cases
from tilted_paths import HEIGHTS, ROUND, SQUARE, SQUARE_UP, contour, lean, random_pair, toolpath_of

from controller.motion.limits import Feeds, JunctionDeviation, MotionLimits
from controller.stepping.pulses import Pulses
from controller.taper.axes import AxisLimits, GuidePlan, guide_pulses, plan_guides
from controller.taper.shifted_contour import Corner
from controller.taper.tilted import TiltedPath, tilted, told_lean
from controller.taper.two_contours import between_contours, matched_rows
from parser.geometry.curves import Curves, Floats, Ints, curves_between, total_before

FREE = AxisLimits((math.inf,) * 4, (math.inf,) * 4)
START = np.zeros(1, dtype=np.int64)


def punch(corner: Corner, program_um: float = 10_000.0) -> TiltedPath:
    path = contour([(0.1 * x, 0.1 * y) for x, y in SQUARE])
    heights = HEIGHTS._replace(program_um=program_um)
    return tilted(path, told_lean(lean(path, -1, math.radians(3.0)), path), heights, corner)


def planned(path: TiltedPath, feed_um_s: float = 100.0, axes: AxisLimits = FREE) -> GuidePlan:
    limits = MotionLimits(1e6, junction=JunctionDeviation(5.0))
    return plan_guides(path, Feeds(feed_um_s, 1000.0), limits, axes, START)


def driven(path: TiltedPath, plan: GuidePlan) -> tuple[Pulses, Pulses]:
    pairs = list(guide_pulses(path, plan))
    return tuple(  # type: ignore[return-value]
        Pulses(*(np.concatenate(column) for column in zip(*(pair[at] for pair in pairs), strict=True))) for at in (0, 1)
    )


def shares(path: TiltedPath, plan: GuidePlan, t_s: Floats) -> tuple[Ints, Floats]:
    """Rows and shares of them at times."""
    length = plan.limits.length_um
    before, along = total_before(length), plan.plan.at(t_s).along_um
    row = np.clip(np.searchsorted(before, along, side="right") - 1, 0, len(length) - 1)
    size = length[row]
    return row, np.clip((along - before[row]) / np.where(size > 0.0, size, 1.0), 0.0, 1.0)


def places_at(pulses: Pulses, start: tuple[float, float], t_s: Floats) -> Floats:
    """Where a pair of axes was told to be at times."""
    x, y = (np.concatenate([[round(of)], column]) for of, column in zip(start, (pulses.x_um, pulses.y_um), strict=True))
    at = np.searchsorted(pulses.t_s, t_s + 1e-9, side="right")
    return np.stack([x[at], y[at]], axis=1)


@pytest.mark.parametrize("corner", ["sharp", "cone"])
def test_no_axis_is_ever_more_than_half_a_step_from_its_share(corner: Corner) -> None:
    path = punch(corner)
    plan = planned(path)
    t = np.linspace(0.0, plan.plan.duration_s, 20_011)
    row, share = shares(path, plan, t)
    low = path.ruled.places(row, share, HEIGHTS.lower_guide_um)
    high = path.ruled.places(row, share, HEIGHTS.upper_guide_um)
    for pulses, exact in zip(driven(path, plan), (low, high - low), strict=True):
        assert np.abs(places_at(pulses, tuple(exact[0]), t) - exact).max() <= 0.5 + 1e-3


def test_all_axes_end_each_block_together_where_it_ends() -> None:
    path = punch("sharp")
    plan = planned(path)
    ends = plan.plan.time_at(np.cumsum(plan.limits.length_um))
    xy, uv = driven(path, plan)
    for pulses in (xy, uv):
        assert pulses.t_s[-1] <= plan.plan.duration_s
        # The last pulse of a block that moves an axis by n steps comes half a step before its end, at most.
        at = np.searchsorted(pulses.t_s, ends[:-1], side="right")
        assert (ends[:-1] - pulses.t_s[at - 1] < 0.1).all()
    assert (xy.x_um[-1], xy.y_um[-1], uv.x_um[-1], uv.y_um[-1]) == (1000, -500, 0, 0)


@pytest.mark.deep
@pytest.mark.parametrize("seed", cases(8, 200))
def test_the_surface_of_the_steps_is_within_1_um_and_a_half(seed: int) -> None:
    toolpath, upper, _ = random_pair(seed)
    small, above = toolpath_of(_smaller(toolpath)), _smaller(upper)
    path = between_contours(small, matched_rows(small, above), HEIGHTS, (0.0, 40_000.0))
    plan = planned(path)
    t = np.linspace(0.0, plan.plan.duration_s, 5003)
    row, share = shares(path, plan, t)
    xy, uv = driven(path, plan)
    start = path.ruled.places(row[:1], share[:1], HEIGHTS.lower_guide_um)[0]
    aside = path.ruled.leans(row[:1], share[:1])[0] * 200_000.0
    low, by = places_at(xy, tuple(start), t), places_at(uv, tuple(aside), t)
    for z_um in (0.0, 10_000.0, 20_000.0, 30_000.0, 40_000.0):
        wire = low + by * (z_um - HEIGHTS.lower_guide_um) / 200_000.0
        off = wire - path.ruled.places(row, share, z_um)
        assert np.hypot(*off.T).max() <= 1.5


def _smaller(curves: Curves) -> Curves:
    """The curves at a tenth of their size."""
    return curves_between(0.1 * curves.start_um, 0.1 * curves.end_um, 0.1 * curves.center_um, curves.sweep_rad)


def test_round_on_square_closes_in_both_planes() -> None:
    path = between_contours(SQUARE_UP, matched_rows(SQUARE_UP, ROUND), HEIGHTS, (0.0, 40_000.0))
    xy, uv = driven(path, planned(path, 1000.0))
    assert (xy.x_um[-1], xy.y_um[-1], uv.x_um[-1], uv.y_um[-1]) == (0, 0, 0, 0)


@pytest.mark.parametrize("axis", range(4))
def test_the_plan_keeps_the_speed_of_each_axis(axis: int) -> None:
    path, most = punch("cone"), 20.0
    speeds = [math.inf] * 4
    speeds[axis] = most
    axes = AxisLimits((speeds[0], speeds[1], speeds[2], speeds[3]), FREE.acceleration_um_s2)
    plan = planned(path, axes=axes)
    t = np.linspace(0.0, plan.plan.duration_s, 40_001)
    row, share = shares(path, plan, t)
    low = path.ruled.places(row, share, HEIGHTS.lower_guide_um)
    four = np.concatenate([low, path.ruled.leans(row, share) * 200_000.0], axis=1)
    speed = np.abs(np.diff(four[:, axis])) / np.diff(t)
    assert speed.max() <= most * 1.02
    assert plan.plan.duration_s > planned(path).plan.duration_s


def test_a_block_without_length_is_passed_without_a_pulse() -> None:
    places = [(0.1 * x, 0.1 * y) for x, y in SQUARE]
    path = contour([*places[:3], places[2], *places[3:]])
    tilt = tilted(path, told_lean(lean(path, -1, math.radians(3.0)), path), HEIGHTS, "sharp")
    xy, uv = driven(tilt, planned(tilt))
    assert (xy.x_um[-1], xy.y_um[-1], uv.x_um[-1], uv.y_um[-1]) == (1000, -500, 0, 0)


def test_no_place_of_the_work_is_cut_faster_than_the_feed() -> None:
    path = punch("sharp")
    plan = planned(path, 100.0)
    t = np.linspace(0.0, plan.plan.duration_s, 40_001)
    row, share = shares(path, plan, t)
    for z_um in (0.0, 20_000.0, 40_000.0):
        place = path.ruled.places(row, share, z_um)
        assert (np.hypot(*np.diff(place, axis=0).T) / np.diff(t)).max() <= 100.0 * 1.001
