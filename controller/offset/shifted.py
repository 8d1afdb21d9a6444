"""Sections of contours that a controller offsets, and their blocks moved aside, each by itself.

What a controller is told of the offset: to which side, and along which blocks of each contour.

Blocks of sections, moved aside each by itself: their ends do not meet yet.
"""

from collections.abc import Sequence
from dataclasses import replace
from enum import IntEnum
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.along import directions, to_left
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import prolonged_meet
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


NOTHING_UM = 1e-6
"""No block is as short as this, and no radius as small: far below a step, far above the rounding of places."""
_CORNER_PER_GAP = 10.0  # blocks that close a contour and meet farther off than so many gaps run side by side: no corner


class Blocks(NamedTuple):
    """m blocks of sections, section after section.

    Attributes
    ----------
    row
        (m,) their rows in the toolpath.
    drawn, shifted
        The blocks as they are drawn, though a closed section has a corner where it closes; and the same moved aside.
    leaving, arriving
        (m, 2) directions at the start and the end of each.
    left_um
        (m,) how far they are moved to the left, negative to the right.
    """

    row: Ints
    drawn: Curves
    shifted: Curves
    leaving: Floats
    arriving: Floats
    left_um: Floats

    @property
    def is_left_over(self) -> NDArray[np.bool_]:
        """(m,) False on blocks without length, and on arcs whose radius the offset uses up."""
        used_up = self.shifted.is_arc & (self.shifted.radius_um <= NOTHING_UM)
        left_over: NDArray[np.bool_] = ~used_up & (self.drawn.length_um > NOTHING_UM)
        return left_over


def shifted_blocks(toolpath: Curves, sections: Sequence[OffsetSection], left_um: Floats) -> Blocks:
    """Blocks of k sections, one or more, each moved to the left by its `left_um` (k,), negative to the right."""
    row = np.concatenate([np.arange(section.first, section.last + 1) for section in sections])
    number = np.array([section.last - section.first + 1 for section in sections])
    past = np.cumsum(number)
    first = past - number
    left = np.repeat(left_um, number)
    closing = np.array([section.closed and section.last > section.first for section in sections])
    drawn = _closed_up(toolpath.picked(row), first[closing], past[closing] - 1)
    leaving, arriving = directions(drawn)
    turn = np.sign(drawn.sweep_rad)
    moved = replace(
        drawn,
        start_um=drawn.start_um + left[:, None] * to_left(leaving),
        end_um=drawn.end_um + left[:, None] * to_left(arriving),
        radius_um=drawn.radius_um - left * turn,
    )
    return Blocks(row, drawn, moved, leaving, arriving, left)


def turned_rad(curves: Curves, row: Ints, from_rad: Floats, place_um: Floats) -> Floats:
    """Angles (k,) in [−π, π) from `from_rad` (k,) to places (k, 2) about arcs `row` (k,), positive as each arc runs."""
    radial = place_um - curves.center_um[row]
    by = (np.arctan2(radial[:, 1], radial[:, 0]) - from_rad) * np.sign(curves.sweep_rad[row])
    return np.mod(by + np.pi, 2.0 * np.pi) - np.pi


def closed_contour(contour: Curves) -> Curves:
    """A closed contour whose last block ends where it meets the first one; a circle alone makes one turn.

    Where the two blocks run side by side and do not meet, the contour stays as it is.
    """
    first, last = np.array([0]), np.array([len(contour) - 1])
    if len(contour) == 1:
        return _one_turn(contour)
    place, is_met = _closing(contour, first, last)
    return _closed_at(contour, first, last, place) if is_met[0] else contour


def _one_turn(circle: Curves) -> Curves:
    sweep = 2.0 * np.pi * np.sign(circle.sweep_rad)
    return replace(circle, end_um=circle.start_um, sweep_rad=sweep, length_um=circle.radius_um * np.abs(sweep))


def _closed_up(curves: Curves, first: Ints, last: Ints) -> Curves:
    """Curves whose rows `last` (k,) end where the rows `first` (k,) begin.

    Arcs of whole µm never close a contour exactly. Its corner is where the two blocks meet, prolonged or shortened, or
    midway between their ends where they run side by side.
    """
    place, is_met = _closing(curves, first, last)
    middle = 0.5 * (curves.start_um[first] + curves.end_um[last])
    corner = np.where(is_met[:, None], place, middle)
    return _closed_at(curves, first, last, corner)


def _closed_at(curves: Curves, first: Ints, last: Ints, corner_um: Floats) -> Curves:
    """Curves whose rows `last` end and rows `first` begin at corners (k, 2)."""
    closed = _ended(_begun(curves, first, corner_um), last, corner_um)
    chord = np.hypot(*(closed.end_um - closed.start_um).T)
    length = np.where(closed.is_arc, closed.radius_um * np.abs(closed.sweep_rad), chord)
    return replace(closed, length_um=length)


def _closing(curves: Curves, first: Ints, last: Ints) -> tuple[Floats, NDArray[np.bool_]]:
    """Places (k, 2) where rows `last` and `first` meet, prolonged or shortened, and whether (k,) they do."""
    gap = curves.start_um[first] - curves.end_um[last]
    middle = curves.end_um[last] + 0.5 * gap
    wide = np.hypot(gap[:, 0], gap[:, 1])
    place = prolonged_meet(curves, last, first).place_um
    off = np.hypot(*np.moveaxis(place - middle[:, None], 2, 0))
    off = np.where(off <= _CORNER_PER_GAP * wide[:, None], off, np.inf)
    at, nearest = np.arange(len(first)), np.argmin(off, axis=1)
    return place[at, nearest], (wide > 0.0) & np.isfinite(off[at, nearest])


def _begun(curves: Curves, row: Ints, place_um: Floats) -> Curves:
    start, angle, sweep = curves.start_um.copy(), curves.start_angle_rad.copy(), curves.sweep_rad.copy()
    moved = row[(start[row] != place_um).any(axis=1)]
    start[row] = place_um
    by = turned_rad(curves, moved, angle[moved], start[moved]) * np.sign(sweep[moved])
    angle[moved] += by
    sweep[moved] -= np.nan_to_num(by)
    return replace(curves, start_um=start, start_angle_rad=angle, sweep_rad=sweep)


def _ended(curves: Curves, row: Ints, place_um: Floats) -> Curves:
    end, sweep = curves.end_um.copy(), curves.sweep_rad.copy()
    moved = row[(end[row] != place_um).any(axis=1)]
    end[row] = place_um
    by = turned_rad(curves, moved, (curves.start_angle_rad + sweep)[moved], end[moved]) * np.sign(sweep[moved])
    sweep[moved] += np.nan_to_num(by)
    return replace(curves, end_um=end, sweep_rad=sweep)
