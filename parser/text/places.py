"""Places in a text: lines and columns, keys of a TOML file, and how people are shown them."""

import re
import unicodedata
from functools import lru_cache
from itertools import accumulate
from typing import Final

import numpy as np
from numpy.typing import NDArray

from parser.findings.findings import Finding, Value
from parser.geometry.curves import Ints
from parser.text.encoding import printable

LINE_END = re.compile(r"\r\n|\r|\n")
"""What ends a line of a program: LF, CRLF or CR, and no other character that Python's `splitlines` cuts at."""

_LF, _CR, _SPACE = 0x0A, 0x0D, 0x20

Codes = NDArray[np.uint8]
"""(n,) the characters of a text, one a byte: those of ASCII, and a question mark for any other."""


class LineIndex:
    """Line and column, both from 1, of the characters of one text. Lines end with LF, CRLF or CR."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.codes: Codes = np.frombuffer(text.encode("ascii", "replace"), dtype=np.uint8)
        """The characters of the text."""
        code = self.codes
        cr = code == _CR
        cr[:-1] &= code[1:] != _LF
        self._starts = np.concatenate([[0], np.flatnonzero((code == _LF) | cr) + 1])
        self._ink = np.concatenate([[0], np.cumsum(code > _SPACE)])

    def lines(self, position: Ints) -> Ints:
        """Lines of (n,) characters, (n,) int64."""
        return np.searchsorted(self._starts, position, side="right")

    def places(self, position: Ints) -> tuple[Ints, Ints]:
        """Lines and columns of (n,) characters, each (n,) int64."""
        line = self.lines(position)
        return line, position - self._starts[line - 1] + 1

    def line(self, position: int) -> int:
        """Line of one character."""
        return int(self._starts.searchsorted(position, side="right"))

    def column(self, position: int) -> int:
        """Column of one character."""
        return position - int(self._starts[self.line(position) - 1]) + 1

    def has_ink(self, first: Ints, past: Ints) -> NDArray[np.bool_]:
        """Whether there is more than blanks and control characters from `first` up to but without `past`, each (n,)."""
        inked: NDArray[np.bool_] = self._ink[past] > self._ink[first]
        return inked

    def bounds(self, line: int) -> tuple[int, int]:
        """First character of a line, and one past its last before the line end."""
        first = int(self._starts[line - 1])
        past = int(self._starts[line]) if line < len(self._starts) else len(self.text)
        tail = self.text[max(first, past - 2) : past]
        return first, past - len(tail) + len(tail.rstrip("\r\n"))

    def inked_lines(self, without: Ints) -> Ints:
        """Lines, in order, that hold more than blanks and control characters outside of the spans `without` (m, 2)."""
        covers = np.zeros(len(self.text) + 1, dtype=np.int64)
        np.add.at(covers, without[:, 0], 1)
        np.add.at(covers, without[:, 1], -1)
        bare = np.cumsum(covers[:-1]) == 0
        line = self.lines(np.flatnonzero(bare & (np.diff(self._ink) > 0)))
        return line[np.diff(line, prepend=-1) > 0]

    def finding(self, code: str, span: tuple[int, int], block: int = 0, **values: Value) -> Finding:
        """Finding at a span of characters, in a block (from 1; 0 in none)."""
        return Finding(code, values, span, self.line(span[0]), self.column(span[0]), block)


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
