"""Paths of the card: where lines, arcs and blocks lead, at once or listed, and the codes of those that do not."""

import math

import numpy as np
import pytest
from plain import PlainBlock, plain_steps
from watched import EMPTY, IDLE, Watched

HUGE = 1e300


@pytest.fixture
def watched():
    return Watched(synvel_pulse_ms=5.0, synacc_pulse_ms2=1.0)


def test_an_immediate_move_runs_at_once_and_returns_at_once(watched):
    assert watched.card.GT_LnXY(100.0, -50.0) == 0
    assert watched.status() == EMPTY
    watched.until_idle()
    assert watched.status() == IDLE | EMPTY
    assert watched.places() == (100, -50, 0, 0)
    assert set(watched.pulses().row) == {-1}


@pytest.mark.parametrize("move", ["GT_LnXY", "GT_MvXY"])
def test_a_second_immediate_move_waits_for_the_first(watched, move):
    watched.card.GT_LnXY(100.0, 0.0)
    arguments = (0.0, 0.0) if move == "GT_LnXY" else (0.0, 0.0, 1.0, 1.0)
    assert getattr(watched.card, move)(*arguments) == 1
    watched.until_idle()
    assert watched.places() == (100, 0, 0, 0)
    assert getattr(watched.card, move)(*arguments) == 0


def test_a_positioning_move_sets_the_speed_of_what_follows(watched):
    card = watched.card
    card.GT_MvXY(100.0, 0.0, 0.1, 1.0)
    began = card.time_s
    assert watched.until_idle(1.0) - began == pytest.approx(1.0, abs=3e-3)
    card.GT_LnXY(200.0, 0.0)
    began = card.time_s
    assert watched.until_idle(1.0) - began == pytest.approx(1.0, abs=3e-3)


@pytest.mark.parametrize(
    ("call", "numbers", "end"),
    [
        ("GT_LnXY", (30.0, 40.0), (30, 40, 0, 0)),
        ("GT_LnXYZ", (30.0, 40.0, -20.0), (30, 40, -20, 0)),
        ("GT_LnXYZA", (30.0, 40.0, -20.0, 7.0), (30, 40, -20, 7)),
        ("GT_LnXYG0", (-30.0, 40.0), (-30, 40, 0, 0)),
        ("GT_LnXYZG0", (30.0, 40.0, -20.0), (30, 40, -20, 0)),
        ("GT_LnXYZAG0", (30.0, 40.0, -20.0, 7.0), (30, 40, -20, 7)),
        ("GT_MvXYZ", (1.0, 2.0, 3.0, 1.0, 1.0), (1, 2, 3, 0)),
        ("GT_MvXYZA", (1.0, 2.0, 3.0, 4.0, 1.0, 1.0), (1, 2, 3, 4)),
        ("GT_ArcXY", (100.0, 0.0, 180.0), (200, 0, 0, 0)),
        ("GT_ArcXY", (100.0, 0.0, 90.0), (100, -100, 0, 0)),
        ("GT_ArcXY", (100.0, 0.0, -90.0), (100, 100, 0, 0)),
        ("GT_ArcYZ", (100.0, 0.0, 90.0), (0, 100, -100, 0)),
        ("GT_ArcZX", (100.0, 0.0, 90.0), (-100, 0, 100, 0)),
        ("GT_ArcXYP", (100.0, 100.0, 100.0, 1), (100, 100, 0, 0)),
        ("GT_ArcYZP", (100.0, 100.0, -100.0, 1), (0, 100, 100, 0)),
        ("GT_ArcZXP", (100.0, 50.0, 100.0, -1), (50, 0, 100, 0)),
        ("GT_ArcXY", (100.0, 0.0, 360.0), (0, 0, 0, 0)),
    ],
)
def test_a_path_ends_where_it_says(watched, call, numbers, end):
    assert getattr(watched.card, call)(*numbers) == 0
    watched.until_idle()
    assert watched.places() == end
    assert watched.point() == pytest.approx(end, abs=1e-9)


