"""Blocks as columns of raw words: digits and letters to numbers, a whole column at once.

Lines that hold one 3B block and nothing else, which is most lines of most programs: read as arrays of characters.

No token of the pattern (`parser.threeb.tokens`) reaches beyond its line, so that these lines are read here, and all
others one by one by the pattern, with the same result.
"""

from itertools import chain, pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Ints
from parser.text.source import Codes, LineIndex
from parser.threeb.tokens import BLOCK_FIELDS, GROUP_AT, GROUPS
from parser.units import MAX_PLACE_UM, MAX_WORD_UM, from_mm

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
    """The text in pieces of whole lines, of `_AT_ONCE` characters or little more; a longer line is one of its own.

    An empty text is one piece.
    """
    ends = np.flatnonzero(_KINDS[codes] == _LINE_END) + 1
    wanted = np.arange(_AT_ONCE, len(codes), _AT_ONCE)
    behind = np.append(ends, len(codes))[np.searchsorted(ends, wanted)]
    borders = sorted({0, *behind.tolist(), len(codes)})
    return list(pairwise(borders)) or [(0, 0)]


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


_OVER_UM, _BEYOND_UM = MAX_WORD_UM + 1, MAX_PLACE_UM + 1

_AXES = {"X": 0, "Y": 1}
_TURNS = {"L": 0, "N": 1, "S": -1}  # by the first letter: blanks may stand before the R
_CURVES: dict[str, int] = {"": 0, "D": 1, "DD": 2}


class RawBlocks(NamedTuple):
    """Columns of the blocks as written; int64 unless said otherwise, n rows.

    `radius_um` and `curve` are those of 4B blocks: the radius, −1 where there is none, and 0 no mark, 1 convex,
    2 concave. `span` is (n, 2) characters; `printed_um` is (n, 2) float64, NaN where no end is printed.
    """

    x_um: Ints
    y_um: Ints
    count_um: Ints
    count_axis: Ints
    turn: Ints
    quadrant: Ints
    radius_um: Ints
    curve: Ints
    span: Ints
    line: Ints
    label: tuple[str, ...]
    printed_um: np.ndarray[tuple[int, int], np.dtype[np.float64]]


def read_mm(digits: str) -> float:
    """Printed millimetres to µm, held at just over `MAX_PLACE_UM` either way."""
    return max(-_BEYOND_UM, min(from_mm(float(digits[:32])), _BEYOND_UM))


def columns_of(words: list[str | None], span: Ints, lines: LineIndex) -> RawBlocks:
    """Columns of n blocks: `words` are the groups of the token pattern, one block's after the other's."""
    column = {name: words[place :: len(GROUPS)] for name, place in GROUP_AT.items()}
    end_x, end_y = column["end_x"], column["end_y"]
    printed = np.full((len(span), 2), np.nan)
    for row in [row for row, end in enumerate(end_x) if end]:
        printed[row] = read_mm(end_x[row] or ""), read_mm(end_y[row] or "")
    x, y, count, radius, before, axis, behind, sense, quadrant = (column[name] for name in BLOCK_FIELDS)
    no_radius = np.fromiter([digits is None for digits in radius], dtype=np.bool_, count=len(radius))
    return RawBlocks(
        x_um=_numbers(x),
        y_um=_numbers(y),
        count_um=_numbers(count),
        count_axis=_look_up(axis, _AXES),
        turn=_look_up([word and word[0] for word in sense], _TURNS),
        quadrant=_numbers(quadrant),
        radius_um=np.where(no_radius, -1, 0 if no_radius.all() else _numbers(radius)),
        curve=_curves(before, behind),
        span=span,
        line=lines.lines(span[:, 0]),
        label=_labels(column["label"], column["number"], column["bare_number"]),
        printed_um=printed,
    )


def columns_of_plain(plain: PlainLines, lines: LineIndex) -> RawBlocks:
    """Columns of blocks that stand alone in their lines: without radius, mark, label and printed end."""
    n = len(plain.x_um)
    return RawBlocks(
        **plain._asdict(),
        radius_um=np.full(n, -1, dtype=np.int64),
        curve=np.zeros(n, dtype=np.int64),
        line=lines.lines(plain.span[:, 0]),
        label=("",) * n,
        printed_um=np.full((n, 2), np.nan),
    )


def all_rows(parts: list[RawBlocks]) -> RawBlocks:
    """The blocks of one or more parts, in the order of the text."""
    parts = [part for part in parts if len(part.line)] or parts[:1]
    if len(parts) == 1:
        return parts[0]
    columns = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in RawBlocks._fields if name != "label"
    }
    order = np.argsort(columns["span"][:, 0], kind="stable")
    label = list(chain.from_iterable(part.label for part in parts))
    return RawBlocks(
        **{name: column[order] for name, column in columns.items()}, label=tuple([label[row] for row in order.tolist()])
    )


def _labels(*columns: list[str | None]) -> tuple[str, ...]:
    """``N7`` of ``N7:``, ``7:`` or a bare ``7``; empty where a block has none."""
    rows = zip(*columns, strict=True)
    return tuple([f"N{number}" if (number := named or plain or bare) else "" for named, plain, bare in rows])


def _curves(before: list[str | None], behind: list[str | None]) -> Ints:
    if not any(before) and not any(behind):
        return np.zeros(len(before), dtype=np.int64)
    marks = [_CURVES[(this or other or "").upper()] for this, other in zip(before, behind, strict=True)]
    return np.array(marks, dtype=np.int64)


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
