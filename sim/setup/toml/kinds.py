"""Kinds of settings: how a value is read from a file, kept inside, and written again.

Kinds of settings that are lists: of lengths, of places, of whole numbers.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from parser.toolpath import Point
from parser.units import from_mm, mm
from sim.setup.toml.reader import PLACE_MM, Bound, number, pair, text, truth

DIGITS = 9
"""More than anyone sets; what is left of a change of units is rounded away."""


class Scale(NamedTuple):
    """Change of units: from those of a file to those inside, and back."""

    inside: Callable[[float], float]
    written: Callable[[float], float]


def in_mm(length_um: float) -> float:
    """Millimetres as they were set."""
    return round(mm(length_um), DIGITS)


AS_IS = Scale(float, lambda value: value)
MM_AS_UM = Scale(from_mm, in_mm)
MM_MIN_AS_UM_S = Scale(lambda mm_min: from_mm(mm_min) / 60.0, lambda um_s: round(mm(um_s) * 60.0, DIGITS))
MS_AS_S = Scale(lambda ms: ms / 1e3, lambda s: round(s * 1e3, DIGITS))
US_AS_S = Scale(lambda us: us / 1e6, lambda s: round(s * 1e6, DIGITS))
DEGREES_AS_RAD = Scale(math.radians, lambda rad: round(math.degrees(rad), DIGITS))


def limits(bound: Bound) -> dict[str, float]:
    """JSON schema of the numbers within bounds, infinite ones left out."""
    ends = {"minimum": bound.low, "maximum": bound.high}
    return {name: end for name, end in ends.items() if math.isfinite(end)}


def pair_schema(bound: Bound) -> dict[str, Any]:
    """JSON schema of two numbers within bounds, such as a place [x, y]."""
    entry = {"type": "number", **limits(bound)}
    return {"type": "array", "minItems": 2, "maxItems": 2, "items": entry}


class ValueKind(ABC):
    """What the values of a key are. Each kind has a name, by which texts about settings call it."""

    name: str
    unit: str = ""
    """Unit of its numbers in a file."""
    bound: Bound | None = None
    """Bounds of its numbers, or of how many there are."""

    @abstractmethod
    def schema(self) -> dict[str, Any]:
        """JSON schema of its values as they stand in a file."""

    @abstractmethod
    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Any:
        """Value of a key as it stands in the file. SettingsError where it is missing or none of this kind."""

    def inside(self, value: Any) -> Any:
        """The value as it is kept inside."""
        return value

    def written(self, value: Any) -> Any:
        """What was kept as a file holds it."""
        return value


class Text(ValueKind):
    """Any text but an empty one."""

    name = "text"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The text."""
        return text(table, key, where)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "string", "minLength": 1}


class Name(Text):
    """A text that is shown to people."""

    def inside(self, value: Any) -> str:
        """Without control characters."""
        return printable(value)


class FileName(Text):
    """A file beside the one that names it."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The path, which ends in a name."""
        path = super().checked(table, key, where)
        if not Path(path).name:
            raise SettingsError("no-file-name", where=where, key=key, found=path)
        return path

    def inside(self, value: Any) -> Path:
        """The path as it was given."""
        return Path(value)

    def written(self, value: Any) -> str:
        """Its name alone."""
        return printable(value.name)


class Keys(ValueKind):
    """Names of keys of the file."""

    name = "keys"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
        """The names."""
        names = table[key]
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            raise SettingsError("no-list-of-keys", where=where, key=key, found=names)
        return tuple(names)

    def written(self, value: Any) -> list[str] | None:
        """A list of them; nothing where there are none."""
        return list(value) or None

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "array", "items": {"type": "string"}}


class Margins(ValueKind):
    """By keys of the file, how far their values may be off, in their units."""

    name = "margins"
    bound = Bound(0.0, 1e9)

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> dict[str, float]:
        """The margins by their keys."""
        found = table[key]
        if not isinstance(found, dict):
            raise SettingsError("no-table-of-keys", where=where, key=key, found=found)
        return {name: number(value, self.bound, f"{where}: {key}: {printable(name)}") for name, value in found.items()}

    def inside(self, value: Any) -> tuple[tuple[str, float], ...]:
        """Pairs of key and margin."""
        return tuple(dict(value).items())

    def written(self, value: Any) -> dict[str, float] | None:
        """A table of them; nothing where there are none."""
        return dict(value) or None

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "object", "additionalProperties": {"type": "number", **limits(self.bound)}}