def swept(pulses, centre):
    """Angle in degrees that pulses turn about a centre."""
    angle = np.unwrap(np.arctan2(pulses.y_um - centre[1], pulses.x_um - centre[0]))
    return math.degrees(angle[-1] - angle[0])


@pytest.mark.parametrize(
    ("radius", "sense", "centre", "degrees"),
    [
        (1000.0, 1, (0.0, 1000.0), 90.0),
        (1000.0, -1, (1000.0, 0.0), -90.0),
        (-1000.0, 1, (1000.0, 0.0), 270.0),
        (-1000.0, -1, (0.0, 1000.0), -270.0),
    ],
)
def test_radius_and_sense_choose_one_of_four_arcs(watched, radius, sense, centre, degrees):
    assert watched.card.GT_ArcXYP(1000.0, 1000.0, radius, sense) == 0
    watched.until_idle()
    pulses = watched.pulses()
    away = np.hypot(pulses.x_um - centre[0], pulses.y_um - centre[1]) - 1000.0
    # Half a pulse on each axis, and one axis a step ahead of the other within a servo period.
    assert np.abs(away).max() < math.sqrt(0.5) + 1.0
    assert swept(pulses, centre) == pytest.approx(degrees, abs=0.2)


def test_a_full_circle_goes_all_the_way_round(watched):
    assert watched.card.GT_ArcXY(500.0, 0.0, -360.0) == 0
    watched.until_idle()
    pulses = watched.pulses()
    assert (pulses.x_um.max(), pulses.y_um.max(), pulses.y_um.min()) == (1000, 500, -500)
    assert watched.places() == (0, 0, 0, 0)


@pytest.mark.parametrize(
    ("code", "call", "numbers"),
    [
        (3, "GT_LnXY", (0.0, 0.0)),
        (3, "GT_LnXY", (1e-12, 0.0)),
        (3, "GT_LnXY", (3e9, 0.0)),
        (3, "GT_LnXY", (0.0, HUGE)),
        (3, "GT_LnXYZA", (0.0, 0.0, 0.0, 0.0)),
        (7, "GT_LnXY", (math.nan, 0.0)),
        (7, "GT_LnXY", (math.inf, 0.0)),
        (4, "GT_MvXY", (10.0, 0.0, 0.0, 1.0)),
        (4, "GT_MvXY", (10.0, 0.0, -1.0, 1.0)),
        (4, "GT_MvXY", (10.0, 0.0, 1.0, 0.0)),
        (3, "GT_MvXY", (HUGE, 0.0, 1.0, 1.0)),
        (3, "GT_MvXY", (1e10, 0.0, 1000.0, 1000.0)),
        (3, "GT_MvXYZA", (0.0, 0.0, HUGE, 0.0, 1.0, 1.0)),
        (2, "GT_ArcXY", (0.0, 0.0, 90.0)),
        (7, "GT_ArcXY", (10.0, 0.0, 0.0)),
        (7, "GT_ArcXY", (10.0, 0.0, 360.001)),
        (3, "GT_ArcXY", (HUGE, 0.0, 90.0)),
        (2, "GT_ArcXYP", (10.0, 0.0, 0.0, 1)),
        (2, "GT_ArcXYP", (0.0, 0.0, 10.0, 1)),
        (5, "GT_ArcXYP", (10.0, 0.0, 4.9, 1)),
        (7, "GT_ArcXYP", (10.0, 0.0, 10.0, 0)),
        (7, "GT_ArcXYP", (10.0, 0.0, 10.0, 2)),
        (3, "GT_ArcXY", (2e9, 0.0, 180.0)),
        (3, "GT_ArcXY", (5e-324, 0.0, 90.0)),
        (3, "GT_ArcXYP", (HUGE, 0.0, 10.0, 1)),
        (3, "GT_ArcXYP", (50.0, 0.0, HUGE, -1)),
        (5, "GT_ArcXYP", (50.0, 0.0, 5e-324, -1)),
        (3, "GT_ArcXYP", (5e-324, 0.0, 50.0, 1)),
        (1, "GT_ScrewXYP", (10, 10, 10, 1, 5)),
        (1, "step_block", (3, 4, 4, 1, 1, 0, 5.0)),
        (4, "GT_SetSynVel", (0.0,)),
        (4, "GT_SetSynAcc", (-1.0,)),
        (4, "GT_SetDccVel", (-0.1,)),
        (4, "GT_SetStrtVel", (-0.1,)),
        (4, "GT_SetMaxVel", (0.0,)),
        (4, "GT_SetStpAcc", (0.0,)),
        (4, "GT_SetEStpAcc", (-1.0,)),
        (4, "GT_SetSynVel", (HUGE,)),
        (7, "GT_SetSynVel", (math.nan,)),
        (7, "GT_Override", (0.0,)),
        (7, "GT_Override", (2.0,)),
        (7, "GT_OverrideG0", (-1.0,)),
        (7, "GT_Delay", (-1,)),
        (7, "GT_BufIO", (0x10000,)),
        (7, "GT_BufIOBit", (16, 1)),
        (7, "GT_BufIOBit", (0, 2)),
        (1, "GT_RestoreMtn", ()),
    ],
)
def test_a_bad_call_gets_its_code_and_moves_nothing(watched, code, call, numbers):
    assert getattr(watched.card, call)(*numbers) == code
    assert watched.status() == IDLE | EMPTY
    watched.card.sleep(100.0)
    assert watched.places() == (0, 0, 0, 0)


