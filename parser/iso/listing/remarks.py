"""Remarks, in ``( )`` or behind ``;``, and the ``%`` that begin and end a tape: what is none of the words."""

import re
from array import array
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Ints
from parser.text.lines import Codes, LineIndex

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
