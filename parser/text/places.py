"""Places for people: ``part.3b:7:12``, a source line with a caret under what is meant, and keys of a TOML file."""

import re
import unicodedata
from functools import lru_cache
from itertools import accumulate
from typing import Final

from parser.text.encoding import printable

_ROOM = 100  # cells of a shown line
_BEFORE = 0.6  # share of them before the first caret, more where the line ends behind it


def place(name: str, line: int | None, column: int | None) -> str:
    """``name:line:column`` with only the parts that are known (0 and None are unknown)."""
    parts = [name, *(str(n) for n in (line, column) if n)]
    return ":".join(parts)


def caret_lines(excerpt: str, column: int, width: int = 1, room: int = _ROOM) -> tuple[str, str]:
    """A source line and the carets under the `width` characters from `column` (from 1) on, at least one.

    The line is windowed to `room` cells of a terminal around the first caret. Wide (CJK) characters take two cells, so
    carets stand under what they mean.
    """
    behind = first_cells(printable(excerpt[column - 1 : column - 1 + room]), room)
    most = max(int(room * _BEFORE), room - max(1, cells(behind)))
    before = first_cells(printable(excerpt[max(0, column - 1 - room) : column - 1])[::-1], most)[::-1]
    behind = first_cells(behind, room - cells(before))
    return before + behind, " " * cells(before) + "^" * max(1, cells(behind[:width]))


def cells(text: str) -> int:
    """Cells that a text takes in a terminal: two a wide character, none a combining one (Unicode, UAX #11)."""
    return len(text) if text.isascii() else sum(map(_cells, text))


def first_cells(text: str, room: int) -> str:
    """As much of the beginning of a text as `room` cells hold."""
    if text.isascii():
        return text[:room]
    for past, taken in enumerate(accumulate(map(_cells, text))):
        if taken > room:
            return text[:past]
    return text


@lru_cache(4096)
def _cells(char: str) -> int:
    if unicodedata.combining(char):
        return 0
    return 2 if unicodedata.east_asian_width(char) in {"W", "F"} else 1


_HEAD: Final = re.compile(r"[ \t]*\[\[?([^\[\]]+)\]\]?[ \t]*(?:#.*)?$")
_WORD = r"""(?:"[^"\n]*"|'[^'\n]*'|[\w-]+)"""
_KEY: Final = re.compile(rf"[ \t]*({_WORD}(?:[ \t]*\.[ \t]*{_WORD})*)[ \t]*=")
_PART: Final = re.compile(r"""[ \t]*(?:"([^"\n]*)"|'([^'\n]*)'|([\w-]+))[ \t]*(?:\.|$)""")


class KeyPlaces:
    """Places of the keys in a text of TOML, of which the file is called `name`."""

    def __init__(self, name: str, text: str) -> None:
        self._name = name
        self._places: dict[tuple[str, ...], tuple[int, int]] = {}
        section: tuple[str, ...] = ()
        for number, line in enumerate(text.split("\n"), start=1):
            head, key = _HEAD.match(line), _KEY.match(line)
            if head:
                section = _parts(head[1])
                self._places.setdefault(section, (number, line.index("[") + 1))
            elif key:
                self._places.setdefault((*section, *_parts(key[1])), (number, key.start(1) + 1))

    def of(self, *keys: str) -> str:
        """``makino.toml:7:1``: the place of a key, or of the nearest table around it that has one; else the file."""
        for length in range(len(keys), 0, -1):
            if keys[:length] in self._places:
                line, column = self._places[keys[:length]]
                return f"{self._name}:{line}:{column}"
        return self._name


def _parts(key: str) -> tuple[str, ...]:
    """The parts of a key with dots."""
    return tuple("".join(quoted) for quoted in _PART.findall(key))
