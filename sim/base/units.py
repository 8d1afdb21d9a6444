"""Numbers that people write and read, with units, and those of the report, rounded.

What people write and read, and what the engine counts in: lengths and speeds with units, durations, forces.

Numbers of the report: rounded, and None where there is no such thing.
"""

import math
import re
from collections.abc import Iterable, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats

ENGINE_FORCE_PER_N = 1e6
"""1 N is 10⁶ kg µm/s², the engine's unit of force where its lengths are µm."""

_Number = TypeVar("_Number", float, Floats)

_LENGTHS_UM = {"um": 1, "µm": 1, "μm": 1, "mm": 1000, "cm": 10_000, "m": 1_000_000, "in": 25_400}
_SPEEDS_UM_S = {
    f"{length}/{time}": Fraction(um, seconds)
    for length, um in _LENGTHS_UM.items()
    for time, seconds in (("s", 1), ("min", 60))
}
_QUANTITY = re.compile(r"\s*([-+]?\d{1,12}(?:\.\d{0,12})?|[-+]?\.\d{1,12})\s*([a-zµμ]+(?:/[a-z]+)?)\s*", re.ASCII)


def parse_length(text: str) -> float:
    """Length such as ``40mm`` or ``0.18 mm`` in µm. SettingsError where it is no number with a unit of length."""
    um = _parsed(text, _LENGTHS_UM)
    if um is None:
        raise SettingsError("no-length", found=text)
    return um


def parse_speed(text: str) -> float:
    """Speed such as ``500mm/min`` or ``2 mm/s`` in µm/s. SettingsError where it is no number with a unit of speed."""
    um_s = _parsed(text, _SPEEDS_UM_S)
    if um_s is None:
        raise SettingsError("no-speed", found=text)
    return um_s


def _parsed(text: str, units: Mapping[str, int | Fraction]) -> float | None:
    """The exact number in the unit that `units` are counted in, rounded once; None where it is none."""
    match = _QUANTITY.fullmatch(text)
    if not match or match[2] not in units:
        return None
    return float(Fraction(match[1]) * units[match[2]])


def engine_force(force_n: _Number) -> _Number:
    """N to the engine's unit of force."""
    return force_n * ENGINE_FORCE_PER_N


def engine_stiffness(stiffness_n_um: _Number) -> _Number:
    """N/µm to the engine's force per length."""
    return stiffness_n_um * ENGINE_FORCE_PER_N


def engine_viscosity(viscous_n_s_mm: _Number) -> _Number:
    """N s/mm to the engine's force per velocity."""
    return viscous_n_s_mm * (ENGINE_FORCE_PER_N / 1000.0)


def newtons(force: _Number) -> _Number:
    """The engine's unit of force to N."""
    return force / ENGINE_FORCE_PER_N


def clock(seconds: float) -> str:
    """Duration for people: ``2 h 27 min``, ``3 min 5 s``, ``12.4 s``."""
    if seconds < 60.0:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours} h {minutes} min"


def hours_text(seconds: float) -> str:
    """Hours, minutes and seconds in a column, such as ``0:19:33``."""
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{rest:02d}"


def in_figures(value: float) -> str:
    """A value above 0 for people: to three figures, and from 100 on to a tenth."""
    rounded = round(value, 1 if value >= 100.0 else 2 - math.floor(math.log10(value)))
    return f"{Decimal(repr(rounded)):,f}".removesuffix(".0")


def in_digits(value: float) -> str:
    """A number as a file has it, with all of its digits and no exponent."""
    return f"{Decimal(repr(float(value))):f}".removesuffix(".0") if math.isfinite(value) else str(value)


Entry = TypeVar("Entry")
_DIGITS = 6
DEG_DIGITS = 9


def rounded(value: float) -> float:
    """To the report's digits; never −0."""
    return round(float(value), _DIGITS) + 0.0


def moment(t_s: float, ran_s: float) -> float:
    """Time of what happened in a run of `ran_s`; what the table does while it comes to rest counts at the last step."""
    return rounded(min(t_s, ran_s))


def known(value: float | None) -> float | None:
    """Rounded, or None."""
    return None if value is None else rounded(value)


def column(values: Floats, digits: int = _DIGITS) -> list[float | None]:
    """Rounded numbers; None for NaN."""
    found = (np.round(values, digits) + 0.0).tolist()
    return [None if value != value else value for value in found]  # noqa: PLR0124 - NaN


def place(of: Iterable[float]) -> list[float]:
    """Rounded coordinates."""
    return [rounded(along) for along in of]


def corners(pairs: NDArray[np.float64]) -> list[list[float]]:
    """Rounded pairs, none of them NaN."""
    found: list[list[float]] = (np.round(pairs, _DIGITS) + 0.0).tolist()
    return found


def numbers(values: Floats, digits: int = _DIGITS) -> list[float]:
    """Rounded numbers, none of them NaN."""
    found: list[float] = (np.round(values, digits) + 0.0).tolist()
    return found


def points(pairs: NDArray[np.float64]) -> list[list[float] | None]:
    """Rounded pairs; None for NaN."""
    found = (np.round(pairs, _DIGITS) + 0.0).tolist()
    return [None if pair[0] != pair[0] else pair for pair in found]


def rows(model: type[Entry], columns: dict[str, list[Any]]) -> list[Entry]:
    """Columns as a list of entries of a model, a `TypedDict`; mypy does not look into columns."""
    names = tuple(columns)
    return cast("list[Entry]", [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)])
