"""What configurations of LinuxCNC and Klipper say of a machine, in the keys of a machine file; and what they do not.

Sections and names are those of the "Configuration Reference" of Klipper and of the "INI Configuration" of LinuxCNC.
Lengths of Klipper are mm; those of LinuxCNC have the unit that ``[TRAJ] LINEAR_UNITS`` names. Klipper passes a junction
by ``square_corner_velocity`` v: with the acceleration a that is a junction deviation of v² (√2 − 1) / a.
"""

import math
from collections.abc import Iterator, Mapping
from configparser import ConfigParser
from configparser import Error as ConfigError
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple

from parser.files import read_bytes
from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from parser.units import from_mm
from sim.setup.machine.machine import TOP, Machine, machine_sections
from sim.setup.toml.keys import WrittenSection

Control = Literal["Klipper", "LinuxCNC"]
_INCH_MM: Final = 25.4
_USUAL_CORNER_MM_S: Final = 5.0
"""``square_corner_velocity`` where a configuration of Klipper leaves it out."""
_FULL_STEPS: Final = 200.0
"""``full_steps_per_rotation`` where it is left out."""
_STEP_UM: Final = 1.0
"""Of a wire table, as drycut steps it."""
_OF_STEPS: Final = ("step_time_ms", "electrical_period_um")
"""What a motor has that no position loop is closed about."""
_NOT_SAID: Final = ("masses", "stiffness", "friction", "force", "cutting")
"""What no such file says: names of texts ``machine.dropped-…``."""


class Carried(NamedTuple):
    """A value of a machine file, and where it stands in the other one."""

    key: str
    value: Any
    source: str


class ForeignMachine(NamedTuple):
    """What a configuration says.

    Attributes
    ----------
    control, name
        Whose configuration it is, and its file.
    carried
        What carries over, in the order of the file.
    dropped
        What does not, and why: names of texts ``machine.dropped-…``.
    """

    control: Control
    name: str
    carried: tuple[Carried, ...]
    dropped: tuple[Remark, ...]


def read_foreign(path: Path) -> ForeignMachine:
    """What a configuration says. Raises FileUnreadableError, and SettingsError for what is none."""
    of = ConfigParser(
        delimiters=("=", ":"),
        comment_prefixes=("#", ";"),
        inline_comment_prefixes=("#", ";"),
        strict=False,
        interpolation=None,
        allow_no_value=True,
    )
    name = printable(path.name)
    try:
        of.read_string(read_bytes(path).decode("utf-8", "replace"))
    except ConfigError:
        raise SettingsError("no-configuration", file=name) from None
    sections = {section.casefold(): dict(of[section]) for section in of.sections()}
    if "max_accel" in sections.get("printer", {}):
        return _klipper(_File(name, sections, 1.0))
    if any(section in sections for section in ("traj", "axis_x", "joint_0")):
        return _linuxcnc(_File(name, sections, _unit_mm(sections)))
    raise SettingsError("no-configuration", file=name)


class _File(NamedTuple):
    """A configuration: its options by sections, both in small letters, and what its unit of length is in mm."""

    name: str
    sections: Mapping[str, Mapping[str, str | None]]
    unit_mm: float

    def number(self, section: str, *options: str) -> tuple[float, str] | None:
        """The first of some options that a section has, and where; SettingsError where it is no number."""
        for option in options:
            text = (self.sections.get(section, {}).get(option) or "").split(" ")[0].strip()
            if text:
                source = f"[{section}] {option}"
                try:
                    value = float(text)
                except ValueError:
                    value = math.nan
                if not math.isfinite(value):
                    raise SettingsError("no-configuration-number", file=self.name, source=source, found=printable(text))
                return value, source
        return None

    def carried(self, key: str, scale: float, section: str, *options: str) -> Iterator[Carried]:
        """A value above 0 under another key, times a scale; none where the file does not say it."""
        found = self.number(section, *options)
        if found is not None and found[0] > 0.0:
            yield Carried(key, _rounded(found[0] * scale), found[1])


