"""Configurations of Klipper and LinuxCNC: what carries over stands in the machine file, all else stays and is told."""

import math
from pathlib import Path

import pytest

from controller.motion.limits import JunctionDeviation
from parser.findings.errors import SettingsError
from sim.setup.machine.foreign import carried_over, read_foreign
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.machine.motor import PositionLoop
from sim.setup.toml.keys import toml_text

KLIPPER = """
[include macros.cfg]
[printer]
kinematics: cartesian
max_velocity: 300
max_accel: 3000   # mm/s²
square_corner_velocity: 8.0
[stepper_x]
position_min: -5
position_max: 235
rotation_distance: 40
microsteps: 16
gear_ratio: 80:16
[stepper_y]
position_max = 220
rotation_distance: 3.2
microsteps: 16
"""
LINUXCNC = """
[EMC]
MACHINE = my mill
[TRAJ]
LINEAR_UNITS = inch
MAX_LINEAR_VELOCITY = 1.5
MAX_LINEAR_ACCELERATION = 20
[AXIS_X]
MIN_LIMIT = -1
MAX_LIMIT = 11
MAX_VELOCITY = 1.2
[JOINT_0]
MAX_VELOCITY = 9
MAX_ACCELERATION = 25
BACKLASH = 0.0005
FERROR = 0.05
SCALE = 20000
[JOINT_1]
MIN_LIMIT = 0
MAX_LIMIT = 8
BACKLASH = 0
"""

SERVOS = """
[EMCMOT]
SERVO_PERIOD = 1000000
[TRAJ]
LINEAR_UNITS = mm
[JOINT_0]
ENCODER_SCALE = 1000
FERROR = 0.5
P = 60
FF1 = 0.9
DEADBAND = 0.001
[JOINT_1]
ENCODER_SCALE = 1000
FERROR = 0.5
P = 60
FF1 = 0.9
DEADBAND = 0.001
"""


def written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, "utf-8")
    return path


def begun(folder: Path, text: str, base: str = "dk7740") -> Machine:
    """The machine of the file that is begun with a configuration."""
    sections = carried_over(load_machine(base), read_foreign(written(folder, "other.cfg", text)))
    return load_machine(str(written(folder, "mine.toml", toml_text(sections))))


def test_klipper_says_travel_acceleration_feed_and_how_a_corner_is_passed(tmp_path: Path) -> None:
    """A right angle is passed at the square corner velocity: v² = a δ sin(θ/2) / (1 − sin(θ/2)) with θ = 90°."""
    machine = begun(tmp_path, KLIPPER)
    assert (machine.table.travel_x_mm, machine.table.travel_y_mm) == (240.0, 220.0)
    assert machine.controller.limits.acceleration_um_s2 == 3e6
    assert machine.controller.jump_feed_mm_s == 300.0
    rule = machine.controller.limits.junction
    assert isinstance(rule, JunctionDeviation)
    half = math.sin(math.radians(45.0))
    assert math.sqrt(3e6 * rule.deviation_um * half / (1.0 - half)) == pytest.approx(8000.0, rel=1e-6)


def test_steps_that_are_not_drycuts_and_included_files_are_told(tmp_path: Path) -> None:
    """40 mm in 200 · 16 · 5 steps are 2.5 µm; 3.2 mm in 3,200 are 1 µm, as here."""
    foreign = read_foreign(written(tmp_path, "printer.cfg", KLIPPER))
    assert [(note.name, dict(note.values)) for note in foreign.dropped[:2]] == [
        ("includes", {"number": 1}),
        ("step", {"axis": "X", "step": 2.5}),
    ]
    assert {note.name for note in foreign.dropped[2:]} == {"masses", "stiffness", "friction", "force", "cutting"}


