"""Text to listing: words by their letters, remarks, tape marks, assignments, and what is none of them.

Remarks, in ``( )`` or behind ``;``, and the ``%`` that begin and end a tape: what is none of the words.
"""

import re
from array import array
from itertools import chain
from typing import NamedTuple

import numpy as np

from parser.findings.errors import ProgramError
from parser.findings.findings import Edit, Finding, Value, file_order
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.lines import OddLine, PlainWords, odd_line, plain_words
from parser.iso.listing.listing import Blocks, ByLetter, Listing, Unread, Words
from parser.text.encoding import narrow, no_program
from parser.text.source import Codes, LineIndex

_REMARK = re.compile(r"(?<![A-Za-z][A-Za-z])\((?:[^()\r\n]*\)|[^\r\n]*)|;[^\r\n]*")
_TAPE_MARK = re.compile(r"%[^\r\n]*")
_WORD_BEFORE = re.compile(r"[A-Za-z][ \t]*[-+]?[ \t]*\.?\d")
_BLOCK = re.compile(r"[(;][ \t]*+(?:[A-Za-z][ \t]*+[-+]?(?:\d++\.?\d*+|\.\d++)[ \t;)]*+){2,}+", re.ASCII)
_MOVING = re.compile(r"[GXYgxy][ \t]*+[-+.\d]")
_BLANK = 0x20
_MOST_BLANKS = 4
_IS_BLANK, _IS_LINE_END = (np.isin(np.arange(256), [ord(sign) for sign in signs]) for signs in (" \t", "\r\n"))


class Bare(NamedTuple):
    """A text without what is none of its words.

    Attributes
    ----------
    codes
        (n,) its characters, with blanks in place of remarks, of a ``;`` that closes a block, of tape marks with what
        stands behind them in their line, and of all behind the end of the tape.
    remarks
        (k, 2) int64, first character and one past the last of each remark, with what begins and ends it; a ``;`` that
        closes a block is none.
    is_open
        (k,) bool, whether a remark in parentheses is not closed in its line, or holds another: it takes the whole line.
    tape_end
        One past the last character before the ``%`` that ends the tape; the length of the text where none does.
    """

    codes: Codes
    remarks: Ints
    is_open: Bools
    tape_end: int


def without_remarks(lines: LineIndex) -> Bare:
    """The text of `lines`, folded, without its remarks and tape marks (docs/iso.md §1)."""
    codes = _without_closing_signs(lines.codes)
    remarks = _remarks(codes)
    codes = _blanked(codes, remarks)
    heads, tape_end = _tape_marks(codes)
    if len(heads):
        codes = _blanked(codes, heads)
    if tape_end < len(codes):
        codes = codes.copy()
        codes[tape_end:] = _BLANK
    return Bare(codes, remarks, _open(lines.codes, remarks), tape_end)


def hidden_blocks(text: str, remarks: Ints) -> list[tuple[int, int]]:
    """Spans of the remarks that would be blocks without what makes them remarks: all of it words, some that move."""
    long = remarks[remarks[:, 1] - remarks[:, 0] > len("(G1")]
    return [
        (first, past)
        for first, past in long.tolist()
        if (found := _BLOCK.match(text, first, past)) and found.end() == past and _MOVING.search(text, first, past)
    ]


def _without_closing_signs(codes: Codes) -> Codes:
    """The characters, with a blank for each ``;`` with nothing behind it, or a few blanks."""
    signs = np.flatnonzero(codes == ord(";"))
    if not len(signs):
        return codes
    ended = np.append(codes, np.uint8(ord("\n")))
    behind = signs + 1
    for _ in range(_MOST_BLANKS):
        behind += _IS_BLANK[ended[behind]]
    without = codes.copy()
    without[signs[_IS_LINE_END[ended[behind]]]] = _BLANK
    return without


def _remarks(codes: Codes) -> Ints:
    ends = array("q")
    text = codes.tobytes().decode("ascii")
    if "(" in text or ";" in text:
        for match in _REMARK.finditer(text):
            ends.extend(match.span())
    return np.array(ends, dtype=np.int64).reshape(-1, 2)


def _open(codes: Codes, remarks: Ints) -> Bools:
    """Whether the remarks (k, 2) begin with a parenthesis that is not closed, or not before another is opened."""
    opened, closed = (np.flatnonzero(codes == ord(sign)) for sign in "()")
    first, past = remarks.T
    within = opened.searchsorted(past) - opened.searchsorted(first)
    is_closed = (within == 1) & (closed.searchsorted(past) - closed.searchsorted(first) == 1)
    is_open: Bools = (codes[first] == ord("(")) & ~is_closed
    return is_open


