"""Outside corners: the curves beside them lengthened to where they meet, in place of an arc about the corner.

Where a contour is made of fitted arcs, nearly each joint is a corner of some hundredths of a degree. The arcs about
these are shorter than what a controller counts in whole µm: there the neighbours meet, whatever is asked for.
"""

import numpy as np

from controller.offset.joints import SHARPEST_RAD
from controller.offset.reach import OffsetLoop
from parser.geometry.along import places
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.directions import directions
from sim.cam.passes.beside.clear import clearance_um
from sim.cam.passes.beside.ends import Met, met_near, with_ends
from sim.setup.making import Corners

MENDED_UM = 0.1
"""How far a mended joint may lie off the exact offset: a fifth of what whole µm take."""
_FARTHEST = 2.0  # times what lines are lengthened: arcs that bend away from each other meet later, or nowhere
_TANGENT_SINE = 1e-3
_ROUNDING_UM = 1e-3


def with_corners(loop: OffsetLoop, by_um: float, corners: Corners, contour: Curves | None) -> Curves:
    """Curves (m,) of a loop at an offset of a contour, with outside corners as they are asked for.

    Corners that turn more than 90° keep their arcs, and so do those whose neighbours do not meet, or would come too
    near to the contour where they do; None for one that turns one way, since outside of it they never do.
    """
    curves = loop.curves
    at = np.flatnonzero(loop.corner & (np.abs(curves.sweep_rad) <= SHARPEST_RAD))
    if not len(at) or len(curves) < 4:
        return curves
    at = at[_is_between(loop, at)]
    met = met_near(curves, at - 1, (at + 1) % len(curves), places(curves, at, np.full(len(at), 0.5)))
    is_met = _meet_well(curves, at, met, by_um, MENDED_UM if corners == "round" else np.inf)
    if contour is not None and is_met.any():
        is_met[is_met] = _is_clear(curves, at[is_met], met.take(is_met), by_um, contour)
    made = _lengthened(curves, at[is_met], met.place_um[is_met])
    return made.picked(np.delete(np.arange(len(curves)), at[is_met]))


def _is_between(loop: OffsetLoop, at: Ints) -> Bools:
    """Whether arcs (k,) lie whole between the curves that meet at their corners, and nothing cuts them short."""
    before, behind = at - 1, (at + 1) % len(loop.curves)
    leaving, arriving = directions(loop.curves)
    bends = [
        np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        for a, b in ((arriving[before], leaving[at]), (arriving[at], leaving[behind]))
    ]
    between: Bools = ~loop.corner[before] & ~loop.corner[behind] & (np.maximum(*bends) <= _TANGENT_SINE)
    return between


def _meet_well(curves: Curves, at: Ints, met: Met, by_um: float, most_um: float) -> Bools:
    """Whether the neighbours of arcs (k,) meet before the corner, no farther than `most_um` beyond the arc."""
    half = 0.5 * np.abs(curves.sweep_rad[at])
    longest = _FARTHEST * by_um * np.tan(half) + _ROUNDING_UM
    before, behind = at - 1, (at + 1) % len(curves)
    well = np.hypot(*(met.place_um - curves.center_um[at]).T) - by_um <= most_um
    for row, by in ((before, met.on_um), (behind, met.before_um)):
        bends = np.where(curves.is_arc[row], by / curves.radius_um[row], 0.0)
        well &= (by >= -_ROUNDING_UM) & (by <= longest) & (bends < 0.5 * np.pi)
    return np.asarray(well)


def _is_clear(curves: Curves, at: Ints, met: Met, by_um: float, contour: Curves) -> Bools:
    """Whether what is added to the neighbours of arcs (k,) keeps the offset from the contour all along."""
    before, behind = at - 1, (at + 1) % len(curves)
    added = [
        curves_between(start, end, curves.center_um[row], _swept(curves, row, by))
        for start, end, row, by in (
            (curves.end_um[before], met.place_um, before, met.on_um),
            (met.place_um, curves.start_um[behind], behind, met.before_um),
        )
    ]
    clear = clearance_um(contour, joined(added), by_um) >= by_um - MENDED_UM
    both: Bools = clear[: len(at)] & clear[len(at) :]
    return both


def _swept(curves: Curves, row: Ints, by_um: Floats) -> Floats:
    """Sweeps (k,) of arcs as long as `by_um`, on the circles of rows; 0 on lines."""
    radius = np.where(curves.is_arc[row], curves.radius_um[row], 1.0)
    return by_um / radius * np.sign(curves.sweep_rad[row])


def _lengthened(curves: Curves, at: Ints, place_um: Floats) -> Curves:
    start, end = curves.start_um.copy(), curves.end_um.copy()
    end[at - 1], start[(at + 1) % len(curves)] = place_um, place_um
    return with_ends(curves, start, end)
