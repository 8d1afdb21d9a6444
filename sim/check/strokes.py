"""Strokes that no sound cut has: forth and back over the same ground, and blocks that fit in the other order.

A wire that runs forth and back cuts a slit. Some slits are meant: one alone, several from one start hole, one inside a
contour that closes without it, small ones at corners. Any other stroke forth and back is a block lost, doubled or put
in a wrong place, and the figure that is left when such strokes are taken out shows what is missing.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import at_block
from parser.findings.findings import Finding, OddOrder
from parser.geometry.along import directions, runs_back_over
from parser.geometry.curves import Bools, Floats, Ints
from parser.geometry.near import distinct
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM, Contour, runs
from parser.shape.passes import Passes
from parser.toolpath import Toolpath

_MOST_RELIEF_UM = 1000.0
_MOST_RELIEF = 0.05
"""Strokes into a corner and back, to clear it, are as short as this, and as this part of their contour (assumed)."""
_SMOOTH_RAD = np.radians(0.2)
"""Joints of a drawing that are tangent are so within this, and what whole µm leave open."""


_LEAST_GAINED = 2
_MOST_OVERCUT = 8  # blocks
_SHORT_UM = 20.0  # steps between passes, and arcs so short that whole µm decide their direction
_SAME_LENGTH_UM = 2.0


class _Rest(NamedTuple):
    """A row, and the share of its length that is left of it."""

    row: int
    share: float


class Retraced(NamedTuple):
    """What is left of a contour when strokes forth and back are taken out.

    Attributes
    ----------
    contour
        As it was found.
    row
        The row that first runs back over the one before.
    by_um
        How far it does.
    gap_um
        From the end of what is left to its start; NaN where nothing is left.
    """

    contour: Contour
    row: int
    by_um: float
    gap_um: float

    @property
    def opened(self) -> Contour:
        """The contour as it is without the strokes: open where the rest does not close."""
        if not self.gap_um > self.contour.tolerance_um:
            return self.contour
        return self.contour._replace(closure_exact_um=self.gap_um, returns=False, encloses=True)


def retraced_contours(toolpath: Toolpath, contours: tuple[Contour, ...], passes: Passes) -> tuple[Retraced, ...]:
    """Contours in which a stroke forth and back cannot be meant, in order.

    Steps between passes over one edge, and leads to them, turn back where they should.
    """
    length = toolpath.length_um
    anywhere = _runs_back(toolpath)
    of = passes.of_row
    back = anywhere & (of == np.append(-1, of[:-1])) & (of >= 0)
    found = []
    for contour in contours:
        low, high = contour.first - 1, contour.last
        rows = low + 1 + np.flatnonzero(back[low + 1 : high])
        rows = rows[~_from_hole(toolpath, low, rows)]
        if not len(rows):
            continue
        by = np.minimum(length[rows - 1], length[rows])
        whole = float(length[low:high].sum())
        large = rows[by > min(_MOST_RELIEF_UM, _MOST_RELIEF * whole)]
        if not len(large):
            continue
        left = _without_strokes(toolpath, low, high, back)
        row = int(large[0])
        if _is_meant(toolpath, (low, high), left, low + 1 + np.flatnonzero(anywhere[low + 1 : high])):
            continue
        gap = float("nan")
        if left:
            gap = float(np.hypot(*_by_um(toolpath, left)))
        found.append(Retraced(contour, row, float(min(length[row - 1], length[row])), gap))
    return tuple(found)


def _from_hole(toolpath: Toolpath, low: int, rows: Ints) -> Bools:
    """(k,) whether rows that run back end a slit of two blocks, from the start hole of a contour and back to it."""
    forth, back = toolpath.start_um[rows - 1] - toolpath.start_um[low], toolpath.end_um[rows] - toolpath.start_um[low]
    slit: Bools = np.maximum(np.hypot(*forth.T), np.hypot(*back.T)) <= CLOSED_WITHIN_UM
    return slit


def _runs_back(toolpath: Toolpath) -> Bools:
    """(n,) whether a row runs back over the one before: the other way along the same line or circle."""
    at = np.arange(len(toolpath) - 1)
    back = np.zeros(len(toolpath), dtype=np.bool_)
    back[1:] = runs_back_over(toolpath, at, at + 1) & ~toolpath.is_jump[1:] & ~toolpath.is_jump[:-1]
    return back


def _without_strokes(toolpath: Toolpath, low: int, high: int, back: Bools) -> list[_Rest]:
    """What is left of the rows of a contour when strokes back take out what they run back over.

    A stroke back may take back several blocks that go on straight, or part of one.
    """
    left: list[_Rest] = []
    for row in range(low, high):
        share = 1.0
        while left and share > 0.0 and _is_opposite(toolpath, left[-1].row, row, back):
            before = left.pop()
            most, own = before.share * toolpath.length_um[before.row], share * toolpath.length_um[row]
            if most > own + CLOSED_WITHIN_UM:
                left.append(_Rest(before.row, (most - own) / toolpath.length_um[before.row]))
                share = 0.0
            else:
                share = (own - most) / toolpath.length_um[row] if own > most + CLOSED_WITHIN_UM else 0.0
        if share > 0.0:
            left.append(_Rest(row, share))
    return left


def _by_um(toolpath: Toolpath, left: list[_Rest]) -> Floats:
    """Way (2,) from the start of what is left to its end; a part of an arc counts as that part of its chord."""
    rows, share = np.array([rest.row for rest in left]), np.array([rest.share for rest in left])
    by: Floats = ((toolpath.end_um[rows] - toolpath.start_um[rows]) * share[:, None]).sum(axis=0)
    return by


def _is_opposite(toolpath: Toolpath, before: int, row: int, back: Bools) -> bool:
    """Whether a row runs back over an earlier one that ends where it begins."""
    if before == row - 1:
        return bool(back[row])
    return bool(runs_back_over(toolpath, np.array([before]), np.array([row]))[0])


def _is_meant(toolpath: Toolpath, bounds: tuple[int, int], left: list[_Rest], rows: Ints) -> bool:
    """Whether strokes forth and back are slits: one alone, several from the start hole, or in a contour that closes.

    `bounds` are those of the contour, `left` what is left of it without the strokes, `rows` (k,) those that run back.
    """
    low, high = bounds
    start = toolpath.start_um
    off_hole = np.hypot(*(start[low + 1 : high] - start[low]).T) > CLOSED_WITHIN_UM
    if not left:
        return int(off_hole[rows - low - 1].sum()) == 1 + int((~off_hole).sum())
    whole = np.array([rest.row for rest in left if rest.share == 1.0], dtype=np.int64)
    gap = toolpath.end_um[left[-1].row] - start[left[0].row]
    closes = float(np.hypot(gap[0], gap[1])) <= CLOSED_WITHIN_UM
    if len(whole) < len(left) or not closes or _area(toolpath, whole) <= CLOSED_WITHIN_UM:
        return False
    cut = np.arange(low, high)
    taken = cut[~np.isin(cut, whole)]
    return not _is_a_side(toolpath, whole, taken)


def _is_a_side(toolpath: Toolpath, left: Ints, taken: Ints) -> bool:
    """Whether a stroke that was taken out is as long as a parallel line that is left, as sides of a figure are."""
    by = toolpath.end_um - toolpath.start_um
    lines = left[~toolpath.is_arc[left]]
    strokes = taken[~toolpath.is_arc[taken] & (toolpath.length_um[taken] > _SHORT_UM)]
    of_strokes, of_lines = _one_way(by[strokes]), _one_way(by[lines])
    for shift in np.ndindex(2, 2):  # two that are near share a cell of one of four grids
        cells = [np.floor(of / (2.0 * _SAME_LENGTH_UM) + np.array(shift) / 2.0) for of in (of_strokes, of_lines)]
        keys = [cell[:, 0] + 1j * cell[:, 1] for cell in cells]
        if np.isin(keys[0], keys[1]).any():
            return True
    return False


def _one_way(by_um: Floats) -> Floats:
    """Ways (k, 2) turned round where they lead to the left, or straight down."""
    left = (by_um[:, 0] < -0.5) | ((np.abs(by_um[:, 0]) <= 0.5) & (by_um[:, 1] < 0.0))
    return np.where(left[:, None], -by_um, by_um)


def _area(toolpath: Toolpath, rows: Ints) -> float:
    """Area of the closed path of some rows over its length, µm."""
    start, end = toolpath.start_um[rows], toolpath.end_um[rows]
    sweep = toolpath.sweep_rad[rows]
    segment = np.nan_to_num(toolpath.radius_um[rows]) ** 2 * (sweep - np.sin(sweep))
    twice = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0] + np.where(toolpath.is_arc[rows], segment, 0.0)
    return abs(float(twice.sum())) / max(float(toolpath.length_um[rows].sum()), 1.0)


def retraced_findings(program: Program, retraced: tuple[Retraced, ...]) -> Iterator[Finding]:
    """Finding 3B317 at the block that runs back."""
    for each_retraced in retraced:
        values = {"by": each_retraced.by_um, "first": each_retraced.contour.first, "last": each_retraced.contour.last}
        yield at_block(program.toolpath, program.lines, "3B317", each_retraced.row, **values).with_fact(OddOrder())


def swapped_findings(program: Program, rows: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding 3B318 at the later one of two blocks that run smoothly into their neighbours in the other order.

    `rows` (n,) is each row's contour, −1 where it is not judged.
    """
    of_pass = np.where(rows >= 0, passes.of_row, -1)
    for row in swapped_rows(program.toolpath, rows, of_pass).tolist():
        yield at_block(program.toolpath, program.lines, "3B318", row, other=row).with_fact(OddOrder())


