"""The planner: every plan lawful and the fastest there is, on random rows of any scale."""

import math
import warnings

import numpy as np
import pytest
from depth import cases
from hypothesis import given
from hypothesis import strategies as st
from lawful import assert_inverse, assert_plan_is_lawful
from plain_planner import plain_border_speeds, plain_duration
from random_motion import random_rows

from controller.motion.planner import RowLimits, border_speeds_sq, plan_rows, reachable
from parser.geometry.curves import Floats


def rows(length: list[float], speed: float = 50.0, a: float = 1000.0, border: list[float] | None = None) -> RowLimits:
    """Rows of one speed and acceleration, at rest at both ends, or with these highest border speeds."""
    n = len(length)
    borders = [0.0, *[math.inf] * (n - 1), 0.0] if border is None else border
    return RowLimits(np.array(length), np.full(n, speed), np.full(n, a), np.array(borders), np.zeros(n + 1))


def scaled(limits: RowLimits, length: float, time: float) -> RowLimits:
    """The same rows with lengths times `length` and times times `time`."""
    speed = length / time
    units = (length, speed, speed / time, speed, time)
    return RowLimits._make(column * unit for column, unit in zip(limits, units, strict=True))


def reversed_rows(limits: RowLimits) -> RowLimits:
    return RowLimits._make(column[::-1] for column in limits)


def split(limits: RowLimits, row: int, share: float) -> RowLimits:
    """The same rows with a point put into one of them."""
    length = np.repeat(limits.length_um, np.where(np.arange(len(limits.length_um)) == row, 2, 1))
    length[row : row + 2] *= share, 1.0 - share
    return RowLimits(
        length,
        np.insert(limits.speed_um_s, row, limits.speed_um_s[row]),
        np.insert(limits.acceleration_um_s2, row, limits.acceleration_um_s2[row]),
        np.insert(limits.border_um_s, row + 1, math.inf),
        np.insert(limits.wait_s, row + 1, 0.0),
    )


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(0, 3000, 300))
def test_every_plan_is_lawful_and_takes_the_least_time(seed: int) -> None:
    for each in range(seed, seed + len(cases(30, 300))):
        limits = random_rows(np.random.default_rng(each))
        assert_plan_is_lawful(plan_rows(limits), limits)


SIZES = st.sampled_from([0.0, 1e-6, 1e-3, 0.05, 1.0, 2.5, 100.0, 1e5])
SPEEDS = st.sampled_from([1e-3, 5.0, 50.0, 50.000001, 1e6])
ROWS = st.lists(
    st.tuples(SIZES, SPEEDS, st.sampled_from([1.0, 1e3, 1e9]), SPEEDS | st.just(0.0)), min_size=1, max_size=6
)


@given(ROWS, st.sampled_from([math.inf, 10.0, 1e4, 1e12]))
def test_rows_of_awkward_numbers_are_planned_lawfully(of: list[tuple[float, ...]], jerk: float) -> None:
    length, speed, a, border = map(np.array, zip(*of, strict=True))
    limits = RowLimits(length, speed, a, np.append(border, 0.0), np.zeros(len(of) + 1))
    assert_plan_is_lawful(plan_rows(limits, jerk_um_s3=jerk), limits, jerk_um_s3=jerk)


def test_every_plan_from_a_speed_that_can_be_obeyed_is_lawful() -> None:
    for seed in range(300):
        rng = np.random.default_rng(seed)
        limits = random_rows(rng)
        start = float(np.sqrt(border_speeds_sq(limits)[0]) * rng.uniform(0.0, 1.0))
        assert_plan_is_lawful(plan_rows(limits, start), limits, from_um_s=start)


def test_border_speeds_are_those_of_the_plain_planner() -> None:
    for seed in range(500):
        limits = random_rows(np.random.default_rng(seed), most=200)
        speeds = np.sqrt(border_speeds_sq(limits))
        assert speeds == pytest.approx(plain_border_speeds(limits), rel=1e-9, abs=1e-9)


def test_look_ahead_is_the_least_over_all_distances() -> None:
    rng = np.random.default_rng(5)
    for n in range(1, 40):
        limit, room = rng.uniform(0.0, 100.0, n + 1), rng.choice([0.0, 1.0, 20.0], n)
        reach = np.concatenate([[0.0], np.cumsum(room)])
        least = (limit[None, :] + np.abs(reach[None, :] - reach[:, None])).min(axis=1)
        assert reachable(limit, room) == pytest.approx(least, rel=1e-12, abs=1e-12)


