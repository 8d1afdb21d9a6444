"""Directions of travel at the two ends of each block."""

import numpy as np

from parser.toolpath import Floats, Toolpath


def directions(toolpath: Toolpath) -> tuple[Floats, Floats]:
    """Unit vectors (n, 2) along the path at the start and at the end of each block; (0, 0) for a block of length 0."""
    by = toolpath.end_um - toolpath.start_um
    chord = np.hypot(by[:, 0], by[:, 1])
    line = by / np.where(chord > 0.0, chord, 1.0)[:, None]
    sense = np.sign(toolpath.sweep_rad)

    def tangent(angle: Floats) -> Floats:
        return np.stack([-np.sin(angle), np.cos(angle)], axis=1) * sense[:, None]

    arc = toolpath.is_arc[:, None]
    return (
        np.where(arc, tangent(toolpath.start_angle_rad), line),
        np.where(arc, tangent(toolpath.end_angle_rad), line),
    )
