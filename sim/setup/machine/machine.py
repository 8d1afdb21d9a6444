"""Machine files: table, motor, controller and cutting rates of one machine, read from TOML and written as it.

The ``[controller]`` section of a machine file: limits of motion, the rule at junctions, and the interpolator.
"""

import math
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

from controller.card.core.settings import UM_S3_PER_PULSE_MS3, CardSettings
from controller.host.entries import Interpolation
from controller.motion.limits import Feeds, Junction, JunctionDeviation, MotionLimits, SlowAt, StopEach, Through
from parser.dialect.reader import Registers
from parser.findings.errors import Message, SettingsError
from parser.units import from_mm
from sim.setup.dialect import REGISTERS
from sim.setup.machine.guides import GUIDES, Guides, read_guides
from sim.setup.machine.motor import MOTOR
from sim.setup.machine.table import TABLE, TableEngine, TableModel, read_table
from sim.setup.obstacles import ARM, Outline
from sim.setup.settable import INTERPOLATOR
from sim.setup.spark import SPARK, Spark, read_spark
from sim.setup.toml.keys import Key, Section, WrittenSection
from sim.setup.toml.kinds import (
    DEGREES_AS_RAD,
    MM_AS_UM,
    MS_AS_S,
    US_AS_S,
    Keys,
    Margins,
    Number,
    OneOf,
    Text,
)
from sim.setup.toml.reader import AREA_RATE_MM2_MIN, Bound, load_toml

_SPEED = Bound(1e-3, 1e3)
_FEED = Number(_SPEED, "mm/s", MM_AS_UM)
_ACCELERATION = Number(Bound(0.01, 1e5), "mm/s²", MM_AS_UM)
_JUNCTIONS: Mapping[str, type[Any]] = {
    "through": Through,
    "slow": SlowAt,
    "stop": StopEach,
    "deviation": JunctionDeviation,
}
_OWN_NUMBER = {"slow": "corner_feed_mm_s", "deviation": "junction_deviation_um"}


class ControllerModel(NamedTuple):
    """How the controller moves.

    Attributes
    ----------
    limits
        Of motion, µm and s.
    cut_step_limit_hz
        Highest feed of a cut, in steps of 1 µm of path a second.
    jump_feed_mm_s
        Feed of jumps.
    interpolation
        How it makes steps of a path.
    servo_period_s
        Period of the card's own interpolator.
    registers
        Values of offset registers that stand on it, for ISO programs that name one and do not set it.
    """

    limits: MotionLimits
    cut_step_limit_hz: float
    jump_feed_mm_s: float
    interpolation: Interpolation
    servo_period_s: float
    registers: Registers = ()

    @property
    def card_settings(self) -> CardSettings:
        """Settings of the emulated card that moves as this controller does; one pulse is 1 µm."""
        return CardSettings(
            servo_period_s=self.servo_period_s,
            jerk_pulse_ms3=self.limits.jerk_um_s3 / UM_S3_PER_PULSE_MS3,
        )


