"""The factor between the inside, µm, and the millimetres that programs and people use; the largest length taken."""

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:  # the command line must start without numpy
    from parser.geometry.curves import Floats

UM_PER_MM = 1000.0
MAX_WORD_UM = 999_999_999
"""Largest length in a program, µm: a kilometre, a thousand times the travel of the largest table (DK7780, 1 m)."""
MAX_PLACE_UM = 9_999_999_999
"""Farthest place in a program, µm: 10 km. Blocks count from where they begin, and may lie far from 0."""
_Length = TypeVar("_Length", float, "Floats")


def mm(length_um: _Length) -> _Length:
    """µm to mm, a number or an array."""
    return length_um / UM_PER_MM


def from_mm(length_mm: _Length) -> _Length:
    """Mm to µm, a number or an array."""
    return length_mm * UM_PER_MM


def mm_text(length_um: float, digits: int = 3) -> str:
    """A length in mm for people, to the µm where nothing else is said; never −0."""
    return f"{round(mm(float(length_um)), digits) + 0.0:.{digits}f}"
