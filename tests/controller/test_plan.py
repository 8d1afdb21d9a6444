"""Plans of toolpaths: every limit of the machine, the feed and the path's form is kept, and the rule of junctions."""

import math
from dataclasses import replace

import numpy as np
import pytest
from lawful import assert_axes_are_lawful, assert_plan_is_lawful
from paths import Pen
from plans import plan_toolpath
from random_motion import random_feeds, random_limits, random_toolpath

from controller.motion.limits import (
    CornerTime,
    Feeds,
    Junction,
    JunctionDeviation,
    MotionLimits,
    SlowAt,
    StopEach,
    Through,
    path_of,
    row_limits,
    run_starts,
)
from controller.motion.plan import EMPTY_PLAN, Plan
from parser.geometry.curves import Floats
from parser.program import parse_program
from parser.toolpath import Toolpath

FEEDS = Feeds(cut_um_s=50.0, jump_um_s=400.0)
LIMITS = MotionLimits(acceleration_um_s2=1000.0)
SQUARE = Pen().to(100.0, 0.0).to(100.0, 100.0).to(0.0, 100.0).to(0.0, 0.0).path()


def plan(toolpath: Toolpath, feeds: Feeds = FEEDS, limits: MotionLimits = LIMITS) -> Plan:
    """The toolpath's plan, proved lawful."""
    made = plan_toolpath(toolpath, feeds, limits)
    assert_plan_is_lawful(made, row_limits(toolpath, feeds, limits), jerk_um_s3=limits.jerk_um_s3)
    assert_axes_are_lawful(path_of(toolpath), made, limits)
    return made


def plan_of(text: str) -> Plan:
    return plan(parse_program(text).toolpath)


def speeds_at(made: Plan, *along: float) -> Floats:
    return made.speed_at(np.array(along))


def test_trapezoid_time_is_that_of_the_closed_form() -> None:
    made = plan_of("B1000B0B1000GXL1")
    assert made.duration_s == pytest.approx(1000 / 50 + 50 / 1000, rel=1e-12)  # s = v t + the ramps' loss v / a


def test_triangle_time_is_that_of_the_closed_form() -> None:
    made = plan_of("B2B0B2GXL1")
    assert made.duration_s == pytest.approx(2 * (2 / 1000) ** 0.5, rel=1e-12)
    assert made.speed_um_s.max() < FEEDS.cut_um_s


def test_blocks_of_one_run_are_passed_without_stopping() -> None:
    one = plan_of("B1000B0B1000GXL1")
    assert plan_of("B400B0B400GXL1 B600B0B600GXL1").duration_s == pytest.approx(one.duration_s, rel=1e-12)


def test_runs_end_at_pauses_and_jumps() -> None:
    toolpath = parse_program("B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B9B0B9GXL1 D B5B0B5GXL1B5B0B20GYNR1 DD").toolpath
    assert run_starts(toolpath).tolist() == [0, 3, 4]
    made = plan(toolpath)
    before = path_of(toolpath).before_um
    assert speeds_at(made, *before[[0, 3, 4, -1]]) == pytest.approx([0.0] * 4, abs=1e-4)
    assert speeds_at(made, before[1])[0] > 1.0


def test_jumps_run_at_their_own_feed() -> None:
    made = plan(Pen().to(100.0, 0.0).jump(1000.0, 0.0).to(1100.0, 0.0).path())
    assert speeds_at(made, 50.0, 550.0, 1050.0) == pytest.approx([50.0, 400.0, 50.0])
    assert speeds_at(made, 100.0, 1000.0) == pytest.approx([0.0, 0.0], abs=1e-4)


def test_a_program_without_motion_takes_no_time() -> None:
    assert plan_of("B5B5B0GXL1").duration_s == 0.0


@pytest.mark.alike(1)
@pytest.mark.parametrize("jerk", [math.inf, 1e5])
@pytest.mark.parametrize("seed", range(0, 600, 200))
def test_every_plan_of_a_toolpath_is_lawful_on_each_axis(seed: int, jerk: float) -> None:
    for each in range(seed, seed + 200):
        rng = np.random.default_rng(each)
        plan(random_toolpath(rng), random_feeds(rng), random_limits(rng, jerk))


def reversed_path(toolpath: Toolpath) -> Toolpath:
    """The same rows run from the last end to the first start."""
    return replace(
        toolpath,
        kind=toolpath.kind[::-1],
        start_um=toolpath.end_um[::-1],
        end_um=toolpath.start_um[::-1],
        center_um=toolpath.center_um[::-1],
        radius_um=toolpath.radius_um[::-1],
        start_angle_rad=toolpath.end_angle_rad[::-1],
        sweep_rad=-toolpath.sweep_rad[::-1],
        length_um=toolpath.length_um[::-1],
    )


