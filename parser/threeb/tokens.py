"""Tokens: every character of a text in exactly one of them, for messages, editors and replays to point at.

The spellings of 3B and 4B as patterns over folded text (`parser.text.encoding.narrow`).

Spellings and their grades: docs/3b.md, sections 1, 2 and 6.
"""

import re
from collections.abc import Iterator
from enum import StrEnum
from functools import cache
from itertools import chain
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import STANDARD_MARKS, Marks
from parser.text.encoding import narrow
from parser.text.source import Field, LineIndex, Span

OWN_MARKS = Marks(end=("DD",), pause=("D",))
"""Marks of the dialect itself (docs/3b.md §2)."""
FOREIGN_ENDS = ("E", "FF", "MJ")
"""End marks of other controllers (docs/3b.md §2, recalled): read as the end, with a warning."""

# Possessive quantifiers keep hostile runs of blanks and digits linear. `WS` is blank space within a line.
WS = r"[ \t]*+"
_LINE_START = r"(?<![^\r\n])"
# `N7:`, `N7`, `7:`; a bare number only where a line begins with it: before a block, `7 DD`, `7DD`, but not `3D`.
_LINE_IS_DONE = rf"{WS}(?![^\r\n;/(])"
_BARE = rf"{_LINE_START}{WS}(\d++)(?:[ \t]++(?=B|DD?{_LINE_IS_DONE})|(?=DD{_LINE_IS_DONE}))"
LABEL = rf"(?:N{WS}(\d++){WS}:?{WS}|(?<![A-Z0-9])(\d++){WS}:{WS}|{_BARE})?"
_NUMBER = rf"B{WS}(\d*+){WS}"
_MM = rf"{WS}([-+]?(?:\d++(?:\.\d*+)?|\.\d++)){WS}"
_PRINTED = rf"{WS};{_MM},{_MM}(?![\d.])"
_CURVE = r"(DD?)"
# A 4B block has a fourth number, 0 or none for a line, and its curve mark behind that or behind the axis.
_RADIUS = rf"B{WS}(\d*+){WS}(?:{_CURVE}{WS})?"
BLOCK = (
    rf"({_NUMBER}{_NUMBER}{_NUMBER}(?:{_RADIUS})?"
    rf"G{WS}([XY]){WS}(?:{_CURVE}{WS})?(L|[SN]{WS}R){WS}([1-4])(?!\d))"
)
BLOCK_WORDS = ("B", "N", "L", "S", "G", "X", "Y", "GX", "GY", "NR", "SR")
"""Words of letters that stand in blocks and their labels, in parts and whole: as marks they would break blocks up."""
_START_NODE = rf"Start{WS}Point{WS}[=:]{WS}\(?{_MM},{_MM}[^\r\n]*"
_HEADER = r"(?:\*{2}|CAXA|Co(?:nn?|rn)er\s?R|Offset|Length)[^\r\n]*"
REMARK_SIGNS = "/(;"
"""First characters of remarks."""
_REMARK = r"//[^\r\n]*|;[^\r\n]*|\([^()\r\n]*\)"

FLAGS = re.IGNORECASE | re.ASCII
HIDDEN_BLOCK = re.compile(BLOCK, FLAGS)
# A line that was meant for a block: a number behind its first B or between two, a count axis with a machining code,
# or numbers with O or l among their digits.
_MISREAD = rf"B{WS}[0-9OIL]++{WS}"
LIKE_A_BLOCK = re.compile(
    rf"{_LINE_START}{WS}(?:N{WS}\d++{WS}:?{WS})?B{WS}\d|B{WS}\d*+{WS}B{WS}\d"
    rf"|G{WS}[XY]{WS}(?:DD?{WS})?(?:L|[NS]{WS}R){WS}\d"
    rf"|(?<![A-Z]){_MISREAD}{_MISREAD}(?:G|{_MISREAD})",
    FLAGS,
)

BLOCK_FIELDS = ("x", "y", "count", "radius", "mark_before", "axis", "mark_behind", "sense", "quadrant")
GROUPS = (
    *("label", "number", "bare_number", "block", *BLOCK_FIELDS, "end_x", "end_y"),
    *("mark", "node_x", "node_y", "passed"),
)
"""Groups of the token pattern, in its order."""

GROUP_AT = {name: place for place, name in enumerate(GROUPS)}
"""Places of the groups in `GROUPS`, from 0."""


@cache
def token_pattern(marks: Marks) -> re.Pattern[str]:
    """Pattern whose matches are the blocks, marks, start nodes, headers and remarks of a text."""
    known = {*chain(*OWN_MARKS, *marks), *FOREIGN_ENDS}
    words = sorted(known, key=lambda word: (-len(word), word))
    # A mark is a token: `D` in a word, in `part-D` or in `3D` is none; glued to a block or behind `N7` it is.
    mark = (
        rf"((?(1)|(?(3)|(?:(?<![A-Z0-9_-])|(?<=[LR][1-4]))))(?:{'|'.join(map(re.escape, words))}))"
        rf"(?:(?![A-Z0-9_-])|(?=B{WS}\d*+{WS}B))"
    )
    # Words behind a printed end are a remark up to the line end, unless a mark or a number is among them.
    no_mark = rf"(?![^\r\n\d]*(?<![A-Z0-9_-])(?:{'|'.join(map(re.escape, words))})(?![A-Z0-9_-]))"
    tail = rf"(?:{WS}{no_mark}[^\s\d;/()][^\r\n\d;/()]*+(?![^\r\n;/(]))?"
    printed = rf"(?:{_PRINTED}{tail})?"
    return re.compile(rf"{LABEL}(?:{BLOCK}{printed}|{mark}|{_START_NODE}|({_HEADER}|{_REMARK}))", FLAGS)


