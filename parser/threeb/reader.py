"""Program text to records: blocks as columns of raw words, marks, start nodes, headers, and what could not be read.

Lines that hold one block alone are read as arrays, all others by one pass of one pattern; what stands between its
matches is looked at only where it is not blank.

Blocks of four numbers that are no 4B blocks: damaged ones, and those that took a number of the block before.
"""

import re
from array import array
from bisect import bisect_left
from itertools import chain
from operator import itemgetter
from typing import Literal, NamedTuple

import numpy as np

from parser.dialect.reader import STANDARD_MARKS, Marks
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, TooLarge, file_order
from parser.geometry.curves import Ints
from parser.text.encoding import narrow, no_program
from parser.text.source import LineIndex
from parser.threeb.columns import RawBlocks, all_rows, columns_of, columns_of_plain, plain_lines, read_mm
from parser.threeb.damage import Unread, unread
from parser.threeb.print_checks import (
    Header,
    HeaderLength,
    read_header,
    read_length,
)
from parser.threeb.tokens import (
    FOREIGN_ENDS,
    GROUP_AT,
    HIDDEN_BLOCK,
    LIKE_A_BLOCK,
    OWN_MARKS,
    REMARK_SIGNS,
    token_pattern,
)
from parser.units import MAX_PLACE_UM, MAX_WORD_UM

RADIUS_TOLERANCE_UM = 1.0
"""R of 4B is written in whole µm."""

_ENDS_IN_NUMBER = re.compile(r"B\s*\d*\s*$", re.IGNORECASE)
_B = re.compile("B", re.IGNORECASE)


def without_stolen_numbers(raw: RawBlocks, covered: Ints, folded: str) -> tuple[RawBlocks, Ints]:
    """Take from 3B blocks the number that they took from a damaged block before them, as if it were their own first.

    ``B1B2B3 B4B5B6GXL1`` holds a block without its end and a whole 3B block, not a 4B block ``B3B4B5B6GXL1``. Four
    numbers make a 4B block only with a curve mark, or in a program of 4B blocks and with an R as 4B has it. In
    ``B5 B1B0B1GXL1`` the last three numbers make a line.
    """
    is_four = raw.radius_um >= 0
    doubtful = is_four & (raw.curve == 0)
    if 2 * int(is_four.sum()) >= len(raw.line):
        doubtful &= (raw.turn == 0) & (raw.radius_um > 0)
    counted = np.where(raw.count_axis == 0, raw.y_um, raw.count_um)
    makes_line = (raw.turn == 0) & (raw.radius_um > 0) & (counted == raw.radius_um)
    four = np.flatnonzero(doubtful)
    if not len(four):
        return raw, covered
    columns = {name: column.copy() for name, column in raw._asdict().items() if name not in ("label", "printed_um")}
    edges = covered.copy()
    for row in four.tolist():
        first = int(raw.span[row, 0])
        gap = int(np.searchsorted(edges, first, side="right")) - 1  # the token begins at or before its block
        before = folded[edges[gap - 1] : edges[gap]] if edges[gap] == first else ""
        if not makes_line[row] and not _ENDS_IN_NUMBER.search(before):
            continue
        second = _B.search(folded, first + 1)
        assert second  # noqa: S101 - a block has at least three
        edges[gap] = columns["span"][row, 0] = second.start()
        columns["x_um"][row], columns["y_um"][row] = raw.y_um[row], raw.count_um[row]
        columns["count_um"][row], columns["radius_um"][row] = raw.radius_um[row], -1
    return raw._replace(**columns), edges


def misfits(raw: RawBlocks) -> list[int]:
    """Rows of four numbers that are damaged: lines with a radius and, among 3B blocks, arcs whose R is not of X and Y.

    An arc with a curve mark, or in a program of 4B blocks, is no damaged block then, but a 4B block whose R is wrong.
    """
    is_four = raw.radius_um >= 0
    if not is_four.any():
        return []
    is_line = raw.turn == 0
    off = (raw.curve == 0) & ~is_line & (np.abs(np.hypot(raw.x_um, raw.y_um) - raw.radius_um) > RADIUS_TOLERANCE_UM)
    if 2 * int(is_four.sum()) >= len(raw.line):
        off[:] = False
    rows: list[int] = np.flatnonzero(is_four & (off | (is_line & (raw.radius_um > 0)))).tolist()
    return rows