def _blanked(codes: Codes, spans: Ints) -> Codes:
    """The characters, with blanks in place of some spans (k, 2), which do not overlap."""
    if not len(spans):
        return codes
    covers = np.zeros(len(codes) + 1, dtype=np.int8)
    covers[spans[:, 0]] += 1
    np.subtract.at(covers, spans[:, 1], 1)
    return np.where(np.cumsum(covers[:-1], dtype=np.int8) > 0, np.uint8(_BLANK), codes)


def _tape_marks(codes: Codes) -> tuple[Ints, int]:
    """Lines that begin the tape (k, 2), from their ``%`` on, and where the first one behind a word ends it."""
    signs = np.flatnonzero(codes == ord("%"))
    heads: list[tuple[int, int]] = []
    if not len(signs):
        return np.empty((0, 2), dtype=np.int64), len(codes)
    text = codes.tobytes().decode("ascii")
    since = 0
    while mark := _TAPE_MARK.search(text, since):
        if _WORD_BEFORE.search(text, since, mark.start()):
            return np.array(heads, dtype=np.int64).reshape(-1, 2), mark.start()
        heads.append(mark.span())
        since = mark.end()
    return np.array(heads, dtype=np.int64).reshape(-1, 2), len(codes)


MOST_BLOCKS = 2_000_000
"""Blocks that are read of one program, as of 3B."""

_LONGEST_SHOWN = 40


def read_listing(text: str) -> Listing:
    """The words of a text (docs/iso.md §1). Raises ProgramError for more than `MOST_BLOCKS`."""
    folded = narrow(text)
    lines = LineIndex(folded)
    bare = without_remarks(lines)
    plain = plain_words(bare.codes)
    if len(plain.opens) + len(plain.odd) > MOST_BLOCKS:
        raise ProgramError(no_program("too-many-blocks", f"{MOST_BLOCKS:,}", language="ISO"))
    odd = _odd_lines(folded, bare, plain)
    in_blocks = [line for line in odd if not line.is_title]
    words, blocks = _gathered(lines, plain, in_blocks)
    blocks, opened = _with_open_remarks(lines, bare, blocks)
    at = blocks.first.searchsorted([line.span[0] for line in in_blocks]).tolist()
    numbered = list(zip(at, in_blocks, strict=True))
    unread = [(bad.code, Unread(bad.span, block)) for block, line in numbered for bad in line.bad]
    titles = [line.span for line in odd if line.is_title]
    return Listing(
        text,
        lines,
        words,
        blocks,
        ByLetter(words.letter),
        tuple(assignment._replace(block=block) for block, line in numbered for assignment in line.assignments),
        tuple(statement._replace(block=block) for block, line in numbered for statement in line.statements),
        bare.remarks,
        tuple(sorted([*opened, *(each for _, each in unread)])),
        bare.tape_end,
        tuple(sorted([*_findings(lines, bare, unread, opened, titles), *_small_letters(lines, words)], key=file_order)),
    )


def _odd_lines(folded: str, bare: Bare, plain: PlainWords) -> list[OddLine]:
    """All lines that are not plain, in order; text stands for a title up to the first G word."""
    g_words = plain.first[plain.letter == ord("G")]
    until = int(g_words[0]) if len(g_words) else len(folded)
    read: list[OddLine] = []
    for first, past in plain.odd.tolist():
        line = odd_line(_line(folded, bare, first, past), first, may_be_title=first < until)
        read.append(line)
        if any(word.letter == ord("G") for word in line.words):
            until = min(until, first)
    return read


def _line(folded: str, bare: Bare, first: int, past: int) -> str:
    """The characters of a line: blanks for remarks and control characters, and what is not ASCII as written."""
    written = bare.codes[first:past]
    line = np.where(written < ord(" "), np.uint8(ord(" ")), written).tobytes().decode("ascii")
    if folded.isascii():
        return line
    return "".join(char if code == "?" else code for char, code in zip(folded[first:past], line, strict=True))


