"""The factor between the inside, µm, and the millimetres that programs, settings and people use."""

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:  # the command line must start without numpy
    from parser.geometry.curves import Floats

UM_PER_MM = 1000.0
_Length = TypeVar("_Length", float, "Floats")


def mm(length_um: _Length) -> _Length:
    """µm to mm, a number or an array."""
    return length_um / UM_PER_MM


def from_mm(length_mm: _Length) -> _Length:
    """Mm to µm, a number or an array."""
    return length_mm * UM_PER_MM
