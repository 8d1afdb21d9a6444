"""What a controller is told of the offset: to which side, and along which blocks of each contour."""

from enum import IntEnum
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.shape.contours import CLOSED_WITHIN_UM, runs
from parser.shape.loops import find_loops
from parser.toolpath import Toolpath


class Side(IntEnum):
    """Side of the contour on which the wire's centre runs, along the cutting direction: G41 left, G42 right."""

    LEFT = 1
    RIGHT = -1


class OffsetSection(NamedTuple):
    """Blocks along the drawing's contour, offset, as between G41 and G40; those before and behind lead in and out.

    Attributes
    ----------
    first, last
        Rows of the toolpath, both included.
    closed
        Whether the last one ends where the first begins, so that they are joined there as any two blocks are.
    """

    first: int
    last: int
    closed: bool


class Round(NamedTuple):
    """One way round a contour: from the start hole to the contour, along it, and back where the program leads back.

    Attributes
    ----------
    begin, past
        First row, and one past the last.
    section
        The blocks along the contour.
    """

    begin: int
    past: int
    section: OffsetSection


def rounds_of(toolpath: Toolpath) -> tuple[Round, ...]:
    """The rounds of a toolpath, in order: its runs of cut blocks, each parted where it is back at its start hole.

    A second way through the start hole is a lead, to a round of its own, if it closes a loop. What does not close one
    stays with the round before it, and is not offset.
    """
    whole = runs(toolpath)
    loops = _loops(toolpath, whole)
    parts = _parted(toolpath, whole, loops)
    if len(parts) > len(whole):
        loops = _loops(toolpath, parts)
    goes_on = (loops[:, 0] < 0) & np.isin(parts[:, 0], whole[:, 0], invert=True)
    found: list[Round] = []
    for (begin, past), (first, last), is_rest in zip(parts.tolist(), loops.tolist(), goes_on.tolist(), strict=True):
        if is_rest:
            found[-1] = found[-1]._replace(past=past)
        else:
            found.append(Round(begin, past, _section(toolpath, begin, past, first, last)))
    return tuple(found)


def _section(toolpath: Toolpath, begin: int, past: int, first: int, last: int) -> OffsetSection:
    """The blocks along the drawing of a round whose loop is from `first` to `last`, −1 where it has none.

    As many blocks as lead in, at least one, may lead out behind the loop. If there are more blocks, they run along the
    contour again, and only the last ones, as many as lead in, lead out. A contour without a loop, such as a parting
    cut, is drawn from its first block to its last.
    """
    end = past - 1
    if first < 0:
        return OffsetSection(begin, end, closed=False)
    leads = first - begin
    again = end - last > max(leads, 1)
    closes = np.hypot(*(toolpath.end_um[last] - toolpath.start_um[first])) <= CLOSED_WITHIN_UM
    return OffsetSection(first, end - leads if again else last, closed=bool(closes and not again))


def _parted(toolpath: Toolpath, whole: Ints, loops: Ints) -> Ints:
    """(m, 2) the runs (k, 2), parted behind each row that ends at their start hole once their loop (k, 2) is closed.

    A contour that begins without a lead-in has no start hole beside it.
    """
    parts: list[tuple[int, int]] = []
    for (begin, past), (first, last) in zip(whole.tolist(), loops.tolist(), strict=True):
        behind = slice(last, past - 1) if first > begin else slice(0)
        off = toolpath.end_um[behind] - toolpath.start_um[begin]
        back = last + 1 + np.flatnonzero(np.hypot(off[:, 0], off[:, 1]) <= CLOSED_WITHIN_UM)
        parts += pairwise([begin, *back.tolist(), past])
    return np.array(parts, dtype=np.int64).reshape(-1, 2)


def _loops(toolpath: Toolpath, parts: Ints) -> Ints:
    """(k, 2) first and last row of the loop of each part (k, 2), a stretch of rows; −1 where it has none."""
    number, length = np.arange(len(parts)), parts[:, 1] - parts[:, 0]
    of_row = np.full(len(toolpath), -1, dtype=np.int64)
    of_row[~toolpath.is_jump] = np.repeat(number, length)
    found = find_loops(toolpath, of_row, number)
    rows = np.full((len(parts), 2), -1, dtype=np.int64)
    rows[found.contour] = np.stack([found.first, found.last], axis=1)
    return rows