def _gathered(lines: LineIndex, plain: PlainWords, odd: list[OddLine]) -> tuple[Words, Blocks]:
    """The words of plain and odd lines, and their blocks, in file order."""
    ends = np.append(plain.opens, len(plain.letter))[1:] - 1
    first = np.concatenate([plain.first[plain.opens], np.array([line.span[0] for line in odd], dtype=np.int64)])
    past = np.concatenate([plain.past[ends], np.array([line.span[1] for line in odd], dtype=np.int64)])
    is_plain = np.zeros(len(plain.opens), dtype=np.bool_)
    is_skipped = np.concatenate([is_plain, np.array([line.is_skipped for line in odd], dtype=np.bool_)])
    is_damaged = np.concatenate([is_plain, np.array([line.is_damaged for line in odd], dtype=np.bool_)])
    order = np.argsort(first, kind="stable") if odd else slice(None)
    first = first[order]
    letter, value, decimals, word_first, word_past = _all_words(plain, odd)
    opens = np.append(word_first.searchsorted(first), len(word_first))
    block = np.repeat(np.arange(len(first)), np.diff(opens))
    words = Words(letter, value, decimals, word_first, word_past, block)
    return words, Blocks(lines.lines(first), first, past[order], is_skipped[order], is_damaged[order], opens)


def _all_words(plain: PlainWords, odd: list[OddLine]) -> tuple[Ints, Floats, Ints, Ints, Ints]:
    """Letter, value, decimals, first and past of all words, in file order."""
    columns = plain.letter, plain.value, plain.decimals, plain.first, plain.past
    rows = list(chain.from_iterable(line.words for line in odd))
    if not rows:
        return columns
    letter, value, decimals, first, past = (
        np.concatenate([column, np.array(more, dtype=column.dtype)])
        for column, more in zip(columns, zip(*rows, strict=True), strict=True)
    )
    order = np.argsort(first, kind="stable")
    return letter[order], value[order], decimals[order], first[order], past[order]


def _with_open_remarks(lines: LineIndex, bare: Bare, blocks: Blocks) -> tuple[Blocks, list[Unread]]:
    """The blocks, damaged where a remark is not closed, and these remarks: they may hold what was meant to run."""
    spans = bare.remarks[bare.is_open & (bare.remarks[:, 0] < bare.tape_end)]
    if not len(spans):
        return blocks, []
    line = lines.lines(spans[:, 0])
    at = blocks.line.searchsorted(line)
    is_in = blocks.line.searchsorted(line, side="right") > at
    is_damaged = blocks.is_damaged.copy()
    is_damaged[at[is_in]] = True
    block = np.where(is_in, at, -1).tolist()
    unread = [Unread((first, past), number) for (first, past), number in zip(spans.tolist(), block, strict=True)]
    return blocks._replace(is_damaged=is_damaged), unread


def _findings(
    lines: LineIndex,
    bare: Bare,
    unread: list[tuple[str, Unread]],
    opened: list[Unread],
    titles: list[tuple[int, int]],
) -> list[Finding]:
    """ISO1xx of the text itself, but for small letters."""
    found = [lines.finding(code, each.span, text=_excerpt(lines.text[slice(*each.span)])) for code, each in unread]
    found += [
        lines.finding("ISO105", each_unread.span, text=_excerpt(lines.text[slice(*each_unread.span)]))
        for each_unread in opened
    ]
    hidden = [span for span in hidden_blocks(lines.text, bare.remarks) if span[0] < bare.tape_end]
    return [*found, *_at_first(lines, "ISO106", hidden), *_at_first(lines, "ISO107", titles)]


def _at_first(lines: LineIndex, code: str, spans: list[tuple[int, int]]) -> list[Finding]:
    """Finding at the first of some spans, where there are any."""
    shown_spans = [_excerpt(lines.text[slice(*span)]) for span in spans[:1]]
    return [lines.finding(code, spans[0], text=text, more=len(spans) - 1) for text in shown_spans]


def _small_letters(lines: LineIndex, words: Words) -> list[Finding]:
    """ISO104 at the first word with a small letter, with the capitals of all of them."""
    small = np.flatnonzero(lines.codes[words.first] >= ord("a"))
    if not len(small):
        return []
    edits = tuple(Edit(at, at + 1, lines.text[at].upper()) for at in words.first[small].tolist())
    word = int(small[0])
    span = int(words.first[word]), int(words.past[word])
    values: dict[str, Value] = {"text": lines.text[slice(*span)], "more": len(small) - 1}
    return [lines.finding("ISO104", span, int(words.block[word]) + 1, **values)._replace(edits=edits)]


def _excerpt(text: str) -> str:
    return text if len(text) <= _LONGEST_SHOWN else text[:_LONGEST_SHOWN] + "…"
