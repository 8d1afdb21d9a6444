"""How far lines and arcs reach."""

import numpy as np

from parser.geometry.curves import Curves, Floats


def extents(curves: Curves) -> tuple[Floats, Floats]:
    """Lowest and highest places (n, 2) µm of each curve."""
    low = np.minimum(curves.start_um, curves.end_um)
    high = np.maximum(curves.start_um, curves.end_um)
    arc = np.flatnonzero(curves.is_arc)
    first = curves.start_angle_rad[arc] + np.minimum(curves.sweep_rad[arc], 0.0)
    reach = np.abs(curves.sweep_rad[arc])
    for quarter, (sign_x, sign_y) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        passed = np.mod(quarter * np.pi / 2.0 - first, 2.0 * np.pi) <= reach
        rows = arc[passed]
        extreme = curves.center_um[rows] + curves.radius_um[rows, None] * np.array([sign_x, sign_y])
        axis = int(sign_x == 0)
        low[rows, axis] = np.minimum(low[rows, axis], extreme[:, axis])
        high[rows, axis] = np.maximum(high[rows, axis], extreme[:, axis])
    return low, high
