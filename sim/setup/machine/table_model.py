"""The ``[table]`` and ``[motor]`` sections of a machine file: what is moved, what moves it, and what resists."""

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any, Literal, NamedTuple

from parser.findings.errors import SettingsError
from sim.setup.toml.reader import Bound, number, numbers, refuse_unknown, text

_FORCE_N = Bound(0.1, 1e6)
_TABLE = {
    "travel_x_mm": Bound(1.0, 10_000.0),
    "travel_y_mm": Bound(1.0, 10_000.0),
    "saddle_mass_kg": Bound(0.01, 100_000.0),
    "carriage_mass_kg": Bound(0.01, 100_000.0),
    "drive_stiffness_n_um": Bound(1e-3, 1e5),
    "drive_damping_ratio": Bound(0.01, 10.0),
    "drive_force_limit_n": _FORCE_N,
}
_RESISTING = {
    "friction_x_n": Bound(0.0, 1e6),
    "friction_y_n": Bound(0.0, 1e6),
    "viscous_x_n_s_mm": Bound(0.0, 1e6),
    "viscous_y_n_s_mm": Bound(0.0, 1e6),
    "backlash_x_um": Bound(0.0, 1e4),
    "backlash_y_um": Bound(0.0, 1e4),
}
_MOTOR = {
    "step_time_ms": Bound(0.0, 1e3),
    "electrical_period_um": Bound(0.1, 1e4),
    "following_error_limit_um": Bound(0.1, 1e6),
}
_OF_KIND = {"stepper": "electrical_period_um", "servo": "following_error_limit_um"}
_RATE_HZ = Bound(0.0, 1e7)


class Motor(NamedTuple):
    """What turns the screw of each axis.

    Attributes
    ----------
    kind
        A stepper slips by whole electrical periods past its pull-out, a servo trips on its following error.
    step_time_s
        Time the motor takes for one step: it turns at constant speed from one place to the next.
    electrical_period_um
        Way of the table in one electrical period: six beats of 1 µm of a three-phase stepper with six beats.
    following_error_limit_um
        Lag at which a servo trips; infinite for a stepper.
    force_curve
        (step rate Hz, force N) from standstill on, rates rising; the force is linear between and constant past the
        last.
    """

    kind: Literal["stepper", "servo"]
    step_time_s: float
    electrical_period_um: float
    following_error_limit_um: float
    force_curve: tuple[tuple[float, float], ...]


class TableModel(NamedTuple):
    """Moving masses, drives and what resists them; mm, kg, N as named, pairs for X and Y.

    The X drive moves saddle and carriage, the Y drive the carriage.
    """

    travel_x_mm: float
    travel_y_mm: float
    saddle_mass_kg: float
    carriage_mass_kg: float
    drive_stiffness_n_um: float
    drive_damping_ratio: float
    motor: Motor
    friction_n: tuple[float, float] = (0.0, 0.0)
    viscous_n_s_mm: tuple[float, float] = (0.0, 0.0)
    backlash_um: tuple[float, float] = (0.0, 0.0)

    @property
    def moved_kg(self) -> tuple[float, float]:
        """Mass that the X and the Y drive have to move."""
        return self.saddle_mass_kg + self.carriage_mass_kg, self.carriage_mass_kg


def read_table(table: Mapping[str, Any], motor: Mapping[str, Any], where: str) -> TableModel:
    """Table of the sections ``[table]`` and ``[motor]``. SettingsError names the file and the key."""
    value = numbers(table, _TABLE, f"{where}: [table]", optional=_RESISTING)
    resisting = dict.fromkeys(_RESISTING, 0.0) | value
    return TableModel(
        motor=_motor(motor, value.pop("drive_force_limit_n"), f"{where}: [motor]"),
        **{key: value[key] for key in _TABLE if key in value},
        friction_n=(resisting["friction_x_n"], resisting["friction_y_n"]),
        viscous_n_s_mm=(resisting["viscous_x_n_s_mm"], resisting["viscous_y_n_s_mm"]),
        backlash_um=(resisting["backlash_x_um"], resisting["backlash_y_um"]),
    )


def _motor(table: Mapping[str, Any], force_n: float, where: str) -> Motor:
    """Motor of a section; `force_n` is what it pulls at standstill."""
    refuse_unknown(table, ("kind", "force_at_rate", *_MOTOR), where)
    kind = text(table, "kind", where, "stepper")
    if kind not in _OF_KIND:
        raise SettingsError(f"{where}: kind is one of {', '.join(_OF_KIND)}; found {kind!r}")
    for of, key in _OF_KIND.items():
        if kind != of and key in table:
            raise SettingsError(f"{where}: {key} belongs to a {of}; found with kind = {kind!r}")
    if kind == "servo" and "following_error_limit_um" not in table:
        raise SettingsError(f"{where}: following_error_limit_um is missing")
    given = {key: entry for key, entry in table.items() if key in _MOTOR}
    value = {"step_time_ms": 2.0, "electrical_period_um": 6.0, "following_error_limit_um": math.inf}
    value |= numbers(given, {}, where, optional=_MOTOR)
    return Motor(
        kind="stepper" if kind == "stepper" else "servo",
        step_time_s=value["step_time_ms"] / 1e3,
        electrical_period_um=value["electrical_period_um"],
        following_error_limit_um=value["following_error_limit_um"],
        force_curve=((0.0, force_n), *_force_at_rate(table.get("force_at_rate", []), where)),
    )


def _force_at_rate(value: object, where: str) -> tuple[tuple[float, float], ...]:
    """Points [step rate Hz, force N] of a curve that begins with the force limit at standstill."""
    where = f"{where}: force_at_rate"
    if not isinstance(value, list) or not all(isinstance(point, list) and len(point) == 2 for point in value):
        raise SettingsError(f"{where} is a list of [step rate in Hz, force in N]; found {value!r}")
    points = tuple(
        (number(rate, _RATE_HZ, f"{where}: Hz"), number(force, _FORCE_N, f"{where}: N")) for rate, force in value
    )
    rates = (0.0, *(rate for rate, _ in points))
    if any(later <= earlier for earlier, later in pairwise(rates)):
        raise SettingsError(f"{where}: rates rise from above 0; found {list(rates[1:])}")
    return points
