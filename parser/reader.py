"""3B text to records: blocks as columns of raw words, marks, start nodes, and what could not be read.

One pass of one pattern over the whole text; what stands between its matches is looked at only where it is not blank.
Spellings and their grades: docs/3b.md, sections 1 and 2.
"""

import re
from itertools import product
from typing import Literal, NamedTuple

import numpy as np

from parser.encoding import narrow
from parser.findings import Finding
from parser.lines import LineIndex
from parser.toolpath import Ints
from parser.units import from_mm

MAX_WORD_UM = 999_999_999
"""Largest X, Y or J taken, in µm: a kilometre, a thousand times the travel of the largest table (DK7780, 1 m)."""

_OVER_UM = MAX_WORD_UM + 1

# Possessive quantifiers keep hostile runs of blanks and digits linear. `_WS` is blank space within a line.
_WS = r"[ \t]*+"
_LABEL = rf"(?:N{_WS}(\d++){_WS}:?{_WS})?"
_NUMBER = rf"{_WS}(\d*+){_WS}"
_MM = rf"{_WS}([-+]?\d++(?:\.\d*+)?){_WS}"
_PRINTED = rf"(?:{_WS};{_MM},{_MM}(?![\d.]))?"
_BLOCK = rf"(B{_NUMBER}B{_NUMBER}B{_NUMBER}G{_WS}([XY]){_WS}(L|SR|NR){_WS}([1-4])){_PRINTED}"
_START_NODE = rf"Start{_WS}Point{_WS}={_MM},{_MM}[^\r\n]*"
_HEADER = r"(?:\*{2}|CAXA|Conn?er\s?R|Offset|Length)[^\r\n]*"
_REMARK = r"//[^\r\n]*|;[^\r\n]*|\([^()\r\n]*\)"
# A mark is a token: `D` in a word, in `part-D` or in `3D` is none; glued to a block it is.
_MARK = rf"((?:(?<![A-Z0-9_-])|(?<=[LR][1-4]))DD?)(?:(?![A-Z0-9_-])|(?=B{_WS}\d*+{_WS}B))"
_TOKEN = re.compile(
    rf"{_LABEL}(?:{_BLOCK}|{_MARK}|{_START_NODE}|({_HEADER}|{_REMARK}))",
    re.IGNORECASE | re.ASCII,
)
_HIDDEN_BLOCK = re.compile(_BLOCK, re.IGNORECASE | re.ASCII)
_INKED_LINE = re.compile(r"[^\s\0-\x1f][^\r\n]*")
_LIKE_A_BLOCK = re.compile(r"^\s*+(?:N\s*+\d++\s*+:?)?\s*+B\s*+\d|B\s*+\d*+\s*+B\s*+\d", re.IGNORECASE | re.MULTILINE)
# Groups of the pattern above, in its order.
_GROUPS = (
    *("label", "block", "x", "y", "j", "axis", "sense", "quadrant", "end_x", "end_y"),
    *("mark", "node_x", "node_y", "passed"),
)
_BLOCK_GROUP = _GROUPS.index("block") + 1

_AXES = {"X": 0, "Y": 1}
_TURNS = {"L": 0, "NR": 1, "SR": -1}


class RawBlocks(NamedTuple):
    """Columns of the blocks as written; int64 unless said otherwise, n rows.

    `span` is (n, 2) characters; `printed_um` is (n, 2) float64, NaN where no end is printed.
    """

    x_um: Ints
    y_um: Ints
    count_um: Ints
    count_axis: Ints
    turn: Ints
    quadrant: Ints
    span: Ints
    line: Ints
    label: tuple[str, ...]
    printed_um: np.ndarray[tuple[int, int], np.dtype[np.float64]]


class Mark(NamedTuple):
    """``D``, ``DD`` or a start node, standing after `after` blocks; `x_um`, `y_um` are the node's place."""

    kind: Literal["pause", "end", "node"]
    after: int
    line: int
    span: tuple[int, int]
    x_um: float = 0.0
    y_um: float = 0.0


class Records(NamedTuple):
    """All that was read of one text."""

    text: str
    lines: LineIndex
    blocks: RawBlocks
    marks: tuple[Mark, ...]
    findings: tuple[Finding, ...]


