"""Stops of the card: how far they brake, where they break, how they go on; limits and captures on the way."""

import math

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from watched import ABNORMAL, EMPTY, IDLE, Watched

from controller.card.core.settings import Switches

V = 1000.0  # µm/s of 1 pulse/ms
POSITIVE, NEGATIVE, FINISHED, CAPTURED = 1 << 5, 1 << 6, 1 << 0, 1 << 3
MOVING = 1 << 10


def running(*path, sleep_ms=500.0, **card_settings):
    watched = Watched(**card_settings)
    watched.load(*path)
    watched.card.GT_StrtMtn()
    watched.card.sleep(sleep_ms)
    return watched


@pytest.mark.parametrize(
    ("call", "set_call", "value"), [("GT_StpMtn", "GT_SetStpAcc", 0.02), ("GT_EStpMtn", "GT_SetEStpAcc", 0.5)]
)
def test_a_stop_takes_the_way_of_its_deceleration(call, set_call, value):
    watched = running((5000.0, 0.0))
    card = watched.card
    assert getattr(card, set_call)(value) == 0
    assert getattr(card, call)() == 0
    deceleration, call_s = value * 1e6, 20e-6
    began, x = card.time_s, watched.point()[0] - V * call_s + deceleration * call_s**2 / 2
    assert watched.status() == 0
    assert watched.until_idle(0.1) - began == pytest.approx(V / deceleration, abs=5e-4)
    code, place = card.GT_GetBrkPnt()
    assert code == 0
    assert place[0] == pytest.approx(x + V * V / (2 * deceleration), abs=1e-6)
    assert watched.point() == place
    assert watched.status() == IDLE


def test_a_stop_is_harmless_at_rest_and_may_be_repeated():
    watched = Watched()
    assert watched.card.GT_StpMtn() == watched.card.GT_EStpMtn() == 0
    assert watched.status() == IDLE | EMPTY
    watched.load((5000.0, 0.0))
    assert watched.card.GT_StpMtn() == 0
    watched.card.GT_StrtMtn()
    watched.card.sleep(500.0)
    alone = running((5000.0, 0.0))
    for card in (watched.card, alone.card):
        card.GT_StpMtn()
    watched.card.sleep(3.0)
    watched.card.GT_StpMtn()
    watched.until_idle()
    alone.until_idle()
    assert watched.point()[0] == pytest.approx(alone.point()[0], abs=0.2)  # two calls more before the stop


def test_a_harder_stop_takes_over_and_a_softer_one_does_not():
    watched = running((5000.0, 0.0))
    card = watched.card
    card.GT_SetStpAcc(0.01)
    card.GT_SetEStpAcc(0.1)
    card.GT_StpMtn()
    card.sleep(50.0)
    began, speed = card.time_s, card.GT_GetPrfVel()[1] * 1000.0
    assert speed == pytest.approx(V - 10e3 * 0.05, abs=2.0)
    card.GT_EStpMtn()
    card.GT_StpMtn()
    assert watched.until_idle(0.1) - began == pytest.approx(speed / 100e3, abs=5e-4)


def test_a_stop_keeps_the_speed_of_a_corner_ahead():
    watched = Watched()
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 1.0)
    card.GT_SetDccVel(0.1)
    card.GT_LnXY(500.0, 0.0)
    card.GT_LnXY(500.0, 500.0)
    card.GT_SetStpAcc(0.001)  # V²/2a is half a metre
    card.GT_StrtMtn()
    card.sleep(400.0)
    card.GT_StpMtn()
    while watched.point()[0] < 499.9:
        card.sleep(0.1)
    assert card.GT_GetPrfVel()[1] == pytest.approx(0.1, abs=0.02)
    watched.until_idle()
    x, y, *_ = card.GT_GetBrkPnt()[1]
    assert x == pytest.approx(500.0)
    assert 0.5 < y < 2.0


