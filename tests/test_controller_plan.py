"""The plan: rest to rest over each run at the machine's feed and acceleration, and its inverse."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from controller.plan import Feeds, Plan, plan_runs, run_starts
from parser.program import parse_program

FEEDS = Feeds(cut_um_s=50.0, jump_um_s=400.0, acceleration_um_s2=1000.0)


def plan_of(text: str, feeds: Feeds = FEEDS) -> Plan:
    return plan_runs(parse_program(text).toolpath, feeds)


def assert_lawful(plan: Plan, acceleration: float, fastest: float) -> None:
    """Phases join in speed, start and end at rest, and keep the limits."""
    dt, ds = np.diff(plan.time_s), np.diff(plan.along_um)
    end_speed = plan.speed_um_s + plan.acceleration_um_s2 * dt
    rounding = 1e-9 * fastest + 1e-15 * plan.duration_s * acceleration  # of speeds got back from summed times
    assert ds == pytest.approx((plan.speed_um_s + end_speed) / 2 * dt, rel=1e-9, abs=1e-9)
    assert end_speed[:-1] == pytest.approx(plan.speed_um_s[1:], abs=rounding)
    assert plan.speed_um_s[0] == 0.0
    assert end_speed[-1] == pytest.approx(0.0, abs=rounding)
    assert np.abs(plan.acceleration_um_s2).max() <= acceleration
    assert plan.speed_um_s.max() <= fastest
    assert end_speed.max() <= fastest + rounding


def test_trapezoid_time_is_that_of_the_closed_form() -> None:
    plan = plan_of("B1000B0B1000GXL1")
    assert plan.duration_s == pytest.approx(1000 / 50 + 50 / 1000, rel=1e-12)  # s = v t + the ramps' loss v / a


def test_triangle_time_is_that_of_the_closed_form() -> None:
    plan = plan_of("B2B0B2GXL1")
    assert plan.duration_s == pytest.approx(2 * (2 / 1000) ** 0.5, rel=1e-12)
    assert plan.speed_um_s.max() < FEEDS.cut_um_s


def test_blocks_of_one_run_are_passed_without_stopping() -> None:
    one = plan_of("B1000B0B1000GXL1")
    assert plan_of("B400B0B400GXL1 B600B0B600GXL1").duration_s == pytest.approx(one.duration_s, rel=1e-12)


def test_runs_end_at_pauses_and_jumps() -> None:
    toolpath = parse_program("B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B9B0B9GXL1 D B5B0B5GXL1B5B0B20GYNR1 DD").toolpath
    assert run_starts(toolpath).tolist() == [0, 3, 4]
    plan = plan_runs(toolpath, FEEDS)
    assert_lawful(plan, FEEDS.acceleration_um_s2, FEEDS.jump_um_s)
    assert len(plan.speed_um_s) == 9


def test_a_program_without_motion_takes_no_time() -> None:
    assert plan_of("B5B5B0GXL1").duration_s == 0.0


@given(
    st.lists(st.integers(1, 10**6), min_size=1, max_size=8),
    st.floats(1.0, 1e5),
    st.floats(1.0, 1e7),
)
def test_every_plan_is_lawful_and_its_inverse_exact(lengths: list[int], feed: float, acceleration: float) -> None:
    text = " D ".join(f"B{length}B0B{length}GXL1" for length in lengths)
    plan = plan_of(text, Feeds(feed, feed, acceleration))
    assert_lawful(plan, acceleration, feed)
    along = np.linspace(0.0, sum(lengths), 500)
    time = plan.time_at(along)
    assert np.diff(time).min() >= 0.0
    phase = np.clip(np.searchsorted(plan.along_um, along, side="right") - 1, 0, len(plan.speed_um_s) - 1)
    dt = time - plan.time_s[phase]
    back = plan.along_um[phase] + plan.speed_um_s[phase] * dt + plan.acceleration_um_s2[phase] * dt**2 / 2
    assert back == pytest.approx(along, rel=1e-9, abs=1e-6)  # µm


def test_speed_along_the_path() -> None:
    plan = plan_of("B1000B0B1000GXL1")
    assert plan.speed_at(np.array([0.0, 0.2, 500.0, 1000.0])) == pytest.approx([0.0, 20.0, 50.0, 0.0], abs=1e-4)
