"""The words of one line: lines of plain words, which most are, as arrays of characters; all others one by one.

All others: lines that are skipped, titles, assignments, functions, macros, what is no word. Read one by one, a line of
plain words gives the same.
"""

import re
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from parser.iso.listing.listing import Assignment, Form, Statement
from parser.text.source import Codes

MOST_DIGITS = 15
"""Digits of which every whole number is exact as a float64; numbers of more are left to the other reader."""

_AT_ONCE = 1 << 18  # characters: their arrays stay in the processor's cache
_BLANK, _DIGIT, _SIGN, _POINT, _LETTER, _LINE_END, _OTHER = range(7)
_KINDS = np.full(256, _OTHER, dtype=np.uint8)
_KINDS[: ord(" ") + 1] = _BLANK
for _characters, _kind in (("0123456789", _DIGIT), (".", _POINT), ("+-", _SIGN), ("\r\n", _LINE_END)):
    _KINDS[[ord(character) for character in _characters]] = _kind
for _letter in range(ord("A"), ord("Z") + 1):
    _KINDS[[_letter, _letter + ord("a") - ord("A")]] = _LETTER
_POWERS = np.array([float(10**power) for power in range(MOST_DIGITS + 1)])
_CAPITAL = np.uint8(0xDF)  # the bits that a letter has as a capital


class PlainWords(NamedTuple):
    """The words of plain lines, in order.

    Attributes
    ----------
    letter, value, decimals, first, past
        (m,) as in `parser.iso.listing.Words`.
    opens
        (p,) int64, the first word of each plain line.
    odd
        (q, 2) int64, first character and one past the last of each other line that is not blank.
    """

    letter: Ints
    value: Floats
    decimals: Ints
    first: Ints
    past: Ints
    opens: Ints
    odd: Ints


class _Signs(NamedTuple):
    """What is not blank in a piece of text, with a line end behind the last, each (n,).

    Attributes
    ----------
    at
        int64, places.
    code, kind
        uint8, characters, and which kind each is of.
    """

    at: Ints
    code: Codes
    kind: Codes


def plain_words(codes: Codes) -> PlainWords:
    """The words of the plain lines of a bare text (n,), and where its other lines are."""
    parts = [_of_piece(codes[first:past], first) for first, past in _pieces(codes)]
    before = np.cumsum([0, *(len(part.letter) for part in parts[:-1])])
    shifted = [part._replace(opens=part.opens + n) for part, n in zip(parts, before.tolist(), strict=True)]
    return PlainWords(*(np.concatenate(columns) for columns in zip(*shifted, strict=True)))


def _pieces(codes: Codes) -> list[tuple[int, int]]:
    """The text in pieces of whole lines, of `_AT_ONCE` characters or little more; a longer line is one of its own."""
    if len(codes) <= _AT_ONCE:
        return [(0, len(codes))]
    ends = np.flatnonzero(_KINDS[codes] == _LINE_END) + 1
    wanted = np.arange(_AT_ONCE, len(codes), _AT_ONCE)
    behind = np.append(ends, len(codes))[np.searchsorted(ends, wanted)]
    return list(pairwise(sorted({0, *behind.tolist(), len(codes)})))


def _of_piece(codes: Codes, since: int) -> PlainWords:
    """The words of a piece that begins at the character `since`."""
    signs = _signs(codes)
    ends = np.flatnonzero(signs.kind == _LINE_END)
    is_odd = _odd_lines(signs, ends)
    stops = np.flatnonzero((signs.kind == _LETTER) | (signs.kind == _LINE_END))
    line = np.cumsum(signs.kind[stops] == _LINE_END)
    is_word = signs.kind[stops] == _LETTER
    is_word &= ~is_odd[np.minimum(line, len(is_odd) - 1)]
    word, past = stops[is_word], stops[np.flatnonzero(is_word) + 1]
    value, decimals = _numbers(signs, word, past)
    line = line[is_word]
    opens = np.flatnonzero(np.diff(line, prepend=-1))
    starts = np.concatenate([[0], ends[:-1] + 1])
    odd = np.stack([signs.at[starts[is_odd]], signs.at[ends[is_odd] - 1] + 1], axis=1)
    letter = (signs.code[word] & _CAPITAL).astype(np.int64)
    return PlainWords(
        letter, value, decimals, signs.at[word] + since, signs.at[past - 1] + 1 + since, opens, odd + since
    )


