"""A list of lines, arcs and circles as CSV, mm: what a spreadsheet, a measuring machine or a script writes.

``line,x1,y1,x2,y2``, ``arc,x1,y1,x2,y2,cx,cy,ccw`` from the first place to the second one about a centre, ``cw`` for
clockwise, ``circle,cx,cy,r``. Rows that begin with ``#`` are remarks; a first row of names is one, too.
"""

import cmath
import math
import re
from collections.abc import Iterator
from typing import Final

from parser.drawing.model import UNITS
from parser.drawing.plots.source import Sheet, Source, arc_places
from parser.findings.errors import DrawingError
from parser.text.encoding import printable

_ROWS: Final = {"line": 4, "arc": 7, "circle": 3}
_ROUNDED_MM: Final = 0.002
"""How much the radii of an arc may differ at its ends: what three decimals lose, and a little."""


def list_source(text: str) -> Source:
    """The document of a list. DrawingError names the row that is none."""
    sheet = Sheet()
    for number, words in _rows(text):
        kind = words[0].lower()
        try:
            _draw(sheet, kind, words[1:])
        except (KeyError, ValueError):
            found = printable(",".join(words))[:60]
            raise DrawingError("curve-list-row", line=number, found=found) from None
    return Source(sheet.document, "CSV", UNITS[4])


def _rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """Rows with their numbers; decimal commas stand where fields are parted by semicolons."""
    for number, line in enumerate(text.splitlines(), start=1):
        row = line.strip().removeprefix("\ufeff")
        if not row or row.startswith("#") or row.lower().startswith("kind"):
            continue
        parted = row.replace(",", ".").split(";") if ";" in row else re.split(r"[,\t]", row)
        yield number, [word.strip() for word in parted]


def _draw(sheet: Sheet, kind: str, words: list[str]) -> None:
    """One row. KeyError for a kind that there is not, ValueError for numbers that are none, or make no curve."""
    if len(words) != _ROWS[kind]:
        raise ValueError
    numbers = [float(word) for word in words[:6]]
    if not all(map(math.isfinite, numbers)):
        raise ValueError
    if kind == "circle":
        x, y, radius = numbers
        if radius <= 0.0:
            raise ValueError
        sheet.circle(complex(x, y), radius)
        return
    start, end = complex(*numbers[:2]), complex(*numbers[2:4])
    if kind == "line":
        sheet.line(start, end)
        return
    center = complex(*numbers[4:6])
    turned = _turned(start - center, end - center, words[6].lower())
    places, bulges = zip(*arc_places(start, center, turned, end), strict=True)
    sheet.way([start, *places], [*bulges])


def _turned(start: complex, end: complex, sense: str) -> float:
    """By how much an arc turns from one way out of its centre to another one; a full turn where both are one."""
    if sense not in {"ccw", "cw"} or abs(abs(start) - abs(end)) > _ROUNDED_MM or not start:
        raise ValueError
    turned = cmath.phase(start.conjugate() * end) % (2.0 * math.pi) or 2.0 * math.pi
    return turned if sense == "ccw" else turned - 2.0 * math.pi or -2.0 * math.pi
