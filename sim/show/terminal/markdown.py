"""Markdown on a terminal, and the documents for users that are shown so.

Markdown on a terminal: headings, paragraphs, lists, tables and fenced text in lines of a width, without its signs.

rich draws Markdown too, but it moves a run of Chinese to the next line whole, and its tables cut words.

The documents for users, which pages of findings cite: beside the code in a wheel, in ``docs`` of the repository.

A document in Chinese stands beside the English one: ``check.zh.md`` and ``check.md`` are one document.
"""

import re
import unicodedata
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import zip_longest
from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.catalogue import Language
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


_PACKAGE: Final = Path(__file__).parents[2]
_NOT_FOR_USERS: Final = {"architecture", "code-flow", "findings", "record"}
"""Documents of those who change drycut, and those made of the pages of all codes; a wheel has none of them."""
_CHINESE = ".zh"
_TWIN = re.compile(r"^\[[^\[\]]+\]\([\w.-]+\.md\)\n\n", re.MULTILINE)
"""The paragraph that leads to the same document in the other language."""
_LINK = re.compile(r"\[([^\[\]]+)\]\([^)]+\)")
_CITED = re.compile(r"\b(?:docs/)?(\w+)(\.zh)?\.md\b", re.ASCII)
_TITLE_SIGNS = re.compile(r"^#+ ")
_FENCE = "```"


@cache
def documents() -> tuple[str, ...]:
    """Names of the documents, in their order; ``drycut explain NAME`` shows them."""
    return tuple(sorted({file.split(".")[0] for file in files()}))


@cache
def files() -> tuple[str, ...]:
    """Their files, in English and in Chinese where a document is written in it."""
    return tuple(sorted(path.name for path in _folder().glob("*.md") if path.name.split(".")[0] not in _NOT_FOR_USERS))


def document(name: str, language: Language = "en") -> str:
    """Markdown of a document, in English where the language has none. KeyError where there is no such document."""
    if name not in documents():
        raise KeyError(name)
    chinese = _folder() / f"{name}{_CHINESE}.md"
    is_chinese = language == "zh" and chinese.exists()
    return (chinese if is_chinese else _folder() / f"{name}.md").read_text(encoding="utf-8")


def section(markdown: str, number: str) -> str:
    """The section ``## NUMBER. …`` of a document. KeyError where it has none."""
    lines, inside, fenced = [], False, False
    for line in markdown.splitlines():
        fenced ^= line.startswith(_FENCE)
        if not fenced and line.startswith("## "):
            inside = line.startswith(f"## {number}. ")
        if inside:
            lines.append(line)
    if not lines:
        raise KeyError(number)
    return "\n".join(lines)


def cited(markdown: str) -> str:
    """Markdown that cites documents by the command that shows them: ``docs/3b.md §2`` is ``drycut explain 3b §2``."""
    return _CITED.sub(_command, _LINK.sub(r"\1", _TWIN.sub("", markdown)))


def title(name: str, language: Language = "en") -> str:
    """Heading of a document, in English where the language has none. KeyError where there is no such document."""
    return _TITLE_SIGNS.sub("", document(name, language).split("\n", 1)[0])


def _folder() -> Path:
    shipped = _PACKAGE / "docs"
    return shipped if shipped.is_dir() else _PACKAGE.parent / "docs"


def _command(match: re.Match[str]) -> str:
    if match[1] == "findings":  # made of the pages of all codes, which the command lists
        return "drycut explain --lang zh" if match[2] else "drycut explain"
    return f"drycut explain {match[1]}" if match[1] in documents() else match[0]
