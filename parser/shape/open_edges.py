"""Passes over an edge that is left open: there and back up to a tab, and the passes that cut the tab.

Where the first pass turns back, the second one runs beside it. What both have in common is the open edge. Its two ends
are known then, and every other stretch of the contour is told by the ends that it runs between: from one end to the
other beside the edge it is a pass, and away from the edge a pass over the tab. All else is lead or step.

Where a path turns back: at once, or behind a short step aside, as from one pass to the next one.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from parser.geometry.along import directions, headings, places
from parser.geometry.curves import Bools, Floats, Ints, total_before
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.shape.parallel_runs import neighbours
from parser.toolpath import Toolpath

_BACK = -0.96  # cosine of the angle between the ways there and back; whole µm tilt short blocks
_MOST_STEP_UM = 400.0
_MOST_STEPS = 3  # blocks of a step aside


class Turns(NamedTuple):
    """Turns (k,) in the order they are met.

    Attributes
    ----------
    arrive, leave
        Rows up to but without `arrive` run there, those from `leave` on back; rows between them are the step.
    aside_um
        How far the way back lies to the left of the way there.
    """

    arrive: Ints
    leave: Ints
    aside_um: Floats

    def take(self, at: Ints | slice) -> "Turns":
        """Those at the indices `at`."""
        return Turns(self.arrive[at], self.leave[at], self.aside_um[at])


def find_turns(toolpath: Toolpath, contour: Ints) -> Turns:
    """Turns within contours; `contour` (n,) is each row's, −1 on jumps."""
    n = len(toolpath)
    ways, before = directions(toolpath), total_before(toolpath.length_um)
    leave = np.full(n, -1, dtype=np.int64)
    for blocks in range(min(_MOST_STEPS, n - 1), -1, -1):
        arriving, leaving = ways.arriving[: n - blocks - 1], ways.leaving[blocks + 1 :]
        turned = arriving[:, 0] * leaving[:, 0] + arriving[:, 1] * leaving[:, 1] <= _BACK
        turned &= (contour[: n - blocks - 1] >= 0) & (contour[: n - blocks - 1] == contour[blocks + 1 :])
        turned &= before[blocks + 1 : n] - before[1 : n - blocks] <= _MOST_STEP_UM
        row = np.flatnonzero(turned)
        leave[row] = row + blocks + 1
    there = np.flatnonzero(leave >= 0)
    # Blocks may be shorter than a step: of turns that leave by one row, the last one is no step longer than it must be.
    there = there[np.diff(leave[there], append=n) != 0]
    there = _apart(there, leave[there], before)
    back = leave[there]
    by = toolpath.start_um[back] - toolpath.end_um[there]
    way = ways.arriving[there]
    return Turns(there + 1, back, way[:, 0] * by[:, 1] - way[:, 1] * by[:, 0])


def _apart(there: Ints, back: Ints, before_um: Floats) -> Ints:
    """Rows (k,) that turn back, without those whose way back would be the step of another one: of two the shorter step.

    Behind a corner the step itself runs back beside the side before it. Where one goes, those about it may meet.
    """
    gone = np.ones(1, dtype=np.bool_)
    while gone.any():
        step_um = before_um[back] - before_um[there + 1]
        meets = back[:-1] >= there[1:] + 1
        gone = np.zeros(len(there), dtype=np.bool_)
        gone[:-1] |= meets & (step_um[:-1] > step_um[1:])
        gone[1:] |= meets & (step_um[:-1] <= step_um[1:])
        there, back = there[~gone], back[~gone]
    return there


MOST_ASIDE_UM = 150.0
"""Trims take no more; two sides of a slot are farther apart."""
LEAST_ASIDE_UM = 3.0  # nearer, it is a slit that is left on the line it was cut on
_LEAST_LENGTH_UM = 1000.0
_LEAST_SHARE = 0.6
AT_END_UM = 450.0
"""Passes over one edge end this near each other."""
_MOST_TURNS = 8  # of a contour at which two passes are looked for


class Section(NamedTuple):
    """Rows of one pass, both included."""

    first: int
    last: int
    is_tab: bool


