"""Outside corners of the wire's way: round, sharp, or with a chamfer.

Where a contour is made of fitted arcs, nearly each joint is a corner of some hundredths of a degree. The arcs about
these are shorter than what a controller counts in whole µm: there the neighbours meet, whatever is asked for.
"""

import math

import numpy as np

from controller.offset.chain import lines_between
from controller.offset.joints import SHARPEST_RAD
from controller.offset.reach import OffsetLoop
from parser.geometry.along import directions, places, to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from sim.make.cam.convex import Met, clearance_um, met_near, with_ends
from sim.setup.making import Corners

MENDED_UM = 0.1
"""How far a mended joint may lie off the exact offset: a fifth of what whole µm take."""
_FARTHEST = 2.0  # times what lines are lengthened: arcs that bend away from each other meet later, or nowhere
_TANGENT_SINE = 1e-3
_ROUNDING_UM = 1e-3
_BLUNT_RAD = math.radians(20.0)  # corners that turn less are no place to form anything


def with_corners(loop: OffsetLoop, by_um: float, corners: Corners, contour: Curves | None) -> Curves:
    """Curves (m,) of a loop at an offset of a contour, with outside corners as they are asked for.

    ``sharp``: the neighbours of a corner run on to where they meet. ``chamfer``: they run on to a line across the
    corner that touches the arc about it, at corners that turn by 20° and more; others are sharp.

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
    at, met = at[is_met], met.take(is_met)
    is_formed = np.abs(curves.sweep_rad[at]) >= _BLUNT_RAD
    if corners == "chamfer" and is_formed.any():
        return _chamfered(curves, at, met, is_formed)
    return _lengthened(curves, at, met.place_um).picked(np.delete(np.arange(len(curves)), at))


def _chamfered(curves: Curves, at: Ints, met: Met, is_formed: Bools) -> Curves:
    """Curves whose arcs `at` (k,) are gone where their neighbours meet, or make room for a line that touches them."""
    corner = at[is_formed]
    middle = places(curves, corner, np.full(len(corner), 0.5))
    out = middle - curves.center_um[corner]
    # Half of a line that touches the middle of an arc is as long as half of the arc's tangents: R tan(sweep / 4).
    half = np.abs(np.tan(0.25 * curves.sweep_rad[corner]))[:, None] * to_left(out)
    ahead = np.sign(curves.sweep_rad[corner])[:, None]
    lines = lines_between(middle - ahead * half, middle + ahead * half)
    both = joined([curves, lines])
    line = len(curves) + np.arange(len(corner))
    early = met_near(both, corner - 1, line, lines.start_um).place_um
    late = met_near(both, line, (corner + 1) % len(curves), lines.end_um).place_um
    end, start = met.place_um.copy(), met.place_um.copy()
    end[is_formed], start[is_formed] = early, late
    others = np.delete(np.arange(len(curves)), at)
    made = joined([_ended(curves, at, end, start).picked(others), lines_between(early, late)])
    return made.picked(np.argsort(np.concatenate([others, corner]), kind="stable"))


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
    return _ended(curves, at, place_um, place_um)


def _ended(curves: Curves, at: Ints, end_um: Floats, start_um: Floats) -> Curves:
    """Curves whose neighbours of rows `at` (k,) end and start at places (k, 2)."""
    start, end = curves.start_um.copy(), curves.end_um.copy()
    end[at - 1], start[(at + 1) % len(curves)] = end_um, start_um
    return with_ends(curves, start, end)
