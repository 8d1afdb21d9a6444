"""Where lines, blocks and fields stand in the text of a program, whatever the dialect.

What people call the blocks of a program: by the labels of its listing where it has some, else by their numbers.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Final

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


_LONGEST: Final = 8
"""Characters of a label; a longer one has no room in tables and pictures, and its block is called by its number."""


class BlockNames:
    """Names of the blocks of a program.

    A block is called by its label, ``N18``. Where several blocks bear one label, the number of the block stands behind
    it: ``N3 (17)``. A block without a label is called by its number in the program, from 1: ``14``.

    Parameters
    ----------
    block
        (n,) int64, number of the block of each row; of a program that a controller adds rows to, several rows have one.
    label
        n labels as printed; empty where there is none.
    """

    def __init__(self, block: Ints, label: Sequence[str]) -> None:
        rows = zip(block.tolist(), label, strict=True) if any(label) else ()
        self._block = block
        self._label = {number: each for number, each in rows if each and len(each) <= _LONGEST}
        bearers = Counter(self._label.values())
        self._other: Mapping[int, str] = {
            number: each if bearers[each] == 1 else f"{each} ({number})" for number, each in self._label.items()
        }

    def __call__(self, number: int) -> str:
        """Name of the block of a number."""
        return self._other.get(number, str(number))

    def of_row(self, row: int) -> str:
        """Name of the block of a row, from 0. IndexError beyond the last row."""
        return self(int(self._block[row]))

    def at(self, place: int) -> str:
        """Name of the block in a place of the path, from 1, as reports count: rows that a controller adds count too."""
        return self.of_row(place - 1)

    def of_rows(self) -> list[str]:
        """Names of the blocks of all rows."""
        return [self(number) for number in self._block.tolist()]

    def label(self, row: int) -> str:
        """Label of the block of a row, where its number stands beside it; empty where there is none."""
        return self._label.get(int(self._block[row]), "")

    def named(self, findings: Iterable[Finding]) -> tuple[Finding, ...]:
        """Findings of the program, each with what the blocks are called that its texts may speak of."""
        return tuple(finding._replace(names=self._names_in(finding)) for finding in findings)

    @property
    def other(self) -> Mapping[int, str]:
        """Names of the blocks, by number, that are called otherwise than by their numbers."""
        return self._other

    def _names_in(self, finding: Finding) -> dict[int, str]:
        numbers = (finding.block, *finding.values.values())
        return {number: self._other[number] for number in numbers if isinstance(number, int) and number in self._other}


Span = tuple[int, int]
"""First character, and one past the last."""


class Field(StrEnum):
    """What a field of a block says, whatever letter it stands behind."""

    X = "x"
    Y = "y"
    COUNT = "count"
    RADIUS = "radius"
    AXIS = "axis"
    SENSE = "sense"
    SIDE = "side"
    REGISTER = "register"

    @property
    def term(self) -> str:
        """Its term of the catalogue."""
        return f"field-{self.value}"


def no_fields(text: str) -> Mapping[Field, Span]:
    """Where the fields of a block stand that nobody can point at: nowhere."""
    return {}


@dataclass(frozen=True, eq=False)
class Source:
    """Where each row stands in the program text.

    Attributes
    ----------
    text
        The whole program.
    block
        (n,) int64, number of each block in the program, from 1; rows that a controller adds bear that of the block
        they belong to.
    span
        (n, 2) int64, first character and one past the last of each block.
    line
        (n,) int64, from 1.
    label
        n labels as printed, such as ``N3``; empty where there is none.
    fields_of
        Where the fields stand in the text of a block, as its reader finds them; those that are written.
    """

    text: str
    block: Ints
    span: Ints
    line: Ints
    label: tuple[str, ...]
    fields_of: Callable[[str], Mapping[Field, Span]] = no_fields

    @cached_property
    def names(self) -> BlockNames:
        """What people call its blocks; worked out once."""
        return BlockNames(self.block, self.label)

    def picked(self, row: Ints) -> "Source":
        """The source of the rows `row`."""
        label = tuple(self.label[at] for at in row.tolist())
        return Source(self.text, self.block[row], self.span[row], self.line[row], label, self.fields_of)

    def block_text(self, row: int) -> str:
        """Text of the block in a row (from 0), as written."""
        return self.text[slice(*self.span[row].tolist())]

    def field(self, row: int, field: Field) -> Span | None:
        """Where a field of the block in a row (from 0) stands; None where the block has none of the kind."""
        within = self.fields_of(self.block_text(row)).get(field)
        first = int(self.span[row, 0])
        return within and (first + within[0], first + within[1])