def open_sections(toolpath: Toolpath, bounds: tuple[int, int], turns: Turns) -> list[Section]:
    """Passes over the open edge of a contour; none where it has none.

    `bounds` are the first row of the contour and the one past its last, `turns` those of the contour.
    """
    aside = np.abs(turns.aside_um)
    trims = np.flatnonzero((aside >= LEAST_ASIDE_UM) & (aside <= MOST_ASIDE_UM))
    if not len(trims):
        return _repeated(toolpath, bounds, turns.take(np.flatnonzero(aside < LEAST_ASIDE_UM)[:1]))
    # There the part lies on the one side, back on the other; round a slot the wire goes aside to one side always.
    to_part = np.sign(turns.aside_um[trims]) * np.where(trims % 2 == 0, 1.0, -1.0)
    if (to_part != to_part[:1]).any():
        return []
    low, past = bounds
    leave, arrive = np.concatenate([[low], turns.leave]), np.concatenate([turns.arrive, [past]])
    for at in trims[:_MOST_TURNS].tolist():
        there, back = np.arange(leave[at], arrive[at]), np.arange(leave[at + 1], arrive[at + 1])
        edge = _common(toolpath, there, back)
        if len(edge):
            return _sections(toolpath, low, past, edge)
    return []


def _repeated(toolpath: Toolpath, bounds: tuple[int, int], turns: Turns) -> list[Section]:
    """Passes over an open edge that lie in one place, there and back; they are passes by the tab that they leave.

    It is shorter than the edge. A slit, left on the line on which it was cut, leaves none.
    """
    low, past = bounds
    if not len(turns.leave):
        return []
    there, back = np.arange(low, turns.arrive[0]), np.arange(turns.leave[0], past)
    whole_um, run_um = toolpath.length_um[there].sum(), np.cumsum(toolpath.length_um[back])
    if not len(run_um) or run_um[-1] < _LEAST_SHARE * whole_um:
        return []  # back over less than most of it
    edge = _common(toolpath, there, back[: np.searchsorted(run_um, whole_um)], 0.0)
    found = _sections(toolpath, low, past, edge) if len(edge) else []
    tabs = [section for section in found if section.is_tab]
    lengths = [toolpath.length_um[tab.first : tab.last + 1].sum() for tab in (*found[:1], *tabs)]
    return found if tabs and max(lengths[1:]) < lengths[0] else []


def is_slot(sections: list[Section], begin: int, loop: tuple[int, int] | None) -> bool:
    """Whether the sections are only the sides of a slot: those of a figure without a tab.

    The contour begins with the row `begin`; `loop` are the first and the last row of the loop that it closes, if any.
    """
    if loop is None or any(section.is_tab for section in sections):
        return False
    within = loop[0] <= sections[0].first and sections[-1].last <= loop[1]
    return within and (loop[0] > begin or sections[0].first == begin)  # else the way from the hole back to it


def sections_of_tours(toolpath: Toolpath, bounds: tuple[int, int], this: Ints, other: Ints) -> list[Section]:
    """Passes over the open edge that two ways from the hole and back to it have in common; `bounds` are the contour's.

    The ways `one` and `other` are given by their rows.
    """
    edge = _common(toolpath, this, other)
    return _sections(toolpath, *bounds, edge) if len(edge) else []


def _common(toolpath: Toolpath, early: Ints, late: Ints, least_um: float = LEAST_ASIDE_UM) -> Ints:
    """Rows of a later stretch up to the last that runs beside an earlier one as most of it does; none if few do.

    `early` and `late` are their rows, and it runs `least_um` aside. Leads of both run on one line, not as far
    aside as passes.
    """
    row, aside, _ = _row_by_row(toolpath, early, late)
    length = toolpath.length_um[row]
    if length.sum() < _LEAST_LENGTH_UM:
        return late[:0]
    order = np.argsort(aside)
    half = np.searchsorted(np.cumsum(length[order]), 0.5 * length.sum())
    usual = float(aside[order][half])
    if not least_um <= abs(usual) <= MOST_ASIDE_UM:
        return late[:0]
    like = row[np.abs(aside - usual) <= max(CLOSED_WITHIN_UM, 0.4 * abs(usual))]
    if not len(like):
        return late[:0]
    stretch = np.arange(like[0], like[-1] + 1)
    share = toolpath.length_um[like].sum() / toolpath.length_um[stretch].sum()
    return stretch if share >= _LEAST_SHARE else late[:0]


