"""How far places lie from lines and arcs, ends included.

Feet of places on lines and arcs.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints


class Feet(NamedTuple):
    """The nearest places (m, 2) of curves to other places, and the angle (m,) of their radii, rad; 0 on lines.

    Along one arc the angle runs on as its sweep does, without a jump of a turn.
    """

    place_um: Floats
    angle_rad: Floats


def angles(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Angles (m,) of the radii at `fraction` (m,) of the curves' length, rad; 0 on lines."""
    return np.where(curves.is_arc[row], curves.start_angle_rad[row] + fraction * curves.sweep_rad[row], 0.0)


def feet(curves: Curves, row: Ints, place_um: Floats) -> Feet:
    """Feet of places (m, 2) on the curves `row` (m,), ends included."""
    foot, angle = np.empty_like(place_um), np.zeros(len(row))
    arc = curves.is_arc[row]
    line, on_arc = np.flatnonzero(~arc), np.flatnonzero(arc)
    foot[line] = _on_lines(curves, row[line], place_um[line])
    angle[on_arc] = _on_arcs(curves, row[on_arc], place_um[on_arc])
    foot[on_arc] = _on_circle(curves, row[on_arc], angle[on_arc])
    return Feet(foot, angle)


def _on_circle(curves: Curves, row: Ints, angle: Floats) -> Floats:
    out = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    place: Floats = curves.center_um[row] + curves.radius_um[row][:, None] * out
    return place


def _on_lines(curves: Curves, row: Ints, place: Floats) -> Floats:
    start = curves.start_um.take(row, axis=0)
    by = curves.end_um.take(row, axis=0) - start
    square = _dot(by, by)
    share = _dot(place - start, by) / np.where(square > 0.0, square, 1.0)
    foot: Floats = start + np.clip(share, 0.0, 1.0)[:, None] * by
    return foot


def _dot(this: Floats, other: Floats) -> Floats:
    dot: Floats = this[:, 0] * other[:, 0] + this[:, 1] * other[:, 1]
    return dot


def _on_arcs(curves: Curves, row: Ints, place: Floats) -> Floats:
    """Angles of the feet on arcs; outside the sweep that of the nearer end."""
    out = place - curves.center_um[row]
    sweep, start = curves.sweep_rad[row], curves.start_angle_rad[row]
    reach = np.abs(sweep)
    turned = np.mod((np.arctan2(out[:, 1], out[:, 0]) - start) * np.sign(sweep), 2.0 * np.pi)
    nearer_end = np.where(turned - reach < 2.0 * np.pi - turned, reach, 0.0)
    angle: Floats = start + np.sign(sweep) * np.where(turned > reach, nearer_end, turned)
    return angle


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
