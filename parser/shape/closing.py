"""When a path is closed: how near its end may lie to its start, and at which of its corners it may end."""

import numpy as np

from parser.geometry.curves import CurveKind, Floats, Ints
from parser.toolpath import Toolpath

CLOSED_WITHIN_UM = 5.0
EXACT_PER_ARC_UM = 1.0
"""A path whose end is this near its start is closed: 1 µm exact per arc, 5 µm stepped (docs/3b.md §3)."""
_OF_LINES_UM = 2.0  # ends in whole µm, of a CAM that rounds them apart
_MOST_OFF_UM = 20.0  # however many arcs: their errors do not add up, and corners lie no nearer than this
_SAME_WAY = 0.99  # cosine of the angle between two ways along one curve
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
    return any(float(_heading(toolpath, row) @ heading) > _SAME_WAY for row in again.tolist())


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
