"""Texts broken into lines of a terminal, in cells: English between words, Chinese between any two characters.

`textwrap` counts characters, and rich moves a run of Chinese to the next line whole; neither keeps punctuation from
the beginning of a line, as Chinese typesetting asks for (W3C, Requirements for Chinese Text Layout, 3.1.6).
"""

import re
import shutil
import unicodedata
from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby
from typing import Final, NamedTuple, TextIO

from parser.text.places import cells, first_cells

WIDTH: Final = 80
"""Cells of a line where nobody looks at a terminal: files, pipes and logs get the same bytes everywhere."""
_NARROWEST, _WIDEST = 60, 100
_LEAST_ROOM = 20  # beside a long head

# Unicode's general categories: opening brackets and quotes; what closes them, and all other punctuation.
_NEVER_LAST = {"Ps", "Pi"}
_NEVER_FIRST = {"Pe", "Pf", "Po"}
_NUMBER = re.compile(r"[\d.,]+")


def width_of(stream: TextIO) -> int:
    """Cells of a line on a stream: those of its terminal within 60 to 100, or 80 where it is none."""
    if not stream.isatty():
        return WIDTH
    return min(max(shutil.get_terminal_size((WIDTH, 24)).columns, _NARROWEST), _WIDEST)


def wrapped(text: str, width: int = WIDTH, head: str = "", indent: str | None = None) -> list[str]:
    """Lines of a text of at most `width` cells: the first behind `head`, the others behind `indent`.

    Without an indent they stand under the first. A head that leaves no room stands on a line of its own. What is longer
    than a line, such as a path, is broken anywhere; blanks are lost only where a line ends.
    """
    indent = " " * cells(head) if indent is None else indent
    text = text.strip(" ")
    if cells(head) + cells(text) <= width:
        return [(head + text).rstrip()]
    room = max(width - cells(indent), min(width, _LEAST_ROOM))
    lines, left = [""], width - cells(head)
    for piece in _pieces(text, room):
        blanks = piece.blanks if lines[-1] else 0
        needed = blanks + cells(piece.text)
        if needed > left and (lines[-1] or (head and len(lines) == 1)):
            lines.append("")
            left, blanks, needed = room, 0, cells(piece.text)
        lines[-1] += " " * blanks + piece.text
        left -= needed
    return [(start + line).rstrip() for start, line in zip([head, *[indent] * (len(lines) - 1)], lines, strict=True)]


class _Piece(NamedTuple):
    """What stays in one line, and the blanks before it."""

    text: str
    blanks: int


def _pieces(text: str, room: int) -> Iterator[_Piece]:
    """The pieces of a text, none wider than `room` cells."""
    whole: list[_Piece] = []
    for piece in _units(text):
        last = whole[-1] if whole else None
        if last and _stay_together(last.text, piece.text):
            whole[-1] = _Piece(last.text + " " * piece.blanks + piece.text, last.blanks)
        else:
            whole.append(piece)
    for piece in whole:
        yield from _cut(piece, room)


def _stay_together(text: str, following: str) -> bool:
    """Whether no line ends between two texts: punctuation keeps its side, and a number what it counts."""
    opens, closes = _category(text[-1]) in _NEVER_LAST, _category(following[0]) in _NEVER_FIRST
    return opens or closes or (text[0].isdigit() and bool(_NUMBER.fullmatch(text)))


def _units(text: str) -> Iterator[_Piece]:
    """Words, and wide characters one by one."""
    blanks = 0
    for word in text.split(" "):
        for unit in _runs(word):
            yield _Piece(unit, blanks)
            blanks = 0
        blanks += 1


def _runs(word: str) -> Iterator[str]:
    if word.isascii():
        yield from filter(None, [word])
        return
    for is_wide, chars in groupby(word, lambda char: cells(char) > 1):
        run = "".join(chars)
        yield from run if is_wide else [run]


def _cut(piece: _Piece, room: int) -> Iterator[_Piece]:
    """A piece in parts that fit; none of them begins with punctuation where that can be."""
    text, blanks = piece
    if cells(text) <= room:
        yield piece
        return
    start = 0
    while start + (fits := len(first_cells(text[start : start + room], room))) < len(text):
        past = start + fits
        while past > start + 1 and _category(text[past]) in _NEVER_FIRST:
            past -= 1
        past = past if past > start + 1 else start + fits
        yield _Piece(text[start:past], blanks)
        start, blanks = past, 0
    yield _Piece(text[start:], blanks)


@lru_cache(4096)
def _category(char: str) -> str:
    return unicodedata.category(char)
