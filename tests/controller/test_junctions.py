"""Junctions: how fast each rule lets a corner be passed, on turns whose answer is known."""

import math
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from paths import Pen

from controller.motion.limits import (
    CornerTime,
    Junction,
    JunctionDeviation,
    Path,
    SlowAt,
    StopEach,
    Through,
    junction_speeds,
    path_of,
    turns,
)
from parser.geometry.curves import Floats
from parser.toolpath import Toolpath

FIVE_DEGREES = math.radians(5.0)


def corner(turn: float, length: float = 100.0) -> Toolpath:
    """Two lines that meet at (100, 0) with a turn."""
    end = 100.0 + length * math.cos(turn), length * math.sin(turn)
    return Pen().to(100.0, 0.0).to(*end).path()


def speeds(toolpath: Toolpath, rule: Junction, a: float = 1000.0) -> Floats:
    return junction_speeds(path_of(toolpath), rule, FIVE_DEGREES, np.full(len(toolpath), a))


@given(st.floats(-math.pi, math.pi), st.floats(1.0, 1e5))
def test_the_turn_is_the_angle_between_directions(turn: float, length: float) -> None:
    assert turns(path_of(corner(turn, length)))[0] == pytest.approx(abs(turn), abs=1e-12)


@pytest.mark.parametrize("turn", [1e-9, 1e-6, math.pi - 1e-9])
def test_turns_near_straight_and_near_back_are_exact(turn: float) -> None:
    assert turns(path_of(corner(turn)))[0] == pytest.approx(turn, abs=1e-15)


def test_a_turn_back_is_half_a_turn_and_a_point_on_a_line_none() -> None:
    path = path_of(Pen().to(30.0, 40.0).to(60.0, 80.0).to(0.0, 0.0).path())
    assert turns(path).tolist() == [0.0, math.pi]


def test_arcs_turn_by_their_tangents() -> None:
    smooth = Pen().to(100.0, 0.0).arc(100.0, 50.0, math.pi / 2).to(150.0, 200.0)
    path = path_of(smooth.arc(100.0, 200.0, math.pi).arc(100.0, 200.0, -0.5).path())
    assert turns(path) == pytest.approx([0.0, 0.0, 0.0, math.pi], abs=1e-12)


def test_rows_without_length_stand_between_the_rows_that_meet() -> None:
    toolpath = Pen().to(0.0, 0.0).to(10.0, 0.0).to(10.0, 0.0).to(10.0, 0.0).to(10.0, 10.0).to(10.0, 10.0).path()
    assert turns(path_of(toolpath)) == pytest.approx([0.0, math.pi / 2, 0.0, 0.0, 0.0])
    assert speeds(toolpath, SlowAt(3.0)).tolist() == [math.inf, 3.0, math.inf, math.inf, math.inf]
    deviation = speeds(toolpath, JunctionDeviation(1.0))
    assert np.isfinite(deviation).tolist() == [False, True, False, False, False]


def test_full_speed_through_limits_nothing() -> None:
    assert speeds(corner(math.pi), Through()).tolist() == [math.inf]


def test_slow_at_corners_begins_beyond_the_angle() -> None:
    for turn, speed in ((0.0, math.inf), (math.radians(4.99), math.inf), (math.radians(5.01), 7.0), (math.pi, 7.0)):
        assert speeds(corner(turn), SlowAt(7.0)).tolist() == [speed]


def test_stop_at_each_block_stops_on_a_straight_line_too() -> None:
    assert speeds(corner(0.0), StopEach()).tolist() == [0.0]


@given(st.floats(0.01, math.pi - 0.01))
def test_junction_deviation_is_the_circle_that_leaves_the_corner_by_it(turn: float) -> None:
    deviation, a = 2.0, 1000.0
    radius = speeds(corner(turn), JunctionDeviation(deviation), a)[0] ** 2 / a
    # The centre lies radius / cos(turn/2) from the corner.
    assert radius / math.cos(turn / 2.0) - radius == pytest.approx(deviation, rel=1e-9)


def test_junction_deviation_takes_the_lesser_acceleration_of_the_two_rows() -> None:
    path = path_of(corner(math.pi / 2))
    pairs = ([10.0, 90.0], [90.0, 10.0], [90.0, 90.0])
    rising, falling, high = (junction_speeds(path, JunctionDeviation(1.0), 0.0, np.array(a))[0] for a in pairs)
    assert rising == falling == pytest.approx(high / 3.0)


def test_junction_deviation_at_a_right_angle() -> None:
    # v² = a δ sin 45° / (1 − sin 45°) = 2.41421 a δ
    assert speeds(corner(math.pi / 2), JunctionDeviation(1.0))[0] == pytest.approx(
        math.sqrt(2414.2135623731), rel=1e-12
    )


def test_no_speed_turns_back_and_any_goes_straight_under_junction_deviation() -> None:
    assert speeds(corner(math.pi), JunctionDeviation(1.0))[0] == pytest.approx(0.0, abs=1e-6)
    assert speeds(corner(0.0), JunctionDeviation(1.0))[0] == math.inf


@given(st.floats(0.01, math.pi))
def test_corner_time_turns_the_velocity_at_its_acceleration(turn: float) -> None:
    speed = speeds(corner(turn), CornerTime(0.02, 5000.0))[0]
    change = speed * np.array([math.cos(turn) - 1.0, math.sin(turn)])
    assert math.hypot(*change) == pytest.approx(0.02 * 5000.0, rel=1e-9)


def test_corner_time_limits_nothing_on_a_straight_line() -> None:
    assert speeds(corner(0.0), CornerTime(0.02, 5000.0))[0] == math.inf


@pytest.mark.parametrize("rule", [Through(), SlowAt(3.0), StopEach(), JunctionDeviation(1.0), CornerTime(0.1, 10.0)])
def test_paths_of_one_row_and_none_have_no_junction(rule: Junction) -> None:
    path = path_of(corner(1.0))
    for n in (0, 1):
        short = Path(*(getattr(path, field.name)[:n] for field in fields(path)))
        assert junction_speeds(short, rule, FIVE_DEGREES, np.ones(n)).tolist() == []


@pytest.mark.parametrize("rule", [Through(), SlowAt(3.0), JunctionDeviation(1.0), CornerTime(0.1, 10.0)])
def test_a_point_on_a_line_changes_nothing(rule: Junction) -> None:
    # Coordinates that have no exact double: directions agree to rounding only.
    path = Pen(0.1, 0.7).to(33.3, 44.4)
    for share in (0.3, 0.7, 1.0):
        path.to(33.3 + share * 33.2, 44.4 + share * 43.7)
    assert (speeds(path.path(), rule) > 1e4).all()


def test_no_rounding_of_a_direction_is_a_corner() -> None:
    path = path_of(Pen().to(31.6, 10.5).to(94.8, 31.5).to(189.6, 63.0).to(200.0, 0.0).path())
    assert turns(path)[:2].tolist() == [0.0, 0.0]
    assert turns(path)[2] > 1.0
