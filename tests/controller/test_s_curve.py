"""Plans under a jerk limit: the same stretches as ruckig runs them, and constant acceleration where jerk is free."""

import itertools
import math

import numpy as np
import pytest
from lawful import assert_inverse, assert_plan_is_lawful
from random_motion import random_rows

from controller.motion.plan import plan_of
from controller.motion.planner import RowLimits, merged, plan_rows
from controller.motion.s_curve import Phases, Stretches, border_speeds, ramp_lengths, s_curves, times_of_lengths
from parser.geometry.curves import Floats

MM = 1e-3


def one_row(length: float, speed: float, a: float, first: float = 0.0, last: float = 0.0) -> RowLimits:
    row = (np.array([value]) for value in (length, speed, a))
    return RowLimits(*row, np.array([first, last]), np.zeros(2))


def ruckig_time(limits: RowLimits, jerk: float) -> float:
    """Time of the fastest motion from state to state over one row.

    ruckig's tolerances are absolute: asked in µm it fails on some rows, in mm on none (0.19.4).
    """
    length, speed, a, (first, last), _ = ((column * MM).tolist() for column in limits)
    ruckig = pytest.importorskip("ruckig", reason="ruckig has no wheel for this machine")
    state = ruckig.InputParameter(1)
    state.current_position, state.current_velocity, state.current_acceleration = [0.0], [first], [0.0]
    state.target_position, state.target_velocity, state.target_acceleration = length, [last], [0.0]
    state.max_velocity, state.max_acceleration, state.max_jerk = speed, a, [jerk * MM]
    trajectory = ruckig.Trajectory(1)
    assert ruckig.Ruckig(1).calculate(state, trajectory) == ruckig.Result.Working
    return float(trajectory.duration)


def random_stretches(rng: np.random.Generator, n: int, jerk: float) -> tuple[Stretches, Floats]:
    """Stretches of all shapes, long and short for their ramps, and border speeds that they can be run with."""
    speed, a = 10.0 ** rng.uniform(0, 3, n), 10.0 ** rng.uniform(1, 4, n)
    stretches = Stretches(10.0 ** rng.uniform(-1, 4, n), speed, a)
    limit = np.append(speed, speed[-1:])
    np.minimum(limit[1:], speed, out=limit[1:])
    return stretches, border_speeds(stretches, limit * rng.choice([0.0, 0.3, 1.0], n + 1), jerk)


@pytest.mark.parametrize("jerk", [1e2, 1e4, 1e6])
def test_each_stretch_takes_the_time_that_ruckig_finds(jerk: float) -> None:
    stretches, borders = random_stretches(np.random.default_rng(1), 3000, jerk)
    times = s_curves(stretches, borders, jerk).time_s.sum(axis=1)
    for row, time in enumerate(times):
        length, speed, a = (float(column[row]) for column in stretches)
        # ruckig takes no state that its last bits put out of reach: borders a little slower, by 1e-10.
        first, last = borders[row : row + 2] * (1.0 - 1e-10)
        assert time == pytest.approx(ruckig_time(one_row(length, speed, a, first, last), jerk), rel=1e-9)


@pytest.mark.alike(1)
@pytest.mark.parametrize("jerk", [1e2, 1e4, 1e6, 1e9])
def test_every_plan_under_a_jerk_limit_is_lawful(jerk: float) -> None:
    for seed in range(250):
        limits = random_rows(np.random.default_rng(seed))
        assert_plan_is_lawful(plan_rows(limits, jerk_um_s3=jerk), limits, jerk_um_s3=jerk)


def test_no_border_could_be_faster() -> None:
    for seed in range(60):
        rng = np.random.default_rng(seed)
        stretches, _ = random_stretches(rng, 30, 1e4)
        limit = rng.choice([0.0, 30.0, 1e3], 31)
        speeds = border_speeds(stretches, limit, 1e4)
        for border in np.flatnonzero(speeds < limit):
            faster = speeds.copy()
            faster[border] *= 1.0 + 1e-9
            lengths = ramp_lengths(faster[:-1], faster[1:], stretches.acceleration_um_s2, 1e4)
            assert (lengths > stretches.length_um)[max(border - 1, 0) : border + 1].any()


@pytest.mark.deeper
def test_without_a_jerk_to_speak_of_the_plan_is_that_of_constant_acceleration() -> None:
    for seed in range(100):
        limits = random_rows(np.random.default_rng(seed), most=30)
        if not limits.length_um.any():
            continue
        constant = plan_rows(limits).duration_s
        losses = [plan_rows(limits, jerk_um_s3=10.0**power).duration_s / constant - 1.0 for power in (12, 15, 18)]
        assert np.diff(losses).max() <= 1e-12
        assert losses[-1] == pytest.approx(0.0, abs=1e-6)


def test_seven_phases_take_the_time_of_the_closed_form() -> None:
    plan = plan_rows(one_row(1000.0, 50.0, 1000.0), jerk_um_s3=1e5)
    # The ramp takes v/a + a/j = 0.06 s, of which half is lost against full speed, twice.
    assert plan.duration_s == pytest.approx(1000.0 / 50.0 + 0.06, rel=1e-12)
    assert len(plan.speed_um_s) == 7
    assert plan.at(0.005) == pytest.approx((1e5 * 0.005**3 / 6, 1e5 * 0.005**2 / 2, 500.0), rel=1e-9)