class _WholeMs(Number):
    """A wait in whole milliseconds, as controllers take it."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Any:
        """The wait, ms."""
        wait_ms = super().checked(table, key, where)
        if wait_ms != int(wait_ms):
            raise SettingsError("key-not-whole", where=where, key=key, found=wait_ms)
        return wait_ms


def _of_rule(attribute: str) -> Callable[[ControllerModel], float | None]:
    """How the number of a rule at junctions is found; other rules have none."""
    return lambda controller: getattr(controller.limits.junction, attribute, None)


def _rule(controller: ControllerModel) -> str:
    """Name of the rule at junctions."""
    return next(name for name, rule in _JUNCTIONS.items() if isinstance(controller.limits.junction, rule))


CONTROLLER = Section(
    "controller",
    (
        Key("path_acceleration_mm_s2", _ACCELERATION, "limits.acceleration_um_s2"),
        Key("cut_step_limit_hz", Number(Bound(0.1, 1e6), "Hz")),
        Key("jump_feed_mm_s", Number(_SPEED, "mm/s")),
        Key("axis_feed_x_mm_s", _FEED, "limits.axis_speed_um_s.0", default=math.inf),
        Key("axis_feed_y_mm_s", _FEED, "limits.axis_speed_um_s.1", default=math.inf),
        Key("axis_acceleration_x_mm_s2", _ACCELERATION, "limits.axis_acceleration_um_s2.0", default=math.inf),
        Key("axis_acceleration_y_mm_s2", _ACCELERATION, "limits.axis_acceleration_um_s2.1", default=math.inf),
        Key("start_feed_mm_s", Number(Bound(0.0, 1e3), "mm/s", MM_AS_UM), "limits.start_speed_um_s", default=0.0),
        Key("corner_angle_deg", Number(Bound(0.0, 180.0), "°", DEGREES_AS_RAD), "limits.corner_angle_rad", default=5.0),
        Key("corner_wait_ms", _WholeMs(Bound(0.0, 1e6), "ms", MS_AS_S), "limits.corner_wait_s", default=0.0),
        Key("jerk_mm_s3", Number(Bound(0.01, 1e9), "mm/s³", MM_AS_UM), "limits.jerk_um_s3", default=math.inf),
        Key("servo_period_us", Number(Bound(10.0, 1e4), "µs", US_AS_S), "servo_period_s", default=200.0),
        Key("junction", OneOf(tuple(_JUNCTIONS)), default="through", get=_rule),
        Key("corner_feed_mm_s", Number(Bound(1e-6, 1e3), "mm/s", MM_AS_UM), default=None, get=_of_rule("speed_um_s")),
        Key("junction_deviation_um", Number(Bound(1e-3, 1e3), "µm"), default=None, get=_of_rule("deviation_um")),
        Key("interpolator", INTERPOLATOR.kind, "interpolation", default="point-by-point"),
        REGISTERS,
    ),
    fills="controller",
)


def read_controller(content: Mapping[str, Any], where: str) -> ControllerModel:
    """Controller of the section ``[controller]`` of a machine file. SettingsError names the file and the key."""
    value = CONTROLLER.read_in(content, where)
    junction = _junction(value, f"{where}: {CONTROLLER.header}")
    return ControllerModel(limits=MotionLimits(junction=junction, **value.pop("limits")), **value)


def _junction(value: dict[str, Any], where: str) -> Junction:
    """Rule at junctions, taken from the values with its own number, which has to be given with it."""
    rule = value.pop("junction")
    own = {of: value.pop(key) for of, key in _OWN_NUMBER.items()}
    for of, key in _OWN_NUMBER.items():
        if (rule == of) != (own[of] is not None):
            needs = Message("needs-number", key=key) if rule == of else Message("takes-no-number", key=key, rule=of)
            raise SettingsError("junction-number", where=where, rule=rule, why=needs)
    made: Junction = _JUNCTIONS[rule](*([own[rule]] if rule in own else []))
    return made


TOP = Section(
    "machine",
    (
        Key("name", Text()),
        Key("name_zh", Text(), default=None),
        Key("assumed", Keys(), default=()),
        Key("measured", Margins(), default=()),
    ),
    form="top",
)
CUTTING = Section("cutting", (Key("area_rate_mm2_min", Number(AREA_RATE_MM2_MIN, "mm²/min")),))
SECTIONS = (TOP, TABLE, MOTOR, CONTROLLER, CUTTING, ARM, SPARK, GUIDES)
"""Sections of a machine file."""


class Machine(NamedTuple):
    """One machine as its file gives it; units as named.

    `arm_um` is the outline of the arm round the wire, if known. `assumed` are the keys of the values that nobody has
    measured, `measured` those that somebody has, each with half of its 95 % interval in the unit of the key: no run
    goes by either. `name_zh` is its name in Chinese, None where that is the same. `engine` is what its table is worked
    out with, which is no matter of the file. `spark` are the sparks of cuts that ask for them,
    `guides` those of the wire, where its file says them.
    """

    name: str
    table: TableModel
    controller: ControllerModel
    area_rate_mm2_min: float
    arm_um: Outline | None = None
    name_zh: str | None = None
    assumed: tuple[str, ...] = ()
    measured: tuple[tuple[str, float], ...] = ()
    engine: TableEngine = "compiled"
    spark: Spark | None = None
    guides: Guides | None = None

    def stepping_by(self, interpolation: Interpolation) -> "Machine":
        """The machine with another interpolator."""
        return self._replace(controller=self.controller._replace(interpolation=interpolation))

    def feeds(self, thickness_mm: float) -> Feeds:
        """Feeds in a work of this thickness, of cuts at the machine's own area rate."""
        return Feeds(
            cut_um_s=self.cut_um_s(thickness_mm, self.area_rate_mm2_min),
            jump_um_s=from_mm(self.controller.jump_feed_mm_s),
        )

    def cut_um_s(self, thickness_mm: float, area_rate_mm2_min: float) -> float:
        """Feed of a cut at an area rate: that over the thickness, no faster than the controller steps."""
        return self.held_um_s(from_mm(area_rate_mm2_min / thickness_mm / 60.0))

    def held_um_s(self, feed_um_s: float) -> float:
        """A feed of cuts as the controller runs it: no faster than one step of 1 µm a tick of its limit."""
        return min(feed_um_s, self.controller.cut_step_limit_hz)


