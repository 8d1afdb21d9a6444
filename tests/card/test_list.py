"""The list of the card: loading, running, growing, its order, its speeds between entries, its codes."""

import math

import numpy as np
import pytest
from watched import EMPTY, IDLE, Watched

V, A = 1000.0, 10_000.0  # µm/s and µm/s² of 1 pulse/ms and 0.01 pulse/ms²
PERIOD_S = 200e-6
CALL_S = 20e-6


@pytest.fixture
def watched():
    return Watched()


def moved_for(watched, since_s):
    """Seconds from a time until the motion is over, to one servo period and one ms of sleep."""
    return watched.until_idle(step_ms=1.0) - since_s


def test_a_line_takes_the_time_of_its_trapezoid(watched):
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    began = watched.card.time_s
    watched.until_idle()
    pulses = watched.pulses()
    # Pulse k + 1 comes at the end of the period in which half a pulse more is passed.
    ramp_um, ramp_s = V * V / (2 * A), V / A
    along = np.arange(1000) + 0.5
    due = np.where(along < ramp_um, np.sqrt(2 * along / A), ramp_s + (along - ramp_um) / V)
    due = np.where(along > 1000 - ramp_um, 1.0 + ramp_s - np.sqrt(2 * (1000 - along) / A), due)
    late = pulses.t_s - began - due
    assert len(pulses.t_s) == 1000
    assert late.min() > -PERIOD_S
    assert late.max() < PERIOD_S + 1e-9
    assert watched.places() == (1000, 0, 0, 0)


def test_a_short_line_takes_the_time_of_its_triangle(watched):
    watched.load((40.0, 30.0))
    watched.card.GT_StrtMtn()
    assert moved_for(watched, watched.card.time_s) == pytest.approx(2 * math.sqrt(50 / A), abs=2e-3)


def test_speed_at_any_instant_is_that_of_the_plan(watched):
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    began = watched.card.time_s
    for _ in range(30):
        watched.card.sleep(10.0)
        t = watched.card.time_s + CALL_S - began
        assert watched.card.GT_GetPrfVel() == (0, pytest.approx(min(A * t, V) / 1000.0, rel=1e-9))
        t = watched.card.time_s + CALL_S - began
        place = A * t * t / 2 if t < V / A else V * t - V * V / (2 * A)
        assert watched.point()[0] == pytest.approx(place, rel=1e-9)


def test_status_tells_loaded_running_and_done(watched):
    assert watched.status() == IDLE | EMPTY
    watched.load((10.0, 0.0))
    assert watched.status() == IDLE
    assert watched.card.GT_StrtMtn() == 0
    assert watched.status() == 0
    watched.until_idle()
    assert watched.status() == IDLE | EMPTY
    assert [watched.card.GT_GetSts(axis)[1] & 1 for axis in (1, 2)] == [1, 0]


def test_path_speed_is_carried_through_a_junction(watched):
    watched.load((500.0, 0.0), (500.0, 500.0))
    watched.card.GT_StrtMtn()
    assert moved_for(watched, watched.card.time_s) == pytest.approx(1.0 + V / A, abs=2e-3)


def test_without_carrying_each_entry_ends_at_rest():
    watched = Watched(carries_speed=False)
    watched.load((500.0, 0.0), (500.0, 500.0))
    watched.card.GT_StrtMtn()
    assert moved_for(watched, watched.card.time_s) == pytest.approx(1.0 + 2 * V / A, abs=2e-3)


@pytest.mark.parametrize("carries", [True, False])
def test_an_end_speed_is_kept_at_the_end_of_its_entry(carries):
    watched = Watched(carries_speed=carries)
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_SetDccVel(0.4)
    card.GT_LnXY(500.0, 0.0)
    card.GT_LnXY(1000.0, 0.0)
    card.GT_StrtMtn()
    # Each half: from 0 to V, on, and to 0.4 V; the time lost in a ramp is (V − v)² / 2aV.
    lost = (V - 0.0) ** 2 / (2 * A * V) + (V - 400.0) ** 2 / (2 * A * V)
    assert moved_for(watched, card.time_s) == pytest.approx(1.0 + 2 * lost, abs=2e-3)


