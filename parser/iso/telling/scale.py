"""The scale of the numbers of a listing: what 1 is, with and without a point (docs/iso.md §4)."""

from dataclasses import replace

from parser.iso.profiles.profile import Profile
from parser.iso.telling.marks import DIGITS_IN_MM, Seen
from parser.units import UM_PER_MM

UM_PER_INCH = 25.4 * UM_PER_MM
_STEP_IN = 1e-4  # inch, of numbers without a point
_MOST_OFFSET_IN = 0.03  # offsets of wires are 0.05 to 0.35 mm, 0.002 to 0.014 inch
_DIGITS_IN_INCH = 4


def scaled(seen: Seen, base: Profile, unit: str) -> tuple[Profile, str]:
    """A profile with the scale of a listing, and the term of what speaks for inches where they were told by it.

    `unit` is ``um``, ``mm`` or ``inch`` as told for the program, or empty: the family tells it then, and in a family
    that writes both mm and inches the numbers themselves.
    """
    inches = _inches(seen) if base.may_be_inch and not unit else ""
    if unit == "inch" or inches:
        return _in_inches(seen, base), inches
    if unit:
        integer_um = UM_PER_MM if unit == "mm" else 1.0
        base = replace(base, integer_um=integer_um, register_integer_um=integer_um)
    return replace(base, resolution_um=base.resolution_um * _finer(seen, DIGITS_IN_MM)), ""


def amount(length_um: float) -> str:
    """What a number of 1 is, for people: ``0.001 mm``, ``1 inch``."""
    inches = length_um / UM_PER_INCH
    if inches in {1.0, _STEP_IN}:
        return f"{inches:g} inch"
    return f"{length_um / UM_PER_MM:g} mm"


def _inches(seen: Seen) -> str:
    """Term of what speaks for inches in a family that writes both units; empty where nothing does."""
    offset = seen.greatest_setting
    if offset:
        return "because-small-offsets" if offset < _MOST_OFFSET_IN else ""
    return "because-four-digits" if seen.decimals > DIGITS_IN_MM else ""


def _in_inches(seen: Seen, base: Profile) -> Profile:
    step_um = _STEP_IN * UM_PER_INCH
    return replace(
        base,
        integer_um=step_um,
        point_um=UM_PER_INCH,
        register_integer_um=step_um,
        register_point_um=UM_PER_INCH,
        resolution_um=step_um * _finer(seen, _DIGITS_IN_INCH),
        step_um=step_um / 10,  # real programs have offsets of five digits
    )


def _finer(seen: Seen, digits: int) -> float:
    """The step of numbers that need more digits than usual, as a part of the usual one; not where some are integers."""
    return 10.0 ** min(digits - seen.decimals, 0) if seen.is_pointed.all() else 1.0
