"""Tokens: every character of a text in exactly one of them, for messages, editors and replays to point at."""

import re
from collections.abc import Iterator
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from parser.dialect.choices import STANDARD_MARKS, Marks
from parser.text.encoding import narrow
from parser.text.lines import LineIndex
from parser.text.source import Field, Span
from parser.threeb.grammar import BLOCK_FIELDS, GROUPS, HIDDEN_BLOCK, REMARK_SIGNS, token_pattern


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