def test_a_start_too_fast_is_braked_until_it_fits() -> None:
    limits = rows([1000.0])
    plan = plan_rows(limits, 90.0)
    # Down to the cap in (90 − 50) / 1000 s over 2.8 µm, along at it, and down to rest in 0.05 s over 1.25 µm.
    assert plan.duration_s == pytest.approx(0.04 + (1000.0 - 2.8 - 1.25) / 50.0 + 0.05, rel=1e-12)
    assert plan.speed_um_s.tolist() == pytest.approx([90.0, 50.0, 50.0])


def test_a_start_that_cannot_be_braked_goes_on_past_the_end_limit() -> None:
    plan = plan_rows(rows([1.0, 1.0]), 100.0)
    end = plan.at(plan.duration_s)
    assert end.along_um == pytest.approx(2.0, rel=1e-12)
    assert end.speed_um_s == pytest.approx(math.sqrt(100.0**2 - 2.0 * 1000.0 * 2.0), rel=1e-12)
    assert_inverse(plan)


def test_trapezoid_and_triangle_take_the_time_of_the_closed_form() -> None:
    assert plan_rows(rows([1000.0])).duration_s == pytest.approx(1000 / 50 + 50 / 1000, rel=1e-12)
    assert plan_rows(rows([2.0])).duration_s == pytest.approx(2 * math.sqrt(2 / 1000), rel=1e-12)


def test_a_start_speed_is_had_at_once() -> None:
    limits = rows([1000.0], border=[20.0, 20.0])
    plan = plan_rows(limits)
    assert plan.duration_s == pytest.approx(2 * 30 / 1000 + (1000 - 2 * (50**2 - 20**2) / 2000) / 50, rel=1e-12)
    assert plan.at(0.0).speed_um_s == 20.0
    assert_plan_is_lawful(plan, limits)


def test_a_wait_stands_still_between_start_speeds() -> None:
    limits = rows([100.0, 100.0], border=[0.0, 5.0, 0.0])
    limits.wait_s[1] = 2.0
    plan = plan_rows(limits)
    assert_plan_is_lawful(plan, limits)
    arrived = plan.time_at(np.array([100.0]))[0]
    assert plan.at(arrived - 1e-9).speed_um_s == pytest.approx(5.0, abs=1e-5)
    during = plan.at(np.array([arrived + 1e-9, arrived + 1.0, arrived + 2.0 - 1e-9]))
    assert during.along_um.tolist() == pytest.approx([100.0] * 3, rel=1e-15)
    assert during.speed_um_s.tolist() == [0.0] * 3
    assert plan.at(arrived + 2.0 + 1e-9).speed_um_s == pytest.approx(5.0, abs=1e-5)


@pytest.mark.alike(1)
@pytest.mark.parametrize("jerk", [math.inf, 1e4])
def test_a_point_put_into_a_row_changes_nothing(jerk: float) -> None:
    for seed in range(120):
        rng = np.random.default_rng(seed)
        limits = random_rows(rng)
        row = int(rng.integers(len(limits.length_um)))
        whole = plan_rows(limits, jerk_um_s3=jerk)
        cut = plan_rows(split(limits, row, rng.uniform(0.0, 1.0)), jerk_um_s3=jerk)
        assert cut.duration_s == pytest.approx(whole.duration_s, rel=1e-9)
        t = np.linspace(0.0, whole.duration_s, 50)
        assert cut.at(t).along_um == pytest.approx(whole.at(t).along_um, abs=1e-8 * limits.length_um.sum())


@pytest.mark.alike(1)
@pytest.mark.parametrize("jerk", [math.inf, 1e4])
def test_rows_run_backwards_take_the_same_time(jerk: float) -> None:
    for seed in range(120):
        limits = random_rows(np.random.default_rng(seed))
        there, back = plan_rows(limits, jerk_um_s3=jerk), plan_rows(reversed_rows(limits), jerk_um_s3=jerk)
        assert back.duration_s == pytest.approx(there.duration_s, rel=1e-9)


@pytest.mark.alike(2)
@pytest.mark.parametrize("jerk", [math.inf, 1e4])
@pytest.mark.parametrize(("length", "time"), [(7.0, 1.0), (1.0, 3.0), (1e-3, 0.3)])
def test_time_scales_as_the_units_say(length: float, time: float, jerk: float) -> None:
    for seed in range(60):
        limits = random_rows(np.random.default_rng(seed))
        plan = plan_rows(limits, jerk_um_s3=jerk)
        other = plan_rows(scaled(limits, length, time), jerk_um_s3=jerk * length / time**3)
        assert other.duration_s == pytest.approx(time * plan.duration_s, rel=1e-9)


