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

# Possessive quantifiers keep hostile runs of blanks and digits linear. `ws` is blank space within a line.
_WS = r"[ \t]*+"
_LABEL = rf"(?:N{_WS}(\d++){_WS}:?{_WS})?"
_NUMBER = rf"{_WS}(\d*+){_WS}"
_MM = rf"{_WS}([-+]?\d++(?:\.\d*+)?){_WS}"
_PRINTED = rf"(?:{_WS};{_MM},{_MM}(?![\d.]))?"
_BLOCK = rf"(B{_NUMBER}B{_NUMBER}B{_NUMBER}G{_WS}([XY]){_WS}(L|SR|NR){_WS}([1-4])){_PRINTED}"
_START_NODE = rf"Start{_WS}Point{_WS}={_MM},{_MM}[^\r\n]*"
_HEADER = r"(?:\*{2}|CAXA|Conn?er\s?R|Offset|Length)[^\r\n]*"
_REMARK = r"//[^\r\n]*|;[^\r\n]*|\([^()\r\n]*\)"
_TOKEN = re.compile(
    rf"{_LABEL}(?:{_BLOCK}|((?<![A-Z_])DD?)(?![A-Z0-9_])|{_START_NODE}|({_HEADER}|{_REMARK}))",
    re.IGNORECASE | re.ASCII,
)
_INKED_LINE = re.compile(r"[^\s\0-\x1f][^\r\n]*")
_LIKE_A_BLOCK = re.compile(r"B\s*+\d", re.IGNORECASE)
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

    Text that is no block, mark, header or remark becomes finding 3B101, and a word over `MAX_WORD_UM` becomes 3B206
    with its digits cut to ten; nothing is raised.
    """
    folded = narrow(text)
    lines = LineIndex(folded)
    words: list[str | None] = []  # one flat list: a hundred thousand tuples would keep the garbage collector busy
    spans: list[int] = []
    marks: list[Mark] = []
    covered = [0]
    for match in _TOKEN.finditer(folded):
        span, groups = match.span(), match.groups()
        covered += span
        if groups[1]:
            words += groups
            spans += match.span(_BLOCK_GROUP)
        elif not groups[13]:
            marks.append(_mark(groups, span, len(spans) // 2, lines.line(span[0])))
    covered.append(len(folded))
    raw = _columns(words, np.array(spans, dtype=np.int64).reshape(-1, 2), lines)
    findings = [*_too_large(raw, lines), *_gaps(covered, lines, first_block=spans[0] if spans else -1)]
    return Records(text, lines, raw, tuple(marks), tuple(sorted(findings, key=lambda f: (f.line, f.column))))


def _mark(groups: tuple[str | None, ...], span: tuple[int, int], after: int, line: int) -> Mark:
    mark, x, y = groups[10:13]
    if mark:
        return Mark("end" if len(mark) == 2 else "pause", after, line, span)
    return Mark("node", after, line, span, _mm(x or ""), _mm(y or ""))


def _mm(digits: str) -> float:
    """Printed millimetres to µm; beyond any table where the digits are hostile."""
    return from_mm(float(digits[:32]))


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
    """Digits to int64: an empty field is 0; more digits than `MAX_WORD_UM` has become a number over it."""
    digits = [digit or "0" for digit in column]
    if max(map(len, digits), default=0) > 10:
        digits = [(digit.lstrip("0") or "0")[:10] for digit in digits]
    return np.fromiter(map(int, digits), dtype=np.int64, count=len(digits))


def _too_large(raw: RawBlocks, lines: LineIndex) -> list[Finding]:
    worst = np.maximum(np.maximum(raw.x_um, raw.y_um), raw.count_um)
    return [
        Finding(
            "3B206",
            "a number of more than nine digits",
            f"at most {MAX_WORD_UM} µm, a kilometre",
            "the machine would run into its end stop",
            int(raw.line[row]),
            lines.column(int(raw.span[row, 0])),
            int(row) + 1,
        )
        for row in np.flatnonzero(worst > MAX_WORD_UM)
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
