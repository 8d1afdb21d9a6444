"""The machine of a run as its file would give it."""

import math
from typing import Any

from controller.motion.junctions import JunctionDeviation, SlowAt, StopEach
from parser.units import mm
from sim.setup.machine.controller_model import ControllerModel
from sim.setup.machine.machine import Machine
from sim.setup.machine.table_model import Motor, TableModel
from sim.setup.obstacles import Outline
from sim.setup.toml.writer import Section

DIGITS = 9
"""More than anyone sets; what is left of a change of units is rounded away."""


def machine_sections(machine: Machine) -> list[tuple[str, Section]]:
    """Sections of the machine file that makes the same machine."""
    force_n = machine.table.motor.force_curve[0][1]
    return [
        ("", {"name": machine.name}),
        ("[table]", {**_table(machine.table), "drive_force_limit_n": force_n}),
        ("[motor]", _motor(machine.table.motor)),
        ("[controller]", _controller(machine.controller)),
        ("[cutting]", {"area_rate_mm2_min": machine.area_rate_mm2_min}),
        ("[arm]", {} if machine.arm_um is None else {"outline_mm": outline_mm(machine.arm_um)}),
    ]


def outline_mm(outline: Outline) -> list[list[float]]:
    """Corners in mm."""
    return [[in_mm(corner.x), in_mm(corner.y)] for corner in outline]


def in_mm(length_um: float) -> float:
    """Millimetres as they were set."""
    return round(mm(length_um), DIGITS)


def _table(table: TableModel) -> Section:
    pairs = {"friction_{}_n": table.friction_n, "viscous_{}_n_s_mm": table.viscous_n_s_mm}
    pairs |= {"backlash_{}_um": table.backlash_um}
    return {
        "travel_x_mm": table.travel_x_mm,
        "travel_y_mm": table.travel_y_mm,
        "saddle_mass_kg": table.saddle_mass_kg,
        "carriage_mass_kg": table.carriage_mass_kg,
        "drive_stiffness_n_um": table.drive_stiffness_n_um,
        "drive_damping_ratio": table.drive_damping_ratio,
        **{key.format(axis): value for key, pair in pairs.items() for axis, value in zip("xy", pair, strict=True)},
    }


def _motor(motor: Motor) -> Section:
    own: dict[str, Any] = (
        {"electrical_period_um": motor.electrical_period_um}
        if motor.kind == "stepper"
        else {"following_error_limit_um": motor.following_error_limit_um}
    )
    curve = [list(point) for point in motor.force_curve[1:]]
    return {
        "kind": motor.kind,
        "step_time_ms": round(motor.step_time_s * 1e3, DIGITS),
        **own,
        **({"force_at_rate": curve} if curve else {}),
    }


def _controller(controller: ControllerModel) -> Section:
    limits = controller.limits
    told = {
        "path_acceleration_mm_s2": in_mm(limits.acceleration_um_s2),
        "cut_step_limit_hz": controller.cut_step_limit_hz,
        "jump_feed_mm_s": controller.jump_feed_mm_s,
        "axis_feed_x_mm_s": in_mm(limits.axis_speed_um_s[0]),
        "axis_feed_y_mm_s": in_mm(limits.axis_speed_um_s[1]),
        "axis_acceleration_x_mm_s2": in_mm(limits.axis_acceleration_um_s2[0]),
        "axis_acceleration_y_mm_s2": in_mm(limits.axis_acceleration_um_s2[1]),
        "start_feed_mm_s": in_mm(limits.start_speed_um_s),
        "corner_angle_deg": round(math.degrees(limits.corner_angle_rad), DIGITS),
        "corner_wait_ms": round(limits.corner_wait_s * 1e3, DIGITS),
        "jerk_mm_s3": in_mm(limits.jerk_um_s3),
        "servo_period_us": round(controller.servo_period_s * 1e6, DIGITS),
    }
    finite = {key: value for key, value in told.items() if math.isfinite(value)}
    return {**finite, **_junction(controller), "interpolator": controller.interpolation}


def _junction(controller: ControllerModel) -> Section:
    rule = controller.limits.junction
    if isinstance(rule, SlowAt):
        return {"junction": "slow", "corner_feed_mm_s": in_mm(rule.speed_um_s)}
    if isinstance(rule, JunctionDeviation):
        return {"junction": "deviation", "junction_deviation_um": rule.deviation_um}
    return {"junction": "stop" if isinstance(rule, StopEach) else "through"}