def left_out(raw: RawBlocks, covered: Ints, rows: list[int]) -> tuple[RawBlocks, Ints]:
    """The blocks without these rows, and what tokens cover without their text; printed ends stay covered."""
    edges = covered.copy()
    edges[np.searchsorted(edges[1::2], raw.span[rows, 0], side="right") * 2 - 1] = raw.span[rows, 1]
    columns = {name: np.delete(column, rows, axis=0) for name, column in raw._asdict().items() if name != "label"}
    gone = set(rows)
    labels = tuple(label for row, label in enumerate(raw.label) if row not in gone)
    return RawBlocks(**columns, label=labels), edges


_MARK, _PASSED = GROUP_AT["mark"], GROUP_AT["passed"]

_LINE = re.compile(r"[^\r\n]+")
_BLOCKS_AT_ONCE = 1 << 16
MOST_BLOCKS = 2_000_000
"""Blocks that are read of one program: twenty times as many as the longest programs of lace and gears (assumed)."""


class Mark(NamedTuple):
    """``D``, ``DD`` or a start node, standing after `after` blocks; `x_um`, `y_um` are the node's place.

    `word` is the mark as written, in capitals; of a node it is empty.
    """

    kind: Literal["pause", "end", "node"]
    after: int
    line: int
    span: tuple[int, int]
    word: str = ""
    x_um: float = 0.0
    y_um: float = 0.0


class Records(NamedTuple):
    """All that was read of one text."""

    text: str
    lines: LineIndex
    blocks: RawBlocks
    marks: tuple[Mark, ...]
    header: Header
    damages: tuple[Unread, ...]
    findings: tuple[Finding, ...]
    remarks: Ints


class _Tokens(NamedTuple):
    """What the pattern found.

    Attributes
    ----------
    blocks
        As written.
    covered
        (2m + 2,) int64, ends of the stretches between tokens, one after the other, from 0 to the end of the text.
    marks, passed, lengths
        Marks and start nodes; header lines and remarks behind ``;``; lengths in start nodes.
    remarks
        (m, 2) int64, first character and one past the last of each remark, with what begins and ends it.
    """

    blocks: RawBlocks
    covered: Ints
    marks: list[Mark]
    passed: list[tuple[int, int]]
    remarks: Ints
    lengths: list[HeaderLength]


def read_records(text: str, marks: Marks = STANDARD_MARKS) -> Records:
    """Read a whole program text.

    Text that is no block, mark, header or remark becomes finding 3B101, a damaged block 3B106, a word over
    `MAX_WORD_UM` 3B206. Raises ProgramError (3B100) for more than `MOST_BLOCKS`.
    """
    folded = narrow(text)
    lines = LineIndex(folded)
    raw, covered, found, passed, remarks, lengths = _tokens(folded, lines, marks)
    raw, covered = without_stolen_numbers(raw, covered, folded)
    damaged_rows = misfits(raw)
    if damaged_rows:
        raw, covered = left_out(raw, covered, damaged_rows)
        found = [mark._replace(after=mark.after - bisect_left(damaged_rows, mark.after)) for mark in found]
    damaged = unread(
        folded, _gaps(covered, lines, first_block=int(raw.span[0, 0]) if len(raw.line) else len(folded)), raw.span[:, 0]
    )
    outside = [*passed, *(mark.span for mark in found if mark.kind == "node")]
    findings = [
        *(lines.finding("3B104", hidden) for span in outside for hidden in _hidden(folded, span)),
        *_too_large(raw, found, lines),
        *(damage.finding(lines) for damage in damaged),
    ]
    header = read_header(folded, [span for span in passed if folded[span[0]] != ";"], lengths)
    ordered = tuple(sorted(findings, key=file_order))
    return Records(text, lines, raw, tuple(found), header, damaged, ordered, remarks)


def _tokens(folded: str, lines: LineIndex, marks: Marks) -> _Tokens:
    """The tokens of a text: those of its plain lines, and what the pattern finds between them."""
    plain = plain_lines(lines.codes)
    if len(plain.span) > MOST_BLOCKS:
        raise _too_many_blocks()
    between = _matched(folded, lines, marks, _inked(lines, plain.span), MOST_BLOCKS - len(plain.span))
    if not len(plain.span):
        return between
    before = plain.span[:, 0].searchsorted([mark.span[0] for mark in between.marks]).tolist()
    marked = [mark._replace(after=mark.after + n) for mark, n in zip(between.marks, before, strict=True)]
    spans = np.concatenate([plain.span, between.covered[1:-1].reshape(-1, 2)])
    spans = spans[np.argsort(spans[:, 0], kind="stable")]
    return between._replace(
        blocks=all_rows([columns_of_plain(plain, lines), between.blocks]),
        covered=np.concatenate([[0], spans.ravel(), [len(folded)]]),
        marks=marked,
    )


