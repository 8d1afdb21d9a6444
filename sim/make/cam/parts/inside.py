"""Whether places lie within a closed contour of lines and arcs."""

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats


def is_inside(contour: Curves, place_um: Floats) -> Bools:
    """(m,) whether places (m, 2) lie within a closed contour: it turns once about those that do.

    The angle that a line or an arc turns about a place is that of its chord, and a full turn where the place lies
    between arc and chord.
    """
    start = contour.start_um[None] - place_um[:, None]
    end = contour.end_um[None] - place_um[:, None]
    cross = start[..., 0] * end[..., 1] - start[..., 1] * end[..., 0]
    turned = np.arctan2(cross, (start * end).sum(axis=2)).sum(axis=1)
    arc = np.flatnonzero(contour.is_arc)
    if len(arc):
        turned += 2.0 * np.pi * _in_segment(contour.picked(arc), place_um).sum(axis=1)
    inside: Bools = np.abs(turned) > np.pi
    return inside


def _in_segment(arcs: Curves, place_um: Floats) -> Floats:
    """(m, k) signed: 1 where a place lies between the chord of an arc and the arc, −1 where that runs clockwise."""
    out = place_um[:, None] - arcs.center_um[None]
    is_near = np.hypot(out[..., 0], out[..., 1]) < arcs.radius_um
    chord = arcs.end_um - arcs.start_um
    off = place_um[:, None] - arcs.start_um[None]
    left = chord[None, :, 0] * off[..., 1] - chord[None, :, 1] * off[..., 0]
    sign = np.sign(arcs.sweep_rad)
    is_full = np.hypot(chord[:, 0], chord[:, 1]) < 1e-6
    beyond = np.where(is_full[None], True, left * sign[None] < 0.0)
    return np.where(is_near & beyond, sign[None], 0.0)
