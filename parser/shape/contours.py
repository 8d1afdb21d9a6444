"""Contours of a toolpath: runs of cut blocks, and how well they close, exact and stepped.

When a path is closed: how near its end may lie to its start, and at which of its corners it may end.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import directions, headings_at
from parser.geometry.curves import Bools, CurveKind, Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.geometry.near import near_places
from parser.toolpath import Toolpath

CLOSED_WITHIN_UM = 5.0
EXACT_PER_ARC_UM = 1.0
"""A path whose end is this near its start is closed: 1 µm exact per arc, 5 µm stepped (docs/3b.md §3)."""
_OF_LINES_UM = 2.0  # ends in whole µm, of a CAM that rounds them apart
_MOST_OFF_UM = 20.0  # however many arcs: their errors do not add up, and corners lie no nearer than this
_SAME_HEADING = 0.99  # cosine of the angle between two ways along one curve
_LATE = 256  # rows that are looked at first


def closure_tolerance_um(arcs: int) -> float:
    """Distance within which a contour with so many arcs counts as closed: lines are exact, arcs are not."""
    return max(CLOSED_WITHIN_UM, EXACT_PER_ARC_UM * arcs) if arcs else _OF_LINES_UM


def ends_closed(toolpath: Toolpath, begin: int, past: int) -> bool:
    """Whether the figure of the rows from `begin` up to but without `past` ends where it should.

    It should end at its start, or at another of its corners, such as the end of its lead-in. It may also overcut: its
    last block leaves such a corner in the direction of the block that it cuts once more.
    """
    last = past - 1
    if any(corners_at(toolpath, first, past, toolpath.end_um[last]).size for first in late_first(begin, past)):
        return True
    again = corners_at(toolpath, begin, last, toolpath.start_um[last])
    heading = _heading(toolpath, last)
    return any(float(_heading(toolpath, row) @ heading) > _SAME_HEADING for row in again.tolist())


def late_first(begin: int, past: int) -> tuple[int, ...]:
    """Where to begin to look for a corner: at the last rows up to but without `past`, and then at `begin`.

    One that counts among some rows counts among more. Where a figure is never left, and grows by a pass at each pause,
    its last rows nearly always have it: to look at all of them each time would take the square of their number.
    """
    late = past - _LATE
    return (late, begin) if late > begin else (begin,)


def corners_at(toolpath: Toolpath, begin: int, past: int, place_um: Floats) -> Ints:
    """Rows from `begin` up to but without `past` that start at a place (2,)."""
    off = toolpath.start_um[begin:past] - place_um
    arcs = float((toolpath.kind[begin:past] == CurveKind.ARC).sum())
    within = min(max(CLOSED_WITHIN_UM, EXACT_PER_ARC_UM * arcs), _MOST_OFF_UM)
    return begin + np.flatnonzero(np.hypot(off[:, 0], off[:, 1]) <= within)


def _heading(toolpath: Toolpath, row: int) -> Floats:
    """Direction (2,) in which a row leaves its start; (0, 0) where it does not move."""
    if toolpath.kind[row] == CurveKind.ARC:
        angle, turn = float(toolpath.start_angle_rad[row]), float(np.sign(toolpath.sweep_rad[row]))
        return np.array([-np.sin(angle) * turn, np.cos(angle) * turn])
    x, y = (toolpath.end_um[row] - toolpath.start_um[row]).tolist()
    return np.array([x, y]) / max(float(np.hypot(x, y)), 1.0)


_SAME_WAY = 0.9  # cosine of the angle between two ways along one curve


class Contour(NamedTuple):
    """Cut blocks without a jump between them.

    Attributes
    ----------
    first, last
        Block numbers.
    closure_exact_um, closure_stepped_um
        Distance of the end from the start, in the exact geometry and as stepped.
    tolerance_um
        Distance within which it counts as closed.
    arcs
        How many of its blocks are arcs.
    returns
        Whether it ends at its start, at a corner that it passed before, such as the end of a lead-in, or past that,
        running along its own path once more.
    in_kerf
        Whether it begins and ends in the kerf of contours that are cut before it, which close it.
    is_closed_later
        Whether a later contour closes it, which begins at its start hole and cuts the tab that it leaves.
    encloses
        Whether it turns back on itself anywhere; a path that always runs forward in some direction is a parting cut
        and need not close.
    """

    first: int
    last: int
    closure_exact_um: float
    closure_stepped_um: float
    tolerance_um: float
    arcs: int
    returns: bool
    encloses: bool
    in_kerf: bool = False
    is_closed_later: bool = False

    @property
    def is_open(self) -> bool:
        """Whether it should close and does not."""
        return self.has_closure and not self.returns

    @property
    def has_closure(self) -> bool:
        """Whether it is to end where it began."""
        return self.encloses and not self.is_closed_by_others

    @property
    def is_closed_by_others(self) -> bool:
        """Whether it ends elsewhere than it began, and other contours close it."""
        return not self.returns and (self.in_kerf or self.is_closed_later)


def runs(toolpath: Toolpath) -> Ints:
    """(k, 2) first row of each run of cut blocks without a jump between them, and one past its last, in order."""
    is_cut = np.concatenate([[False], ~toolpath.is_jump, [False]])
    return np.flatnonzero(np.diff(is_cut)).reshape(-1, 2)


def contour_rows(toolpath: Toolpath) -> Ints:
    """Contour number (n,) of each row, from 0 in the order they are cut; −1 on jumps, which part the contours."""
    first, past = runs(toolpath).T
    number = np.full(len(toolpath), -1, dtype=np.int64)
    number[~toolpath.is_jump] = np.repeat(np.arange(len(first)), past - first)
    return number


def find_contours(toolpath: Toolpath, corner_um: Ints) -> tuple[Contour, ...]:
    """Contours in the order they are cut; `corner_um` (n + 1, 2) is where the steps stand between the blocks."""
    ways, is_arc = directions(toolpath), toolpath.is_arc
    pauses = np.array([*(stop.after for stop in toolpath.stops), len(toolpath)], dtype=np.int64)
    found = []
    for low, high in runs(toolpath).tolist():
        rows = slice(low, high)
        arcs = int(is_arc[rows].sum())
        tolerance = closure_tolerance_um(arcs)
        first_pause = int(pauses[np.searchsorted(pauses, low, side="right")])
        before = np.arange(low, max(min(first_pause, high - 1), low + 1))
        found.append(
            Contour(
                first=low + 1,
                last=high,
                closure_exact_um=_length(toolpath.end_um[high - 1] - toolpath.start_um[low]),
                closure_stepped_um=_length(corner_um[high] - corner_um[low]),
                tolerance_um=tolerance,
                arcs=arcs,
                returns=_returns(toolpath, before, high - 1, ways.arriving[high - 1], tolerance),
                encloses=_turns_back(toolpath, rows, np.concatenate([ways.leaving[rows], ways.arriving[rows]])),
            )
        )
    left = [at for at, contour in enumerate(found) if contour.is_open]
    ends = np.array([(found[at].first - 1, found[at].last - 1) for at in left], dtype=np.int64).reshape(-1, 2)
    in_kerf = are_in_kerf(toolpath, ends, np.array([found[at].tolerance_um for at in left]))
    for at in np.array(left, dtype=np.int64)[in_kerf].tolist():
        found[at] = found[at]._replace(in_kerf=True)
    left = [at for at in left if found[at].is_open]
    for at, closer in zip(left, closers(toolpath, np.array(left, dtype=np.int64)).tolist(), strict=True):
        found[at] = found[at]._replace(is_closed_later=closer >= 0)
    return tuple(found)


def closers(toolpath: Toolpath, wanted: Ints) -> Ints:
    """(k,) the first later contour that closes each of the contours `wanted`; −1 where none does.

    It begins where that one begins, at the same start hole, and runs over the place where that one ends.
    """
    found = np.full(len(wanted), -1, dtype=np.int64)
    if not len(wanted):
        return found
    first, past = runs(toolpath).T
    start, end = toolpath.start_um[first[wanted]], toolpath.end_um[past[wanted] - 1]
    near = near_places(toolpath.picked(first), start, CLOSED_WITHIN_UM)
    off = np.hypot(*(toolpath.start_um[first[near.row]] - start[near.other]).T)
    later = np.flatnonzero((off <= CLOSED_WITHIN_UM) & (near.row > wanted[near.other]))
    pairs = sorted(zip(near.other[later].tolist(), near.row[later].tolist(), strict=True))
    for at, other in pairs:
        rows = np.arange(first[other], past[other])
        off, _ = distance_to_curves(toolpath, rows, np.full(len(rows), end[at, 0]), np.full(len(rows), end[at, 1]))
        if found[at] < 0 and off.min() <= CLOSED_WITHIN_UM:
            found[at] = other
    return found


def are_in_kerf(toolpath: Toolpath, ends: Ints, tolerance_um: Floats) -> Bools:
    """Which of contours (k,) begin and end on the paths of contours before them, within a tolerance, not at one place.

    `ends` (k, 2) are the first row of each and its last one.
    """
    number = len(ends)
    if not number:
        return np.zeros(0, dtype=np.bool_)
    place = np.concatenate([toolpath.start_um[ends[:, 0]], toolpath.end_um[ends[:, 1]]])
    cut = np.flatnonzero(~toolpath.is_jump)
    near = near_places(toolpath.picked(cut), place, float(tolerance_um.max()))
    off, _ = distance_to_curves(toolpath, cut[near.row], *place[near.other].T)
    before = (cut[near.row] < np.tile(ends[:, 0], 2)[near.other]) & (off <= np.tile(tolerance_um, 2)[near.other])
    is_on = np.zeros(2 * number, dtype=np.bool_)
    is_on[near.other[before]] = True
    apart = np.hypot(*(place[:number] - place[number:]).T) > tolerance_um
    both: Bools = is_on[:number] & is_on[number:] & apart
    return both


def _length(pair: Floats) -> float:
    return float(np.hypot(pair[0], pair[1]))


def _returns(toolpath: Toolpath, before: Ints, last: int, arriving: Floats, tolerance_um: float) -> bool:
    """Whether the row `last`, `arriving` so, ends at the start of a row of `before`, or on such a row in its direction.

    `before` are the rows up to the first pause. An end on what was cut after the pause is no closure: there a faulty
    figure and the next one make one contour. Nor is an end on the way back along the lead-in, short of its start: its
    direction tells it from an overlap.
    """
    end = toolpath.end_um[last]
    turned = abs(toolpath.sweep_rad[last])
    # A full circle closes on itself; past a full turn it overlaps itself, and off the axes it stops a little short.
    if turned >= 2.0 * np.pi or (turned > np.pi and _length(end - toolpath.start_um[last]) <= tolerance_um):
        return True
    corners = toolpath.start_um[before] - end
    if (np.hypot(corners[:, 0], corners[:, 1]) <= tolerance_um).any():
        return True
    before = before[before < last]
    if not len(before):
        return False
    off, _ = distance_to_curves(toolpath, before, np.full(len(before), end[0]), np.full(len(before), end[1]))
    before = before[off <= tolerance_um]
    along = headings_at(toolpath, before, np.broadcast_to(end, (len(before), 2)))
    return bool((along @ arriving > _SAME_WAY).any())


def _turns_back(toolpath: Toolpath, rows: slice, tangents: Floats) -> bool:
    """Whether no direction lies within a right angle of every tangent of the blocks.

    An arc of less than half a turn runs between its first and last tangent, so these stand for it.
    """
    if np.abs(toolpath.sweep_rad[rows]).max() >= np.pi:
        return True
    tangents = tangents[np.hypot(tangents[:, 0], tangents[:, 1]) > 0.5]  # a block of length 0 has none
    if not len(tangents):
        return False
    heading = np.sort(np.arctan2(tangents[:, 1], tangents[:, 0]))
    gaps = np.diff(heading, append=heading[0] + 2.0 * np.pi)
    return bool(gaps.max() <= np.pi + 1e-9)
