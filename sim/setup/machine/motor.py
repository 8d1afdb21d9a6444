"""The ``[motor]`` section of a machine file: what turns the screws, and the position loop that is closed about it."""

import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any, Literal, NamedTuple

from parser.findings.errors import SettingsError
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MS_AS_S, Number, OneOf, ValueKind, limits
from sim.setup.toml.reader import Bound, number

FORCE_N = Bound(0.1, 1e6)
_RATE_HZ = Bound(0.0, 1e7)
_LOOP_KEYS = ("feed_forward", "loop_period_ms", "feedback", "in_position_um")
_OF_KIND: Mapping[str, tuple[str, ...]] = {
    "stepper": ("electrical_period_um",),
    "servo": ("following_error_limit_um", "position_gain_per_s", *_LOOP_KEYS),
}
_UNSTABLE = 2.0
"""Gain times period from which a loop runs away: what is left of a way after each look is 1 less that."""

Feedback = Literal["motor", "scale"]


class PositionLoop(NamedTuple):
    """How a drive closes its position loop.

    Attributes
    ----------
    gain_per_s
        Speed for each µm that the axis is behind its command, 1/s.
    feed_forward
        Share of the command's own speed that is added.
    period_s
        How often the loop looks; its motor turns evenly from look to look.
    feedback
        What it looks at: the motor by its encoder, or the slide by a scale.
    in_position_um
        Within this of a command that stands the motor stands too.
    """

    gain_per_s: float
    feed_forward: float
    period_s: float
    feedback: Feedback
    in_position_um: float


class Motor(NamedTuple):
    """What turns the screw of each axis.

    Attributes
    ----------
    kind
        A stepper slips by whole electrical periods past its pull-out, a servo trips on its following error.
    step_time_s
        Time the motor takes for one step, where no loop is closed: it turns at constant speed from one place to the
        next.
    electrical_period_um
        Way of the table in one electrical period: six beats of 1 µm of a three-phase stepper with six beats.
    following_error_limit_um
        Following error at which a servo trips; infinite for a stepper. Where no loop is closed it is the lag of the
        slide behind the motor, else how far what the loop looks at is behind the command.
    force_curve
        (step rate Hz, force N) from standstill on, rates rising; the force is linear between and constant past the
        last.
    loop
        The position loop of a servo; None where the motor stands where its pulses sent it.
    """

    kind: Literal["stepper", "servo"]
    step_time_s: float
    electrical_period_um: float
    following_error_limit_um: float
    force_curve: tuple[tuple[float, float], ...]
    loop: PositionLoop | None = None

    @property
    def may_trip(self) -> bool:
        """Whether it is a servo."""
        return self.kind == "servo"


class _ForceAtRate(ValueKind):
    """Points [step rate Hz, force N] of a curve that begins with the force limit at standstill."""

    name = "force-at-rate"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> tuple[tuple[float, float], ...]:
        """Its points."""
        value, where = table[key], f"{where}: {key}"
        if not isinstance(value, list) or not all(isinstance(point, list) and len(point) == 2 for point in value):
            raise SettingsError("no-list-of-rates", where=where, found=value)
        points = tuple(
            (number(rate, _RATE_HZ, f"{where}: Hz"), number(force, FORCE_N, f"{where}: N")) for rate, force in value
        )
        rates = (0.0, *(rate for rate, _ in points))
        if any(later <= earlier for earlier, later in pairwise(rates)):
            raise SettingsError("rates-do-not-rise", where=where, rates=list(rates[1:]))
        return points

    def written(self, value: Any) -> list[list[float]]:
        """A list of lists."""
        return [list(point) for point in value]

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        rate, force = ({"type": "number", **limits(bound)} for bound in (_RATE_HZ, FORCE_N))
        point = {"type": "array", "minItems": 2, "maxItems": 2, "prefixItems": [rate, force]}
        return {"type": "array", "items": point}


def _of_loop(attribute: str) -> Callable[[Motor], Any]:
    """How a value of the position loop is found; there is none where no loop is closed."""
    return lambda motor: getattr(motor.loop, attribute, None)


MOTOR = Section(
    "motor",
    (
        Key("kind", OneOf(tuple(_OF_KIND)), default="stepper"),
        Key(
            "step_time_ms",
            Number(Bound(0.0, 1e3), "ms", MS_AS_S),
            "step_time_s",
            default=2.0,
            get=lambda motor: motor.step_time_s if motor.loop is None else None,
        ),
        Key(
            "electrical_period_um",
            Number(Bound(0.1, 1e4), "µm"),
            default=6.0,
            get=lambda motor: motor.electrical_period_um if motor.kind == "stepper" else None,
        ),
        Key("following_error_limit_um", Number(Bound(0.1, 1e6), "µm"), default=math.inf),
        Key("force_at_rate", _ForceAtRate(), default=(), get=lambda motor: motor.force_curve[1:] or None),
        Key("position_gain_per_s", Number(Bound(0.1, 1e4), "1/s"), "loop.gain_per_s", None, get=_of_loop("gain_per_s")),
        Key("feed_forward", Number(Bound(0.0, 2.0)), "loop.feed_forward", 0.0, get=_of_loop("feed_forward")),
        Key(
            "loop_period_ms",
            Number(Bound(0.01, 100.0), "ms", MS_AS_S),
            "loop.period_s",
            default=1.0,
            get=_of_loop("period_s"),
        ),
        Key("feedback", OneOf(("motor", "scale")), "loop.feedback", "motor", get=_of_loop("feedback")),
        Key(
            "in_position_um", Number(Bound(0.0, 1e3), "µm"), "loop.in_position_um", 0.0, get=_of_loop("in_position_um")
        ),
    ),
    fills="table.motor",
)


def read_motor(table: Mapping[str, Any], force_n: float, where: str) -> Motor:
    """Motor of a section; `force_n` is what it pulls at standstill. SettingsError names the file and the key."""
    value = MOTOR.read(table, where)
    kind = value["kind"]
    for of, keys in _OF_KIND.items():
        for key in keys:
            if kind != of and key in table:
                raise SettingsError("key-of-another-kind", where=where, key=key, of=of, kind=kind)
    if kind == "servo" and "following_error_limit_um" not in table:
        raise SettingsError("following-error-limit-missing", where=where)
    loop = _closed(table, value.pop("loop"), where)
    return Motor(force_curve=((0.0, force_n), *value.pop("force_at_rate")), loop=loop, **value)


def _closed(table: Mapping[str, Any], value: dict[str, Any], where: str) -> PositionLoop | None:
    """The position loop of a section, if one is closed."""
    if value["gain_per_s"] is None:
        for key in _LOOP_KEYS:
            if key in table:
                raise SettingsError("key-of-a-loop", where=where, key=key)
        return None
    if "step_time_ms" in table:
        raise SettingsError("step-time-of-a-loop", where=where)
    loop = PositionLoop(**value)
    if loop.gain_per_s * loop.period_s >= _UNSTABLE:
        raise SettingsError("loop-unstable", where=where, product=loop.gain_per_s * loop.period_s, most=_UNSTABLE)
    return loop
