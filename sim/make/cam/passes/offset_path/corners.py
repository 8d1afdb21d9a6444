"""Outside corners: the curves beside them lengthened to where they meet, in place of an arc about the corner.

Where a contour is made of fitted arcs, nearly each joint is a corner of some hundredths of a degree. The arcs about
these are shorter than what a controller counts in whole µm: there the neighbours meet, whatever is asked for.

How far curves lie from a contour, all along: in closed form, without samples.
"""

import numpy as np

from controller.offset.joints import SHARPEST_RAD
from controller.offset.reach import OffsetLoop
from parser.geometry.along import directions, places
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import distance_to_curves, feet
from parser.geometry.near import near_curves
from sim.make.cam.passes.offset_path.convex import Met, met_near, with_ends
from sim.setup.making import Corners

_FEW = 4096  # pairs
_FAR = 1e6  # times the way between two centres: from there, the far side of an arc is the near one


def clearance_um(contour: Curves, curves: Curves, within_um: float) -> Floats:
    """(m,) µm least distance of curves from those of a contour that they do not cross; ∞ for some that lie farther.

    Two curves that do not cross are nearest at an end of one of them, or on a line through the centre of one and across
    the other, or through the centres of both.
    """
    this, other = _pairs(contour, curves, within_um)
    away = np.minimum.reduce(
        [
            _away(contour, other, curves.start_um[this]),
            _away(contour, other, curves.end_um[this]),
            _away(curves, this, contour.start_um[other]),
            _away(curves, this, contour.end_um[other]),
        ]
    )
    arc = np.flatnonzero(contour.is_arc[other])
    away[arc] = np.minimum(away[arc], _across(contour, other[arc], curves, this[arc]))
    arc = np.flatnonzero(curves.is_arc[this])
    away[arc] = np.minimum(away[arc], _across(curves, this[arc], contour, other[arc]))
    result = np.full(len(curves), np.inf)
    np.minimum.at(result, this, away)
    return result


def _pairs(contour: Curves, curves: Curves, within_um: float) -> tuple[Ints, Ints]:
    """Rows of curves and rows of the contour that may be near each other: of small ones all, which is faster."""
    if len(contour) * len(curves) <= _FEW:
        return np.repeat(np.arange(len(curves)), len(contour)), np.tile(np.arange(len(contour)), len(curves))
    near = near_curves(contour, curves, within_um)
    return near.other, near.row


def _across(arcs: Curves, arc: Ints, curves: Curves, row: Ints) -> Floats:
    """Distances (k,) of arcs from those places of the rows `row` that are nearest to their centres, and farthest."""
    center = arcs.center_um[arc]
    away = _away(arcs, arc, feet(curves, row, center).place_um)
    both = np.flatnonzero(curves.is_arc[row])
    own = curves.center_um[row[both]]
    far = feet(curves, row[both], own + _FAR * (own - center[both])).place_um
    away[both] = np.minimum(away[both], _away(arcs, arc[both], far))
    return away


def _away(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    return distance_to_curves(curves, row, place_um[:, 0], place_um[:, 1])[0]


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
