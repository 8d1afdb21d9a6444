"""Machine files: every key of table and motor read strictly, every shipped machine one that could stand in a shop."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from places import MACHINES, ROOT

from parser.controller_words import Axis
from parser.findings.errors import SettingsError
from parser.units import from_mm
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.machine.motor import PositionLoop
from sim.setup.machine.table import TableModel

SHIPPED = {path.stem: load_machine(path.stem) for path in sorted(MACHINES.glob("*.toml"))}
STEPPERS = {name: machine for name, machine in SHIPPED.items() if machine.table.motor.kind == "stepper"}
EACH = [pytest.param(machine, axis, id=f"{name} {axis.name}") for name, machine in SHIPPED.items() for axis in Axis]
EACH_STEPPER = [pytest.param(machine, id=name) for name, machine in STEPPERS.items()]

BARE = """
name = "bare"
[controller]
path_acceleration_mm_s2 = 100.0
cut_step_limit_hz = 180.0
jump_feed_mm_s = 0.5
[cutting]
area_rate_mm2_min = 105.0
[table]
travel_x_mm = 320.0
travel_y_mm = 400.0
saddle_mass_kg = 120.0
carriage_mass_kg = 95.0
drive_stiffness_n_um = 40.0
drive_damping_ratio = 0.7
drive_force_limit_n = 2000.0
"""


def table_of(tmp_path: Path, more: str) -> TableModel:
    """Table of a machine file that says this besides what it must."""
    path = tmp_path / "m.toml"
    path.write_text(BARE + more, "utf-8")
    return load_machine(str(path)).table


def test_a_machine_without_them_has_no_friction_no_backlash_and_a_plain_stepper(tmp_path: Path) -> None:
    table = table_of(tmp_path, "")
    assert (table.friction_n, table.viscous_n_s_mm, table.backlash_um) == ((0.0, 0.0), (0.0, 0.0), (0.0, 0.0))
    assert table.motor == ("stepper", 0.002, 6.0, math.inf, ((0.0, 2000.0),), None)
    assert table.moved_kg == (215.0, 95.0)


def test_keys_of_table_and_motor_go_where_they_belong(tmp_path: Path) -> None:
    table = table_of(
        tmp_path,
        "friction_x_n = 1\nfriction_y_n = 2\nviscous_x_n_s_mm = 3\nviscous_y_n_s_mm = 4\n"
        "backlash_x_um = 5\nbacklash_y_um = 6\n"
        "[motor]\nkind = 'stepper'\nstep_time_ms = 7\nelectrical_period_um = 8\n"
        "force_at_rate = [[100, 1500.5], [2000, 40]]",
    )
    assert (table.friction_n, table.viscous_n_s_mm, table.backlash_um) == ((1.0, 2.0), (3.0, 4.0), (5.0, 6.0))
    curve = ((0.0, 2000.0), (100.0, 1500.5), (2000.0, 40.0))
    assert table.motor == ("stepper", pytest.approx(0.007), 8.0, math.inf, curve, None)
    motor = table_of(tmp_path, "[motor]\nkind = 'servo'\nfollowing_error_limit_um = 9").motor
    assert (motor.kind, motor.following_error_limit_um) == ("servo", 9.0)
    assert motor.loop is None
    loop = "position_gain_per_s = 40\nfeed_forward = 0.5\nloop_period_ms = 2\nfeedback = 'scale'\nin_position_um = 0.5"
    motor = table_of(tmp_path, f"[motor]\nkind = 'servo'\nfollowing_error_limit_um = 9\n{loop}").motor
    assert motor.loop == PositionLoop(40.0, 0.5, 0.002, "scale", 0.5)


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("friction_x_n = -1", r"\[table\]: friction_x_n is -1; it must lie between 0 and 1000000"),
        ("friction_y_n = '20'", r"\[table\]: friction_y_n is a number; found '20'"),
        ("viscous_x_n_s_mm = nan", r"\[table\]: viscous_x_n_s_mm is nan"),
        ("viscous_y_n_s_mm = inf", r"\[table\]: viscous_y_n_s_mm is inf"),
        ("backlash_x_um = 10001", r"\[table\]: backlash_x_um is 10001; it must lie between 0 and 10000"),
        ("backlash_y_um = [2]", r"\[table\]: backlash_y_um is a number; found \[2\]"),
        ("backlash_um = 2", r"\[table\]: unknown key 'backlash_um'; did you mean backlash_"),
    ],
)
def test_bad_friction_and_backlash_are_refused_by_file_and_key(tmp_path: Path, line: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=rf"m\.toml: {complaint}"):
        table_of(tmp_path, line)


@pytest.mark.parametrize(
    ("lines", "complaint"),
    [
        ("kind = 'linear'", "kind is one of stepper, servo; found 'linear'"),
        ("kind = 3", "kind is a text and must be given; found 3"),
        ("kind = 'servo'", "following_error_limit_um is missing"),
        (
            "kind = 'servo'\nfollowing_error_limit_um = 100\nelectrical_period_um = 6",
            "electrical_period_um belongs to a stepper; found with kind = 'servo'",
        ),
        ("following_error_limit_um = 100", "following_error_limit_um belongs to a servo; found with kind = 'stepper'"),
        ("kind = 'servo'\nfollowing_error_limit_um = 0", "following_error_limit_um is 0; it must lie between 0.1"),
        ("electrical_period_um = 0", "electrical_period_um is 0; it must lie between 0.1 and 10000"),
        ("step_time_ms = -1", "step_time_ms is -1; it must lie between 0 and 1000"),
        ("step_time_ms = true", "step_time_ms is a number; found True"),
        ("position_gain_per_s = 40", "position_gain_per_s belongs to a servo; found with kind = 'stepper'"),
        (
            "kind = 'servo'\nfollowing_error_limit_um = 100\nfeedback = 'scale'",
            "feedback belongs to a position loop, which position_gain_per_s closes; found without that",
        ),
        (
            "kind = 'servo'\nfollowing_error_limit_um = 100\nposition_gain_per_s = 40\nstep_time_ms = 2",
            "step_time_ms is left out where position_gain_per_s closes a loop",
        ),
        (
            "kind = 'servo'\nfollowing_error_limit_um = 100\nposition_gain_per_s = 400\nloop_period_ms = 5",
            "position_gain_per_s times loop_period_ms is 2; from 2 on the loop runs away",
        ),
        ("step_time_s = 0.1", "unknown key 'step_time_s'; did you mean step_time_ms"),
        ("force_at_rate = 500", r"force_at_rate is a list of \[step rate in Hz, force in N\]; found 500"),
        (
            "force_at_rate = [500, 900]",
            r"force_at_rate is a list of \[step rate in Hz, force in N\]; found \[500, 900\]",
        ),
        ("force_at_rate = [[500]]", "force_at_rate is a list of"),
        ("force_at_rate = [[500, 900, 1]]", "force_at_rate is a list of"),
        ("force_at_rate = [['500', 900]]", "force_at_rate: Hz is a number; found '500'"),
        ("force_at_rate = [[500, nan]]", "force_at_rate: N is nan"),
        ("force_at_rate = [[500, 0]]", "force_at_rate: N is 0; it must lie between 0.1"),
        ("force_at_rate = [[-500, 900]]", "force_at_rate: Hz is -500; it must lie between 0"),
        ("force_at_rate = [[0, 900]]", r"force_at_rate: rates rise from above 0; found \[0.0\]"),
        ("force_at_rate = [[500, 900], [500, 800]]", r"force_at_rate: rates rise from above 0; found \[500.0, 500.0\]"),
        ("force_at_rate = [[500, 900], [400, 800]]", r"force_at_rate: rates rise from above 0; found \[500.0, 400.0\]"),
    ],
)
def test_bad_motors_are_refused_by_file_and_key(tmp_path: Path, lines: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=rf"m\.toml: \[motor\]: {complaint}"):
        table_of(tmp_path, f"[motor]\n{lines}")


def test_a_motor_that_is_no_table_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    path.write_text("motor = 'servo'\n" + BARE, "utf-8")
    with pytest.raises(SettingsError, match=r"m\.toml: motor is a table, \[motor\]; found 'servo'"):
        load_machine(str(path))


def force_n(machine: Machine, speed_um_s: float) -> float:
    """Force that the drive has while the axis steps at this speed."""
    rates, forces = zip(*machine.table.motor.force_curve, strict=True)
    return float(np.interp(speed_um_s, rates, forces))


def feeds_um_s(machine: Machine) -> tuple[float, float]:
    """Fastest cut, and jumps."""
    return machine.controller.cut_step_limit_hz, from_mm(machine.controller.jump_feed_mm_s)


def resisting_n(machine: Machine, axis: Axis, speed_um_s: float) -> float:
    """Friction of an axis at a speed."""
    table = machine.table
    return table.friction_n[axis] + table.viscous_n_s_mm[axis] * speed_um_s / 1e3


def test_the_classes_are_shipped_with_steppers_and_one_table_with_servos() -> None:
    assert sorted(STEPPERS) == ["dk7732", "dk7740", "dk7750"]
    assert sorted(set(SHIPPED) - set(STEPPERS)) == ["servo-400x500"]
    assert len({machine.name for machine in SHIPPED.values()}) == len(SHIPPED)


@pytest.mark.parametrize(
    ("name", "travel_mm"), [("dk7732", (320, 400)), ("dk7740", (400, 500)), ("dk7750", (500, 630))]
)
def test_travels_are_those_of_the_classes(name: str, travel_mm: tuple[int, int]) -> None:
    table = SHIPPED[name].table
    assert (table.travel_x_mm, table.travel_y_mm) == travel_mm
    row = f"{name.upper()} {travel_mm[0]}×{travel_mm[1]}"
    assert row in (ROOT / "docs" / "3b.md").read_text("utf-8")


@pytest.mark.parametrize("name", SHIPPED)
def test_every_value_of_table_and_motor_has_its_source_or_is_assumed(name: str) -> None:
    text = (MACHINES / f"{name}.toml").read_text("utf-8")
    body = text.partition("[table]\n")[2].partition("[controller]\n")[0]
    said = False
    for line in filter(None, body.splitlines()):
        commented = "#" in line
        pair = re.match(r"\w+_y_", line)  # of a pair for X and Y the first is commented
        key = re.match(r"\w+ = ", line)
        assert commented or line == "[motor]" or said or pair, line
        said = commented and not key  # a comment of its own speaks of the next line
    assert "assumed" in body


@pytest.mark.parametrize(("machine", "axis"), EACH)
def test_axes_ring_as_screw_drives_do(machine: Machine, axis: Axis) -> None:
    table = machine.table
    frequency_hz = math.sqrt(table.drive_stiffness_n_um * 1e6 / table.moved_kg[axis]) / (2.0 * math.pi)
    assert 40.0 <= frequency_hz <= 150.0


@pytest.mark.parametrize(("machine", "axis"), EACH)
def test_a_reversal_costs_a_few_micrometres(machine: Machine, axis: Axis) -> None:
    table = machine.table
    bent_um = table.friction_n[axis] / table.drive_stiffness_n_um
    assert 0.1 <= bent_um <= 1.0
    assert 1.0 <= table.backlash_um[axis] + 2.0 * bent_um <= 5.0


@pytest.mark.parametrize(("machine", "axis"), EACH)
def test_guides_resist_more_than_rolling_alone_and_less_than_sliding(machine: Machine, axis: Axis) -> None:
    weight_n = machine.table.moved_kg[axis] * 9.81
    assert 0.003 * weight_n < machine.table.friction_n[axis] < 0.05 * weight_n


@pytest.mark.parametrize(("machine", "axis"), EACH)
def test_drives_have_force_to_spare_at_cuts_and_jumps(machine: Machine, axis: Axis) -> None:
    accelerating_n = machine.table.moved_kg[axis] * machine.controller.limits.acceleration_um_s2 / 1e6
    for speed_um_s in feeds_um_s(machine):
        assert force_n(machine, speed_um_s) > 3.0 * (resisting_n(machine, axis, speed_um_s) + accelerating_n)


@pytest.mark.parametrize(("machine", "axis"), EACH)
def test_drives_take_a_corner_at_full_speed_without_loss(machine: Machine, axis: Axis) -> None:
    """A jump of speed bends an undamped spring by v √(m/k), and friction adds its own; reversing takes twice v."""
    table, motor = machine.table, machine.table.motor
    for speed_um_s in feeds_um_s(machine):
        swing_um = 2.0 * speed_um_s * math.sqrt(table.moved_kg[axis] / (table.drive_stiffness_n_um * 1e6))
        lag_um = swing_um + resisting_n(machine, axis, speed_um_s) / table.drive_stiffness_n_um
        assert lag_um * table.drive_stiffness_n_um < force_n(machine, speed_um_s)
        assert lag_um + table.backlash_um[axis] / 2.0 < motor.following_error_limit_um


@pytest.mark.parametrize("machine", [pytest.param(machine, id=name) for name, machine in SHIPPED.items()])
def test_force_falls_with_the_rate_and_reaches_past_the_jumps(machine: Machine) -> None:
    rates, forces = zip(*machine.table.motor.force_curve, strict=True)
    assert list(forces) == sorted(forces, reverse=True)
    assert rates[-1] > 2.0 * from_mm(machine.controller.jump_feed_mm_s)


@pytest.mark.parametrize("machine", EACH_STEPPER)
def test_force_of_a_stepper_is_that_of_its_motor_at_the_screw(machine: Machine) -> None:
    turn_mm = 24 / 80 * 24 / 120 * 4.0  # way of a turn of the motor (docs/3b.md, section 7)
    assert turn_mm * 1.5 / 360.0 * 1e3 == pytest.approx(1.0)  # µm a beat
    assert machine.table.motor.electrical_period_um == 6.0  # six beats
    held_n = 2.0 * math.pi * 0.88 / (turn_mm / 1e3) * 0.7
    assert machine.table.motor.force_curve[0][1] == pytest.approx(held_n, rel=0.02)
    assert machine.table.drive_damping_ratio == 0.7


@pytest.mark.parametrize("machine", EACH_STEPPER)
def test_step_time_of_a_stepper_is_half_a_swing_of_its_rotor(machine: Machine) -> None:
    swing_s = 2.0 * math.pi / math.sqrt(0.88 * 40 / 1.6e-5)  # N m, teeth, kg m²
    assert machine.table.motor.step_time_s == pytest.approx(swing_s / 2.0, rel=0.1)


def test_a_servo_trips_only_when_its_force_is_used_up() -> None:
    table = SHIPPED["servo-400x500"].table
    bent_um = table.motor.force_curve[0][1] / table.drive_stiffness_n_um
    assert bent_um < table.motor.following_error_limit_um
    assert table.motor.force_curve[0][1] == pytest.approx(
        2.0 * math.pi * 3 * 400 / (2 * math.pi * 50) / 4e-3 * 0.9, rel=0.02
    )
