"""Blocks of four numbers that are no 4B blocks: damaged ones, and those that took a number of the block before."""

import re

import numpy as np

from parser.geometry.curves import Ints
from parser.threeb.columns import RawBlocks

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