def test_the_end_speed_holds_for_one_entry(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_SetDccVel(0.0)
    for x in (300.0, 600.0, 900.0):
        card.GT_LnXY(x, 0.0)
    card.GT_StrtMtn()
    assert moved_for(watched, card.time_s) == pytest.approx(0.9 + 2 * V / A, abs=2e-3)


def test_start_speed_begins_and_ends_the_list(watched):
    watched.card.GT_SetStrtVel(0.6)
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    assert watched.card.GT_GetPrfVel()[1] == pytest.approx(0.6, abs=1e-3)
    assert moved_for(watched, watched.card.time_s) == pytest.approx(1.0 + 2 * 400.0**2 / (2 * A * V), abs=2e-3)


def test_between_entries_it_gets_no_slower_than_the_start_speed(watched):
    card = watched.card
    card.GT_SetStrtVel(0.6)
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_SetDccVel(0.0)
    card.GT_LnXY(500.0, 0.0)
    card.GT_LnXY(1000.0, 0.0)
    card.GT_StrtMtn()
    assert moved_for(watched, card.time_s) == pytest.approx(1.0 + 4 * 400.0**2 / (2 * A * V), abs=2e-3)


def test_an_end_speed_is_no_faster_than_the_entries_it_lies_between(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_SetDccVel(5.0)
    card.GT_LnXY(500.0, 0.0)
    card.GT_LnXY(1000.0, 0.0)
    card.GT_StrtMtn()
    assert moved_for(watched, card.time_s) == pytest.approx(1.0 + V / A, abs=2e-3)


def test_the_pulse_limit_holds_all_round_an_arc():
    watched = Watched(pulse_limit_hz=500.0)
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 1.0)
    card.GT_ArcXY(300.0, 300.0, 90.0)
    card.GT_StrtMtn()
    began = card.time_s
    assert moved_for(watched, began) == pytest.approx(math.pi / 2 * 300.0 * math.sqrt(2.0) / 500.0, abs=5e-3)


def test_speeds_are_stored_in_the_order_of_the_list(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 1.0)
    card.GT_LnXY(500.0, 0.0)
    card.GT_SetSynVel(0.1)
    card.GT_LnXY(600.0, 0.0)
    card.GT_SetSynVel(2.0)
    card.GT_LnXY(1600.0, 0.0)
    card.GT_StrtMtn()
    assert moved_for(watched, card.time_s) == pytest.approx(0.5 + 1.0 + 0.5, abs=5e-3)


def test_the_ceiling_and_the_pulse_limit_bound_every_speed():
    watched = Watched(pulse_limit_hz=500.0)
    watched.load((300.0, 400.0), acc=1.0)
    watched.card.GT_StrtMtn()
    # Y makes 0.8 of the path: 500 pulses/s are 625 µm/s.
    assert moved_for(watched, watched.card.time_s) == pytest.approx(500.0 / 625.0, abs=3e-3)
    watched.card.GT_SetMaxVel(0.25)
    watched.load((0.0, 0.0), acc=1.0)
    watched.card.GT_StrtMtn()
    assert moved_for(watched, watched.card.time_s) == pytest.approx(500.0 / 250.0, abs=3e-3)


def test_rapid_lines_run_at_the_rapid_speed():
    watched = Watched(rapid_pulse_ms=5.0)
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 1.0)
    card.GT_LnXYG0(5000.0, 0.0)
    card.GT_StrtMtn()
    assert moved_for(watched, card.time_s) == pytest.approx(1.0 + 5000.0 / 1e6, abs=2e-3)


