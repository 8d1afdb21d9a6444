"""Pulses of the card: what `on_pulses` is told, against the plan of the whole path and the place asked for."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from watched import IDLE, Watched

from controller import GECard
from controller.card.core.settings import CardSettings
from controller.card.engine import entries, stretch
from controller.card.engine.entries import ORIGIN, Pace, Stepped
from controller.card.engine.speeds import speeds_of
from controller.card.engine.stretch import Start, make_stretch
from controller.motion.limits import Path
from controller.motion.planner import RowLimits, plan_rows
from controller.stepping.chunks import chunk_of
from controller.stepping.steps import interpolate_words
from parser.controller_words import StepWords

PERIOD_S = 200e-6
BLOCK = (30, 40, 40, 1, 1, 0)


def fed(watched, push, entries, capacity, sleep_ms):
    """Run entries through the list as a program does: push until it is full, sleep, go on. The time it set off, s."""
    card, began = watched.card, None
    for entry in entries:
        while push(*entry):
            assert card.GT_GetCmdSts() == (0, 0x8000)
            if began is None:
                card.GT_StrtMtn()
                began = card.time_s
            card.sleep(sleep_ms)
    watched.until_idle(sleep_ms)
    return began


@pytest.mark.parametrize("capacity", [16, 64])
def test_blocks_through_a_list_are_timed_as_one_plan_of_all(capacity):
    rng = np.random.default_rng(20260101)
    x, y = rng.integers(1, 60, (2, 400))
    axis = (y > x).astype(np.int64)
    zero, count = np.zeros_like(x), np.maximum(x, y)
    words = StepWords(x, y, count, axis, rng.integers(1, 5, 400), zero, zero - 1, zero)
    length = np.hypot(x, y)
    watched = Watched(capacity=capacity, synvel_pulse_ms=5.0, synacc_pulse_ms2=0.1)
    card = watched.card
    card.GT_StrtList()
    columns = (column.tolist() for column in (x, y, count, axis, words.quadrant, zero, length))
    fed(watched, card.step_block, zip(*columns, strict=True), capacity, sleep_ms=15.0)
    pulses = watched.pulses()
    border = np.full(401, 5000.0)
    border[[0, -1]] = 0.0
    plan = plan_rows(RowLimits(length, np.full(400, 5000.0), np.full(400, 1e5), border, np.zeros(401)))
    steps = interpolate_words(words, length)
    whole = chunk_of(steps, 0, len(steps))
    due = plan.time_at(whole.along_um)
    np.testing.assert_array_equal(pulses.x_um, whole.x_um)
    np.testing.assert_array_equal(pulses.y_um, whole.y_um)
    np.testing.assert_array_equal(pulses.row, whole.row + 1)
    np.testing.assert_allclose(pulses.t_s - pulses.t_s[0], due - due[0], rtol=0, atol=1e-6)


def test_lines_and_arcs_through_a_list_keep_to_one_plan_of_all():
    """Each pulse stands within half a pulse of the plan's place at the end of its servo period."""
    watched = Watched(capacity=8, synvel_pulse_ms=2.0, synacc_pulse_ms2=0.05)
    card = watched.card
    card.GT_StrtList()
    ends = [(40.0 * k, 30.0 * (k % 2)) for k in range(1, 80)]
    began = fed(watched, card.GT_LnXY, ends, 8, sleep_ms=30.0)
    start = np.array([(0.0, 0.0), *ends])
    by = np.diff(start, axis=0)
    length = np.hypot(*by.T)
    n = len(ends)
    path = Path(start[:-1], by / length[:, None], np.zeros((n, 2)), np.zeros(n), length)
    border = np.full(n + 1, 2000.0)
    border[[0, -1]] = 0.0
    plan = plan_rows(RowLimits(length, np.full(n, 2000.0), np.full(n, 5e4), border, np.zeros(n + 1)))
    pulses = watched.pulses()
    tick_s = np.ceil(pulses.t_s / PERIOD_S - 1e-6) * PERIOD_S
    along = plan.at(tick_s - began).along_um
    row = np.minimum(np.searchsorted(path.before_um, along, side="right") - 1, n - 1)
    place = path.place(row, along - path.before_um[row])
    last = np.flatnonzero(np.diff(tick_s, append=np.inf) > PERIOD_S / 2)  # of each period
    away = np.stack([pulses.x_um, pulses.y_um], axis=1)[last] - place[last]
    assert np.abs(away).max() <= 0.5 + 1e-6


