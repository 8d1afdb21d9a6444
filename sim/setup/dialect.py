"""What is told of the programs of a shop beside their text: dialect, unit, and the values of offset registers."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from parser.dialect.reader import (
    UNITS,
    ChosenDialect,
    OwnDialect,
    Registers,
    merged,
    register_name,
)
from parser.files import read_text
from parser.findings.errors import SettingsError
from parser.program import dialects, own_dialect
from parser.text.places import KeyPlaces
from parser.units import from_mm
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import OneOf, ValueKind, in_mm, limits
from sim.setup.toml.reader import Bound, load_toml, number, section, text

REGISTER_MM = Bound(-10.0, 10.0)
"""Value of an offset register; a negative one swaps the sides (docs/iso.md §9)."""


OWN_SUFFIX = ".toml"
"""Ends the name of a dialect that is a file."""


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


def own_dialect_of(file: Path) -> OwnDialect:
    """A dialect of one's own from a file, named as that is without its suffix.

    Raises FileUnreadableError, and SettingsError with line and column for what no profile can have.
    """
    content = load_toml(file)
    return own_dialect(file.stem.lower(), content, KeyPlaces(str(file), read_text(file)))


def own_dialects_of(content: Mapping[str, Any], file: Path, name: str, above: tuple[str, ...]) -> dict[str, OwnDialect]:
    """Dialects of one's own under ``[dialects]`` of a settings file, by their names; the file is called `name`.

    `content` stands in the file under the tables `above`, such as ``tool.drycut``.

    Each is a table, or the name of its file, from the folder of the settings. Raises as `own_dialect_of` does.
    """
    listed = section(content, "dialects", name)
    if not listed:
        return {}
    places, own = KeyPlaces(name, read_text(file)), {}
    for key, value in listed.items():
        under = (*above, "dialects", key)
        if isinstance(value, str):
            own[key] = own_dialect_of(file.parent / value)._replace(name=key)
        elif isinstance(value, Mapping):
            own[key] = own_dialect(key, value, places, under)
        else:
            raise SettingsError("no-dialect", where=places.of(*under), key=key, found=value)
    return own


def chosen_dialect(name: str, folder: Path, own: Mapping[str, OwnDialect], where: str) -> ChosenDialect:
    """The dialect of a name: one of a shop's own, that of a file from a folder, or a profile; empty of an empty one.

    Raises SettingsError where there is none, and as `own_dialect_of`.
    """
    if name.endswith(OWN_SUFFIX):
        return own_dialect_of(folder / name)
    if name in own:
        return own[name]
    if name and name not in dialects():
        words = ", ".join((*own, *dialects()))
        raise SettingsError("key-not-one-of", where=where, key="dialect", words=words, found=name)
    return name


class DialectName(OneOf):
    """A profile, or the file of a dialect of one's own, which ends in ``.toml``."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The name as written."""
        name = text(table, key, where)
        return name if name.endswith(OWN_SUFFIX) else super().checked(table, key, where)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"anyOf": [super().schema(), {"type": "string", "pattern": r"\.toml$"}]}


def _written(owner: Any) -> str | None:
    """The name of a dialect in a file; of one of a shop's own that of its file."""
    own = owner.dialect
    return f"{own}{OWN_SUFFIX}" if isinstance(own, OwnDialect) else own or None


DIALECT = Key("dialect", DialectName(dialects()), default="", get=_written)
UNIT = Key("unit", OneOf(UNITS), default="", get=lambda owner: owner.unit or None)
REGISTERS = Key("registers_mm", RegisterTable(), "registers", default=())
"""Also of a machine file, under ``[controller]``: they stand there, whatever program runs."""
READ_WITH = (DIALECT, UNIT, REGISTERS)
"""The keys that scenario files and settings have in common."""
