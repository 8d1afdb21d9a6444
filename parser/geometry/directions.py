"""Directions of travel along blocks, as unit vectors; (0, 0) along a block of length 0."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints

_BACK_RAD = np.radians(0.2)  # besides what whole µm leave open of the angle of a block
_SAME_CENTER_UM = 5.0  # of two arcs along one circle: centres in whole µm, from ends that are some µm off


class Directions(NamedTuple):
    """Directions (n, 2) at the start and at the end of each block."""

    leaving: Floats
    arriving: Floats


def directions(curves: Curves) -> Directions:
    """Directions at the ends of all n blocks."""
    leaving = _along_chords(curves.end_um - curves.start_um)
    arriving = leaving.copy()
    arc = np.flatnonzero(curves.is_arc)
    leaving[arc] = _across_radii(curves, arc, curves.start_angle_rad[arc])
    arriving[arc] = _across_radii(curves, arc, curves.start_angle_rad[arc] + curves.sweep_rad[arc])
    return Directions(leaving, arriving)


def runs_back_over(curves: Curves, this: Ints, other: Ints) -> Bools:
    """(k,) whether rows `other` run back over the rows `one`: the opposite way along the same line or circle."""
    way, length = directions(curves), np.maximum(curves.length_um, 1.0)
    arriving, leaving = way.arriving[this], way.leaving[other]
    cross = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    angle = np.pi - np.abs(np.arctan2(cross, (arriving * leaving).sum(axis=1)))
    arcs, lines = curves.is_arc[this] & curves.is_arc[other], ~curves.is_arc[this] & ~curves.is_arc[other]
    off = np.hypot(*(np.nan_to_num(curves.center_um[other]) - np.nan_to_num(curves.center_um[this])).T)
    opposite: Bools = (lines | (arcs & (off <= _SAME_CENTER_UM))) & (
        angle <= _BACK_RAD + 1.0 / length[this] + 1.0 / length[other]
    )
    return opposite


def headings(curves: Curves, row: Ints, fraction: Floats) -> Floats:
    """Directions (m, 2) in the blocks `row` (m,) at `fraction` (m,) of their length, 0 at the start, 1 at the end."""
    heading, arc = _along_lines(curves, row)
    on = row[arc]
    heading[arc] = _across_radii(curves, on, curves.start_angle_rad[on] + fraction[arc] * curves.sweep_rad[on])
    return heading


def headings_at(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    """Directions (m, 2) of the blocks `row` (m,) where they pass places (m, 2) that lie on them."""
    heading, arc = _along_lines(curves, row)
    on = row[arc]
    radial = place_um[arc] - curves.center_um[on]
    heading[arc] = _across_radii(curves, on, np.arctan2(radial[:, 1], radial[:, 0]))
    return heading


def to_left(way: Floats) -> Floats:
    """Ways (k, 2) a quarter turn to the left of others, as long as they are."""
    return np.stack([-way[:, 1], way[:, 0]], axis=1)


def _along_lines(curves: Curves, row: Ints) -> tuple[Floats, Ints]:
    """Directions (m, 2) along the chords of rows (m,), and which of these are arcs, which run across their radii."""
    by = curves.end_um.take(row, axis=0) - curves.start_um.take(row, axis=0)
    return _along_chords(by), np.flatnonzero(curves.is_arc[row])


def _along_chords(by_um: Floats) -> Floats:
    """Directions (m, 2) along ways (m, 2)."""
    length = np.hypot(by_um[:, 0], by_um[:, 1])
    heading: Floats = by_um / np.where(length > 0.0, length, 1.0)[:, None]
    return heading


def _across_radii(curves: Curves, arc: Ints, angle_rad: Floats) -> Floats:
    """Directions (m, 2) in which the arcs `arc` (m,) pass places at angles (m,) from their centres."""
    turn = np.sign(curves.sweep_rad[arc])
    return np.stack([-np.sin(angle_rad) * turn, np.cos(angle_rad) * turn], axis=1)