def _rounded(value: float) -> float:
    return float(f"{value:.9g}")


def _unit_mm(sections: Mapping[str, Mapping[str, str | None]]) -> float:
    word = (sections.get("traj", {}).get("linear_units") or "mm").casefold()
    return _INCH_MM if word in {"in", "inch", "imperial"} else 1.0


def _travel(of: _File, key: str, section: str, least: str, most: str) -> Iterator[Carried]:
    high, low = of.number(section, most), of.number(section, least)
    if high is not None:
        span_mm = (high[0] - (0.0 if low is None else low[0])) * of.unit_mm
        if span_mm > 0.0:
            yield Carried(key, _rounded(span_mm), high[1] if low is None else f"{low[1]}, {most}")


def _klipper(of: _File) -> ForeignMachine:
    carried = [
        *_travel(of, "travel_x_mm", "stepper_x", "position_min", "position_max"),
        *_travel(of, "travel_y_mm", "stepper_y", "position_min", "position_max"),
        *of.carried("path_acceleration_mm_s2", 1.0, "printer", "max_accel"),
        *of.carried("jump_feed_mm_s", 1.0, "printer", "max_velocity"),
        *_square_corner(of),
    ]
    dropped = [Remark("includes", {"number": number}) for number in [_includes(of)] if number]
    dropped += [Remark("step", values) for values in (_klipper_step(of, axis) for axis in "xy") if values]
    return ForeignMachine("Klipper", of.name, tuple(carried), (*dropped, *map(Remark, _NOT_SAID)))


def _square_corner(of: _File) -> Iterator[Carried]:
    """The rule at junctions."""
    found = of.number("printer", "square_corner_velocity")
    accel = of.number("printer", "max_accel")
    speed, source = (_USUAL_CORNER_MM_S, "[printer], as usual") if found is None else found
    if accel is not None and accel[0] > 0.0 and speed > 0.0:
        deviation_um = from_mm(speed**2 * (math.sqrt(2.0) - 1.0) / accel[0])
        yield Carried("junction", "deviation", source)
        yield Carried("junction_deviation_um", _rounded(deviation_um), source)


def _includes(of: _File) -> int:
    return sum(section.startswith("include ") for section in of.sections)


def _klipper_step(of: _File, axis: str) -> dict[str, Any]:
    """The step of an axis where it is another one than drycut's, for people; nothing where it is not said."""
    section = f"stepper_{axis}"
    turn, micro = of.number(section, "rotation_distance"), of.number(section, "microsteps")
    if turn is None or micro is None or micro[0] <= 0.0:
        return {}
    full = of.number(section, "full_steps_per_rotation")
    steps = micro[0] * (_FULL_STEPS if full is None else full[0]) * _gears(of, section)
    if steps <= 0.0:
        return {}
    step_um = from_mm(turn[0] / steps)
    return {} if abs(step_um - _STEP_UM) < 1e-6 else {"axis": axis.upper(), "step": _rounded(step_um)}


def _gears(of: _File, section: str) -> float:
    """Turns of the motor for one of what it drives: ``gear_ratio`` has pairs such as ``57:11, 2:1``."""
    ratio = 1.0
    for pair in filter(None, (of.sections.get(section, {}).get("gear_ratio") or "").split(",")):
        motor, _, driven = pair.partition(":")
        try:
            ratio *= float(motor) / float(driven)
        except (ValueError, ZeroDivisionError):
            source = f"[{section}] gear_ratio"
            raise SettingsError("no-configuration-number", file=of.name, source=source, found=printable(pair)) from None
    return ratio


