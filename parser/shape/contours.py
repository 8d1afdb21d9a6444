"""Contours of a toolpath: runs of cut blocks, how well they close, exact and stepped."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.geometry.directions import directions, headings_at
from parser.geometry.distance import distance_to_curves
from parser.threeb.figures import CLOSED_WITHIN_UM, EXACT_PER_ARC_UM
from parser.toolpath import Toolpath

_OF_LINES_UM = 2.0  # ends in whole µm, of a CAM that rounds them apart
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

    @property
    def is_open(self) -> bool:
        """Whether it should close and does not."""
        return self.encloses and not self.returns


def find_contours(toolpath: Toolpath, corner_um: Ints) -> tuple[Contour, ...]:
    """Contours in the order they are cut; `corner_um` (n + 1, 2) is where the steps stand between the blocks."""
    cut = np.concatenate([[False], ~toolpath.is_jump, [False]])
    borders = np.flatnonzero(np.diff(cut)).reshape(-1, 2)
    ways, is_arc = directions(toolpath), toolpath.is_arc
    pauses = np.array([*(stop.after for stop in toolpath.stops), len(toolpath)], dtype=np.int64)
    found = []
    for low, high in borders.tolist():
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
    return tuple(found)


def closure_tolerance_um(arcs: int) -> float:
    """Distance within which a contour with so many arcs counts as closed: lines are exact, arcs are not."""
    return max(CLOSED_WITHIN_UM, EXACT_PER_ARC_UM * arcs) if arcs else _OF_LINES_UM


def _length(pair: Floats) -> float:
    return float(np.hypot(pair[0], pair[1]))


def _returns(toolpath: Toolpath, before: Ints, last: int, arriving: Floats, tolerance_um: float) -> bool:
    """Whether the row `last`, arriving so, ends at the start of a row of `before`, or on such a row in its direction.

    `before` are the rows up to the first pause: an end on what was cut after it is no closure, since a faulty figure
    and the next one make one contour there. Neither is one back along the lead-in, short of its start: the direction
    tells it from an overlap.
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
    along = headings_at(toolpath, before[off <= tolerance_um], end)
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
