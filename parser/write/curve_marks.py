"""Curve marks of 4B: which arcs are convex on the part (docs/3b.md §6)."""

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Ints

_CONVEX, _CONCAVE = 1, 2


def curve_marks(curves: Curves) -> Ints:
    """(n,) 1 for convex arcs, 2 for concave ones, 0 elsewhere.

    A figure that is run counter-clockwise turns so along its convex arcs. Figures end where the wire goes on in the
    air; ways in and out along each other take no part in which way one runs.
    """
    figure = np.cumsum(curves.kind == CurveKind.JUMP)
    cross = curves.start_um[:, 0] * curves.end_um[:, 1] - curves.start_um[:, 1] * curves.end_um[:, 0]
    segment = np.where(curves.is_arc, curves.radius_um**2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    cut = curves.kind != CurveKind.JUMP
    area = 0.0 + np.bincount(figure[cut], (cross + segment)[cut], minlength=int(figure[-1]) + 1 if len(figure) else 0)
    area += _closing(curves, figure, len(area))
    convex = np.sign(curves.sweep_rad) == np.sign(area[figure])
    return np.where(curves.is_arc, np.where(convex, _CONVEX, _CONCAVE), 0).astype(np.int64)


def _closing(curves: Curves, figure: Ints, count: int) -> np.ndarray:
    """(count,) twice the area under the straight way from the end of each figure back to its start."""
    closing = np.zeros(count)
    for number in range(count):
        rows = np.flatnonzero((figure == number) & (curves.kind != CurveKind.JUMP))
        if len(rows):
            end, start = curves.end_um[rows[-1]], curves.start_um[rows[0]]
            closing[number] = end[0] * start[1] - end[1] * start[0]
    return closing
