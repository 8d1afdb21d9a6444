"""What is told of the programs of a shop beside their text: dialect, unit, and the values of offset registers."""

from collections.abc import Mapping
from typing import Any

from parser.dialect.choices import UNITS, Registers, merged, register_name
from parser.findings.errors import SettingsError
from parser.program import dialects
from parser.units import from_mm
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import OneOf, ValueKind, in_mm, limits
from sim.setup.toml.reader import Bound, number, section

REGISTER_MM = Bound(-10.0, 10.0)
"""Value of an offset register; a negative one swaps the sides (docs/iso.md §9)."""


class RegisterTable(ValueKind):
    """Values of offset registers by their names."""

    name = "registers"
    unit = "mm"
    bound = REGISTER_MM

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Registers:
        """Names and values in mm."""
        return tuple(_register(name, value, f"{where}: {key}") for name, value in section(table, key, where).items())

    def inside(self, value: Any) -> Registers:
        """In µm, by their names."""
        return merged([tuple((name, from_mm(by_mm)) for name, by_mm in value)])

    def written(self, value: Any) -> dict[str, float] | None:
        """A table; nothing where there are none."""
        return {name: in_mm(by_um) for name, by_um in value} or None

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "object", "additionalProperties": {"type": "number", **limits(REGISTER_MM)}}


def _register(name: str, by_mm: object, where: str) -> tuple[str, float]:
    known = register_name(name)
    if not known:
        raise SettingsError("no-offset-register", where=where, name=name)
    return known, number(by_mm, REGISTER_MM, f"{where}: {name}")


DIALECT = Key("dialect", OneOf(dialects()), default="", get=lambda owner: owner.dialect or None)
UNIT = Key("unit", OneOf(UNITS), default="", get=lambda owner: owner.unit or None)
REGISTERS = Key("registers_mm", RegisterTable(), "registers", default=())
"""Also of a machine file, under ``[controller]``: they stand there, whatever program runs."""
READ_WITH = (DIALECT, UNIT, REGISTERS)
"""The keys that scenario files and settings have in common."""