def test_entries_pushed_by_the_thousand_are_planned_a_few_times(monkeypatch):
    planned = []

    def counted(limits, *rest):
        planned.append(len(limits.length_um))
        return plan_rows(limits, *rest)

    monkeypatch.setattr(stretch, "plan_rows", counted)
    watched = Watched(synvel_pulse_ms=10.0)
    card = watched.card
    card.GT_StrtList()
    card.GT_StrtMtn()
    for k in range(1, 4000):
        assert card.GT_LnXY(10.0 * k, 0.0) == 0
    card.sleep(500.0)
    assert len(planned) < 20
    watched.until_idle(1000.0)
    assert watched.places() == (39990, 0, 0, 0)


def test_pulses_are_handed_on_after_each_sleep_and_question():
    watched = Watched()
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(500.0)
    slept = sum(len(pulses.t_s) for pulses in watched.collected)
    assert slept == pytest.approx(450, abs=1)
    for _ in range(100):
        watched.card.GT_GetCrdSts()
    assert watched.places()[0] == sum(len(pulses.t_s) for pulses in watched.collected) > slept


def test_pulses_come_in_bounded_pieces():
    watched = Watched(synvel_pulse_ms=50.0)
    watched.load((1e6, 0.0), vel=50.0, acc=1.0)
    watched.card.GT_StrtMtn()
    watched.until_idle(100_000.0)
    assert sum(len(pulses.t_s) for pulses in watched.collected) == 1_000_000
    assert max(len(pulses.t_s) for pulses in watched.collected) <= 1 << 18


@pytest.mark.parametrize("sleep_ms", [0.07, 3.1, 50.0, 10_000.0])
def test_how_time_is_slept_changes_no_pulse(sleep_ms):
    def run(sleep_ms):
        watched = Watched(call_s=1e-30)
        watched.card.sleep(1.0)  # from here on, a call of 1e-30 s takes no time
        watched.load((150.0, 20.0), (150.0, 60.0, 120.0), (0.0, 0.0))
        watched.card.GT_StrtMtn()
        watched.until_idle(sleep_ms, most=100_000)
        return watched.pulses()

    once, often = run(1e6), run(sleep_ms)
    for a, b in zip(once, often, strict=True):
        np.testing.assert_array_equal(a, b)


def test_only_the_first_card_tells_its_pulses():
    collected = []
    card = GECard(CardSettings(cards=2), on_pulses=collected.append)
    card.GT_Open()
    assert card.GT_SwitchtoCardNo(1) == 0
    card.GT_Open()
    card.GT_LnXY(100.0, 0.0)
    card.sleep(5000.0)
    assert card.places == [[0, 0, 0, 0], [100, 0, 0, 0]]
    assert not collected


def test_four_axes_are_pulsed_together():
    watched = Watched()
    watched.card.GT_LnXYZA(300.0, -200.0, 100.0, 50.0)
    watched.card.sleep(200.0)
    place = watched.point()
    share = [axis / end for axis, end in zip(place, (300.0, -200.0, 100.0, 50.0), strict=True)]
    assert share == pytest.approx([share[0]] * 4)
    code, z = watched.card.GT_GetAtlPos(3)
    assert code == 0
    assert abs(z - place[2]) <= 0.5 + 1000.0 * PERIOD_S
    watched.until_idle()
    assert watched.places() == (300, -200, 100, 50)


