"""Lines as data of an SVG path: whole and half units, by differences, so that they stay short."""

import numpy as np

from parser.geometry.curves import Floats


def path_data(line: Floats) -> str:
    """A line (n, 2), n ≥ 1, units of the picture with y down, rounded to half a unit; empty where it does not move."""
    placed = np.round(2.0 * line)
    moves = np.concatenate([[True], (np.diff(placed, axis=0) != 0.0).any(axis=1)])
    corners = placed[moves]
    return f"M{_pair(corners[0])}l{' '.join(map(_pair, np.diff(corners, axis=0)))}" if len(corners) > 1 else ""


def _pair(place: Floats) -> str:
    return ",".join(f"{value / 2.0:g}" for value in place)
