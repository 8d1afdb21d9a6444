"""The host drives the card: its pulses are those of the plan, whatever the list holds."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from lawful import assert_plan_is_lawful
from line_words import line_words
from strategies import program_text, programs

from controller.card.calls.base import Logged, slice_of
from controller.card.core.settings import CardSettings
from controller.card.ge import GECard
from controller.host.entries import Drive, Interpolation, entries_of
from controller.host.host import Host
from controller.motion.limits import (
    Feeds,
    JunctionDeviation,
    MotionLimits,
    SlowAt,
    StopEach,
    Through,
    path_of,
    row_limits,
)
from controller.motion.planner import plan_rows
from controller.stepping.interpolators import EqualTime, PointByPoint
from controller.stepping.pulses import Pulses
from controller.stepping.steps import interpolate
from parser.program import load_program, parse_program
from parser.toolpath import Toolpath

FEEDS = Feeds(cut_um_s=500.0, jump_um_s=4000.0)
LIMITS = MotionLimits(acceleration_um_s2=1e5, axis_acceleration_um_s2=(5e4, 7e4), junction=JunctionDeviation(0.1))
SQUARE = "B500B0B500GXL1 B0B700B700GYL2 B500B0B500GXL3 B0B700B700GYL4 DD"
PERIOD_S = 200e-6


def drive_of(text: str, interpolation: Interpolation, limits: MotionLimits = LIMITS) -> Drive:
    return drive_along(parse_program(text).toolpath, interpolation, limits)


def drive_along(toolpath: Toolpath, interpolation: Interpolation, limits: MotionLimits = LIMITS) -> Drive:
    rows = row_limits(toolpath, FEEDS, limits)
    plan = plan_rows(rows, jerk_um_s3=limits.jerk_um_s3)
    assert_plan_is_lawful(plan, rows, jerk_um_s3=limits.jerk_um_s3)
    return Drive(toolpath, rows, plan, (0, 0), interpolation)


def driven(drive: Drive, card: CardSettings | None = None) -> tuple[Pulses, list[Logged]]:
    calls: list[Logged] = []
    taken = list(Host(drive, card or CardSettings(servo_period_s=PERIOD_S), calls.append).pulses())
    if not taken:
        return Pulses(*(np.zeros(0) for _ in range(4))), calls
    return Pulses(*(np.concatenate(columns) for columns in zip(*taken, strict=True))), calls


def planned(drive: Drive) -> Pulses:
    """Pulses of the plan without a card."""
    if drive.interpolation == "point-by-point":
        stepping = PointByPoint(interpolate(drive.toolpath), drive.plan, 0.0, (0, 0))
    else:
        stepping = EqualTime(path_of(drive.toolpath), drive.plan, 0.0, (0, 0), PERIOD_S)
    parts = list(stepping.pulses(drive.plan.duration_s + 1.0))
    return Pulses(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


@pytest.mark.parametrize("capacity", [8, 4096])
def test_stepped_pulses_are_those_of_the_plan(capacity: int) -> None:
    drive = drive_of(SQUARE * 20, "point-by-point")
    pulses, _ = driven(drive, CardSettings(capacity=capacity))
    wanted = planned(drive)
    assert np.array_equal(pulses.x_um, wanted.x_um)
    assert np.array_equal(pulses.y_um, wanted.y_um)
    assert np.array_equal(pulses.row, wanted.row)
    assert pulses.t_s == pytest.approx(wanted.t_s, abs=1e-6)  # s


@pytest.mark.alike(1)
@pytest.mark.parametrize("rule", [Through(), StopEach(), JunctionDeviation(0.1)])
@pytest.mark.parametrize("interpolation", ["point-by-point", "card"])
@settings(max_examples=15, deadline=None)
@given(programs)
def test_the_card_takes_the_time_of_the_plan_and_ends_where_it_ends(
    rule: object, interpolation: Interpolation, program: list
) -> None:
    limits = LIMITS._replace(junction=rule)
    drive = drive_of(program_text(program), interpolation, limits)
    if not len(drive.plan.speed_um_s):
        return
    pulses, calls = driven(drive)
    wanted = planned(drive)
    exact = np.rint(np.round(drive.toolpath.end_um[-1] - drive.toolpath.start_um[0], 6))
    end = interpolate(drive.toolpath).corner_um[-1] if interpolation == "point-by-point" else exact
    assert [pulses.x_um[-1], pulses.y_um[-1]] == end.tolist()
    if interpolation == "point-by-point":
        assert len(pulses.t_s) == len(wanted.t_s)
        assert pulses.t_s == pytest.approx(wanted.t_s, abs=1e-6)  # s
    else:  # periods of the card's clock do not begin with the motion
        assert pulses.t_s[-1] == pytest.approx(wanted.t_s[-1], abs=PERIOD_S + 1e-6)  # s
    assert all(call.answer in (0, None) or isinstance(call.answer, tuple) for call in calls)


def circle_of_chords(chords: int) -> str:
    """A circle of R 2 mm in chords of a few µm."""
    turn = 2.0 * math.pi / chords
    points = [(round(2000 * math.cos(k * turn)), round(2000 * math.sin(k * turn))) for k in range(chords + 1)]
    words = [line_words(c - a, d - b) for (a, b), (c, d) in itertools.pairwise(points)]
    return " ".join(f"B{w.x_um}B{w.y_um}B{w.count_um}G{w.count_axis.name}L{w.quadrant}" for w in words)


@pytest.mark.alike(3)
@pytest.mark.parametrize(
    "limits",
    [
        MotionLimits(5e3),
        MotionLimits(5e3, jerk_um_s3=5e4),
        MotionLimits(5e3, jerk_um_s3=5e3, junction=SlowAt(100.0), corner_angle_rad=0.02),
        MotionLimits(5e3, start_speed_um_s=20.0, junction=StopEach()),
        MotionLimits(5e3, corner_angle_rad=0.02, corner_wait_s=0.003),
    ],
    ids=["through", "jerk", "jerk and slow", "stops", "waits"],
)
@pytest.mark.parametrize("interpolation", ["point-by-point", "card"])
def test_a_list_shorter_than_the_program_changes_nothing(interpolation: Interpolation, limits: MotionLimits) -> None:
    drive = drive_of(circle_of_chords(400), interpolation, limits)
    card = CardSettings(capacity=60, servo_period_s=PERIOD_S, jerk_pulse_ms3=limits.jerk_um_s3 / 1e9)
    pulses, _ = driven(drive, card)
    wanted = planned(drive)
    assert np.array_equal(pulses.x_um, wanted.x_um)
    assert np.array_equal(pulses.y_um, wanted.y_um)
    assert pulses.t_s == pytest.approx(wanted.t_s, abs=1e-4)  # s: at rest, 10⁻⁹ µm of path take that long


def test_entries_are_told_in_the_cards_units() -> None:
    entries = entries_of(
        drive_of(SQUARE, "card", LIMITS._replace(junction=StopEach(), axis_acceleration_um_s2=(5e4, 7e4)))
    )
    assert entries.speed_pulse_ms.tolist() == [0.5] * 4
    assert entries.acceleration_pulse_ms2.tolist() == [0.05, 0.07, 0.05, 0.07]
    assert entries.end_pulse_ms.tolist()[:3] == [0.0] * 3
    assert np.isnan(entries.end_pulse_ms[3])  # the list ends at rest by itself
    assert entries.end_um.tolist() == [[500.0, 0.0], [500.0, 700.0], [0.0, 700.0], [0.0, 0.0]]


def test_waits_at_corners_are_entries() -> None:
    drive = drive_of(SQUARE, "card", LIMITS._replace(corner_wait_s=0.25))
    pulses, calls = driven(drive)
    assert [call.arguments for call in calls if call.name == "GT_Delay"] == [(250,)] * 3
    assert pulses.t_s[-1] == pytest.approx(planned(drive).t_s[-1], abs=PERIOD_S + 1e-6)  # s
    assert drive.plan.duration_s > 0.75


def test_arcs_of_several_turns_are_several_entries_and_one_block() -> None:
    drive = drive_of("B500B0B5000GYNR1", "card")
    assert entries_of(drive).angle_deg == pytest.approx([300.0] * 3)
    pulses, _ = driven(drive)
    assert set(pulses.row.tolist()) == {0}
    assert len(entries_of(drive._replace(interpolation="point-by-point")).row) == 1


def test_blocks_without_length_are_left_out_and_their_borders_joined() -> None:
    drive = drive_of("B500B0B500GXL1 B5B5B0GXL1 B0B500B500GYL2", "point-by-point", LIMITS._replace(junction=StopEach()))
    entries = entries_of(drive)
    assert entries.row.tolist() == [0, 2]
    assert entries.end_pulse_ms[0] == 0.0
    assert set(driven(drive)[0].row.tolist()) == {0, 2}


def test_blocks_that_whole_um_leave_no_steps_are_left_out() -> None:
    text = "G92 X0 Y0\nG01 X1. Y0\nG01 X1.0003 Y0.0002\nG01 X1. Y1.\nM02\n"
    drive = drive_along(load_program(text.encode(), "short.iso").toolpath, "point-by-point")
    assert drive.limits.length_um[1] > 0.0
    assert set(driven(drive)[0].row.tolist()) == {0, 2}


def test_a_program_without_motion_runs_through() -> None:
    pulses, calls = driven(drive_of("B5B5B0GXL1", "card"))
    assert not len(pulses.t_s)
    assert calls[-1].name == "GT_Close"


def test_a_jerk_limit_reaches_the_card() -> None:
    limits = LIMITS._replace(jerk_um_s3=1e6, junction=StopEach())
    drive = drive_of(SQUARE, "point-by-point", limits)
    pulses, _ = driven(drive, CardSettings(jerk_pulse_ms3=1e6 / 1e9))
    assert drive.plan.jerk_um_s3.any()
    assert pulses.t_s == pytest.approx(planned(drive).t_s, abs=1e-6)  # s


@pytest.mark.parametrize("seconds", [0.001, 10.0, 3600.0, 1e6, 1e9])
def test_a_sleep_of_years_is_no_more_than_so_many_slices(seconds: float) -> None:
    card = GECard(CardSettings())
    slices = sum(1 for _ in card.sleeping(seconds * 1e3, slice_of(seconds)))
    assert slices <= 100_001
    assert card.time_s == seconds
