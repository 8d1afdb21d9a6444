"""What people write and read, and what the engine counts in: lengths with units, durations, forces."""

import re
from fractions import Fraction

from parser.errors import SettingsError

ENGINE_FORCE_PER_N = 1e6
"""1 N is 10⁶ kg µm/s², the engine's unit of force where its lengths are µm."""

_LENGTHS_UM = {"um": 1, "µm": 1, "μm": 1, "mm": 1000, "cm": 10_000, "m": 1_000_000, "in": 25_400}
_LENGTH = re.compile(r"\s*([-+]?\d{1,12}(?:\.\d{0,12})?|[-+]?\.\d{1,12})\s*([a-zµμ]+)\s*", re.ASCII)


def parse_length(text: str) -> float:
    """Length such as ``40mm`` or ``0.18 mm`` in µm. SettingsError where it is no number with a unit of length."""
    match = _LENGTH.fullmatch(text)
    if not match or match[2] not in _LENGTHS_UM:
        raise SettingsError(f"{text!r} is no length; write a number with its unit, such as 40mm, 180um or 0.18mm")
    return float(Fraction(match[1]) * _LENGTHS_UM[match[2]])


def engine_force(force_n: float) -> float:
    """N to the engine's unit of force."""
    return force_n * ENGINE_FORCE_PER_N


def engine_stiffness(stiffness_n_um: float) -> float:
    """N/µm to the engine's force per length."""
    return stiffness_n_um * ENGINE_FORCE_PER_N


def clock(seconds: float) -> str:
    """Duration for people: ``2 h 27 min``, ``3 min 5 s``, ``12.4 s``."""
    if seconds < 60.0:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours} h {minutes} min"
