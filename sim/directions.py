"""Directions of travel along blocks, as unit vectors."""

from typing import NamedTuple

import numpy as np

from parser.toolpath import Floats, Ints, Toolpath


class Directions(NamedTuple):
    """Directions (n, 2) at the start and at the end of each block; (0, 0) for a block of length 0."""

    leaving: Floats
    arriving: Floats


def directions(toolpath: Toolpath) -> Directions:
    """Directions of all blocks."""
    chord, sense = _chords(toolpath.end_um - toolpath.start_um), np.sign(toolpath.sweep_rad)

    def tangent(angle: Floats) -> Floats:
        return np.stack([-np.sin(angle), np.cos(angle)], axis=1) * sense[:, None]

    arc = toolpath.is_arc[:, None]
    return Directions(
        np.where(arc, tangent(toolpath.start_angle_rad), chord), np.where(arc, tangent(toolpath.end_angle_rad), chord)
    )


def tangents_at(toolpath: Toolpath, rows: Ints, place_um: Floats) -> Floats:
    """Directions (m, 2) of the blocks `rows` where they pass a place (2,) that lies on them."""
    radial = _chords(place_um - toolpath.center_um[rows])
    tangent = np.stack([-radial[:, 1], radial[:, 0]], axis=1) * np.sign(toolpath.sweep_rad[rows])[:, None]
    chord = _chords(toolpath.end_um[rows] - toolpath.start_um[rows])
    return np.where(toolpath.is_arc[rows][:, None], tangent, chord)


def _chords(by_um: Floats) -> Floats:
    length = np.hypot(by_um[:, 0], by_um[:, 1])
    return by_um / np.where(length > 0.0, length, 1.0)[:, None]