def scaled_path(toolpath: Toolpath, by: float) -> Toolpath:
    columns = ("start_um", "end_um", "center_um", "radius_um", "length_um")
    return replace(toolpath, **{column: getattr(toolpath, column) * by for column in columns})


def scaled_rule(rule: Junction, length: float, time: float) -> Junction:
    match rule:
        case SlowAt(speed_um_s=speed):
            return SlowAt(speed * length / time)
        case JunctionDeviation(deviation_um=deviation):
            return JunctionDeviation(deviation * length)
        case CornerTime(time_s=within, acceleration_um_s2=a):
            return CornerTime(within * time, a * length / time**2)
    return rule


def scaled_limits(limits: MotionLimits, length: float, time: float) -> MotionLimits:
    """The same limits in units of which the old ones are `length` µm and `time` s."""
    speed, a = length / time, length / time**2
    return MotionLimits(
        acceleration_um_s2=limits.acceleration_um_s2 * a,
        axis_speed_um_s=tuple(axis * speed for axis in limits.axis_speed_um_s),
        axis_acceleration_um_s2=tuple(axis * a for axis in limits.axis_acceleration_um_s2),
        start_speed_um_s=limits.start_speed_um_s * speed,
        junction=scaled_rule(limits.junction, length, time),
        corner_wait_s=limits.corner_wait_s * time,
        jerk_um_s3=limits.jerk_um_s3 * a / time,
    )


@pytest.mark.alike(1)
@pytest.mark.parametrize("jerk", [math.inf, 1e5])
def test_a_path_run_backwards_takes_the_same_time(jerk: float) -> None:
    for seed in range(60):
        rng = np.random.default_rng(seed)
        toolpath, feeds, limits = random_toolpath(rng), random_feeds(rng), random_limits(rng, jerk)
        there, back = (plan_toolpath(path, feeds, limits) for path in (toolpath, reversed_path(toolpath)))
        assert back.duration_s == pytest.approx(there.duration_s, rel=1e-7)  # a smooth joint is one to 1e-8 rad


@pytest.mark.alike(2)
@pytest.mark.parametrize("jerk", [math.inf, 1e5])
@pytest.mark.parametrize(("length", "time"), [(8.0, 1.0), (1.0, 4.0), (0.25, 0.5)])
def test_time_scales_as_the_units_say(length: float, time: float, jerk: float) -> None:
    for seed in range(30):
        rng = np.random.default_rng(seed)
        toolpath, feeds, limits = random_toolpath(rng), random_feeds(rng), random_limits(rng, jerk)
        other = plan_toolpath(
            scaled_path(toolpath, length),
            Feeds(*(feed * length / time for feed in feeds)),
            scaled_limits(limits, length, time),
        )
        assert other.duration_s == pytest.approx(time * plan_toolpath(toolpath, feeds, limits).duration_s, rel=1e-9)


def test_full_speed_through_is_the_fastest_rule() -> None:
    through = plan(SQUARE).duration_s
    for rule in (SlowAt(3.0), JunctionDeviation(1.0), CornerTime(0.01, 1000.0), StopEach()):
        assert plan(SQUARE, limits=LIMITS._replace(junction=rule)).duration_s > through
    assert LIMITS.junction == Through()


def test_speed_along_the_path() -> None:
    made = plan_of("B1000B0B1000GXL1")
    assert speeds_at(made, 0.0, 0.2, 500.0, 1000.0) == pytest.approx([0.0, 20.0, 50.0, 0.0], abs=1e-4)


def test_an_axis_limits_lines_by_its_share_in_them() -> None:
    limits = LIMITS._replace(axis_speed_um_s=(30.0, math.inf), axis_acceleration_um_s2=(math.inf, 80.0))
    rows = row_limits(Pen().to(30.0, 40.0).to(30.0, 90.0).to(90.0, 90.0).path(), FEEDS, limits)
    assert rows.speed_um_s.tolist() == pytest.approx([50.0, 50.0, 30.0])
    assert rows.acceleration_um_s2.tolist() == pytest.approx([100.0, 80.0, 1000.0])


