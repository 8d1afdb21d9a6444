"""Places in a program for people: ``part.3b:7:12``, and a source line with a caret under what is meant."""

import unicodedata

from parser.text.encoding import printable

_BEFORE = 60
_WINDOW = 100


def place(name: str, line: int | None, column: int | None) -> str:
    """``name:line:column`` with only the parts that are known (0 and None are unknown)."""
    parts = [name, *(str(n) for n in (line, column) if n)]
    return ":".join(parts)


def with_caret(excerpt: str, column: int, width: int = 1) -> str:
    """A source line and a line of carets below it, both set in by four blanks."""
    shown, carets = caret_lines(excerpt, column, width)
    return f"    {shown}\n    {carets}"


def caret_lines(excerpt: str, column: int, width: int = 1) -> tuple[str, str]:
    """A source line and the carets under the `width` characters from `column` (from 1) on, at least one.

    The line is windowed to 100 characters around the first caret. Wide (CJK) characters take two cells of a terminal,
    so carets stand under what they mean.
    """
    first = max(0, column - 1 - _BEFORE)
    shown = printable(excerpt[first : first + _WINDOW])
    at = column - 1 - first
    return shown, " " * cells(shown[:at]) + "^" * max(1, cells(shown[at : at + width]))


def cells(text: str) -> int:
    """Cells that a text takes in a terminal: two a wide character, none a combining one (Unicode, UAX #11)."""
    return len(text) if text.isascii() else sum(map(_cells, text))


def _cells(char: str) -> int:
    if unicodedata.combining(char):
        return 0
    return 2 if unicodedata.east_asian_width(char) in {"W", "F"} else 1
