"""Units that a DXF file may be drawn in, by its header variable $INSUNITS."""

from typing import NamedTuple

from parser.units import UM_PER_MM


class Unit(NamedTuple):
    """A unit of length by its name, and µm in one of it."""

    name: str
    um: float


_INCH_MM = 25.4

# Codes as the DXF reference gives them for $INSUNITS.
_UNITS = {
    1: Unit("inch", _INCH_MM * UM_PER_MM),
    2: Unit("foot", 12.0 * _INCH_MM * UM_PER_MM),
    4: Unit("mm", UM_PER_MM),
    5: Unit("cm", 10.0 * UM_PER_MM),
    6: Unit("m", 1000.0 * UM_PER_MM),
    8: Unit("microinch", _INCH_MM * UM_PER_MM / 1e6),
    9: Unit("mil", _INCH_MM * UM_PER_MM / 1e3),
    12: Unit("nm", 1e-3),
    13: Unit("µm", 1.0),
    14: Unit("dm", 100.0 * UM_PER_MM),
}


def unit_of(code: object) -> tuple[Unit, str | None]:
    """The unit that $INSUNITS names, mm where it names none; with a note on what was assumed."""
    if isinstance(code, int) and code in _UNITS:
        return _UNITS[code], None
    said = "names no unit" if code in (None, 0) else f"names a unit that no part is drawn in ($INSUNITS {code})"
    return _UNITS[4], f"the file {said}; taken as mm"
