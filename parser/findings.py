"""Findings: what is wrong with a program, as data with a stable code.

The hundreds digit of a code names the layer: ``3B1xx`` grammar, ``3B2xx`` block, ``3B3xx`` contour, ``3B4xx`` machine.
"""

from enum import StrEnum
from typing import NamedTuple

from parser.encoding import printable


class Severity(StrEnum):
    """How a finding counts: an error fails the dry run, a warning and a note do not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


CATALOGUE: dict[str, tuple[Severity, str]] = {
    "3B100": (Severity.ERROR, "no 3B program"),
    "3B101": (Severity.ERROR, "unreadable text"),
    "3B102": (Severity.NOTE, "no end code"),
    "3B103": (Severity.ERROR, "blocks after the end code"),
    "3B104": (Severity.ERROR, "block in a remark"),
    "3B201": (Severity.ERROR, "arc without radius"),
    "3B202": (Severity.ERROR, "the counted axis never moves"),
    "3B205": (Severity.WARNING, "zero count length"),
    "3B206": (Severity.ERROR, "number beyond any table"),
    "3B207": (Severity.ERROR, "printed end differs from the decoded end"),
    "3B301": (Severity.ERROR, "open contour"),
    "3B302": (Severity.WARNING, "poor closure when stepped"),
    "3B303": (Severity.ERROR, "the stepped end misses the exact end"),
    "3B401": (Severity.ERROR, "out of travel"),
    "3B490": (Severity.ERROR, "not as the scenario expects"),
}
"""Code -> severity and title. Faults and their effects: the 3B notes in docs/3b.md, section 4."""


class Finding(NamedTuple):
    """One thing that is wrong, where, and what follows from it.

    Attributes
    ----------
    code
        Key of `CATALOGUE`.
    found, expected, machine
        What stands there; what should; what the machine would do with it.
    line, column
        Place in the program, counted from 1; 0 where the whole program is meant.
    block
        Block number counted from 1; 0 where no one block is meant.
    """

    code: str
    found: str
    expected: str
    machine: str
    line: int = 0
    column: int = 0
    block: int = 0

    @property
    def severity(self) -> Severity:
        """Severity that the catalogue gives this code."""
        return CATALOGUE[self.code][0]

    @property
    def title(self) -> str:
        """Title that the catalogue gives this code."""
        return CATALOGUE[self.code][1]

    @property
    def message(self) -> str:
        """Found, expected and the machine's doing, as one line."""
        return f"{self.found}; expected {self.expected}; {self.machine}"


def place(name: str, line: int | None, column: int | None) -> str:
    """``name:line:column`` with only the parts that are known (0 and None are unknown)."""
    parts = [name, *(str(n) for n in (line, column) if n)]
    return ":".join(parts)


def with_caret(excerpt: str, column: int) -> str:
    """A source line with a caret under `column` (from 1), windowed to 100 characters around it.

    Wide (CJK) characters before the caret take two cells, so the caret keeps its place in a terminal.
    """
    first = max(0, column - 61)
    window = printable(excerpt[first : first + 100])
    cells = sum(2 if ord(char) >= 0x1100 else 1 for char in window[: column - 1 - first])
    return f"    {window}\n    {' ' * cells}^"
