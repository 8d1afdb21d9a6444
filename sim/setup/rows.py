"""Rows of CSV files that shops and measuring machines write: named columns, numbers with a point or a comma.

The first row names the columns, in letters of either case and any order; other columns may stand beside those that are
asked for. Fields are parted by commas, semicolons or tabs, by what parts the first row. Where that is no comma, numbers
may have a decimal comma. Empty rows and those that begin with ``#`` are passed over.
"""

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from parser.files import read_bytes
from parser.findings.errors import ProgramError, SettingsError
from parser.text.encoding import decode_text, printable
from sim.setup.toml.reader import Bound

MOST_ROWS: Final = 1_000_000
_SEPARATORS: Final = ";\t,"
_SHOWN: Final = 40


class Row(NamedTuple):
    """One row: its file and line, and what stands in each column that was asked for; empty where nothing does."""

    file: str
    line: int
    fields: Mapping[str, str]
    has_commas: bool

    def text(self, column: str) -> str:
        """What stands in a column; empty where there is no such column."""
        return self.fields.get(column, "")

    def number(self, column: str, bound: Bound) -> float | None:
        """The number in a column, None where nothing stands there. SettingsError for what is none, or out of bounds."""
        found = self.text(column)
        if not found:
            return None
        try:
            value = float(found.replace(",", ".") if self.has_commas else found)
        except ValueError:
            value = math.nan
        if not bound.low <= value <= bound.high:
            raise self.refused(column, f"{bound.low:g} … {bound.high:g}")
        return value

    def refused(self, column: str, expected: str) -> SettingsError:
        """What to raise for what stands in a column."""
        found = printable(self.text(column))[:_SHOWN]
        return SettingsError("row-field", file=self.file, line=self.line, column=column, found=found, expected=expected)


def read_rows(path: Path, columns: Sequence[str], needed: Sequence[str] = ()) -> list[Row]:
    """Rows of a file, with those of the columns that it has.

    Raises FileUnreadableError, and SettingsError where it lacks a needed column or any of them, or has no row.
    """
    name = printable(str(path))
    try:
        text, _ = decode_text(read_bytes(path))
    except ProgramError:  # a reader of programs says so of what is empty, or no text
        raise SettingsError("rows-empty", file=name, columns=", ".join(columns)) from None
    lines = [(at, line) for at, line in enumerate(text.removeprefix("\ufeff").splitlines(), start=1) if _counts(line)]
    if not lines:
        raise SettingsError("rows-empty", file=name, columns=", ".join(columns))
    head = lines[0][1]
    separator = max(_SEPARATORS, key=head.count)
    names = [field.strip().lower() for field in _parted(head, separator)]
    at = {column: names.index(column) for column in columns if column in names}
    if not at or any(column not in at for column in needed):
        missing = next((column for column in needed if column not in at), columns[0])
        found = printable(head)[:_SHOWN]
        raise SettingsError(
            "rows-lack-column", file=name, line=lines[0][0], column=missing, found=found, columns=", ".join(columns)
        )
    if len(lines) - 1 > MOST_ROWS:
        raise SettingsError("rows-too-many", file=name, most=MOST_ROWS)
    rows = [*_rows(name, lines[1:], separator, at)]
    if not rows:
        raise SettingsError("rows-empty", file=name, columns=", ".join(columns))
    return rows


def _counts(line: str) -> bool:
    return bool(line.strip(" \t;,")) and not line.lstrip().startswith("#")


def _rows(name: str, lines: Sequence[tuple[int, str]], separator: str, at: Mapping[str, int]) -> Iterator[Row]:
    for number, line in lines:
        fields = _parted(line, separator)
        of_columns = {column: fields[of].strip() for column, of in at.items() if of < len(fields)}
        yield Row(name, number, of_columns, separator != ",")


def _parted(line: str, separator: str) -> list[str]:
    return next(csv.reader([line], delimiter=separator), [])
