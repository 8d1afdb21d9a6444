"""Curve marks of 4B: which arcs are convex on the part (docs/3b.md §6)."""

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints

_CONVEX, _CONCAVE = 1, 2


def curve_marks(curves: Curves) -> Ints:
    """(n,) 1 for convex arcs, 2 for concave ones, 0 elsewhere.

    A figure that is run counter-clockwise turns so along its convex arcs. Figures end where the wire goes on in the
    air; ways in and out along each other take no part in which way one runs.
    """
    figure = np.cumsum(curves.kind == CurveKind.JUMP)
    segment = np.where(curves.is_arc, curves.radius_um**2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    cut = np.flatnonzero(curves.kind != CurveKind.JUMP)
    area = np.zeros(int(figure[-1]) + 1 if len(figure) else 0)
    np.add.at(area, figure[cut], (_under(curves.start_um, curves.end_um) + segment)[cut])
    number, first = np.unique(figure[cut], return_index=True)
    last = np.append(first[1:], len(cut)) - 1
    area[number] += _under(curves.end_um[cut[last]], curves.start_um[cut[first]])
    convex = np.sign(curves.sweep_rad) == np.sign(area[figure])
    return np.where(curves.is_arc, np.where(convex, _CONVEX, _CONCAVE), 0).astype(np.int64)


def _under(start_um: Floats, end_um: Floats) -> Floats:
    """(n,) twice the area between straight ways and the origin; round a figure they add up to that of the figure."""
    area: Floats = start_um[:, 0] * end_um[:, 1] - start_um[:, 1] * end_um[:, 0]
    return area
