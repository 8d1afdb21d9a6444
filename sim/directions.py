"""Directions of travel along blocks, as unit vectors; (0, 0) along a block of length 0."""

from typing import NamedTuple

import numpy as np

from parser.toolpath import Floats, Ints, Kind, Toolpath


class Directions(NamedTuple):
    """Directions (n, 2) at the start and at the end of each block."""

    leaving: Floats
    arriving: Floats


def directions(toolpath: Toolpath) -> Directions:
    """Directions at the ends of all n blocks."""
    rows = np.arange(len(toolpath))
    return Directions(*(headings(toolpath, rows, np.full(len(rows), share)) for share in (0.0, 1.0)))


def headings(toolpath: Toolpath, row: Ints, fraction: Floats) -> Floats:
    """Directions (m, 2) in the blocks `row` (m,) at `fraction` (m,) of their length, 0 at the start, 1 at the end."""
    return _headings(toolpath, row, toolpath.start_angle_rad[row] + fraction * toolpath.sweep_rad[row])


def headings_at(toolpath: Toolpath, row: Ints, place_um: Floats) -> Floats:
    """Directions (m, 2) of the blocks `row` (m,) where they pass a place (2,) that lies on them."""
    radial = place_um - toolpath.center_um[row]
    return _headings(toolpath, row, np.arctan2(radial[:, 1], radial[:, 0]))


def _headings(toolpath: Toolpath, row: Ints, angle_rad: Floats) -> Floats:
    """Directions of lines along their chord, of arcs across the radius at an angle from the centre."""
    by = toolpath.end_um[row] - toolpath.start_um[row]
    length = np.hypot(by[:, 0], by[:, 1])[:, None]
    tangent = np.stack([-np.sin(angle_rad), np.cos(angle_rad)], axis=1) * np.sign(toolpath.sweep_rad[row])[:, None]
    return np.where((toolpath.kind[row] == Kind.ARC)[:, None], tangent, by / np.where(length > 0.0, length, 1.0))
