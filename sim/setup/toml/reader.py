"""TOML settings read strictly: every key known, every number in its bounds, every complaint names file and key."""

import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from parser.files import read_text
from parser.findings.errors import Message, SettingsError, did_you_mean
from sim.base.units import in_digits


class Bound(NamedTuple):
    """Lowest and highest value a number may take, both included."""

    low: float
    high: float


MOST_CHARACTERS = 1_000_000
"""Of a settings, machine or scenario file: outlines of 50,000 corners."""
MOST_PARTS = 50
"""Of a key with dots, such as ``a.b.c``: the library takes a time that grows with their square."""
_PART = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+"""
_DOTTED = re.compile(rf"(?<![\w-])(?:{_PART}\.[ \t]*+){{{MOST_PARTS}}}{_PART}", re.ASCII)

PLACE_MM = Bound(-1e5, 1e5)
AREA_RATE_MM2_MIN = Bound(0.1, 1e4)
_MOST_BITS = 2048


def load_toml(path: Path) -> dict[str, Any]:
    """Content of a TOML file. FileUnreadableError where it cannot be read, SettingsError where it is no TOML."""
    try:
        import tomllib  # noqa: PLC0415 - most checks have no settings file

        content = tomllib.loads(_bounded(path, read_text(path)))
        if _is_endless(content):
            raise SettingsError("number-too-long", path=path, most=_MOST_BITS)
    except RecursionError:
        raise SettingsError("nested-too-deep", path=path) from None
    except SettingsError:
        raise
    except ValueError as error:  # TOMLDecodeError, UnicodeDecodeError, and integers of thousands of digits
        raise SettingsError("no-toml", path=path, why=str(error)) from None
    return content


def _is_endless(value: object) -> bool:
    """Whether a value holds a whole number of more digits than Python would print; hexadecimal ones can be read."""
    inside = value.values() if isinstance(value, Mapping) else value if isinstance(value, list) else ()
    return (isinstance(value, int) and value.bit_length() > _MOST_BITS) or any(map(_is_endless, inside))


def _bounded(path: Path, content: str) -> str:
    """The content of a settings file. SettingsError for more than the library reads in a second or so."""
    if len(content) > MOST_CHARACTERS:
        raise SettingsError("settings-too-long", path=path, most=MOST_CHARACTERS)
    if _DOTTED.search(content):
        raise SettingsError("keys-nested-too-deep", path=path, most=MOST_PARTS)
    return content


def refuse_unknown(table: Mapping[str, Any], known: Iterable[str], where: str) -> None:
    """SettingsError for the first key that is not known, with the nearest known one."""
    names = sorted(known)
    for key in table:
        if key not in names:
            hint = did_you_mean(key, names, Message("known-keys", names=", ".join(names)))
            raise SettingsError("unknown-key", where=where, key=key, hint=hint)


def section(table: Mapping[str, Any], key: str, where: str) -> Mapping[str, Any]:
    """Sub-table `key`, empty where there is none. SettingsError where it is no table."""
    value = table.get(key, {})
    if not isinstance(value, Mapping):
        raise SettingsError("no-table", where=where, key=key, found=value)
    return value


def tables(content: Mapping[str, Any], key: str, where: str) -> list[Mapping[str, Any]]:
    """Tables ``[[key]]``, none where they are left out. SettingsError where they are something else."""
    value = content.get(key, [])
    if not isinstance(value, list) or not all(isinstance(table, Mapping) for table in value):
        raise SettingsError("no-tables", where=where, key=key, found=value)
    return value


def text(table: Mapping[str, Any], key: str, where: str) -> str:
    """Text `key`. SettingsError where it is missing or no text."""
    value = table.get(key)
    if not isinstance(value, str) or not value:
        raise SettingsError("no-text", where=where, key=key, found=value)
    return value


def truth(table: Mapping[str, Any], key: str, where: str) -> bool:
    """Truth `key`; false where it is left out. SettingsError where it is something else."""
    value = table.get(key, False)
    if not isinstance(value, bool):
        raise SettingsError("no-truth", where=where, key=key, found=value)
    return value


def number(value: object, bound: Bound, where: str) -> float:
    """A number in its bounds. SettingsError otherwise."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise SettingsError("no-number", where=where, found=value)
    if isinstance(value, int) and abs(value) > 1e300:
        value = math.inf if value > 0 else -math.inf
    if not bound.low <= value <= bound.high:  # also refuses NaN
        found, low, high = (in_digits(each) for each in (value, *bound))
        raise SettingsError("out-of-bounds", where=where, found=found, low=low, high=high)
    return float(value)


def pair(table: Mapping[str, Any], key: str, where: str) -> tuple[float, float] | None:
    """Place [x, y] on the table in mm; None where it is left out. SettingsError where it is no pair of numbers."""
    if key not in table:
        return None
    value = table[key]
    if not isinstance(value, list) or len(value) != 2:
        raise SettingsError("no-point-on-table", where=where, key=key, found=value)
    x, y = (number(place, PLACE_MM, f"{where}: {key}") for place in value)
    return x, y