def test_an_axis_limits_an_arc_by_its_largest_share_within_the_sweep() -> None:
    limits = LIMITS._replace(axis_speed_um_s=(30.0, 40.0))
    feeds = Feeds(1e3, 1e3)

    def cap(start: float, sweep: float) -> float:
        at = 1e6 * math.cos(start), 1e6 * math.sin(start)
        return float(row_limits(Pen(*at).arc(0.0, 0.0, sweep).path(), feeds, limits).speed_um_s[0])

    # The direction at angle φ is (−sin φ, cos φ).
    assert cap(0.0, 0.3) == pytest.approx(40.0)
    assert cap(0.2, 0.2) == pytest.approx(40.0 / math.cos(0.2))
    assert cap(0.2, -0.2) == pytest.approx(40.0)
    assert cap(1.5, 0.2) == pytest.approx(30.0)
    assert cap(1.2, 0.2) == pytest.approx(30.0 / math.sin(1.4))
    assert cap(1.2, -0.8) == pytest.approx(30.0 / math.sin(1.2))
    assert cap(2.5, 5.0) == pytest.approx(30.0)


def test_an_arc_leaves_half_of_the_acceleration_for_speed() -> None:
    circle = Pen(100.0, 0.0).arc(0.0, 0.0, 2.0 * math.pi).path()
    rows = row_limits(circle, Feeds(1e6, 1e6), LIMITS)
    assert rows.speed_um_s[0] ** 2 / 100.0 == pytest.approx(1000.0 * math.sqrt(0.75))
    assert rows.acceleration_um_s2[0] == pytest.approx(500.0)
    slow = row_limits(circle, Feeds(1.0, 1.0), LIMITS)
    assert slow.acceleration_um_s2[0] == pytest.approx(1000.0, rel=1e-4)


def test_no_corner_is_passed_more_slowly_than_the_start_speed() -> None:
    for rule in (SlowAt(2.0), StopEach(), JunctionDeviation(1e-6)):
        rows = row_limits(SQUARE, FEEDS, LIMITS._replace(start_speed_um_s=5.0, junction=rule))
        assert rows.border_um_s == pytest.approx([5.0] * 5)


def test_corners_are_waited_at_and_smooth_borders_are_not() -> None:
    toolpath = Pen().to(100.0, 0.0).arc(100.0, 50.0, math.pi).to(50.0, 100.0).to(0.0, 100.0).to(0.0, 50.0).path()
    waiting = LIMITS._replace(corner_wait_s=0.5)
    assert row_limits(toolpath, FEEDS, waiting).wait_s.tolist() == [0.0, 0.0, 0.0, 0.0, 0.5, 0.0]
    stopping = [
        plan(part).duration_s for part in (Pen().to(0.0, 200.0 + 50.0 * math.pi).path(), Pen().to(0, 50).path())
    ]
    assert plan(toolpath, limits=waiting).duration_s == pytest.approx(sum(stopping) + 0.5, rel=1e-9)


def test_stop_at_each_block_takes_the_time_of_each_alone() -> None:
    side = plan(Pen().to(100.0, 0.0).path()).duration_s
    stopped = plan(SQUARE, limits=LIMITS._replace(junction=StopEach()))
    assert stopped.duration_s == pytest.approx(4.0 * side, rel=1e-12)


@pytest.mark.parametrize("rule", [SlowAt(3.0), JunctionDeviation(1.0)])
@pytest.mark.parametrize("jerk", [math.inf, 1e5])
def test_a_collinear_point_changes_nothing(rule: Junction, jerk: float) -> None:
    limits = LIMITS._replace(junction=rule, jerk_um_s3=jerk, axis_speed_um_s=(37.0, 41.0))
    whole = Pen(0.1, 0.3).to(70.3, 50.1).to(10.7, 200.9).path()
    cut = Pen(0.1, 0.3)
    for share in (0.1, 0.25, 0.7, 1.0):
        cut.to(0.1 + share * 70.2, 0.3 + share * 49.8)
    first, second = plan(whole, limits=limits), plan(cut.to(10.7, 200.9).path(), limits=limits)
    assert second.duration_s == pytest.approx(first.duration_s, rel=1e-9)
    t = np.linspace(0.0, first.duration_s, 200)
    assert second.at(t).along_um == pytest.approx(first.at(t).along_um, abs=1e-6)


def test_before_the_plan_it_stands_at_its_start_and_after_it_at_its_end() -> None:
    made = plan_of("B100B0B100GXL1")
    assert made.at(-1.0) == (0.0, 0.0, 1000.0)
    assert made.at(1e6)[:2] == (pytest.approx(100.0), 0.0)
    assert made.at(np.array([])).along_um.tolist() == []
    assert EMPTY_PLAN.at(3.0) == (0.0, 0.0, 0.0)


def test_columns_that_do_not_fit_are_told() -> None:
    with pytest.raises(ValueError, match="3 lengths and 2 times"):
        Plan(np.zeros(3), np.zeros(2), np.zeros(1), np.zeros(1), np.zeros(1))
