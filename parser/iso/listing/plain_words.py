"""Lines that hold words and nothing else, which is most lines of most programs: read as arrays of characters.

All other lines are read one by one in `parser.iso.listing.odd_lines`, which gives the same for a line of words.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints
from parser.text.lines import Codes

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