def test_linuxcnc_says_each_axis_in_its_unit(tmp_path: Path) -> None:
    machine, base = begun(tmp_path, LINUXCNC), load_machine("dk7740")
    limits = machine.controller.limits
    assert (machine.table.travel_x_mm, machine.table.travel_y_mm) == pytest.approx((12 * 25.4, 8 * 25.4))
    assert limits.axis_speed_um_s == pytest.approx((1.2 * 25400.0, math.inf))
    assert limits.axis_acceleration_um_s2 == pytest.approx((25 * 25400.0, math.inf))
    assert limits.acceleration_um_s2 == pytest.approx(20 * 25400.0)
    assert machine.table.backlash_um == pytest.approx((12.7, base.table.backlash_um[1]))
    assert "backlash_x_um" not in machine.assumed
    assert "backlash_y_um" in machine.assumed
    assert machine.table.moved_kg == base.table.moved_kg
    notes = {note.name: dict(note.values) for note in read_foreign(tmp_path / "other.cfg").dropped}
    assert notes["step"] == {"axis": "X", "step": 1.27}
    assert notes["following-error"] == {"error": 1270.0}


def test_linuxcnc_says_the_position_loop_of_joints_with_encoders(tmp_path: Path) -> None:
    machine = begun(tmp_path, SERVOS)
    assert machine.table.motor.kind == "servo"
    assert machine.table.motor.following_error_limit_um == 500.0
    assert machine.table.motor.loop == PositionLoop(60.0, 0.9, 0.001, "motor", 1.0)
    assert not {"step_time_ms", "electrical_period_um"} & set(machine.assumed)
    notes = {note.name for note in read_foreign(tmp_path / "other.cfg").dropped}
    assert "encoder" in notes
    assert "following-error" not in notes


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (SERVOS.replace("P = 60\nFF1 = 0.9\nDEADBAND = 0.001\n[JOINT_1]", "P = 50\n[JOINT_1]"), {"loops"}),
        (SERVOS.replace("ENCODER_SCALE = 1000", "STEP_SCALE = 1000"), set()),
        (SERVOS.replace("FERROR", "MIN_FERROR"), set()),
    ],
)
def test_loops_that_differ_or_are_none_do_not_carry_over(tmp_path: Path, text: str, told: set[str]) -> None:
    machine = begun(tmp_path, text)
    assert machine.table.motor == load_machine("dk7740").table.motor
    assert {note.name for note in read_foreign(tmp_path / "other.cfg").dropped} & {"loops", "encoder"} == told


@pytest.mark.parametrize("base", ["dk7740", "dk7750", "servo-400x500"])
@pytest.mark.parametrize("text", [KLIPPER, LINUXCNC, SERVOS])
def test_a_file_that_is_begun_is_a_machine_file_on_any_base(tmp_path: Path, base: str, text: str) -> None:
    assert begun(tmp_path, text, base).area_rate_mm2_min == load_machine(base).area_rate_mm2_min


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "no configuration"),
        ("B100B0B100GXL1", "no configuration"),
        ("[printer]\nmax_velocity: 1", "no configuration"),
        ("[printer]\nmax_accel: much", r"\[printer\] max_accel"),
        ("[printer]\nmax_accel: nan", r"\[printer\] max_accel"),
        ("[printer]\nmax_accel: 10\n[stepper_x]\nrotation_distance: 4\nmicrosteps: 8\ngear_ratio: 1:0", "gear_ratio"),
        ("\x00\x1b[31m", "no configuration"),
    ],
)
def test_what_is_none_is_refused_with_its_place(tmp_path: Path, text: str, why: str) -> None:
    with pytest.raises(SettingsError, match=why):
        read_foreign(written(tmp_path, "other.cfg", text))


def test_a_value_out_of_bounds_is_refused_when_the_file_is_read(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="path_acceleration"):
        begun(tmp_path, "[printer]\nmax_accel: 1e9\n")


def test_what_carries_over_was_not_measured(tmp_path: Path) -> None:
    """A base's margins are of its own values; a carried value has none."""
    base = load_machine("dk7740")._replace(assumed=(), measured=(("backlash_x_um", 0.3), ("drive_damping_ratio", 0.1)))
    foreign = read_foreign(written(tmp_path, "mill.ini", LINUXCNC))
    path = written(tmp_path, "own.toml", toml_text(carried_over(base, foreign)))
    assert load_machine(str(path)).measured == (("drive_damping_ratio", 0.1),)
    only = base._replace(measured=(("backlash_x_um", 0.3),))
    path = written(tmp_path, "own.toml", toml_text(carried_over(only, foreign)))
    assert load_machine(str(path)).measured == ()
