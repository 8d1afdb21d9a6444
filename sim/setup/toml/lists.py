"""Kinds of settings that are lists: of lengths, of places, of whole numbers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from parser.findings.errors import SettingsError
from parser.toolpath import Point
from parser.units import from_mm
from sim.setup.toml.kinds import ValueKind, in_mm
from sim.setup.toml.reader import Bound, number

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
        return tuple(self._entry(one, f"{where}: {key}: entry {at}") for at, one in enumerate(value, start=1))

    def _entry(self, value: Any, where: str) -> Any:
        return number(value, self.bound, where)


class Lengths(_List):
    """Lengths in mm."""

    name = "lengths"
    unit = "mm"

    def kept(self, value: Any) -> tuple[float, ...]:
        """In µm."""
        return tuple(from_mm(one) for one in value)

    def written(self, value: Any) -> list[float] | None:
        """In mm."""
        return [in_mm(one) for one in value] or None


class Places(_List):
    """Places [x, y] in mm."""

    name = "places"
    unit = "mm"

    def _entry(self, value: Any, where: str) -> tuple[float, float]:
        if not isinstance(value, list) or len(value) != 2:
            raise SettingsError("no-point", where=where, found=value)
        x, y = (number(one, self.bound, where) for one in value)
        return x, y

    def kept(self, value: Any) -> tuple[Point, ...]:
        """In µm."""
        return tuple(Point(from_mm(x), from_mm(y)) for x, y in value)

    def written(self, value: Any) -> list[list[float]] | None:
        """In mm."""
        return [[in_mm(place.x), in_mm(place.y)] for place in value] or None


class Wholes(_List):
    """Whole numbers."""

    name = "wholes"

    def _entry(self, value: Any, where: str) -> int:
        if isinstance(value, float):
            raise SettingsError("not-whole", where=where, found=value)
        return int(number(value, self.bound, where))

    def kept(self, value: Any) -> tuple[int, ...]:
        """As they are."""
        return tuple(value)

    def written(self, value: Any) -> list[int] | None:
        """A list of them."""
        return list(value) or None