def swapped_rows(toolpath: Toolpath, contour: Ints, of_pass: Ints) -> Ints:
    """Rows (k,) that with the one before would stand in the other order: two joints more are then tangent.

    Joints of two lines do not count: what runs on straight is one line. A lead and the block beside it are looked at
    where the contour closes behind a lead-in of one block when they are swapped.
    """
    n = len(toolpath)
    if n < 3:
        return np.zeros(0, dtype=np.int64)
    joints = _Joints(toolpath)
    at = np.arange(1, n - 2)  # the earlier of the two
    same = (of_pass[at] >= 0) & (of_pass[at + 1] == of_pass[at])
    same &= (contour[at - 1] == contour[at]) & (contour[at + 2] == contour[at])
    at = at[same]
    at = at[np.minimum(toolpath.length_um[at], toolpath.length_um[at + 1]) > CLOSED_WITHIN_UM]  # else nothing is moved
    at = at[~runs_back_over(toolpath, at, at + 1)]  # a slit
    now = joints.tangent(at - 1, at) + joints.tangent(at, at + 1) + joints.tangent(at + 1, at + 2)
    then = joints.tangent(at - 1, at + 1) + joints.tangent(at + 1, at) + joints.tangent(at, at + 2)
    between = at[then - now >= _LEAST_GAINED] + 1
    return distinct(np.concatenate([between, _swapped_leads(toolpath, contour, joints)]))


