"""Contours of a toolpath: runs of cut blocks, how well they close, exact and stepped."""

from typing import NamedTuple

import numpy as np

from controller.steps import Steps
from parser.toolpath import Floats, Toolpath
from sim.deviation import distance_to_blocks
from sim.directions import directions

EXACT_PER_ARC_UM = 1.0
CLOSES_WITHIN_UM = 5.0
"""A sound program closes to 1 µm per arc exact and to 5 µm stepped (docs/3b.md §3)."""


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
    returns
        Whether its end lies on its own earlier path: at the start, at the end of a lead-in, or past them.
    encloses
        Whether it turns back on itself anywhere; a path that always runs forward in some direction is a parting cut
        and need not close.
    """

    first: int
    last: int
    closure_exact_um: float
    closure_stepped_um: float
    tolerance_um: float
    returns: bool
    encloses: bool

    @property
    def is_open(self) -> bool:
        """Whether it should close and does not."""
        return self.encloses and not self.returns

    @property
    def closes_badly_stepped(self) -> bool:
        """Whether it closes in the exact geometry and not on the machine."""
        return self.closure_exact_um <= self.tolerance_um < self.closure_stepped_um


def find_contours(toolpath: Toolpath, steps: Steps) -> tuple[Contour, ...]:
    """Contours in the order they are cut."""
    cut = np.concatenate([[False], ~toolpath.is_jump, [False]])
    borders = np.flatnonzero(np.diff(cut)).reshape(-1, 2)
    leaving, arriving = directions(toolpath)
    return tuple(
        Contour(
            first=low + 1,
            last=high,
            closure_exact_um=_length(toolpath.end_um[high - 1] - toolpath.start_um[low]),
            closure_stepped_um=_length(steps.corner_um[high] - steps.corner_um[low]),
            tolerance_um=(tolerance := _tolerance(toolpath, slice(low, high))),
            returns=_returns(toolpath, low, high, tolerance),
            encloses=_turns_back(toolpath, slice(low, high), np.concatenate([leaving[low:high], arriving[low:high]])),
        )
        for low, high in borders.tolist()
    )


def _length(pair: Floats) -> float:
    return float(np.hypot(pair[0], pair[1]))


def _tolerance(toolpath: Toolpath, rows: slice) -> float:
    return max(CLOSES_WITHIN_UM, EXACT_PER_ARC_UM * float(toolpath.is_arc[rows].sum()))


def _returns(toolpath: Toolpath, low: int, high: int, tolerance_um: float) -> bool:
    """Whether the end lies on the start or on a block before the last one (a full circle is on its own start)."""
    x, y = toolpath.end_um[high - 1]
    if np.hypot(x - toolpath.start_um[low, 0], y - toolpath.start_um[low, 1]) <= tolerance_um:
        return True
    rows = np.arange(low, high - 1)
    off, _ = distance_to_blocks(toolpath, rows, np.full(len(rows), x), np.full(len(rows), y))
    return bool((off <= tolerance_um).any())


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