@dataclass(frozen=True)
class OneOf(ValueKind):
    """One of a few words."""

    words: tuple[str, ...]
    name = "word"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The word."""
        word = text(table, key, where)
        if word not in self.words:
            raise SettingsError("key-not-one-of", where=where, key=key, words=", ".join(self.words), found=word)
        return word

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"enum": list(self.words)}


@dataclass(frozen=True)
class Number(ValueKind):
    """A number in its bounds."""

    bound: Bound
    unit: str = ""
    scale: Scale = AS_IS
    name = "number"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Any:
        """The number."""
        if key not in table:
            raise SettingsError("key-missing", where=where, key=key)
        return number(table[key], self.bound, f"{where}: {key}")

    def inside(self, value: Any) -> float:
        """In the unit inside."""
        return self.scale.inside(value)

    def written(self, value: Any) -> float:
        """In the unit of the file."""
        return self.scale.written(value)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "number", **limits(self.bound)}


class Whole(Number):
    """A whole number, written without a point."""

    name = "whole"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Any:
        """The number, an integer."""
        if isinstance(table.get(key), float):
            raise SettingsError("key-not-whole", where=where, key=key, found=table[key])
        return super().checked(table, key, where)

    def inside(self, value: Any) -> int:
        """A count."""
        return int(value)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {**super().schema(), "type": "integer"}


class Truth(ValueKind):
    """True or false."""

    name = "truth"

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> bool:
        """The truth."""
        return truth(table, key, where)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {"type": "boolean"}


class TablePlace(ValueKind):
    """A place [x, y] on the table."""

    name = "place"
    unit = "mm"
    bound = PLACE_MM

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> tuple[float, float] | None:
        """Its two numbers."""
        return pair(table, key, where)

    def written(self, value: Any) -> list[float]:
        """A list of two."""
        return list(value)

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return pair_schema(PLACE_MM)


MOST = 10_000
"""Entries of a list: more than any drawing has figures that somebody names one by one."""


@dataclass(frozen=True)
class _List(ValueKind):
    """A list whose entries are checked one by one; nothing is written where there are none."""

    bound: Bound

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> tuple[Any, ...]:
        """The entries."""
        value = table[key]
        if not isinstance(value, list) or len(value) > MOST:
            raise SettingsError("list-too-long", where=where, key=key, most=MOST)
        return tuple(self._entry(each, f"{where}: {key}: entry {at}") for at, each in enumerate(value, start=1))

    def _entry(self, value: Any, where: str) -> Any:
        return number(value, self.bound, where)

    def schema(self) -> dict[str, Any]:
        """Of a list."""
        return {"type": "array", "maxItems": MOST, "items": {"type": "number", **limits(self.bound)}}


class Lengths(_List):
    """Lengths in mm."""

    name = "lengths"
    unit = "mm"

    def inside(self, value: Any) -> tuple[float, ...]:
        """In µm."""
        return tuple(from_mm(each) for each in value)

    def written(self, value: Any) -> list[float] | None:
        """In mm."""
        return [in_mm(each) for each in value] or None


class Places(_List):
    """Places [x, y] in mm."""

    name = "places"
    unit = "mm"

    def _entry(self, value: Any, where: str) -> tuple[float, float]:
        if not isinstance(value, list) or len(value) != 2:
            raise SettingsError("no-point", where=where, found=value)
        x, y = (number(each, self.bound, where) for each in value)
        return x, y

    def inside(self, value: Any) -> tuple[Point, ...]:
        """In µm."""
        return tuple(Point(from_mm(x), from_mm(y)) for x, y in value)

    def written(self, value: Any) -> list[list[float]] | None:
        """In mm."""
        return [[in_mm(place.x), in_mm(place.y)] for place in value] or None

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {**super().schema(), "items": pair_schema(self.bound)}


class Wholes(_List):
    """Whole numbers."""

    name = "wholes"

    def _entry(self, value: Any, where: str) -> int:
        if isinstance(value, float):
            raise SettingsError("not-whole", where=where, found=value)
        return int(number(value, self.bound, where))

    def inside(self, value: Any) -> tuple[int, ...]:
        """As they are."""
        return tuple(value)

    def written(self, value: Any) -> list[int] | None:
        """A list of them."""
        return list(value) or None

    def schema(self) -> dict[str, Any]:
        """Of its values."""
        return {**super().schema(), "items": {"type": "integer", **limits(self.bound)}}