class _Joints:
    """Which joints of blocks are tangent, if one followed the other."""

    def __init__(self, toolpath: Toolpath) -> None:
        self._way = directions(toolpath)
        self._slack = 1.0 / np.maximum(toolpath.length_um, 1.0)
        self._is_arc = toolpath.is_arc & (toolpath.length_um > _SHORT_UM)

    def tangent(self, this: Ints, other: Ints) -> Ints:
        """(k,) 1 where a row would run smoothly into another one, and one of them is an arc; else 0."""
        arriving, leaving = self._way.arriving[this], self._way.leaving[other]
        cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
        angle = np.abs(np.arctan2(cross, (arriving * leaving).sum(axis=1)))
        smooth = angle <= _SMOOTH_RAD + self._slack[this] + self._slack[other]
        return np.asarray(smooth & (self._is_arc[this] | self._is_arc[other]), dtype=np.int64)


def _swapped_leads(toolpath: Toolpath, contour: Ints, joints: _Joints) -> Ints:
    """Rows (k,) of contours whose lead-in or lead-out was swapped with the block of the contour beside it."""
    first, past = runs(toolpath).T
    wanted = (past - first >= 4) & (contour[first] >= 0)
    first, last = first[wanted], past[wanted] - 1
    start, end = toolpath.start_um, toolpath.end_um
    by = end - start

    def near(this: Floats, other: Floats) -> Bools:
        close: Bools = np.hypot(*(this - other).T) <= CLOSED_WITHIN_UM
        return close

    # In: block 2 would lead in, and the loop close at its end, with or without a lead-out.
    hole = start[first] + by[first + 1]
    found = []
    for closing in (last, last - 1):
        closes = near(end[closing], hole) & ~near(end[closing], start[first + 1])
        then = joints.tangent(first, first + 2) + joints.tangent(closing, first)
        now = joints.tangent(first, first + 1) + joints.tangent(first + 1, first + 2)
        found.append(first[closes & (then - now >= _LEAST_GAINED)] + 1)
    # Out: the last block would close the loop at the end of the lead-in, and the one before it lead out.
    joint = end[last] - by[last - 1]
    closes = near(joint, start[first + 1]) & ~near(end[last - 2], start[first + 1])
    then = joints.tangent(last - 2, last) + joints.tangent(last, first + 1)
    now = joints.tangent(last - 2, last - 1) + joints.tangent(last - 1, last)
    found.append(last[closes & (then - now >= _LEAST_GAINED)])
    return np.concatenate(found)