@pytest.mark.parametrize(
    ("code", "block"),
    [
        (3, (0, 0, 0, 0, 1, 0, 0.0)),
        (3, (3, 4, 0, 1, 1, 0, 5.0)),
        (3, (3, 4, 4, 1, 1, 0, 0.0)),
        (3, (0, 5, 5, 0, 1, 0, 5.0)),  # never counts on X
        (3, (1, 0, 4, 0, 1, 1, 6.0)),  # a radius of 1 µm swings between two points
        (3, (1, 1 << 30, 1000, 0, 1, 0, 1000.0)),  # 10¹² steps in a mm
        (3, ((1 << 30) + 1, 0, 1 << 30, 0, 1, 0, float(1 << 30))),
        (7, (-3, 4, 4, 1, 1, 0, 5.0)),
        (7, (3, 4, 4, 2, 1, 0, 5.0)),
        (7, (3, 4, 4, 1, 0, 0, 5.0)),
        (7, (3, 4, 4, 1, 1, 2, 5.0)),
    ],
)
def test_a_block_that_no_controller_finishes_is_refused(watched, code, block):
    watched.card.GT_StrtList()
    assert watched.card.step_block(*block) == code
    assert watched.status() == IDLE | EMPTY


def test_axes_that_the_card_lacks_are_refused():
    card = Watched(axes=2).card
    assert card.GT_LnXYZ(1.0, 2.0, 3.0) == 1
    assert card.GT_ArcYZ(10.0, 0.0, 90.0) == 1
    assert card.GT_MvXYZA(1.0, 2.0, 3.0, 4.0, 1.0, 1.0) == 1
    assert card.GT_LnXY(1.0, 2.0) == 0


def test_a_path_needs_its_axes_on_where_the_settings_say_so():
    card = Watched(needs_axis_on=True).card
    assert card.GT_LnXY(10.0, 0.0) == 1
    assert card.GT_AxisOn(1) == 0
    assert card.GT_LnXY(10.0, 10.0) == 1
    assert card.GT_LnXY(10.0, 0.0) == 0


def test_a_positioning_move_too_short_to_be_one_is_taken(watched):
    assert watched.card.GT_MvXY(1e-12, 0.0, 1.0, 1.0) == 0
    watched.until_idle()
    assert watched.places() == (0, 0, 0, 0)


@pytest.mark.parametrize("count", [1e-300, 1e300])
def test_speeds_in_user_units_keep_their_bounds_in_pulses(count):
    watched = Watched(speeds_in_user_units=True)
    assert watched.card.GT_MapCnt(1, count) == 0
    assert watched.card.GT_SetSynVel(1.0) == watched.card.GT_SetStpAcc(1.0) == 4
    assert watched.card.GT_MvXY(0.0, 10.0, 1.0, 1.0) == 4
    assert watched.card.GT_LnXY(0.0, 10.0) == 0
    watched.until_idle()
    assert watched.places() == (0, 10, 0, 0)