def test_a_stop_runs_over_several_entries_and_sets_the_outputs_between():
    watched = Watched()
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 1.0, 0.01)
    for x in range(1, 51):
        card.GT_LnXY(x * 10.0, 0.0)
        card.GT_BufIO(0xFFFF - x)
    card.GT_StrtMtn()
    card.sleep(200.0)
    before = watched.point()[0]
    card.GT_SetStpAcc(0.005)
    card.GT_StpMtn()
    watched.until_idle()
    x = watched.point()[0]
    assert x - before == pytest.approx(V * V / (2 * 5e3), abs=0.1)
    assert card.GT_GetExOpt() == (0, 0xFFFF - int(x // 10))


def test_a_stop_ends_a_wait_and_its_rest_is_waited_later():
    watched = Watched()
    card = watched.card
    card.GT_StrtList()
    card.GT_Delay(100)
    card.GT_LnXY(10.0, 0.0)
    card.GT_StrtMtn()
    card.sleep(30.0)
    card.GT_StpMtn()
    card.sleep(1.0)
    assert watched.status() == IDLE
    card.sleep(500.0)
    card.GT_RestoreMtn()
    card.sleep(60.0)
    assert watched.places() == (0, 0, 0, 0)
    watched.until_idle()
    assert watched.places() == (10, 0, 0, 0)


@pytest.mark.parametrize("resume", ["GT_RestoreMtn", "GT_StrtMtn"])
def test_the_list_goes_on_from_its_break_point(resume):
    watched = running((1000.0, 0.0), (1000.0, 1000.0))
    card = watched.card
    card.GT_StpMtn()
    assert getattr(card, resume)() == 1
    watched.until_idle()
    assert watched.status() == IDLE
    assert getattr(card, resume)() == 0
    assert watched.status() == 0
    watched.until_idle()
    assert watched.places() == (1000, 1000, 0, 0)
    assert watched.status() == IDLE | EMPTY
    assert len(watched.pulses().t_s) == 2000
    assert card.GT_RestoreMtn() == 1


def test_the_axes_may_move_away_and_come_back_before_the_list_goes_on():
    watched = running((1000.0, 0.0))
    card = watched.card
    card.GT_StpMtn()
    watched.until_idle()
    x, y, *_ = card.GT_GetBrkPnt()[1]
    assert card.GT_LnXY(x, 300.0) == 0
    watched.until_idle()
    assert card.GT_RestoreMtn() == card.GT_StrtMtn() == 1
    assert card.GT_LnXY(x, y) == 0
    watched.until_idle()
    assert card.GT_GetBrkPnt()[1] == (x, y, 0.0, 0.0)
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (1000, 0, 0, 0)


def test_opening_the_list_afresh_forgets_what_was_stopped():
    watched = running((1000.0, 0.0))
    watched.card.GT_StpMtn()
    watched.until_idle()
    assert watched.card.GT_StrtList() == 0
    assert watched.card.GT_RestoreMtn() == 1
    assert watched.status() == IDLE | EMPTY


def stopped_move(*call):
    watched = Watched()
    assert getattr(watched.card, call[0])(*call[1:]) == 0
    watched.card.sleep(300.0)
    watched.card.GT_StpMtn()
    assert watched.card.GT_RestoreMtn() == 1, "it still brakes"
    watched.until_idle()
    return watched


@pytest.mark.parametrize("call", [("GT_LnXY", 1000.0, 0.0), ("GT_ArcXY", 500.0, 0.0, -180.0)])
def test_an_immediate_move_goes_on_from_its_break_point(call):
    watched, whole = stopped_move(*call), Watched()
    card = watched.card
    assert watched.status() == IDLE | EMPTY
    assert card.GT_GetSts(1)[1] & FINISHED
    code, place = card.GT_GetBrkPnt()
    assert (code, place) == (0, watched.point())
    assert math.hypot(*place) > 100.0
    assert card.GT_RestoreMtn() == 0
    assert watched.status() == EMPTY
    assert card.GT_GetSegPnt()[1][0] == pytest.approx(1000.0)
    watched.until_idle()
    getattr(whole.card, call[0])(*call[1:])
    whole.until_idle()
    assert watched.places() == whole.places() == (1000, 0, 0, 0)
    assert len(watched.pulses().t_s) == len(whole.pulses().t_s)
    assert card.GT_RestoreMtn() == 1
    assert card.GT_GetBrkPnt()[1] == place


def test_a_new_move_and_the_start_of_the_list_forget_an_immediate_move():
    watched = stopped_move("GT_LnXY", 1000.0, 0.0)
    x, y, *_ = watched.card.GT_GetBrkPnt()[1]
    watched.card.GT_LnXY(0.0, 0.0)
    watched.until_idle()
    watched.card.GT_LnXY(x, y)
    watched.until_idle()
    assert watched.card.GT_RestoreMtn() == 1
    watched = stopped_move("GT_LnXY", 1000.0, 0.0)
    watched.load()
    assert watched.card.GT_StrtMtn() == 0
    watched.until_idle()
    assert watched.card.GT_RestoreMtn() == 1


def test_a_move_stopped_on_the_way_back_leaves_the_list_its_break_point():
    watched = running((1000.0, 0.0))
    card = watched.card
    card.GT_StpMtn()
    watched.until_idle()
    x, y, *_ = card.GT_GetBrkPnt()[1]
    card.GT_LnXY(x, 300.0)
    card.sleep(200.0)
    card.GT_StpMtn()
    watched.until_idle()
    assert card.GT_StrtMtn() == 1, "away from where the list broke"
    assert 0.0 < card.GT_GetBrkPnt()[1][1] < 300.0
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (round(x), 300, 0, 0)
    assert card.GT_LnXY(x, y) == 0
    watched.until_idle()
    assert card.GT_GetBrkPnt()[1] == (x, y, 0.0, 0.0)
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (1000, 0, 0, 0)


def test_the_break_point_counts_from_the_zeros_of_now():
    watched = running((1000.0, 0.0))
    card = watched.card
    card.GT_StpMtn()
    watched.until_idle()
    x = card.GT_GetBrkPnt()[1][0]
    stood = watched.places()[0]
    card.GT_ZeroPos(1)
    assert card.GT_GetBrkPnt()[1][0] == pytest.approx(x - stood, abs=1e-9)
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (1000, 0, 0, 0)
    assert watched.point()[0] == pytest.approx(1000.0 - stood)


def test_entries_can_be_added_to_a_stopped_list():
    watched = running((1000.0, 0.0))
    card = watched.card
    card.GT_StpMtn()
    watched.until_idle()
    card.GT_AddList()
    assert card.GT_LnXY(1000.0, 100.0) == 0
    assert watched.status() == IDLE
    card.GT_RestoreMtn()
    watched.until_idle()
    assert watched.places() == (1000, 100, 0, 0)


def way(watched):
    """Places that the pulses lead through, in order."""
    pulses = watched.pulses()
    return np.stack([pulses.x_um, pulses.y_um], axis=1)


@settings(max_examples=examples(40), deadline=None, derandomize=True)
@given(
    stops=st.lists(st.tuples(st.floats(0.1, 400.0), st.sampled_from(["GT_StpMtn", "GT_EStpMtn"])), max_size=6),
    stepped=st.booleans(),
)
def test_stops_lose_no_pulse(stops, stepped):
    """Lines and blocks: pulse for pulse the same way, however often it is stopped, even in the middle of an arc."""

    def run(stops):
        watched = Watched()
        card = watched.card
        card.GT_StrtList()
        card.GT_MvXY(3.3, 0.0, 1.0, 0.01)
        if stepped:
            card.step_block(200, 0, 400, 0, 1, 1, math.pi * 200.0)
            card.step_block(30, 40, 40, 1, 4, 0, 50.0)
            card.step_block(0, 100, 150, 0, 3, -1, 100.0 * (math.pi / 2 + math.pi / 6))
        else:
            for x, y in ((200.5, 0.0), (300.0, 77.7), (250.0, 200.0)):
                card.GT_LnXY(x, y)
        card.GT_StrtMtn()
        for ms, call in stops:
            card.sleep(ms)
            getattr(card, call)()
            watched.until_idle(5.0)
            assert card.GT_RestoreMtn() in (0, 1)
        watched.until_idle()
        return watched

    plain, stopped = run([]), run(stops)
    assert stopped.places() == plain.places()
    if stepped:
        np.testing.assert_array_equal(way(stopped), way(plain))
    assert len(way(stopped)) == len(way(plain))


@pytest.mark.parametrize("sleep_ms", [40.0, 333.0, 700.0, 1234.5])
def test_an_arc_goes_on_round_its_centre(sleep_ms):
    watched = running((300.0, 0.0, 360.0), sleep_ms=sleep_ms)
    watched.card.GT_StpMtn()
    watched.until_idle()
    x, y, *_ = watched.point()
    assert math.hypot(x - 300.0, y) == pytest.approx(300.0, abs=1e-9)
    watched.card.GT_RestoreMtn()
    watched.until_idle()
    assert watched.places() == (0, 0, 0, 0)
    away = np.hypot(*(way(watched) - [300, 0]).T) - 300.0
    assert np.abs(away).max() < math.sqrt(0.5) + 1.0
    assert len(way(watched)) == 2400


SOFT = 0.002  # pulse/ms²: 250 µm to stop from V


def limited(limit_wiring="as-sensed", **card_settings):
    switches = (Switches(negative=-400.0, positive=500.0, limit_wiring=limit_wiring),)
    return Watched(switches=switches, stpacc_pulse_ms2=SOFT, **card_settings)


@pytest.mark.alike(1)
@pytest.mark.parametrize(("end", "limit", "bit"), [(3000.0, 500.0, POSITIVE), (-3000.0, -400.0, NEGATIVE)])
def test_a_limit_flags_at_once_and_brakes(end, limit, bit):
    watched = limited()
    card = watched.card
    watched.load((end, 0.0))
    card.GT_StrtMtn()
    while abs(watched.point()[0]) < abs(limit) - 1.0:
        card.sleep(0.1)
        assert not card.GT_GetSts(1)[1] & bit
    card.sleep(2.0)
    assert card.GT_GetSts(1)[1] & (bit | MOVING) == bit | MOVING
    watched.until_idle()
    word = card.GT_GetSts(1)[1]
    assert word & (bit | MOVING | FINISHED) == bit | FINISHED
    assert watched.status() == IDLE | ABNORMAL
    braked = V * V / (2 * SOFT * 1e6)
    assert abs(watched.point()[0]) == pytest.approx(abs(limit) + braked, abs=1e-6)


def test_a_move_away_from_a_limit_is_taken_while_its_flag_is_latched():
    watched = limited()
    card = watched.card
    card.GT_LnXY(3000.0, 0.0)
    watched.until_idle()
    assert card.GT_GetSts(1)[1] & POSITIVE
    assert card.GT_LnXY(0.0, 0.0) == 0
    watched.until_idle()
    assert watched.places() == (0, 0, 0, 0)
    assert watched.status() == IDLE | EMPTY
    assert card.GT_GetSts(1)[1] & POSITIVE
    card.GT_ClrSts(1)
    assert not card.GT_GetSts(1)[1] & POSITIVE


def test_a_move_further_beyond_a_limit_makes_no_pulse():
    watched = limited()
    card = watched.card
    card.GT_LnXY(3000.0, 0.0)
    watched.until_idle()
    stood = watched.places()
    card.GT_ClrSts(1)
    assert card.GT_LnXY(3000.0, 0.0) == 0
    watched.until_idle()
    assert watched.places() == stood
    assert watched.status() & ABNORMAL
    assert card.GT_GetSts(1)[1] & POSITIVE
    assert card.GT_LnXY(stood[0], 500.0) == 0
    watched.until_idle()
    assert watched.places() == (stood[0], 500, 0, 0)


def test_a_list_stopped_by_a_limit_meets_it_again_when_it_goes_on():
    watched = limited()
    card = watched.card
    watched.load((3000.0, 0.0))
    card.GT_StrtMtn()
    watched.until_idle()
    stood = watched.places()
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == stood
    assert watched.status() == IDLE | ABNORMAL


@pytest.mark.parametrize(
    ("begins", "end", "trips"), [(0, 300, True), (0, -300, False), (600, 900, False), (600, 450, False)]
)
def test_a_limit_of_inverted_sense_stops_what_heads_for_it(begins, end, trips):
    watched = limited(limit_wiring="normally-closed")
    card = watched.card
    card.GT_LmtsOff(1)
    card.GT_LnXY(float(begins), 0.0) if begins else None
    watched.until_idle()
    card.GT_LmtsOn(1)
    card.GT_LmtSns(0x1)
    assert card.GT_GetLmtSwt()[1] & 1 == (begins >= 500)
    assert card.GT_LnXY(float(end), 0.0) == 0
    watched.until_idle()
    assert watched.places()[0] == (begins if trips else end)
    assert bool(card.GT_GetSts(1)[1] & POSITIVE) is trips


def test_an_arc_that_turns_toward_a_limit_of_inverted_sense_is_stopped_there():
    watched = Watched(switches=(Switches(limit_wiring="normally-closed"),))
    card = watched.card
    card.GT_SetEStpAcc(1e3)
    card.GT_SetStpAcc(1e3)
    card.GT_LmtSns(0x1)
    assert card.GT_ArcXY(0.0, 200.0, -360.0) == 0
    watched.until_idle()
    assert watched.point()[:2] == pytest.approx((-200.0, 200.0), abs=1.0)
    card.GT_LmtSns(0)
    assert card.GT_RestoreMtn() == 0
    watched.until_idle()
    assert watched.places() == (0, 0, 0, 0)


def test_a_limit_inverted_on_the_way_stops_at_once():
    watched = running((3000.0, 0.0), switches=(Switches(limit_wiring="normally-closed"),))
    x = watched.point()[0]
    watched.card.GT_LmtSns(0x1)
    watched.until_idle()
    assert watched.point()[0] < x + 10.0
    assert watched.card.GT_GetSts(1)[1] & POSITIVE


def test_limits_that_are_off_are_passed():
    watched = limited()
    watched.card.GT_LmtsOff(1)
    watched.card.GT_LnXY(3000.0, 0.0)
    watched.until_idle()
    assert watched.places() == (3000, 0, 0, 0)
    assert not watched.card.GT_GetSts(1)[1] & POSITIVE


def test_limits_switched_on_beyond_them_stop_the_axis():
    watched = limited()
    card = watched.card
    card.GT_LmtsOff(1)
    card.GT_LnXY(3000.0, 0.0)
    card.sleep(1000.0)
    before = watched.point()[0]
    assert before > 500.0
    card.GT_LmtsOn(1)
    watched.until_idle()
    assert watched.places()[0] < before + 300.0
    assert card.GT_GetSts(1)[1] & POSITIVE


def test_an_arc_that_bulges_over_a_limit_is_stopped_on_it():
    watched = Watched(switches=(Switches(positive=350.0),), stpacc_pulse_ms2=1.0)
    watched.load((0.0, 200.0, 180.0))  # bulges to x = 200
    watched.card.GT_StrtMtn()
    watched.until_idle()
    assert watched.status() == IDLE | EMPTY
    watched.card.GT_MvXY(200.0, 0.0, 1.0, 0.01)
    watched.until_idle()
    watched.load((200.0, 200.0, 180.0))  # bulges to x = 400
    watched.card.GT_StrtMtn()
    watched.until_idle()
    braked = V * V / 2e6
    x, y, *_ = watched.point()
    along = 200.0 * math.asin((350.0 - 200.0) / 200.0) + braked
    assert (x, y) == pytest.approx(
        (200.0 + 200.0 * math.sin(along / 200.0), 200.0 - 200.0 * math.cos(along / 200.0)), abs=1e-6
    )


def test_a_limit_at_full_speed_stops_within_its_braking_way():
    watched = Watched(switches=(Switches(positive=50_000.0),), stpacc_pulse_ms2=1.0)
    watched.card.GT_MvXY(1e6, 0.0, 200.0, 1.0)
    watched.until_idle()
    assert watched.places()[0] == round(50_000 + 200e3**2 / 2e6)


@pytest.mark.parametrize(("begins", "end", "edge"), [(0.0, 1000.0, 301), (800.0, 0.0, 400)])
def test_the_home_edge_is_captured_where_it_is(begins, end, edge):
    watched = Watched(switches=(Switches(home=(301.0, 400.0)),), stpacc_pulse_ms2=SOFT)
    card = watched.card
    if begins:
        card.GT_LnXY(begins, 0.0)
        watched.until_idle()
    assert card.GT_CaptHome(1) == 0
    card.GT_MvXY(end, 0.0, 1.0, 0.01)
    while not card.GT_GetSts(1)[1] & CAPTURED:
        card.sleep(1.0)
        assert not watched.status() & IDLE
    card.GT_StpMtn()
    watched.until_idle()
    assert card.GT_GetCapt(1) == (0, edge)
    assert abs(watched.places()[0] - edge) > 100
    card.GT_LnXY(float(edge), 0.0)
    watched.until_idle()
    assert watched.places()[0] == edge


def test_a_home_switch_of_inverted_sense_is_captured_at_its_other_edge():
    watched = Watched(switches=(Switches(home=(100.0, 150.0), home_wiring="normally-closed"),))
    card = watched.card
    card.GT_HomeSns(0x1)
    card.GT_CaptHome(1)
    card.GT_LnXY(300.0, 0.0)
    watched.until_idle()
    assert card.GT_GetCapt(1) == (0, 150)
    card.GT_CaptHome(1)
    card.GT_LnXY(0.0, 0.0)
    watched.until_idle()
    assert card.GT_GetCapt(1) == (0, 100)


def test_the_next_index_mark_is_captured_in_either_direction():
    watched = Watched(switches=(Switches(index_every=250.0),))
    card = watched.card
    for end, mark in ((600.0, 250), (900.0, 750), (800.0, None), (10.0, 750), (-300.0, 0)):
        card.GT_ClrSts(1)
        assert card.GT_CaptIndex(1) == 0
        card.GT_LnXY(end, 0.0)
        watched.until_idle()
        assert bool(card.GT_GetSts(1)[1] & CAPTURED) == (mark is not None)
        if mark is not None:
            assert card.GT_GetCapt(1) == (0, mark)


def test_a_capture_armed_on_the_way_sees_only_what_is_ahead():
    watched = Watched(switches=(Switches(index_every=250.0),))
    card = watched.card
    card.GT_LnXY(1000.0, 0.0)
    card.sleep(400.0)
    assert 300.0 < watched.point()[0] < 490.0
    card.GT_CaptIndex(1)
    watched.until_idle()
    assert card.GT_GetCapt(1) == (0, 500)


def test_an_edge_in_the_middle_of_a_stop_is_captured():
    watched = Watched(switches=(Switches(home=(500.0, 600.0)),), stpacc_pulse_ms2=SOFT)
    card = watched.card
    card.GT_CaptHome(1)
    card.GT_LnXY(2000.0, 0.0)
    card.sleep(450.0)
    assert watched.point()[0] < 499.0
    card.GT_StpMtn()
    watched.until_idle()
    assert card.GT_GetCapt(1) == (0, 500)


@pytest.mark.alike(1)
@pytest.mark.parametrize("behind", ["nothing", "line", "block"])
def test_a_new_plan_within_the_last_servo_period_before_a_wait_loses_no_pulse(behind: str) -> None:
    ends = []
    for disturbed in (False, True):
        watched = Watched(servo_period_s=0.01, call_s=1e-6)
        card = watched.card
        card.GT_SetStrtVel(1.0)
        card.GT_StrtList()
        card.GT_MvXY(0.0, 0.0, 5.0, 0.05)
        card.GT_LnXY(79.0, -30.0)
        card.GT_Delay(300)
        if behind == "line":
            card.GT_LnXY(156.0, -70.0)
        if behind == "block":
            card.step_block(77, 40, 77, 0, 4, 0, math.hypot(77, 40))
        card.GT_StrtMtn()
        while card.GT_GetPrfPnt()[1][0] < 76.0:
            card.sleep(0.1)
        while card.GT_GetPrfPnt()[1][0] < 79.0:
            pass  # each call takes 1 µs
        if disturbed:
            card.GT_Override(1.0)
        watched.until_idle()
        ends.append((watched.places(), watched.point(), card.GT_GetAtlErr(1)))
        assert np.diff(watched.pulses().t_s).min() >= 0.0
    assert ends[0] == ends[1]