def test_four_phases_where_the_acceleration_is_not_reached() -> None:
    plan = plan_rows(one_row(2.0, 1e6, 1e6), jerk_um_s3=1e3)
    # Half the length is a ramp of two equal phases of t: j t³ = L / 2.
    assert plan.duration_s == pytest.approx(4.0 * (2.0 / 2.0 / 1e3) ** (1.0 / 3.0), rel=1e-12)


def test_a_start_too_fast_is_braked_by_an_s_curve_where_there_is_room() -> None:
    limits = one_row(1000.0, 50.0, 1000.0, last=50.0)
    plan = plan_rows(limits, 90.0, jerk_um_s3=1e5)
    # Down by 40 in 40/1000 + 1000/1e5 s, at 70 in the mean.
    assert plan.duration_s == pytest.approx(0.05 + (1000.0 - 70.0 * 0.05) / 50.0, rel=1e-9)
    assert np.abs(plan.jerk_um_s3).max() == 1e5
    assert plan.at(0.0)[1:] == (90.0, 0.0)


def test_a_start_too_fast_for_that_is_braked_at_constant_acceleration() -> None:
    limits = one_row(1.0, 100.0, 1000.0)
    plan = plan_rows(limits, 40.0, jerk_um_s3=1e4)
    assert plan.duration_s == pytest.approx(2.0 * 1.0 / 40.0, rel=1e-12)
    assert plan.acceleration_um_s2.tolist() == pytest.approx([-(40.0**2) / 2.0])
    beyond = plan_rows(limits, 60.0, jerk_um_s3=1e4)
    assert beyond.at(beyond.duration_s).speed_um_s == pytest.approx(math.sqrt(60.0**2 - 2000.0), rel=1e-12)


def test_every_start_speed_gives_a_plan_that_runs_the_whole_path() -> None:
    for seed in range(150):
        rng = np.random.default_rng(seed)
        limits = random_rows(rng)
        if not limits.length_um.any():
            continue
        start = 10.0 ** rng.uniform(-2, 5)
        plan = plan_rows(limits, start, jerk_um_s3=1e5)
        assert plan.along_um[-1] == pytest.approx(limits.length_um.sum(), rel=1e-12)
        assert plan.speed_um_s[np.flatnonzero(plan.speed_um_s)[0]] == start
        assert_inverse(plan)


def test_rows_that_nothing_parts_are_one_stretch() -> None:
    limits = RowLimits(
        np.array([5.0, 0.0, 7.0, 3.0, 2.0]),
        np.array([50.0, 20.0, 50.0, 50.0 * (1.0 + 1e-12), 40.0]),
        np.full(5, 1e3),
        np.array([0.0, math.inf, 60.0, 51.0, 50.0, 0.0]),
        np.zeros(6),
    )
    parted = merged(limits)
    assert parted.length_um.tolist() == [5.0, 10.0, 2.0]
    assert parted.border_um_s.tolist() == [0.0, 20.0, 50.0, 0.0]
    assert merged(limits._replace(border_um_s=np.full(6, 9.0))).length_um.tolist() == [5.0, 7.0, 3.0, 2.0]


def test_times_under_jerk_are_those_of_a_bisection() -> None:
    limits = one_row(100.0, 50.0, 1000.0)
    plan = plan_rows(limits, jerk_um_s3=2e4)
    along = np.linspace(0.0, 100.0, 500)[1:-1]
    low, high = np.zeros(498), np.full(498, plan.duration_s)
    for _ in range(70):
        middle = (low + high) / 2.0
        short = plan.at(middle).along_um < along
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    assert plan.time_at(along) == pytest.approx(high, rel=1e-12, abs=1e-12)
    assert plan.speed_at(along) == pytest.approx(plan.at(high).speed_um_s, rel=1e-9)


def test_the_inverse_of_a_phase_is_exact_over_twenty_decades() -> None:
    sizes = [0.0, *10.0 ** np.linspace(-8.0, 8.0, 17)]
    t = 10.0 ** np.linspace(-20, 0, 201)
    for v, a, j in itertools.product(sizes, sizes, (1.0, -1.0)):
        if j < 0.0 and a < 1.0:
            continue
        phases = Phases(*(np.full(201, value) for value in (v + a / 2.0 + j / 6.0, 1.0, v, a, j)))
        s = t * (v + t * (a / 2.0 + t * j / 6.0))
        assert (np.abs(times_of_lengths(phases, s) - t) <= 1e-12 * t).all()


def test_a_plan_of_s_curves_is_continuous_in_acceleration() -> None:
    stretches, borders = random_stretches(np.random.default_rng(3), 200, 1e4)
    plan = plan_of(s_curves(stretches, borders, 1e4), np.zeros(201))
    after = plan.acceleration_um_s2 + plan.jerk_um_s3 * np.diff(plan.time_s)
    assert after[:-1] == pytest.approx(plan.acceleration_um_s2[1:], rel=1e-9, abs=1e-4)


@pytest.mark.parametrize(
    ("a", "rows"), [((100.0, 71.0), 1), ((71.0, 100.0), 1), ((100.0, 69.0), 2), ((69.0, 100.0), 2)]
)
def test_accelerations_are_near_by_their_share_of_the_larger(a: tuple[float, float], rows: int) -> None:
    limits = RowLimits(np.array([5.0, 7.0]), np.full(2, 9.0), np.array(a), np.array([0.0, 9.0, 0.0]), np.zeros(3))
    joined = merged(limits, 0.3)
    assert len(joined.length_um) == rows
    assert joined.acceleration_um_s2.min() == min(a)