def _row_by_row(toolpath: Toolpath, early: Ints, late: Ints) -> tuple[Ints, Floats, Ints]:
    """Those of the rows `late` whose middle has one of `early` beside it, how far aside to the left, and its sense."""
    half = np.full(len(late), 0.5)
    beside_neighbours = neighbours(toolpath, early, places(toolpath, late, half), headings(toolpath, late, half))
    nearest = np.lexsort((np.abs(beside_neighbours.aside_um), beside_neighbours.at))
    once = nearest[np.flatnonzero(np.diff(beside_neighbours.at[nearest], prepend=-1))]
    return late[beside_neighbours.at[once]], beside_neighbours.aside_um[once], beside_neighbours.sense[once]


def sections_elsewhere(toolpath: Toolpath, bounds: tuple[int, int], edge: Ints, within_um: float) -> list[Section]:
    """Passes over an open edge of the rows `edge`, and over its tab, in another contour; `bounds` are of that one.

    They begin and end no farther than `within_um` from the ends of the edge.
    """
    found = _between_ends(toolpath, bounds, edge, within_um)
    return [section._replace(is_tab=not is_beside) for section, is_beside in found]


def _sections(toolpath: Toolpath, low: int, past: int, edge: Ints) -> list[Section]:
    """Passes over the open edge of the rows `edge`, several of them, and over its tab."""
    found = _between_ends(toolpath, (low, past), edge, AT_END_UM)
    # What is cut first is the edge, the other one its tab.
    sections = [section._replace(is_tab=is_beside != found[0][1]) for section, is_beside in found]
    return sections if sum(not section.is_tab for section in sections) > 1 else []


def _between_ends(
    toolpath: Toolpath, bounds: tuple[int, int], edge: Ints, within_um: float
) -> list[tuple[Section, bool]]:
    """What runs between the ends of the open edge of the rows `edge`, and whether it runs beside it."""
    low, past = bounds
    corner = np.concatenate([toolpath.start_um[low:past], toolpath.end_um[past - 1 : past]])
    is_near = np.zeros(past - low, dtype=np.bool_)
    is_near[_row_by_row(toolpath, edge, np.arange(low, past))[0] - low] = True
    # What runs beside the edge for a little, out and back at one end of it, goes on over a tab that it cuts.
    least_um = 0.5 * float(toolpath.length_um[edge].sum())
    found: list[tuple[Section, bool]] = []
    for (here, _, leave), (there, arrive, _) in pairwise(_visits(toolpath, corner, edge, within_um)):
        length = toolpath.length_um[low + leave : low + arrive]
        share = float(length[is_near[leave:arrive]].sum() / max(float(length.sum()), 1.0))
        is_beside = share >= _LEAST_SHARE and float(length.sum()) >= least_um
        if (is_beside or here != there) and not _by_hole(corner, leave, arrive):
            found.append((Section(low + leave, low + arrive - 1, False), is_beside))
    return found


def _visits(toolpath: Toolpath, corner: Floats, edge: Ints, within_um: float) -> list[tuple[int, int, int]]:
    """Visits of the corners (m, 2) to the ends of the edge: which end, the corners of arriving there and leaving it."""
    ends = np.stack([toolpath.start_um[edge[0]], toolpath.end_um[edge[-1]]])
    ways = headings(toolpath, edge[[0, -1]], np.array([0.0, 1.0]))
    off = corner[:, None, :] - ends
    away = np.hypot(off[:, :, 0], off[:, :, 1])
    apart = float(np.hypot(*(ends[1] - ends[0])))
    end = np.where(away.min(axis=1) <= min(within_um, 0.5 * apart), away.argmin(axis=1), -1)
    along = np.abs((off * ways).sum(axis=2))
    first = np.flatnonzero(np.diff(end, prepend=-1) != 0)
    found = []
    for begin, until in pairwise([*first.tolist(), len(end)]):
        if end[begin] >= 0:
            near = along[begin:until, end[begin]]
            level = begin + np.flatnonzero(near <= near.min() + CLOSED_WITHIN_UM)
            found.append((int(end[begin]), int(level[0]), int(level[-1])))
    return found


def _by_hole(corner: Floats, leave: int, arrive: int) -> bool:
    """Whether the corners (m, 2) from one to another one come by the first, where the wire is threaded."""
    off = corner[leave + 1 : arrive] - corner[0]
    near: Bools = np.hypot(off[:, 0], off[:, 1]) <= CLOSED_WITHIN_UM
    return bool(near.any())
