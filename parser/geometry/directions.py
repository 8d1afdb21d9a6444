"""Directions of travel along blocks, as unit vectors; (0, 0) along a block of length 0."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats, Ints


class Directions(NamedTuple):
    """Directions (n, 2) at the start and at the end of each block."""

    leaving: Floats
    arriving: Floats


def directions(curves: Curves) -> Directions:
    """Directions at the ends of all n blocks."""
    rows = np.arange(len(curves))
    return Directions(*(headings(curves, rows, np.full(len(rows), share)) for share in (0.0, 1.0)))


def headings(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Directions (m, 2) in the blocks `row` (m,) at `fraction` (m,) of their length, 0 at the start, 1 at the end."""
    return _headings(curves, row, curves.start_angle_rad[row] + fraction * curves.sweep_rad[row])


def headings_at(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Directions (m, 2) of the blocks `row` (m,) where they pass places (m, 2) that lie on them."""
    radial = place_um - curves.center_um[row]
    return _headings(curves, row, np.arctan2(radial[:, 1], radial[:, 0]))


def to_left(way: Floats) -> Floats:
    """Ways (k, 2) a quarter turn to the left of others, as long as they are."""
    return np.stack([-way[:, 1], way[:, 0]], axis=1)


def _headings(curves: Curves, row: Ints, angle_rad: Floats) -> Floats:
    """Directions of lines along their chord, of arcs across the radius at an angle from the centre."""
    by = curves.end_um.take(row, axis=0) - curves.start_um.take(row, axis=0)
    length = np.hypot(by[:, 0], by[:, 1])
    heading: Floats = by / np.where(length > 0.0, length, 1.0)[:, None]
    arc = np.flatnonzero(curves.kind[row] == CurveKind.ARC)
    if len(arc):
        angle, turn = angle_rad[arc], np.sign(curves.sweep_rad[row[arc]])
        heading[arc] = np.stack([-np.sin(angle) * turn, np.cos(angle) * turn], axis=1)
    return heading
