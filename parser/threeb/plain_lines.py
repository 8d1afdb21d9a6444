"""Lines that hold one 3B block and nothing else, which is most lines of most programs: read as arrays of characters.

No token of the pattern (`parser.threeb.grammar`) reaches beyond its line, so that these lines are read here, and all
others one by one by the pattern, with the same result.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Ints
from parser.text.lines import Codes

_MOST_DIGITS = 9  # what is longer may be over the largest word: such lines are left to the pattern
_AT_ONCE = 1 << 18  # characters: their arrays stay in the processor's cache
_BLANK, _DIGIT, _LINE_END, _OTHER = range(4)
_B, _G, _X, _Y, _L, _N, _S, _R = range(4, 12)
_KINDS = np.full(256, _OTHER, dtype=np.uint8)
for _signs, _kind in ((" \t", _BLANK), ("0123456789", _DIGIT), ("\r\n", _LINE_END)):
    _KINDS[[ord(sign) for sign in _signs]] = _kind
for _letter, _kind in zip("BGXYLNSR", range(_B, _R + 1), strict=True):
    _KINDS[[ord(_letter), ord(_letter.lower())]] = _kind

# The signs of a plain line, a number being one: B X B Y B J G axis sense quadrant. An arc has two letters in its sense.
_BEGIN = np.array([_B, _DIGIT, _B, _DIGIT, _B, _DIGIT, _G], dtype=np.uint8)
_AXIS, _SENSE = 7, 8
_LINE_SIGNS, _ARC_SIGNS = 10, 11
_FIRST_NUMBERS = np.array([1, 3, 5])


class PlainLines(NamedTuple):
    """Blocks of plain lines, in order: words as in `RawBlocks`, each (n,) int64, and `span` (n, 2) characters."""

    x_um: Ints
    y_um: Ints
    count_um: Ints
    count_axis: Ints
    turn: Ints
    quadrant: Ints
    span: Ints


def plain_lines(codes: Codes) -> PlainLines:
    """The plain lines of a folded text.

    They hold three numbers of up to nine digits, axis, sense and quadrant, with blanks anywhere but in a number.
    """
    parts = [_of_piece(codes[first:past], first) for first, past in _pieces(codes)]
    return PlainLines(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def _pieces(codes: Codes) -> list[tuple[int, int]]:
    """The text in pieces of whole lines, of `_AT_ONCE` characters or little more; a longer line is one of its own."""
    ends = np.flatnonzero(_KINDS[codes] == _LINE_END) + 1
    wanted = np.arange(_AT_ONCE, len(codes), _AT_ONCE)
    behind = np.append(ends, len(codes))[np.searchsorted(ends, wanted)]
    borders = sorted({0, *behind.tolist(), len(codes)})
    return list(pairwise(borders))


def _of_piece(codes: Codes, since: int) -> PlainLines:
    """The plain lines of a piece that begins at the character `since`."""
    kind = _KINDS[codes]
    is_digit = np.concatenate([[False], kind == _DIGIT, [False]])
    opens, past = is_digit[1:-1] & ~is_digit[:-2], np.flatnonzero(is_digit[1:-1] & ~is_digit[2:]) + 1
    at = np.append(np.flatnonzero((kind > _DIGIT) | opens), len(codes))  # of each sign: letters, numbers, line ends
    sign = np.append(kind, np.uint8(_LINE_END))[at]
    ends = np.flatnonzero(sign == _LINE_END)
    signs = np.diff(ends, prepend=-1) - 1
    may = (signs == _LINE_SIGNS) | (signs == _ARC_SIGNS)
    begin, is_arc = ends[may] - signs[may], signs[may] == _ARC_SIGNS
    fits = _fits(sign, begin, is_arc)
    begin, is_arc = begin[fits], is_arc[fits]
    quadrant_at = begin + _SENSE + 1 + is_arc
    number_at = np.concatenate([begin[:, None] + _FIRST_NUMBERS, quadrant_at[:, None]], axis=1)
    first = at[number_at]
    numbers = np.cumsum(sign == _DIGIT)
    past = past[numbers[begin + 1][:, None] - 1 + np.arange(4)] if len(begin) else first
    digits = past - first
    quadrant = codes[np.minimum(first[:, 3], len(codes) - 1)].astype(np.int64) - ord("0")
    short = (digits[:, :3] <= _MOST_DIGITS).all(axis=1) & (digits[:, 3] == 1) & (quadrant >= 1) & (quadrant <= 4)
    begin, is_arc, first, past = begin[short], is_arc[short], first[short], past[short]
    x, y, count = _values(codes, first[:, :3].T, past[:, :3].T)
    turn = np.where(is_arc, np.where(sign[begin + _SENSE] == _N, 1, -1), 0)
    span = np.stack([at[begin], past[:, 3]], axis=1) + since
    axis = (sign[begin + _AXIS] == _Y).astype(np.int64)
    return PlainLines(x, y, count, axis, turn, quadrant[short], span)


def _fits(sign: Codes, begin: Ints, is_arc: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether the lines whose signs begin there are blocks, by their signs alone."""
    axis, sense, behind = (sign[begin + at] for at in (_AXIS, _SENSE, _SENSE + 1))
    fits = (sign[begin[:, None] + np.arange(len(_BEGIN))] == _BEGIN).all(axis=1)
    fits &= (axis == _X) | (axis == _Y)
    is_line_end = (sense == _L) & (behind == _DIGIT)
    is_arc_end = ((sense == _N) | (sense == _S)) & (behind == _R) & (sign[begin + _ARC_SIGNS - 1] == _DIGIT)
    whole: NDArray[np.bool_] = fits & np.where(is_arc, is_arc_end, is_line_end)
    return whole


def _values(codes: Codes, first: Ints, past: Ints) -> Ints:
    """Numbers whose digits stand from `first` up to but without `past`."""
    value = np.zeros(first.shape, dtype=np.int64)
    for at in range(int((past - first).max(initial=0))):
        place = first + at
        digit = codes[np.minimum(place, len(codes) - 1)].astype(np.int64) - ord("0")
        value = np.where(place < past, 10 * value + digit, value)
    return value
