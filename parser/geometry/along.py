"""Places on lines and arcs, by the share of them or the length along them, and directions there."""

import numpy as np

from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import headings

_SAGITTA_UM = 0.05  # of the chords of an outline


def places(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Places (m, 2) on the curves of the rows `row` (m,), at fractions (m,) of their length."""
    start = curves.start_um.take(row, axis=0)
    place = start + fraction[:, None] * (curves.end_um.take(row, axis=0) - start)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    angle = curves.start_angle_rad[on] + fraction[arc] * curves.sweep_rad[on]
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    place[arc] = curves.center_um[on] + curves.radius_um[on][:, None] * way
    return place


def places_at(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    """Places (m, 2) on the curves of the rows `row`, a length (m,) behind their starts."""
    return places(curves, row, _share(curves, row, length_um))


def headings_along(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    """Directions (m, 2) of the curves of the rows `row`, a length (m,) behind their starts."""
    return headings(curves, row, _share(curves, row, length_um))


def _share(curves: Curves, row: Ints, length_um: Floats) -> Floats:
    whole = curves.length_um[row]
    return length_um / np.where(whole > 0.0, whole, 1.0)


def along_um(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Lengths (m,) µm from the starts of the curves of the rows `row` to the places on them nearest to (m, 2)."""
    out = place_um - np.where(curves.is_arc[row][:, None], curves.center_um[row], curves.start_um[row])
    by = curves.end_um[row] - curves.start_um[row]
    length = curves.length_um[row]
    result: Floats = np.clip((out * by).sum(axis=1) / np.where(length > 0.0, length, 1.0), 0.0, length)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    turned = (np.arctan2(out[arc, 1], out[arc, 0]) - curves.start_angle_rad[on]) * np.sign(curves.sweep_rad[on])
    turned, reach = np.mod(turned, 2.0 * np.pi), np.abs(curves.sweep_rad[on])
    # In the open sector the nearer end counts.
    turned = np.where(turned - reach >= np.pi - 0.5 * reach, 0.0, np.minimum(turned, reach))
    result[arc] = turned * curves.radius_um[on]
    return result


def outline(curves: Curves) -> Floats:
    """Places (m, 2) along a closed chain of curves, on arcs so many that their chords lie 0.05 µm off at most."""
    return corners(curves, _SAGITTA_UM)[0]


def corners(curves: Curves, sagitta_um: float) -> tuple[Floats, Ints]:
    """Places (m, 2) along curves from the start of each on, so that chords lie no farther off; and their rows (m,)."""
    radius = np.where(curves.is_arc, curves.radius_um, 1.0)
    step = np.sqrt(8.0 * sagitta_um / np.maximum(radius, sagitta_um))
    parts = np.maximum(np.ceil(np.abs(curves.sweep_rad) / step), 1.0).astype(np.int64)
    parts[curves.is_arc] = np.maximum(parts[curves.is_arc], 3)
    row = np.repeat(np.arange(len(curves)), parts)
    at = np.arange(len(row)) - (np.cumsum(parts) - parts)[row]
    return places(curves, row, at / parts[row]), row
