"""The ``[controller]`` section of a machine file: limits of motion, the rule at junctions, and the interpolator."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple, cast, get_args

from controller.card.core.settings import CardSettings
from controller.card.core.units import UM_S3_PER_PULSE_MS3
from controller.host.entries import Interpolation
from controller.motion.junctions import Junction, JunctionDeviation, SlowAt, StopEach, Through
from controller.motion.limits import MotionLimits
from parser.findings.errors import SettingsError
from parser.units import from_mm
from sim.setup.toml.reader import Bound, numbers, refuse_unknown, text

_SPEED = Bound(1e-3, 1e3)
_ACCELERATION = Bound(0.01, 1e5)
_REQUIRED = {
    "path_acceleration_mm_s2": _ACCELERATION,
    "cut_step_limit_hz": Bound(0.1, 1e6),
    "jump_feed_mm_s": _SPEED,
}
_OPTIONAL = {
    "axis_feed_x_mm_s": _SPEED,
    "axis_feed_y_mm_s": _SPEED,
    "axis_acceleration_x_mm_s2": _ACCELERATION,
    "axis_acceleration_y_mm_s2": _ACCELERATION,
    "start_feed_mm_s": Bound(0.0, 1e3),
    "corner_angle_deg": Bound(0.0, 180.0),
    "corner_feed_mm_s": Bound(1e-6, 1e3),
    "junction_deviation_um": Bound(1e-3, 1e3),
    "corner_wait_ms": Bound(0.0, 1e6),
    "jerk_mm_s3": Bound(0.01, 1e9),
    "servo_period_us": Bound(10.0, 1e4),
}
_DEFAULTS = {
    "axis_feed_x_mm_s": math.inf,
    "axis_feed_y_mm_s": math.inf,
    "axis_acceleration_x_mm_s2": math.inf,
    "axis_acceleration_y_mm_s2": math.inf,
    "start_feed_mm_s": 0.0,
    "corner_angle_deg": 5.0,
    "corner_wait_ms": 0.0,
    "jerk_mm_s3": math.inf,
    "servo_period_us": 200.0,
}
_TEXTS = ("junction", "interpolator")
_JUNCTIONS = ("through", "slow", "stop", "deviation")


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
    """

    limits: MotionLimits
    cut_step_limit_hz: float
    jump_feed_mm_s: float
    interpolation: Interpolation
    servo_period_s: float

    @property
    def card_settings(self) -> CardSettings:
        """Settings of the emulated card that moves as this controller does; one pulse is 1 µm."""
        return CardSettings(
            servo_period_s=self.servo_period_s,
            jerk_pulse_ms3=self.limits.jerk_um_s3 / UM_S3_PER_PULSE_MS3,
        )


def read_controller(table: Mapping[str, Any], where: str) -> ControllerModel:
    """Controller of a section ``[controller]``. SettingsError names the file and the key."""
    refuse_unknown(table, (*_REQUIRED, *_OPTIONAL, *_TEXTS), where)
    given = {key: value for key, value in table.items() if key not in _TEXTS}
    value = _DEFAULTS | numbers(given, _REQUIRED, where, optional=_OPTIONAL)
    speeds = value["axis_feed_x_mm_s"], value["axis_feed_y_mm_s"]
    accelerations = value["axis_acceleration_x_mm_s2"], value["axis_acceleration_y_mm_s2"]
    return ControllerModel(
        limits=MotionLimits(
            acceleration_um_s2=from_mm(value["path_acceleration_mm_s2"]),
            axis_speed_um_s=(from_mm(speeds[0]), from_mm(speeds[1])),
            axis_acceleration_um_s2=(from_mm(accelerations[0]), from_mm(accelerations[1])),
            start_speed_um_s=from_mm(value["start_feed_mm_s"]),
            junction=_junction(text(table, "junction", where, "through"), value, where),
            corner_angle_rad=math.radians(value["corner_angle_deg"]),
            corner_wait_s=_whole_ms(value["corner_wait_ms"], f"{where}: corner_wait_ms") / 1e3,
            jerk_um_s3=from_mm(value["jerk_mm_s3"]),
        ),
        cut_step_limit_hz=value["cut_step_limit_hz"],
        jump_feed_mm_s=value["jump_feed_mm_s"],
        interpolation=interpolation(text(table, "interpolator", where, "point-by-point"), f"{where}: interpolator"),
        servo_period_s=value["servo_period_us"] / 1e6,
    )


def interpolation(name: str, where: str) -> Interpolation:
    """Interpolator of this name. SettingsError where there is none."""
    known = get_args(Interpolation)
    if name not in known:
        raise SettingsError(f"{where} is one of {', '.join(known)}; found {name!r}")
    return cast("Interpolation", name)


def _junction(rule: str, value: Mapping[str, float], where: str) -> Junction:
    """Rule at junctions; its own number has to be given with it."""
    if rule not in _JUNCTIONS:
        raise SettingsError(f"{where}: junction is one of {', '.join(_JUNCTIONS)}; found {rule!r}")
    for of, key in (("slow", "corner_feed_mm_s"), ("deviation", "junction_deviation_um")):
        if (rule == of) != (key in value):
            needs = f"needs {key}" if rule == of else f"takes no {key}, which belongs to junction = {of!r}"
            raise SettingsError(f"{where}: junction = {rule!r} {needs}")
    if rule == "slow":
        return SlowAt(from_mm(value["corner_feed_mm_s"]))
    if rule == "deviation":
        return JunctionDeviation(value["junction_deviation_um"])
    return StopEach() if rule == "stop" else Through()


def _whole_ms(wait_ms: float, where: str) -> float:
    """A wait in whole milliseconds, as controllers take it."""
    if wait_ms != int(wait_ms):
        raise SettingsError(f"{where} is a whole number; found {wait_ms:g}")
    return wait_ms