class TokenKind(StrEnum):
    """What a token is. The kinds from `X` to `DIRECTION` are the fields of a block."""

    BLANK = "blank"
    NEWLINE = "newline"
    LABEL = "label"
    SEPARATOR = "separator"
    X = "x"
    Y = "y"
    COUNT = "count"
    RADIUS = "radius"
    CURVE = "curve"
    AXIS = "axis"
    DIRECTION = "direction"
    PRINTED_END = "printed end"
    MARK = "mark"
    START_NODE = "start node"
    HEADER = "header"
    REMARK = "remark"
    OTHER = "other"


class Token(NamedTuple):
    """Characters `first` up to but without `past` of the text; line and column of the first, from 1."""

    kind: TokenKind
    text: str
    first: int
    past: int
    line: int
    column: int


_FIELD_KINDS = {
    **{"x": TokenKind.X, "y": TokenKind.Y, "count": TokenKind.COUNT, "radius": TokenKind.RADIUS},
    **{"mark_before": TokenKind.CURVE, "axis": TokenKind.AXIS, "mark_behind": TokenKind.CURVE},
}
_GROUP = {name: place for place, name in enumerate(GROUPS, start=1)}
_FIELDS = {
    **{TokenKind.X: Field.X, TokenKind.Y: Field.Y, TokenKind.COUNT: Field.COUNT, TokenKind.RADIUS: Field.RADIUS},
    **{TokenKind.AXIS: Field.AXIS, TokenKind.DIRECTION: Field.SENSE},
}
_BETWEEN = re.compile(r"(\r\n|\r|\n)|([^\S\r\n]+)|(B)|[^\sB]+", re.IGNORECASE)
_Piece = tuple[TokenKind, int, int]


def tokens(text: str, marks: Marks = STANDARD_MARKS) -> tuple[Token, ...]:
    """Tokens of a text, in order and without gaps: joined they are the text again."""
    folded = narrow(text)
    pieces = [piece for piece in _pieces(folded, marks) if piece[2] > piece[1]]
    line, column = LineIndex(folded).places(np.array([first for _, first, _ in pieces], dtype=np.int64))
    return tuple(
        Token(kind, text[first:past], first, past, at_line, at_column)
        for (kind, first, past), at_line, at_column in zip(pieces, line.tolist(), column.tolist(), strict=True)
    )


def fields_of(block: str) -> dict[Field, Span]:
    """Where the fields of a block stand in its text; the axis with its G, the sense with its quadrant."""
    match = HIDDEN_BLOCK.fullmatch(narrow(block))
    pieces = _fields(match) if match else []
    return {_FIELDS[kind]: (low, high) for kind, low, high in pieces if kind in _FIELDS}


def _pieces(folded: str, marks: Marks) -> Iterator[_Piece]:
    at = 0
    for match in token_pattern(marks).finditer(folded):
        yield from _between(folded, at, match.start(), TokenKind.OTHER)
        at = match.end()
        if match[_GROUP["block"]]:
            yield from _block(folded, match)
            continue
        kind = _kind(match, folded)
        first = match.start(_GROUP["mark"]) if kind is TokenKind.MARK else match.start()
        yield from _between(folded, match.start(), first, TokenKind.LABEL)
        yield kind, first, at
    yield from _between(folded, at, len(folded), TokenKind.OTHER)


def _kind(match: re.Match[str], folded: str) -> TokenKind:
    if match[_GROUP["mark"]]:
        return TokenKind.MARK
    if match[_GROUP["node_x"]]:
        return TokenKind.START_NODE
    return TokenKind.REMARK if folded[match.start()] in REMARK_SIGNS else TokenKind.HEADER


def _block(folded: str, match: re.Match[str]) -> Iterator[_Piece]:
    """Label, fields and printed end of a block, with what stands between them."""
    first, past = match.span(_GROUP["block"])
    yield from _between(folded, match.start(), first, TokenKind.LABEL)
    block = HIDDEN_BLOCK.fullmatch(folded, first, past)
    for kind, low, high in _fields(block) if block else ():
        yield from _between(folded, first, low, TokenKind.OTHER)
        yield kind, low, high
        first = high
    yield from _between(folded, first, past, TokenKind.OTHER)
    if match.end() > past:
        yield TokenKind.PRINTED_END, past, match.end()


def _fields(block: re.Match[str]) -> list[_Piece]:
    """Fields of a block that are written, in order; the axis with its G, the sense with its quadrant."""
    span = {name: block.span(place) for place, name in enumerate(("block", *BLOCK_FIELDS), start=1)}
    fields = [(kind, *span[name]) for name, kind in _FIELD_KINDS.items() if span[name][0] >= 0]
    fields.append((TokenKind.DIRECTION, span["sense"][0], span["quadrant"][1]))
    return [(kind, _axis_start(block, low) if kind is TokenKind.AXIS else low, high) for kind, low, high in fields]


def _axis_start(block: re.Match[str], letter: int) -> int:
    """Place of the G before the axis letter."""
    return max(block.string.rfind(g, block.start(), letter) for g in "Gg")


def _between(folded: str, first: int, past: int, kind: TokenKind) -> Iterator[_Piece]:
    """Newlines, blanks and the letters B between other tokens; what is none of these is of `kind`."""
    for match in _BETWEEN.finditer(folded, first, past):
        newline, blank, letter = match.groups()
        yield _between_kind(newline, blank, letter, kind), *match.span()


def _between_kind(newline: str | None, blank: str | None, letter: str | None, other: TokenKind) -> TokenKind:
    if newline:
        return TokenKind.NEWLINE
    if blank:
        return TokenKind.BLANK
    return TokenKind.SEPARATOR if letter else other