@pytest.mark.parametrize("jerk", [math.inf, 1e3, 1e7])
@pytest.mark.parametrize("length", [1e-6, 1e-3, 1.0, 1e6])
@pytest.mark.parametrize("speed", [1e-3, 1e6])
@pytest.mark.parametrize("a", [1.0, 1e9])
def test_limits_of_any_size_are_planned_without_a_warning(length: float, speed: float, a: float, jerk: float) -> None:
    pattern = [length, 0.0, length, 0.0, 0.0, length / 3.0]
    border = [0.0, 0.0, math.inf, math.inf, speed / 7.0, 0.0, 0.0]
    limits = rows(pattern, speed, a, border)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        plan = plan_rows(limits, jerk_um_s3=jerk)
    assert_plan_is_lawful(plan, limits, jerk_um_s3=jerk)


def test_rows_without_length_and_no_rows_take_no_time() -> None:
    still = rows([0.0, 0.0])
    assert plan_rows(rows([])).duration_s == 0.0
    for jerk in (math.inf, 1e3):
        plan = plan_rows(still, jerk_um_s3=jerk)
        assert plan.duration_s == 0.0
        assert plan.time_at(np.zeros(2)).tolist() == [0.0, 0.0]
        assert plan_rows(still._replace(wait_s=np.array([1.0, 2.0, 0.5])), jerk_um_s3=jerk).duration_s == 3.5


def test_a_long_ramp_over_many_rows_keeps_its_precision() -> None:
    n = 20_000
    limits = rows([0.05] * n, 1e9, 1e3)
    plan = plan_rows(limits)
    assert plan.duration_s == pytest.approx(2.0 * math.sqrt(0.05 * n / 1e3), rel=1e-12)
    assert plain_duration(limits) == pytest.approx(plan.duration_s, rel=1e-9)


def test_the_proof_finds_a_plan_that_is_not_lawful() -> None:
    limits = rows([100.0, 30.0, 100.0], border=[0.0, 40.0, 10.0, 0.0])
    for column, factor in _wrong(limits):
        wrong = limits._replace(**{column: getattr(limits, column) * factor})
        plan = plan_rows(wrong)
        with pytest.raises(AssertionError):
            assert_plan_is_lawful(plan, limits)


def _wrong(limits: RowLimits) -> list[tuple[str, Floats]]:
    """Each column, a little too high, and a little too low, which takes too long."""
    columns = ("length_um", "speed_um_s", "acceleration_um_s2", "border_um_s")
    return [(column, np.full(len(getattr(limits, column)), 1.0 + by)) for column in columns for by in (1e-6, -1e-6)]


@pytest.mark.parametrize("jerk", [math.inf, 1e6])
def test_every_wait_begins_where_its_row_ends(jerk: float) -> None:
    rng = np.random.default_rng(11)
    for n in (3, 10, 1000):
        length = 10.0 ** rng.uniform(0.0, 4.0, n)
        speed, a = 10.0 ** rng.uniform(1.0, 4.0, n), 10.0 ** rng.uniform(2.0, 5.0, n)
        limits = RowLimits(length, speed, a, np.append(speed, 0.0) * (rng.random(n + 1) < 0.7), np.zeros(n + 1))
        wait = rng.choice([0.0, 0.25], n + 1)
        border = np.where(wait > 0.0, 0.0, limits.border_um_s)
        limits = limits._replace(border_um_s=border, wait_s=wait)
        plan = plan_rows(limits, jerk_um_s3=jerk)
        before = np.concatenate([[0.0], np.cumsum(limits.length_um)])
        since = np.diff(plan.time_at(before))
        least = limits.length_um / limits.speed_um_s + wait[:-1]
        assert (since >= least * (1.0 - 1e-9)).all()  # a wait before a row counts to it, and never to the row before
        assert plan.at(plan.time_at(before)[wait > 0.0] + 0.125).speed_um_s.max(initial=0.0) == 0.0


@pytest.mark.deeper
@pytest.mark.parametrize("loosened", [1.001, 1.02, 1.2])
def test_under_a_jerk_limit_a_row_that_may_accelerate_more_makes_no_plan_slower(loosened: float) -> None:
    for seed in range(150):
        rng = np.random.default_rng(seed)
        n = int(rng.integers(2, 12))
        length, speed = rng.uniform(50.0, 3000.0, n), np.full(n, rng.choice([2000.0, 10_000.0, 50_000.0]))
        acceleration = np.full(n, rng.choice([3e4, 1e5])) if seed % 2 else rng.choice([3e4, 1e5], n)
        border = np.where(rng.random(n + 1) < 0.1, rng.uniform(0.0, 500.0, n + 1), np.inf)
        border[[0, -1]] = 0.0
        limits = RowLimits(length, speed, acceleration, border, np.zeros(n + 1))
        jerk = float(rng.choice([1e6, 1e7, 1e8]))
        more = acceleration.copy()
        more[rng.integers(n)] *= loosened
        slower = plan_rows(limits._replace(acceleration_um_s2=more), jerk_um_s3=jerk).duration_s
        assert slower <= plan_rows(limits, jerk_um_s3=jerk).duration_s * 1.001