def _comes_back(toolpath: Toolpath, row: int) -> bool:
    """Whether the way from a row on runs out over a few blocks, and back over the same ones, as an overcut does."""
    if toolpath.is_jump[row]:
        return False
    for number in range(1, min(_MOST_OVERCUT, (len(toolpath) - row) // 2) + 1):
        turn = row + number
        off = toolpath.end_um[turn : turn + number] - toolpath.start_um[row:turn][::-1]
        if (np.hypot(*off.T) <= CLOSED_WITHIN_UM).all():
            return True
    return False


def doubled_findings(program: Program, rows: Ints, passes: Passes) -> Iterator[Finding]:
    """Finding 3B319 at a block that is written as the one before it, where both cannot be sides of one contour.

    A jump, a lead, or a lead and the first side: no CAM cuts one of these in two equal halves. An overcut that runs on
    by a block as long as the last side, and back again, is no such slip. `rows` (n,) is each row's contour, −1 where it
    is not judged and on jumps.
    """
    toolpath = program.toolpath
    by = toolpath.end_um - toolpath.start_um
    same = (by[1:] == by[:-1]).all(axis=1) & (toolpath.sweep_rad[1:] == toolpath.sweep_rad[:-1])
    same &= (toolpath.length_um[1:] > _SHORT_UM) & (toolpath.kind[1:] == toolpath.kind[:-1])
    same &= toolpath.is_jump[1:] | ((rows[1:] >= 0) & (rows[1:] == rows[:-1]))
    same &= (passes.of_row[1:] < 0) | (passes.of_row[:-1] < 0)
    compensation = toolpath.compensation
    if compensation is not None:  # a lead is halved where its offset changes
        same &= (compensation.side[1:] == compensation.side[:-1]) & (compensation.by_um[1:] == compensation.by_um[:-1])
    parted = {stop.after for stop in toolpath.stops}
    for row in (1 + np.flatnonzero(same)).tolist():
        if row not in parted and not _comes_back(toolpath, row):
            yield at_block(toolpath, program.lines, "3B319", row, other=row).with_fact(OddOrder())
