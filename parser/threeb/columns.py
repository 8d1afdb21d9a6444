"""Blocks as columns of raw words: digits and letters to numbers, a whole column at once."""

from itertools import chain, product
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.text.lines import LineIndex
from parser.threeb.grammar import BLOCK_FIELDS, GROUP_AT, GROUPS
from parser.threeb.plain_lines import PlainLines
from parser.units import MAX_PLACE_UM, MAX_WORD_UM, from_mm

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
    marks = [_CURVES[(one or other or "").upper()] for one, other in zip(before, behind, strict=True)]
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