@pytest.mark.parametrize("factor", [1e-300, 1e-10])
def test_no_override_is_too_small_to_run(watched, factor):
    assert watched.card.GT_Override(factor) == 0
    assert watched.card.GT_LnXY(10.0, 0.0) == 0
    watched.card.sleep(5e8)  # 10 pulses at 1e-7 pulse/ms take 1e8 ms
    assert watched.places() == (10, 0, 0, 0)


def test_user_units_count_pulses(watched):
    card = watched.card
    assert card.GT_MapCnt(1, 1000.0) == card.GT_MapCnt(2, 1000.0) == 0
    card.GT_LnXY(0.5, 0.25)
    watched.until_idle()
    assert watched.places() == (500, 250, 0, 0)
    assert watched.point() == pytest.approx((0.5, 0.25, 0.0, 0.0))
    card.GT_ArcXYP(0.5, 0.75, 0.25, 1)
    watched.until_idle()
    assert watched.places() == (500, 750, 0, 0)


def test_an_arc_in_unlike_units_has_no_solution(watched):
    watched.card.GT_MapCnt(1, 1000.0)
    assert watched.card.GT_ArcXY(1.0, 0.0, 90.0) == 6
    assert watched.card.GT_ArcXYP(1.0, 0.0, 9.0, 1) == 6


def test_speeds_count_user_units_where_the_settings_say_so():
    watched = Watched(speeds_in_user_units=True)
    card = watched.card
    card.GT_MapCnt(1, 10.0)
    card.GT_MvXY(100.0, 0.0, 0.1, 1.0)
    began = card.time_s
    assert watched.until_idle(1.0) - began == pytest.approx(1.0, abs=3e-3)
    assert watched.places() == (1000, 0, 0, 0)


def test_coordinates_count_from_the_zero_of_the_axis(watched):
    card = watched.card
    card.GT_LnXY(100.0, 50.0)
    watched.until_idle()
    assert card.GT_ZeroPos(1) == 0
    assert watched.point() == (0.0, 50.0, 0.0, 0.0)
    card.GT_LnXY(20.0, 0.0)
    watched.until_idle()
    assert watched.places() == (120, 0, 0, 0)


def test_fractions_of_a_pulse_are_carried_from_path_to_path(watched):
    for x in range(1, 11):
        assert watched.card.GT_LnXY(x * 0.3, 0.0) == 0
        watched.until_idle()
        assert watched.places()[0] == round(x * 0.3)


BLOCKS = [(30, 40, 40, "Y", "L", 2), (100, 3, 100, "X", "L", 3), (20, 0, 40, "X", "NR", 1), (0, 25, 50, "Y", "SR", 2)]


def test_blocks_are_stepped_as_a_3b_controller_steps_them(watched):
    card = watched.card
    card.GT_StrtList()
    card.GT_MvXY(12.6, 0.0, 5.0, 1.0)
    expected, at = [], (13, 0)
    for x, y, count, axis, sense, quadrant in BLOCKS:
        turn = {"L": 0, "NR": 1, "SR": -1}[sense]
        length = math.hypot(x, y) * (math.pi if turn else 1.0)
        assert card.step_block(x, y, count, "XY".index(axis), quadrant, turn, length) == 0
        places = plain_steps(PlainBlock(x, y, count, axis, sense, quadrant))
        expected += [(at[0] + dx, at[1] + dy) for dx, dy in places]
        at = expected[-1]
    card.GT_LnXY(0.0, 0.0)
    card.GT_StrtMtn()
    watched.until_idle()
    pulses = watched.pulses()
    stepped = (pulses.row > 0) & (pulses.row <= len(BLOCKS))
    made = list(zip(pulses.x_um[stepped].tolist(), pulses.y_um[stepped].tolist(), strict=True))
    assert made == expected
    assert watched.places() == (0, 0, 0, 0)