def _signs(codes: Codes) -> _Signs:
    kind = _KINDS[codes]
    at = np.flatnonzero(kind != _BLANK)
    return _Signs(
        np.append(at, len(codes)),
        np.append(codes[at], np.uint8(ord("\n"))),
        np.append(kind[at], np.uint8(_LINE_END)),
    )


def _odd_lines(signs: _Signs, ends: Ints) -> NDArray[np.bool_]:
    """Of each line of a piece, whether something in it is no part of a plain word."""
    kind = signs.kind
    before = np.concatenate([[np.uint8(_LINE_END)], kind[:-1]])
    behind = np.append(kind[1:], np.uint8(_LINE_END))
    of_number, number_before = (kind == _DIGIT) | (kind == _POINT), (before == _DIGIT) | (before == _POINT)
    is_bad = kind == _OTHER
    is_bad |= (kind == _LETTER) & ((behind == _LETTER) | (behind == _LINE_END))
    is_bad |= (kind == _SIGN) & ((before != _LETTER) | ((behind != _DIGIT) & (behind != _POINT)))
    is_bad |= of_number & (before == _LINE_END)
    is_bad |= (kind == _POINT) & (before != _DIGIT) & (behind != _DIGIT)
    is_bad[1:] |= of_number[1:] & number_before[1:] & (np.diff(signs.at) > 1)
    odd = np.zeros(len(ends), dtype=np.bool_)
    odd[np.searchsorted(ends, np.concatenate([np.flatnonzero(is_bad), _second_points(kind), _too_long(signs)]))] = True
    return odd


def _second_points(kind: Codes) -> Ints:
    """Points with another one before them in their word."""
    marks = np.flatnonzero(kind >= _POINT)
    is_point = kind[marks] == _POINT
    second: Ints = marks[1:][is_point[1:] & is_point[:-1]]
    return second


def _too_long(signs: _Signs) -> Ints:
    """Words of more characters than a number of `MOST_DIGITS` can have."""
    stops = np.flatnonzero(signs.kind >= _LETTER)
    long: Ints = stops[:-1][(np.diff(stops) > MOST_DIGITS + 1) & (signs.kind[stops[:-1]] == _LETTER)]
    return long


def _numbers(signs: _Signs, word: Ints, past: Ints) -> tuple[Floats, Ints]:
    """Value and decimals of the words from the signs `word` up to but without `past`, each (m,)."""
    first = word + 1
    sign = signs.code[np.minimum(first, len(signs.code) - 1)]
    value = np.zeros(len(word), dtype=np.int64)
    decimals = np.full(len(word), -1, dtype=np.int64)
    for step in range(int((past - first).max(initial=0))):
        at = first + step
        code = signs.code[np.minimum(at, len(signs.code) - 1)]
        inside = at < past
        is_digit = inside & (code >= ord("0"))
        value = np.where(is_digit, 10 * value + code - ord("0"), value)
        decimals = np.where(inside & (code == ord(".")), 0, decimals + (is_digit & (decimals >= 0)))
    scaled = value / _POWERS[np.maximum(decimals, 0)]
    return np.where(sign == ord("-"), 0.0 - scaled, scaled), decimals


LARGEST = 1e15
"""Numbers beyond it, either way, are held at it: they are out of the range of any word."""