def _inked(lines: LineIndex, spans: Ints) -> list[tuple[int, int]]:
    """Stretches of a text outside of the spans (n, 2) that are not blank."""
    edges = np.concatenate([[0], spans.ravel(), [len(lines.text)]]).reshape(-1, 2)
    inked: list[tuple[int, int]] = edges[lines.has_ink(edges[:, 0], edges[:, 1])].tolist()
    return inked


def _matched(
    folded: str, lines: LineIndex, marks: Marks, stretches: list[tuple[int, int]], most_blocks: int
) -> _Tokens:
    """What the pattern finds in stretches of a text, which begin and end with lines or with plain blocks.

    Words become numbers every so many blocks: as texts they take ten times the room.
    """
    read: list[RawBlocks] = []
    words: list[str | None] = []  # one flat list: a hundred thousand tuples would keep the garbage collector busy
    spans, covered, remarks = array("q"), array("q", [0]), array("q")
    found: list[Mark] = []
    passed: list[tuple[int, int]] = []
    lengths: list[HeaderLength] = []
    block, number = GROUP_AT["block"] + 1, 0
    pattern = token_pattern(marks)
    for match in chain.from_iterable(pattern.finditer(folded, *stretch) for stretch in stretches):
        span, groups = match.span(), match.groups()
        covered.extend(span)
        if groups[block - 1]:
            number += 1
            words += groups
            spans.extend(match.span(block))
            if number > most_blocks:
                raise _too_many_blocks()
            if number % _BLOCKS_AT_ONCE == 0:
                read.append(columns_of(words, _pairs(spans), lines))
                words, spans = [], array("q")
        elif groups[_PASSED]:
            if folded[span[0]] not in "/(":
                passed.append(span)
            if groups[_PASSED][0] in REMARK_SIGNS:
                remarks.extend(match.span(_PASSED + 1))
        else:
            found.append(_mark(groups, span, number, lines.line(span[0]), marks))
            lengths += read_length(folded, span)
    covered.append(len(folded))
    read.append(columns_of(words, _pairs(spans), lines))
    return _Tokens(all_rows(read), np.array(covered, dtype=np.int64), found, passed, _pairs(remarks), lengths)


def _too_many_blocks() -> ProgramError:
    return ProgramError(no_program("too-many-blocks", f"{MOST_BLOCKS:,}"))


def _pairs(ends: "array[int]") -> Ints:
    """Firsts and pasts, one after the other, as (n, 2)."""
    return np.array(ends, dtype=np.int64).reshape(-1, 2)


def _mark(groups: tuple[str | None, ...], span: tuple[int, int], after: int, line: int, marks: Marks) -> Mark:
    word, x, y = groups[_MARK : _MARK + 3]
    if not word:
        return Mark("node", after, line, span, "", read_mm(x or ""), read_mm(y or ""))
    word = word.upper()
    ends = word in {*OWN_MARKS.end, *marks.end} or (word in FOREIGN_ENDS and word not in marks.pause)
    return Mark("end" if ends else "pause", after, line, span, word)


def _hidden(folded: str, span: tuple[int, int]) -> list[tuple[int, int]]:
    """Span of the first whole block in a header line or in a remark after ``;``."""
    block = HIDDEN_BLOCK.search(folded, *span)
    return [block.span()] if block else []


def _too_large(raw: RawBlocks, marks: list[Mark], lines: LineIndex) -> list[Finding]:
    worst = np.maximum.reduce([raw.x_um, raw.y_um, raw.count_um, raw.radius_um])
    rows = np.flatnonzero(worst > MAX_WORD_UM).tolist()
    places = [(tuple(raw.span[row].tolist()), row + 1, MAX_WORD_UM) for row in rows]
    places += [(mark.span, 0, MAX_PLACE_UM) for mark in marks if max(abs(mark.x_um), abs(mark.y_um)) > MAX_PLACE_UM]
    return [
        lines.finding("3B206", span, block, what="number-too-large", limit=limit).with_fact(TooLarge())
        for span, block, limit in places
    ]


def _gaps(covered: Ints, lines: LineIndex, first_block: int) -> list[tuple[int, int]]:
    """What no token covers and is not blank. Before the first block, lines that do not look like one are header."""
    inked = _inked(lines, covered[1:-1])
    behind = bisect_left(inked, first_block, key=itemgetter(0))
    header = (line.span() for gap in inked[:behind] for line in _LINE.finditer(lines.text, *gap))
    return [*(span for span in header if LIKE_A_BLOCK.search(lines.text, *span)), *inked[behind:]]
