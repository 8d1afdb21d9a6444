"""How far curves lie from a contour, all along: in closed form, without samples."""

import numpy as np

from parser.geometry.broad_phase_places import near_curves
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.geometry.feet import feet

_FEW = 4096  # pairs
_FAR = 1e6  # times the way between two centres: from there, the far side of an arc is the near one


def clearance_um(contour: Curves, curves: Curves, within_um: float) -> Floats:
    """(m,) µm least distance of curves from those of a contour that they do not cross; ∞ for some that lie farther.

    Two curves that do not cross are nearest at an end of one of them, or on a line through the centre of one and across
    the other, or through the centres of both.
    """
    one, other = _pairs(contour, curves, within_um)
    away = np.minimum.reduce(
        [
            _away(contour, other, curves.start_um[one]),
            _away(contour, other, curves.end_um[one]),
            _away(curves, one, contour.start_um[other]),
            _away(curves, one, contour.end_um[other]),
        ]
    )
    arc = np.flatnonzero(contour.is_arc[other])
    away[arc] = np.minimum(away[arc], _across(contour, other[arc], curves, one[arc]))
    arc = np.flatnonzero(curves.is_arc[one])
    away[arc] = np.minimum(away[arc], _across(curves, one[arc], contour, other[arc]))
    result = np.full(len(curves), np.inf)
    np.minimum.at(result, one, away)
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