_NUMBER = r"(?:[-+][ \t]*)?(?:\d+\.?\d*|\.\d+)"
_TERM = rf"(?:{_NUMBER}|[A-Za-z][ \t]*\d+)"
_WORD = re.compile(rf"([A-Za-z])[ \t]*({_NUMBER})", re.ASCII)
_PIECE = re.compile(r"[A-Za-z]{3,}[-+.\d]*|[A-Za-z][ \t]*(?:[-+.\d][-+.\d \t]*)?|[^A-Za-z \t]+(?:[ \t]+[^A-Za-z \t]+)*")
_SKIP = re.compile(r"/\d?[ \t]*", re.ASCII)
_BLOCK_NUMBER = re.compile(r"([Nn])[ \t]*(\d+)[ \t]*(?=[A-Za-z])", re.ASCII)
_REGISTER = re.compile(
    rf"([HDhd])[ \t]*(\d+)[ \t]*=[ \t]*({_TERM}(?:[ \t]*(?:\+[ \t]*|(?=-)){_TERM})*)[ \t]*", re.ASCII
)
_TERMS = re.compile(rf"({_NUMBER})|([A-Za-z])[ \t]*(\d+)", re.ASCII)
_SETTING = re.compile(r"[A-CE-GI-Za-ce-gi-z][ \t]*\d*[ \t]*=.*", re.ASCII)
_FUNCTION = re.compile(r"[A-Za-z]{2,}\d*[ \t]*\([^()]*\)", re.ASCII)
_MACRO = re.compile(
    r"[\[\]]|\A#|(?<![A-Z])[A-Z][ \t]*[-+]?[ \t]*#|\b(?:GOTO|DO|END)[ \t]*\d|\b(?:IF|WHILE)\b", re.IGNORECASE
)
_FEED = re.compile(r"F[ \t]*#[ \t]*\d+(?![\w.])", re.ASCII | re.IGNORECASE)
_TEXT = re.compile(r"[^\W\d_]{3,}|[^\x00-\x7f]")
_MOVING = re.compile(r"[GXY][ \t]*[-+]?[ \t]*\.?\d", re.IGNORECASE)


class OddWord(NamedTuple):
    """A word of an odd line: as a row of `parser.iso.listing.Words`, but for its block."""

    letter: int
    value: float
    decimals: int
    first: int
    past: int


class Bad(NamedTuple):
    """A piece that is no word: the code of its finding, and its span."""

    code: str
    span: tuple[int, int]


class OddLine(NamedTuple):
    """What an odd line holds; the blocks of assignments and statements are not known here, and are 0.

    Attributes
    ----------
    span
        First character, and one past the last, without blanks at its ends.
    is_title
        Whether it is text without remark signs: no block.
    is_skipped
        Whether it begins with ``/``.
    words, assignments, statements, bad
        In the order of the line.
    """

    span: tuple[int, int]
    is_title: bool = False
    is_skipped: bool = False
    words: tuple[OddWord, ...] = ()
    assignments: tuple[Assignment, ...] = ()
    statements: tuple[Statement, ...] = ()
    bad: tuple[Bad, ...] = ()

    @property
    def is_damaged(self) -> bool:
        """Whether its motion is not known."""
        return bool(self.bad) or any(statement.form is Form.MACRO for statement in self.statements)


def odd_line(line: str, at: int, *, may_be_title: bool) -> OddLine:
    """What a line holds that is not blank; its first character stands at `at` of the text (docs/iso.md §1)."""
    feeds = [found.span() for found in _FEED.finditer(line)]
    if not feeds:
        return _odd_line(line, at, may_be_title=may_be_title)
    read = _odd_line(_FEED.sub(lambda found: " " * len(found[0]), line), at, may_be_title=False)
    stated = (Statement(Form.FEED, 0, (at + first, at + past)) for first, past in feeds)
    return read._replace(span=(at, at + len(line)), statements=(*read.statements, *stated))