def read_records(text: str) -> Records:
    """Read a whole program text.

    Text that is no block, mark, header or remark becomes finding 3B101, and a word over `MAX_WORD_UM` becomes 3B206;
    nothing is raised.
    """
    folded = narrow(text)
    lines = LineIndex(folded)
    words: list[str | None] = []  # one flat list: a hundred thousand tuples would keep the garbage collector busy
    spans: list[int] = []
    marks: list[Mark] = []
    hidden: list[int] = []
    covered = [0]
    for match in _TOKEN.finditer(folded):
        span, groups = match.span(), match.groups()
        covered += span
        if groups[1]:
            words += groups
            spans += match.span(_BLOCK_GROUP)
            continue
        if not groups[13]:
            marks.append(_mark(groups, span, len(spans) // 2, lines.line(span[0])))
        if folded[span[0]] not in "/(" and (block := _HIDDEN_BLOCK.search(folded, *span)):
            hidden.append(block.start())
    covered.append(len(folded))
    raw = _columns(words, np.array(spans, dtype=np.int64).reshape(-1, 2), lines)
    findings = [
        *_hidden(hidden, lines),
        *_too_large(raw, marks, lines),
        *_gaps(covered, lines, first_block=spans[0] if spans else -1),
    ]
    return Records(text, lines, raw, tuple(marks), tuple(sorted(findings, key=lambda f: (f.line, f.column))))


def _mark(groups: tuple[str | None, ...], span: tuple[int, int], after: int, line: int) -> Mark:
    mark, x, y = groups[10:13]
    if mark:
        return Mark("end" if len(mark) == 2 else "pause", after, line, span)
    return Mark("node", after, line, span, _mm(x or ""), _mm(y or ""))


def _mm(digits: str) -> float:
    """Printed millimetres to µm, held at just over `MAX_WORD_UM` either way."""
    return max(-_OVER_UM, min(from_mm(float(digits[:32])), _OVER_UM))


def _columns(words: list[str | None], span: Ints, lines: LineIndex) -> RawBlocks:
    label, _, x, y, j, axis, sense, quadrant, end_x, end_y = (words[place :: len(_GROUPS)] for place in range(10))
    printed = np.full((len(x), 2), np.nan)
    for row in [row for row, end in enumerate(end_x) if end]:
        printed[row] = _mm(end_x[row] or ""), _mm(end_y[row] or "")
    return RawBlocks(
        x_um=_numbers(x),
        y_um=_numbers(y),
        count_um=_numbers(j),
        count_axis=_look_up(axis, _AXES),
        turn=_look_up(sense, _TURNS),
        quadrant=_numbers(quadrant),
        span=span,
        line=lines.lines(span[:, 0]),
        label=tuple([f"N{number}" if number else "" for number in label]),
        printed_um=printed,
    )


def _look_up(column: list[str | None], table: dict[str, int]) -> Ints:
    spellings: dict[str | None, int] = {spelling: value for key, value in table.items() for spelling in _cases(key)}
    return np.fromiter(map(spellings.__getitem__, column), dtype=np.int64, count=len(column))


def _cases(word: str) -> list[str]:
    """Every mix of upper and lower case of a word."""
    return ["".join(letters) for letters in product(*((letter, letter.lower()) for letter in word))]


def _numbers(column: list[str | None]) -> Ints:
    """Digits to int64: an empty field is 0, a number over `MAX_WORD_UM` is held at just over it."""
    digits = [digit or "0" for digit in column]
    if max(map(len, digits), default=0) > 10:
        digits = [(digit.lstrip("0") or "0")[:10] for digit in digits]
    return np.minimum(np.fromiter(map(int, digits), dtype=np.int64, count=len(digits)), _OVER_UM)


def _hidden(positions: list[int], lines: LineIndex) -> list[Finding]:
    return [
        Finding(
            "3B104",
            "a block in a header line or in a remark after `;`",
            "a block on a line of its own, or behind // where it is not to run",
            "some controllers would run it; the path here leaves it out",
            lines.line(at),
            lines.column(at),
        )
        for at in positions
    ]


def _too_large(raw: RawBlocks, marks: list[Mark], lines: LineIndex) -> list[Finding]:
    worst = np.maximum(np.maximum(raw.x_um, raw.y_um), raw.count_um)
    places = raw.span[worst > MAX_WORD_UM, 0].tolist()
    places += [mark.span[0] for mark in marks if max(abs(mark.x_um), abs(mark.y_um)) > MAX_WORD_UM]
    return [
        Finding(
            "3B206",
            f"a number over {MAX_WORD_UM} µm",
            "at most that, a kilometre",
            "the machine would run into its end stop",
            lines.line(at),
            lines.column(at),
        )
        for at in places
    ]


def _gaps(covered: list[int], lines: LineIndex, first_block: int) -> list[Finding]:
    """Findings for what no token covers. Before the first block, text that does not look like a block is header."""
    edges = np.array(covered, dtype=np.int64).reshape(-1, 2)
    inked = edges[lines.has_ink(edges[:, 0], edges[:, 1])].tolist()
    return [
        _unreadable(lines, left + line.start(), line[0])
        for left, right in inked
        if left >= first_block or _LIKE_A_BLOCK.search(lines.text, left, right)
        for line in _INKED_LINE.finditer(lines.text[left:right])
    ]


def _unreadable(lines: LineIndex, at: int, text: str) -> Finding:
    shown = text.rstrip() if len(text) <= 40 else text[:40] + "…"
    return Finding(
        "3B101",
        f"{shown!r} is no block, mark, header or remark",
        "a block such as `B 0 B 24900 B 24900 GY L2`, D or DD",
        "the controller would stop or skip it, and the path here leaves it out",
        lines.line(at),
        lines.column(at),
    )