def test_override_scales_running_and_later_entries(watched):
    watched.load((1000.0, 0.0), (2000.0, 0.0), acc=1.0)
    watched.card.GT_StrtMtn()
    began = watched.card.time_s
    watched.card.sleep(1000.0)
    assert watched.card.GT_Override(0.5) == 0
    assert moved_for(watched, began) == pytest.approx(1.0 + 1000.0 / 500.0, abs=5e-3)
    watched.load((1000.0, 0.0), acc=1.0)
    watched.card.GT_StrtMtn()
    assert moved_for(watched, watched.card.time_s) == pytest.approx(2.0, abs=5e-3)


def test_a_lower_override_brakes_with_the_acceleration_of_the_entry(watched):
    watched.load((2000.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(500.0)
    watched.card.GT_Override(0.2)
    watched.card.sleep(50.0)
    speed = watched.card.GT_GetPrfVel()[1]
    assert speed == pytest.approx((V - A * 0.050) / 1000.0, abs=1e-3)
    watched.card.sleep(100.0)
    assert watched.card.GT_GetPrfVel()[1] == pytest.approx(0.2)


def test_entries_pushed_while_running_join_the_motion(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    card.GT_LnXY(200.0, 0.0)
    card.GT_StrtMtn()
    began = card.time_s
    for x in (400.0, 600.0, 800.0, 1000.0):
        card.sleep(50.0)
        assert card.GT_LnXY(x, 0.0) == 0
    assert moved_for(watched, began) == pytest.approx(1.0 + V / A, abs=2e-3)


def test_an_entry_pushed_into_the_final_braking_lets_it_speed_up_again(watched):
    watched.load((100.0, 0.0))
    card = watched.card
    card.GT_AddList()
    card.GT_StrtMtn()
    began = card.time_s
    card.sleep(150.0)  # 100 µm: 100 ms up, 100 ms down; now at half the speed, 87.5 µm done
    card.GT_LnXY(200.0, 0.0)
    # From 500 µm/s: up to V over 37.5 µm, then down over 50 µm; 25 µm between.
    assert moved_for(watched, began) == pytest.approx(0.150 + 0.050 + 0.025 + 0.100, abs=2e-3)


def test_the_run_state_survives_an_empty_list(watched):
    card = watched.card
    watched.load((50.0, 0.0))
    card.GT_StrtMtn()
    watched.until_idle()
    assert card.GT_AddList() == 0
    assert card.GT_LnXY(50.0, 50.0) == 0
    assert watched.status() == 0
    watched.until_idle()
    assert watched.places() == (50, 50, 0, 0)


def test_a_full_list_says_so_and_takes_the_entry_once_there_is_room():
    watched = Watched(capacity=4)
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.1)
    for x in (100.0, 200.0, 300.0):
        assert card.GT_LnXY(x, 0.0) == 0
    assert card.GT_LnXY(400.0, 0.0) == 1
    assert card.GT_GetCmdSts() == (0, 0x8000)
    assert card.GT_BufIO(0) == 1
    assert card.GT_LnXY(300.0, 0.0) == 3
    assert card.GT_GetCmdSts() == (0, 0)
    card.GT_StrtMtn()
    card.sleep(150.0)  # the first line is behind
    assert card.GT_LnXY(400.0, 0.0) == 0
    assert card.GT_LnXY(500.0, 0.0) == 0
    assert card.GT_GetCmdSts() == (0, 0)
    assert card.GT_LnXY(600.0, 0.0) == 1
    watched.until_idle()
    assert watched.places() == (500, 0, 0, 0)


@pytest.mark.parametrize("call", ["GT_StrtMtn", "GT_StrtList"])
def test_the_word_of_a_full_list_goes_when_the_list_does(call):
    watched = Watched(capacity=1)
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(10.0, 0.0, 1.0, 0.1)
    assert card.GT_LnXY(400.0, 0.0) == 1
    assert card.GT_GetExOpt()[0] == card.GT_ExOpt(0) == card.GT_AddList() == 0
    assert card.GT_GetCmdSts() == (0, 0x8000)
    assert getattr(card, call)() == 0
    assert card.GT_GetCmdSts() == (0, 0)


def test_the_list_is_not_emptied_during_an_immediate_move_but_may_be_added_to(watched):
    card = watched.card
    card.GT_LnXY(100.0, 0.0)
    assert card.GT_StrtList() == 1
    assert card.GT_AddList() == card.GT_LnXY(100.0, 50.0) == 0
    assert card.GT_StrtMtn() == 1
    watched.until_idle()
    assert card.GT_StrtMtn() == 0
    watched.until_idle()
    assert watched.places() == (100, 50, 0, 0)


def test_numbers_follow_the_entries(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(100.0, 0.0, 1.0, 1.0)
    card.GT_LnXY(200.0, 0.0)
    card.GT_BufIO(0xFFFE)
    card.GT_ArcXY(200.0, 50.0, 90.0)
    card.GT_LnXY(250.0, 150.0)
    card.GT_StrtMtn()
    seen = []
    for _ in range(400):
        card.sleep(1.0)
        code, number = card.GT_GetMtnNm()
        assert code == 0
        seen += [number] if number not in seen else []
    assert seen == [0, 1, 2, 3]
    rows = watched.pulses().row
    assert np.unique(rows).tolist() == [0, 1, 2, 3]
    assert (np.diff(rows) >= 0).all()


def test_the_end_of_the_entry_being_executed_is_told(watched):
    watched.load((500.0, 0.0), (500.0, 500.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(200.0)
    assert watched.card.GT_GetSegPnt() == (0, (500.0, 0.0, 0.0, 0.0))
    watched.card.sleep(500.0)
    assert watched.card.GT_GetSegPnt() == (0, (500.0, 500.0, 0.0, 0.0))


def test_waits_and_outputs_come_in_their_order(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 1.0)
    card.GT_LnXY(100.0, 0.0)
    card.GT_BufIOBit(0, 0)
    card.GT_Delay(50)
    card.GT_BufIOBit(1, 0)
    card.GT_LnXY(200.0, 0.0)
    card.GT_BufIO(0xFF00)
    card.GT_LnXY(300.0, 0.0)
    card.GT_StrtMtn()
    began, seen = card.time_s, {}
    while not watched.status() & IDLE:
        card.sleep(0.5)
        seen.setdefault(card.GT_GetExOpt()[1], card.time_s - began)
    assert list(seen) == [0xFFFF, 0xFFFE, 0xFFFC, 0xFF00]
    # Ramps of 1 ms each; the wait stands between two lines at rest, the last output is passed at speed.
    assert list(seen.values())[1:] == pytest.approx([0.101, 0.151, 0.2515], abs=1.5e-3)


def test_outputs_that_act_at_once_do_so_while_a_list_is_open(watched):
    watched.card.GT_StrtList()
    watched.card.GT_ExOpt(0x0F0F)
    assert watched.card.GT_GetExOpt() == (0, 0x0F0F)


def test_listed_outputs_act_at_once_outside_a_list_and_waits_are_refused(watched):
    assert watched.card.GT_BufIO(0x1234) == 0
    assert watched.card.GT_GetExOpt() == (0, 0x1234)
    assert watched.card.GT_Delay(10) == 1


def test_calls_that_are_harmless_twice(watched):
    card = watched.card
    assert card.GT_EndList() == 0
    assert card.GT_EndList() == 0
    assert card.GT_StrtMtn() == 0
    watched.load((100.0, 0.0))
    assert card.GT_StrtMtn() == 0
    assert card.GT_StrtMtn() == 0
    assert watched.status() == 0
    card.GT_AddList()
    assert card.GT_AddList() == 0


def test_a_running_list_is_not_emptied(watched):
    watched.load((100.0, 0.0))
    watched.card.GT_StrtMtn()
    assert watched.card.GT_StrtList() == 1
    assert watched.card.GT_GetCmdSts() == (0, 0)
    watched.until_idle()
    assert watched.places() == (100, 0, 0, 0)
    assert watched.card.GT_StrtList() == 0


def test_a_list_can_be_started_while_it_is_open(watched):
    card = watched.card
    card.GT_StrtList()
    assert card.GT_StrtMtn() == 0
    card.GT_MvXY(100.0, 0.0, 1.0, 0.01)
    assert watched.status() == 0
    watched.until_idle()
    assert watched.places() == (100, 0, 0, 0)


@pytest.mark.parametrize("move", ["GT_MvXY", "GT_MvXYZ"])
def test_a_positioning_move_may_have_no_length_and_come_later(watched, move):
    card, more = watched.card, () if move == "GT_MvXY" else (0.0,)
    card.GT_StrtList()
    numbers = []
    for x in (0.0, 0.0, 10.0):
        assert getattr(card, move)(x, 0.0, *more, 1.0, 0.01) == 0
    assert card.GT_LnXY(20.0, 0.0) == 0
    assert getattr(card, move)(20.0, 5.0, *more, 2.0, 0.01) == 0
    assert getattr(card, move)(20.0, 5.0, *more, 1.0, 0.01) == 0
    assert card.GT_LnXY(20.0, 10.0) == 0
    card.GT_StrtMtn()
    while not watched.status() & IDLE:
        card.sleep(0.5)
        numbers.append(card.GT_GetMtnNm()[1])
    assert watched.places() == (20, 10, 0, 0)
    assert numbers == sorted(numbers)
    assert numbers[-1] == 6


def test_a_list_of_a_wait_alone_goes_on_from_where_a_stopped_move_left_the_axes(watched):
    card = watched.card
    card.GT_LnXY(1000.0, 0.0)
    card.GT_AddList()
    assert card.GT_Delay(500) == 0, "at the end of the move, as it seems"
    card.GT_StpMtn()
    watched.until_idle()
    stood = watched.places()
    assert stood[0] < 900
    assert card.GT_StrtMtn() == 0
    assert card.GT_LnXY(2000.0, 0.0) == 0
    last = watched.point()[0]
    while not watched.status() & IDLE:
        card.sleep(5.0)
        assert watched.point()[0] - last < 10.0, "at 1 pulse/ms"
        last = watched.point()[0]
    assert watched.places() == (2000, 0, 0, 0)


def test_a_list_that_begins_elsewhere_starts_with_a_line_from_here_or_not_at_all(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_LnXY(100.0, 0.0)
    card.GT_EndList()
    card.GT_MvXY(0.0, 50.0, 1.0, 0.01)
    watched.until_idle()
    assert card.GT_StrtMtn() == 0
    card.sleep(100.0)
    x, y, *_ = watched.point()
    assert y == pytest.approx(50.0 - x / 2)
    watched.until_idle()
    assert watched.places() == (100, 0, 0, 0)
    card.GT_StrtList()
    card.GT_ArcXY(100.0, 100.0, 90.0)
    card.GT_EndList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    watched.until_idle()
    assert card.GT_StrtMtn() == 1
    assert watched.status() == IDLE


def test_reset_ends_motion_and_empties_the_list(watched):
    watched.load((1000.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.sleep(300.0)
    assert watched.card.GT_Reset() == 0
    assert watched.status() == IDLE | EMPTY
    place = watched.places()
    watched.card.sleep(500.0)
    assert watched.places() == place
    assert watched.point() == (0.0, 0.0, 0.0, 0.0)


def test_close_does_not_stop_motion(watched):
    watched.load((100.0, 0.0))
    watched.card.GT_StrtMtn()
    watched.card.GT_Close()
    watched.card.sleep(1000.0)
    assert watched.card.GT_GetPrfPnt() == (-1, (0.0, 0.0, 0.0, 0.0))
    watched.card.GT_Open()
    assert watched.places() == (100, 0, 0, 0)


def test_an_immediate_move_ends_the_run_of_the_list(watched):
    card = watched.card
    watched.load((50.0, 0.0))
    card.GT_StrtMtn()
    watched.until_idle()
    card.GT_LnXY(0.0, 0.0)
    watched.until_idle()
    card.GT_AddList()
    card.GT_LnXY(0.0, 50.0)
    assert watched.status() == IDLE
    card.GT_StrtMtn()
    watched.until_idle()
    assert watched.places() == (0, 50, 0, 0)