def _linuxcnc(of: _File) -> ForeignMachine:
    unit = of.unit_mm
    axes = [(axis, f"axis_{axis}", f"joint_{joint}") for joint, axis in enumerate("xy")]
    carried: list[Carried] = []
    for axis, section, joint in axes:
        own = section if "max_limit" in of.sections.get(section, {}) else joint
        carried += _travel(of, f"travel_{axis}_mm", own, "min_limit", "max_limit")
        carried += of.carried(f"backlash_{axis}_um", from_mm(unit), joint, "backlash")
        for key, option in (("feed", "max_velocity"), ("acceleration", "max_acceleration")):
            name = f"axis_{key}_{axis}_mm_s{'' if key == 'feed' else '2'}"
            has_own = option in of.sections.get(section, {})
            carried += of.carried(name, unit, section if has_own else joint, option)
    carried += of.carried("path_acceleration_mm_s2", unit, "traj", "max_linear_acceleration", "max_acceleration")
    carried += of.carried("jump_feed_mm_s", unit, "traj", "max_linear_velocity", "max_velocity")
    dropped = []
    for axis, _, joint in axes:
        scale = of.number(joint, "step_scale", "scale", "input_scale")
        if scale is not None and scale[0] != 0.0:
            step_um = from_mm(unit) / abs(scale[0])
            dropped += [Remark("step", {"axis": axis.upper(), "step": _rounded(step_um)})] * (abs(step_um - 1.0) > 1e-6)
    loops = [_loop(of, joint) for _, _, joint in axes]
    if loops[0] and _alike(*loops):
        carried += loops[0]
        return ForeignMachine("LinuxCNC", of.name, tuple(carried), (*dropped, *map(Remark, ("encoder", *_NOT_SAID))))
    dropped += [Remark("loops", {})] * any(loops)
    errors = [found for _, _, joint in axes if (found := of.number(joint, "ferror")) is not None]
    dropped += [Remark("following-error", {"error": _rounded(from_mm(unit) * value)}) for value, _ in errors[:1]]
    return ForeignMachine("LinuxCNC", of.name, tuple(carried), (*dropped, *map(Remark, _NOT_SAID)))


def _loop(of: _File, joint: str) -> tuple[Carried, ...]:
    """The position loop of a joint with an encoder; none where it is stepped, or says no gain or following error.

    Its gain is that of LinuxCNC's `pid`, whose output is a speed: in 1/s whatever the unit. It looks once in the
    servo period of ``[EMCMOT]``, ns.
    """
    stepped = any(of.number(joint, option) for option in ("step_scale", "stepgen_maxaccel"))
    if stepped or not of.number(joint, "encoder_scale", "input_scale"):
        return ()
    found = (
        *of.carried("following_error_limit_um", from_mm(of.unit_mm), joint, "ferror"),
        *of.carried("position_gain_per_s", 1.0, joint, "p"),
        *of.carried("feed_forward", 1.0, joint, "ff1"),
        *of.carried("loop_period_ms", 1e-6, "emcmot", "servo_period"),
        *of.carried("in_position_um", from_mm(of.unit_mm), joint, "deadband"),
    )
    if {"following_error_limit_um", "position_gain_per_s"} - {each.key for each in found}:
        return ()
    return Carried("kind", "servo", found[0].source), *found


def _alike(first: tuple[Carried, ...], second: tuple[Carried, ...]) -> bool:
    """Whether two loops say the same."""
    return [each[:2] for each in first] == [each[:2] for each in second]


def carried_over(base: Machine, foreign: ForeignMachine) -> list[WrittenSection]:
    """Sections of a machine file with what carries over in place of a base's own values, which stay for all else."""
    values = {each.key: each.value for each in foreign.carried}
    found = []
    for written in machine_sections(base):
        own = {key.name: values[key.name] for key in written.section.keys if key.name in values}
        of_base = dict(written.values)
        if "junction" in own:
            of_base.pop("corner_feed_mm_s", None)
        if "position_gain_per_s" in own:
            for key in _OF_STEPS:
                of_base.pop(key, None)
        if written.section is TOP:
            of_base.pop("name_zh", None)
            gone = _OF_STEPS if "position_gain_per_s" in values else ()
            assumed = [key for key in base.assumed if key not in {*values, *gone}]
            own = {"name": foreign.name, "assumed": assumed}
            if measured := {key: within for key, within in base.measured if key not in values}:
                own["measured"] = measured
            else:
                of_base.pop("measured", None)
        found.append(written._replace(values={**of_base, **own}))
    return found