def _odd_line(line: str, at: int, *, may_be_title: bool) -> OddLine:
    span = at, at + len(line)
    if _MACRO.search(line):
        return OddLine(span, statements=(Statement(Form.MACRO, 0, span),))
    if _FUNCTION.fullmatch(line):
        return OddLine(span, statements=(Statement(Form.FUNCTION, 0, span),))
    if "=" not in line and _TEXT.search(line) and not _MOVING.search(line):
        return OddLine(span, is_title=True) if may_be_title else OddLine(span, bad=(Bad("ISO101", span),))
    skip = _SKIP.match(line)
    since = skip.end() if skip else 0
    read = _set(line, at, since) or _two_planes(line, at, since) or _words(line, at, since)
    return read._replace(span=span, is_skipped=skip is not None)


def _set(line: str, at: int, since: int) -> OddLine | None:
    """A line that sets registers, or something else; None where it sets nothing."""
    if "=" not in line:
        return None
    numbered = _BLOCK_NUMBER.match(line, since)
    words = (_word(numbered, at),) if numbered else ()
    since = numbered.end() if numbered else since
    if _SETTING.fullmatch(line, since):
        return OddLine((at, at), words=words, statements=(Statement(Form.SETTING, 0, (at + since, at + len(line))),))
    assignments: list[Assignment] = []
    while since < len(line):
        register = _REGISTER.match(line, since)
        if not register:
            return OddLine((at, at), words=words, bad=(Bad("ISO102", (at + since, at + len(line))),))
        assignments.append(_assignment(register, at))
        since = register.end()
    return OddLine((at, at), words=words, assignments=tuple(assignments))


def _assignment(register: re.Match[str], at: int) -> Assignment:
    terms = tuple(
        _number(number) if number else _name(letter, digits) for number, letter, digits in _TERMS.findall(register[3])
    )
    return Assignment(0, _name(register[1], register[2]), terms, (at + register.start(), at + register.end(3)))


def _two_planes(line: str, at: int, since: int) -> OddLine | None:
    """Upper contour, colon, lower contour; None where there are no words on both sides."""
    colon = line.find(":")
    if colon < 0 or not (_WORD.search(line, since, colon) and _WORD.search(line, colon)):
        return None
    numbered = _BLOCK_NUMBER.match(line, since)
    lower = _words(line, at, colon + 1)
    first = numbered.end() if numbered else since
    return lower._replace(
        words=(*((_word(numbered, at),) if numbered else ()), *lower.words),
        statements=(Statement(Form.TWO_PLANES, 0, (at + first, at + colon + 1)),),
    )


def _words(line: str, at: int, since: int) -> OddLine:
    words: list[OddWord] = []
    bad: list[Bad] = []
    for piece in _PIECE.finditer(line, since):
        past = piece.start() + len(piece[0].rstrip(" \t"))
        word = _WORD.fullmatch(line, piece.start(), past)
        if word:
            words.append(_word(word, at))
        else:
            is_letter = piece[0][0].isascii() and piece[0][0].isalpha() and not _TEXT.match(piece[0])
            bad.append(Bad("ISO102" if is_letter else "ISO101", (at + piece.start(), at + past)))
    return OddLine((at, at), words=tuple(words), bad=tuple(bad))


def _word(match: re.Match[str], at: int) -> OddWord:
    return OddWord(ord(match[1].upper()), *_number(match[2]), at + match.start(1), at + match.end(2))


def _number(figure: str) -> tuple[float, int]:
    """A number as written, and the digits behind its point, −1 without a point."""
    figure = figure.replace(" ", "").replace("\t", "")
    value = max(-LARGEST, min(float(figure), LARGEST)) + 0.0
    return value, len(figure) - figure.index(".") - 1 if "." in figure else -1


def _name(letter: str, digits: str) -> str:
    """Of a register, without leading zeros."""
    return f"{letter.upper()}{digits.lstrip('0') or '0'}"
