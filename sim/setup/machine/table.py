"""The ``[table]`` section of a machine file: what is moved, by what, what resists, and where its slides then stand."""

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.units import mm
from sim.setup.machine.motor import FORCE_N, Motor, read_motor
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import (
    Number,
    ValueKind,
    limits,
)
from sim.setup.toml.reader import Bound, number, section

_TRAVEL = Number(Bound(1.0, 10_000.0), "mm")
_MASS = Number(Bound(0.01, 100_000.0), "kg")
_FRICTION = Number(Bound(0.0, 1e6), "N")
_VISCOUS = Number(Bound(0.0, 1e6), "N s/mm")
_SKEW = Bound(-1e4, 1e4)
_PLACE_MM = Bound(-10_000.0, 10_000.0)
_PITCH_UM = Bound(-1e4, 1e4)
_BACKLASH = Number(Bound(0.0, 1e4), "µm")


Points = tuple[tuple[float, float], ...]
"""Places mm and errors µm, the places rising."""


class Geometry(NamedTuple):
    """How far slides stand from where their screws say: what no drive can tell, and only an outer measure finds.

    Attributes
    ----------
    squareness_urad
        By how much Y leans: X moves by as much of a way in Y, the other way.
    scale_ppm
        By how much each axis moves too far.
    pitch_error
        Of each axis places from the corner of the travel, mm, and by how much it stands too far there, µm; straight
        between them, and as at the last one beyond.
    """

    squareness_urad: float = 0.0
    scale_ppm: tuple[float, float] = (0.0, 0.0)
    pitch_error: tuple[Points, Points] = ((), ())

    def placed(self, place_um: Floats, start_um: Floats) -> Floats:
        """Where places (n, 2) of the slides, by their screws, are; from the corner of the travel, µm.

        The program's start (2,) is where the wire is brought by eye or by touch: there nothing is off.
        """
        if self == Geometry():
            return place_um
        by = place_um - start_um
        off: Floats = 1e-6 * np.array(self.scale_ppm) * by
        off[:, 0] -= 1e-6 * self.squareness_urad * by[:, 1]
        for axis, points in enumerate(self.pitch_error):
            if points:
                at, error = np.array(points).T
                of_start = float(np.interp(mm(float(start_um[axis])), at, error))
                off[:, axis] += np.interp(mm(place_um[:, axis]), at, error) - of_start
        placed: Floats = place_um + off
        return placed


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
    geometry: Geometry = Geometry()

    @property
    def moved_kg(self) -> tuple[float, float]:
        """Mass that the X and the Y drive have to move."""
        return self.saddle_mass_kg + self.carriage_mass_kg, self.carriage_mass_kg


def _pitch_error(axis: int) -> Callable[[TableModel], Points | None]:
    """How the pitch errors of an axis are found; there are none where nobody measured them."""
    return lambda table: table.geometry.pitch_error[axis] or None


class _PitchError(ValueKind):
    """Points [place mm, error µm], the places rising."""

    name = "pitch-error"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Points:
        """Its points."""
        value, where = table[key], f"{where}: {key}"
        if not isinstance(value, list) or not all(isinstance(point, list) and len(point) == 2 for point in value):
            raise SettingsError("no-list-of-pitch-errors", where=where, found=value)
        points = tuple(
            (number(at, _PLACE_MM, f"{where}: mm"), number(off, _PITCH_UM, f"{where}: µm")) for at, off in value
        )
        if any(later[0] <= earlier[0] for earlier, later in pairwise(points)):
            raise SettingsError("places-do-not-rise", where=where)
        return points

    def written(self, value: Any) -> list[list[float]]:
        """A list of lists."""
        return [list(point) for point in value]

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        place, error = ({"type": "number", **limits(bound)} for bound in (_PLACE_MM, _PITCH_UM))
        point = {"type": "array", "minItems": 2, "maxItems": 2, "prefixItems": [place, error]}
        return {"type": "array", "items": point}


TABLE = Section(
    "table",
    (
        Key("travel_x_mm", _TRAVEL),
        Key("travel_y_mm", _TRAVEL),
        Key("saddle_mass_kg", _MASS),
        Key("carriage_mass_kg", _MASS),
        Key("drive_stiffness_n_um", Number(Bound(1e-3, 1e5), "N/µm")),
        Key("drive_damping_ratio", Number(Bound(0.01, 10.0))),
        Key("friction_x_n", _FRICTION, "friction_n.0", default=0.0),
        Key("friction_y_n", _FRICTION, "friction_n.1", default=0.0),
        Key("viscous_x_n_s_mm", _VISCOUS, "viscous_n_s_mm.0", default=0.0),
        Key("viscous_y_n_s_mm", _VISCOUS, "viscous_n_s_mm.1", default=0.0),
        Key("backlash_x_um", _BACKLASH, "backlash_um.0", default=0.0),
        Key("backlash_y_um", _BACKLASH, "backlash_um.1", default=0.0),
        Key("squareness_urad", Number(_SKEW, "µrad"), "geometry.squareness_urad", default=0.0),
        Key("scale_x_ppm", Number(_SKEW, "ppm"), "geometry.scale_ppm.0", default=0.0),
        Key("scale_y_ppm", Number(_SKEW, "ppm"), "geometry.scale_ppm.1", default=0.0),
        Key("pitch_error_x", _PitchError(), default=(), get=_pitch_error(0)),
        Key("pitch_error_y", _PitchError(), default=(), get=_pitch_error(1)),
        Key("drive_force_limit_n", Number(FORCE_N, "N"), get=lambda table: table.motor.force_curve[0][1]),
    ),
    fills="table",
)


def read_table(content: Mapping[str, Any], where: str) -> TableModel:
    """Table of the sections ``[table]`` and ``[motor]`` of a machine file. SettingsError names the file and the key."""
    value = TABLE.read_in(content, where)
    force_n = value.pop("drive_force_limit_n")
    pitch_error = tuple(value.pop(f"pitch_error_{axis}") for axis in "xy")
    value["geometry"] = Geometry(pitch_error=pitch_error, **value["geometry"])
    return TableModel(motor=read_motor(section(content, "motor", where), force_n, f"{where}: [motor]"), **value)


TableEngine = Literal["compiled", "pymunk"]
"""What works out the motion of a table: a compiled loop, or the same in Python with bodies that pymunk moves."""
