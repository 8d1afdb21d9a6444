"""How far places lie from lines and arcs, ends included."""

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints


def distance_to_curves(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    """Distances (m,) µm of positions from the curves of the rows `row`, and −1, 0, +1: before, on, past the curve."""
    result, beyond = np.empty(len(row)), np.empty(len(row), dtype=np.int64)
    arc = curves.kind[row] == CurveKind.ARC
    for which, measure in ((np.flatnonzero(~arc), _from_lines), (np.flatnonzero(arc), _from_arcs)):
        if len(which):
            result[which], beyond[which] = measure(curves, row[which], x[which], y[which])
    return result, beyond


def _from_lines(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    by_x = curves.end_um[:, 0][row] - curves.start_um[:, 0][row]
    by_y = curves.end_um[:, 1][row] - curves.start_um[:, 1][row]
    length = np.hypot(by_x, by_y)
    inverse = 1.0 / np.where(length > 0.0, length, 1.0)
    # A line without length has no direction: any will do.
    ux, uy = np.where(length > 0.0, by_x * inverse, 1.0), by_y * inverse
    dx, dy = x - curves.start_um[:, 0][row], y - curves.start_um[:, 1][row]
    along = dx * ux + dy * uy
    across = dx * uy - dy * ux
    excess = along - np.clip(along, 0.0, length)
    return np.hypot(across, excess), np.sign(excess).astype(np.int64)


def _from_arcs(curves: Curves, row: Ints, x: Floats, y: Floats) -> tuple[Floats, Ints]:
    dx, dy = x - curves.center_um[:, 0][row], y - curves.center_um[:, 1][row]
    sweep = curves.sweep_rad[row]
    reach = np.abs(sweep)
    turned = np.mod((np.arctan2(dy, dx) - curves.start_angle_rad[row]) * np.sign(sweep), 2.0 * np.pi)
    result = np.abs(np.hypot(dx, dy) - curves.radius_um[row])
    # Outside the sweep, the half of the open sector nearer the end is past it.
    open_ = turned > reach
    past_end = turned - reach < 2.0 * np.pi - turned
    beyond = np.where(open_, np.where(past_end, 1, -1), 0)
    end = np.where(past_end[:, None], curves.end_um[row], curves.start_um[row])
    return np.where(open_, np.hypot(x - end[:, 0], y - end[:, 1]), result), beyond