class MeasuredValue(NamedTuple):
    """A value of a machine file that was measured, ± `within` in 95 of 100 cases; both in the unit of its key."""

    key: str
    value: float
    within: float


def measured_values(machine: Machine) -> tuple[MeasuredValue, ...]:
    """What was measured of a machine, in the order of its file."""
    written = {name: value for section in machine_sections(machine) for name, value in section.values.items()}
    return tuple(MeasuredValue(name, written[name], within) for name, within in machine.measured)


def machine_names() -> tuple[str, ...]:
    """Names of the machines that are shipped, in order."""
    shipped = resources.files("sim.setup.machine")
    return tuple(sorted(each.name.removesuffix(".toml") for each in shipped.iterdir() if each.name.endswith(".toml")))


def load_machine(name: str, folder: Path | None = None, own: Path | None = None) -> Machine:
    """Machine of a shipped name such as ``dk7740``, or of a ``.toml`` file (relative to `folder`).

    `own` is a folder of machine files, whose names without ``.toml`` count before those that are shipped. Raises
    FileUnreadableError and SettingsError with the file and the key.
    """
    if name.endswith(".toml"):
        return _read(Path(folder or "") / name)
    shipped = resources.files("sim.setup.machine")
    theirs = {file.stem: file for file in sorted(own.glob("*.toml"))} if own else {}
    if name in theirs:
        return _read(theirs[name])
    known = (*theirs, *machine_names())
    if name not in known:
        raise SettingsError("machine-not-shipped", name=name, known=", ".join(known))
    with resources.as_file(shipped / f"{name}.toml") as path:
        return _read(path)


def machine_sections(machine: Machine) -> list[WrittenSection]:
    """Sections of the machine file that makes the same machine."""
    return [written for section in SECTIONS for written in section.written(machine)]


def _read(path: Path) -> Machine:
    content, where = load_toml(path), str(path)
    arm = ARM.read_in(content, where) if ARM.name in content else {}
    top = TOP.read(content, where, others=(section.name for section in SECTIONS[1:]))
    machine = Machine(
        **top,
        table=read_table(content, where),
        controller=read_controller(content, where),
        **CUTTING.read_in(content, where),
        spark=read_spark(content, where),
        guides=read_guides(content, where),
        **arm,
    )
    _check_grades(machine, where)
    return machine


def _check_grades(machine: Machine, where: str) -> None:
    """SettingsError for a mark of what is no value of the file, and for a value that is assumed and measured."""
    known = {key.name: key.kind for section in SECTIONS[1:] for key in section.keys}
    for name in machine.assumed:
        if name not in known:
            raise SettingsError("assumed-key-unknown", where=where, name=name)
    values = {name for section in machine_sections(machine) for name in section.values}
    for name, _ in machine.measured:
        if name not in values or not isinstance(known.get(name), Number):
            raise SettingsError("measured-key-unknown", where=where, name=name)
        if name in machine.assumed:
            raise SettingsError("measured-and-assumed", where=where, name=name)
