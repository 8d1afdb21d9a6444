"""Markdown on a terminal: headings, paragraphs, lists, tables and fenced text in lines of a width, without its signs.

rich draws Markdown too, but it moves a run of Chinese to the next line whole, and its tables cut words.
"""

import re
import unicodedata
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

from parser.text.encoding import printable
from parser.text.places import cells
from sim.show.terminal.wrap import WIDTH, wrapped

_SET_IN = "    "  # of fenced text
_GAP = "  "  # between the columns of a table
_FENCED = re.compile(r"^```.*\n((?:.*\n)*?)```$", re.MULTILINE)
_COMMENT = re.compile(r"<!--.*?-->\n?", re.DOTALL)
_HEADING = re.compile(r"#+ .*|\*\*[^*]+\*\*")
"""A heading, or a line in bold."""
_ITEM = re.compile(r"\s*(?:[*-]|\d+\.) ")
_CELLS = re.compile(r"(?<!\\)\|")
_RULE = re.compile(r"[|:\s-]+")
_CODE = re.compile(r"(`[^`]+`)")
_SIGNS = re.compile(r"\*\*")


class ShownLine(NamedTuple):
    """A line, and whether it is a heading."""

    text: str
    is_heading: bool = False


def shown_lines(markdown: str, width: int = WIDTH) -> Iterator[ShownLine]:
    """The lines of a text, of at most `width` cells but for those of fenced text, which stay as they are."""
    before = ""
    for at, text in enumerate(_FENCED.split(_COMMENT.sub("", markdown))):  # every second one is fenced
        blocks = [text.splitlines()] if at % 2 else _blocks(text)
        for block in blocks:
            kind = "fence" if at % 2 else _kind(block[0])
            if before and before != "heading" and not before == kind == "item":
                yield ShownLine("")
            yield from _lines(kind, block, width)
            before = kind


def plain(text: str) -> str:
    """A text in one line without the signs of Markdown."""
    parts = _CODE.split(_in_one_line(text))
    return printable("".join(part[1:-1] if at % 2 else _SIGNS.sub("", part) for at, part in enumerate(parts)))


def _in_one_line(text: str) -> str:
    """The lines joined: with a blank, but for Chinese, which needs none, nor does its punctuation."""
    first, *others = [" ".join(line.split()) for line in text.splitlines() if line.strip()] or [""]
    joined = first
    for line in others:
        ends, begins = (cells(char) > 1 for char in (joined[-1], line[0]))
        closes = ends and unicodedata.category(joined[-1]).startswith("P")
        joined += line if (ends and begins) or closes else f" {line}"
    return joined


def _blocks(text: str) -> Iterator[list[str]]:
    """Headings, items, tables and paragraphs, each by its lines."""
    block: list[str] = []
    for line in text.splitlines():
        if block and not _goes_on(_kind(block[0]), _kind(line)):
            yield block
            block = []
        if line.strip():
            block.append(line)
    if block:
        yield block


def _goes_on(kind: str, following: str) -> bool:
    """Whether a line of a kind belongs to the block before it."""
    return following == "table" == kind or (following == "text" and kind in {"text", "item"})


def _kind(line: str) -> str:
    if not line.strip():
        return "blank"
    if line.startswith("|"):
        return "table"
    if _HEADING.fullmatch(line):
        return "heading"
    return "item" if _ITEM.match(line) else "text"


def _lines(kind: str, block: Sequence[str], width: int) -> Iterator[ShownLine]:
    if kind == "fence":
        set_in = _SET_IN[: max(0, width - max(map(cells, block), default=0))]
        yield from (ShownLine((set_in + printable(line)).rstrip()) for line in block)
    elif kind == "table":
        yield from map(ShownLine, _table(block, width))
    else:
        item = _ITEM.match(block[0]) if kind == "item" else None
        head = item[0] if item else ""
        text = "\n".join(block)[len(head) :].lstrip("#")
        yield from (ShownLine(line, kind == "heading") for line in wrapped(plain(text), width, head))


def _table(rows: Sequence[str], width: int) -> Iterator[str]:
    """The rows in columns, each cell wrapped; the heads end with a line."""
    table = [
        [plain(cell.replace("\\|", "|")) for cell in _CELLS.split(row.strip().strip("|"))]
        for row in rows
        if not _RULE.fullmatch(row)
    ]
    widths = _widths(list(zip(*table, strict=True)), width - len(_GAP) * (len(table[0]) - 1))
    for at, row in enumerate(table):
        columns = [wrapped(cell, room) for cell, room in zip(row, widths, strict=True)]
        for line in zip_longest(*columns, fillvalue=""):
            yield _GAP.join(text + " " * (room - cells(text)) for text, room in zip(line, widths, strict=True)).rstrip()
        if not at:
            yield _GAP.join("-" * room for room in widths)


def _widths(columns: Sequence[Sequence[str]], room: int) -> list[int]:
    """Widths of columns that fit together: the widest give way, all alike, and words are cut last."""
    whole = [max(map(cells, column)) for column in columns]
    words = [max(cells(word) for text in column for word in text.split(" ")) for column in columns]
    for least in (words, [1] * len(words)):
        most = max(whole)
        while most > 1 and sum(map(min, whole, (max(most, each) for each in least))) > room:
            most -= 1
        widths = [min(each, max(most, word)) for each, word in zip(whole, least, strict=True)]
        if sum(widths) <= room:
            break
    return widths
