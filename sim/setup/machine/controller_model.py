"""The ``[controller]`` section of a machine file: limits of motion, the rule at junctions, and the interpolator."""

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, get_args

from controller.card.core.settings import UM_S3_PER_PULSE_MS3, CardSettings
from controller.host.entries import Interpolation
from controller.motion.limits import (
    Junction,
    JunctionDeviation,
    MotionLimits,
    SlowAt,
    StopEach,
    Through,
)
from parser.dialect.reader import Registers
from parser.findings.errors import Message, SettingsError
from sim.setup.dialect import REGISTERS
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import DEGREES_AS_RAD, MM_AS_UM, MS_AS_S, US_AS_S, Number, OneOf
from sim.setup.toml.reader import Bound

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


INTERPOLATOR = OneOf(get_args(Interpolation))

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
        Key("interpolator", INTERPOLATOR, "interpolation", default="point-by-point"),
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
