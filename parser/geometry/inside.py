"""Whether places lie within closed contours of lines and arcs: by the angle that a contour turns about them."""

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats

_FULL_RAD = 2.0 * np.pi


def is_inside(contour: Curves, place_um: Floats) -> Bools:
    """(m,) whether places (m, 2) lie within a closed contour: it turns once about those that do."""
    start = contour.start_um[None] - place_um[:, None]
    end = contour.end_um[None] - place_um[:, None]
    out = contour.center_um[None] - place_um[:, None]
    in_disc = np.hypot(out[..., 0], out[..., 1]) < contour.radius_um
    turned = turned_about(start, end, np.broadcast_to(contour.sweep_rad, in_disc.shape), in_disc).sum(axis=1)
    inside: Bools = np.abs(turned) > np.pi
    return inside


def turned_about(start: Floats, end: Floats, turn_rad: Floats, in_disc: Bools) -> Floats:
    """Signed angles (…) that lines and arcs from `start` to `end` (…, 2) turn about the origin.

    The angle is that of the chord, and a full turn more where the origin lies between chord and arc. `turn_rad` is 0 on
    lines; `in_disc` says where the origin is nearer to the centre of an arc than its radius.
    """
    cross = start[..., 0] * end[..., 1] - start[..., 1] * end[..., 0]
    chord = np.arctan2(cross, (start * end).sum(axis=-1))
    # On the chord itself, as in the middle of a half circle, the sign of a zero must not tell.
    chord = np.where((cross == 0.0) & in_disc, np.abs(chord) * np.sign(turn_rad), chord)
    beyond = (cross * turn_rad < 0.0) | (np.abs(turn_rad) >= _FULL_RAD)
    turned: Floats = chord + np.where(in_disc & beyond, _FULL_RAD * np.sign(turn_rad), 0.0)
    return turned