def test_velocity_points_along_the_path():
    watched = Watched()
    watched.load((0.0, 500.0, 360.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(1000.0)
    engine = watched.card._engine.motion
    x, y, *_ = engine.place()
    vx, vy, *_ = engine.velocity()
    assert math.hypot(vx, vy) == pytest.approx(1000.0)
    assert (vx, vy) == pytest.approx((-(y - 500.0) * 2.0, x * 2.0), abs=1e-6)
    assert engine.axis_moving(1)
    assert engine.axis_moving(2)
    assert not engine.axis_moving(3)
    watched.until_idle()
    assert engine.velocity() == (0.0, 0.0, 0.0, 0.0)


def test_a_jerk_limited_list_changes_its_acceleration_gradually():
    watched = Watched(jerk_pulse_ms3=2e-4)  # 2e5 µm/s³: a of 0.01 pulse/ms² is there after 50 ms
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    began = watched.card.time_s
    watched.card.sleep(20.0)
    t = watched.card.time_s + 20e-6 - began
    assert watched.card.GT_GetPrfVel()[1] == pytest.approx(2e5 * t**2 / 2 / 1000.0, rel=1e-6)
    # V/a + a/j at each end, in place of V/a.
    assert watched.until_idle(1.0) - began == pytest.approx(1.0 + 0.1 + 0.05, abs=2e-3)
    assert watched.places() == (1000, 0, 0, 0)


def test_time_stands_still_between_calls_of_a_resting_card():
    watched = Watched(call_s=20e-6)
    before = watched.card.time_s
    assert watched.status() & IDLE
    assert watched.card.time_s == pytest.approx(before + 20e-6)


def test_the_end_of_a_stepped_block_is_where_its_steps_end():
    watched = Watched()
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.4, 0.0, 1.0, 0.1)
    for quadrant in (1, 4):
        card.step_block(300, 400, 400, 1, quadrant, 0, 500.0)
    card.GT_StrtMtn()
    seen = []
    for _ in range(12):
        card.sleep(100.0)
        code, end = card.GT_GetSegPnt()
        assert code == 0
        seen += [end] if end not in seen else []
        if len(seen) == 1:
            card.GT_StpMtn()
            card.sleep(20.0)
            card.GT_RestoreMtn()
    assert seen == [(300.0, 400.0, 0.0, 0.0), (600.0, 0.0, 0.0, 0.0)]
    assert watched.places() == (600, 0, 0, 0)


def steps_left(blocks):
    """Steps still to be made; only the first block can be begun."""
    return len(entries.steps_of(blocks)) - blocks[0].done if blocks else 0


@pytest.mark.deeper
def test_a_stretch_cut_at_the_border_of_blocks_keeps_every_step():
    """By rounding, the last step of a block may come due just behind the end of the block."""
    rng = np.random.default_rng(7)
    x, y = rng.integers(1, 20, (2, 120)).tolist()
    pace = Pace(43.75, 1e5)
    blocks = [
        Stepped(k, pace, *xy, max(xy), int(xy[1] > xy[0]), 1, 0, math.hypot(*xy))
        for k, xy in enumerate(zip(x, y, strict=True))
    ]
    start, card = Start(0.0, ORIGIN, (0, 0, 0, 0)), CardSettings()
    speeds = speeds_of(card)
    first = make_stretch(blocks, start, speeds, card)
    now = 1 / 3
    at = [(int(p.x_um[-1]), int(p.y_um[-1])) for p in first.interpolator.pulses(now)][-1]
    blocks, start = first.unfinished(now), Start(now, ORIGIN, (*at, 0, 0), first.speed(now))
    ends = make_stretch(blocks, start, speeds, card).ends_s
    total = steps_left(blocks)
    for now in [float(time) for end in ends for time in (np.nextafter(end, 0.0), end, np.nextafter(end, np.inf))]:
        cut = make_stretch(blocks, start, speeds, card)
        made = sum(len(pulses.t_s) for pulses in cut.interpolator.pulses(now))
        left = cut.unfinished(now)
        assert steps_left(left) == total - made
        assert not left or left[0].done >= 0


def test_a_plan_made_on_the_way_under_a_jerk_limit_goes_on_with_its_acceleration():
    watched = Watched(jerk_pulse_ms3=2e-4)
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(70.0)
    before = watched.card.GT_GetPrfVel()[1]
    watched.card.GT_Override(1.9)
    watched.card.sleep(9.96)
    assert watched.card.GT_GetPrfVel()[1] == pytest.approx(before + 0.01 * 10.0, abs=1e-6)


@given(st.lists(st.floats(0.01, 400.0), min_size=1, max_size=12))
def test_pulses_that_nobody_hears_go_out_all_the_same(sleeps: list[float]) -> None:
    cards = [Watched(servo_period_s=0.005).card, GECard(CardSettings(servo_period_s=0.005))]
    cards[1].GT_Open()
    for card in cards:
        card.GT_SetSynVel(3.0)
        card.GT_StrtList()
        card.GT_MvXY(0.0, 0.0, 3.0, 0.02)
        card.GT_ArcXY(300.0, 0.0, -250.0)
        card.GT_LnXYZ(40.0, -70.0, 155.0)
        card.GT_StrtMtn()
    for ms in sleeps:
        seen = []
        for card in cards:
            card.sleep(ms)
            seen.append((card.places, card.GT_GetPrfPnt(), card.GT_GetAtlPos(3), card.GT_GetCrdSts()))
        assert seen[0] == seen[1]


def test_a_long_way_that_nobody_watches_is_run_at_once() -> None:
    card = GECard()
    card.GT_Open()
    card.GT_SetSynVel(100.0)
    card.GT_LnXY(2e9, 1e9)
    card.sleep(1e9)
    assert card.places == [[2_000_000_000, 1_000_000_000, 0, 0]]
    assert card.GT_GetCrdSts() == (0, 0x2001)
