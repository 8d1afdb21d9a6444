"""Places in a text: lines, columns, and which stretches are blank, by arrays over all characters."""

import re

import numpy as np
from numpy.typing import NDArray

from parser.findings.findings import Finding, Value
from parser.geometry.curves import Ints

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
