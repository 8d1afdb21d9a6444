"""Fewer points for the same line: a trace has one for each pulse, a picture only so many pixels."""

from typing import Final

import numpy as np

from parser.geometry.curves import Floats, Ints

CHORD_PX: Final = 0.15
"""How far a drawn line may leave the true one."""


def simplify(points: Floats, tolerance: float) -> Floats:
    """Leave out points that nobody could see.

    Stretches of 2, 4, 8 … chords become one wherever it stays close to their points, so the cost is n log n with no
    loop over points.

    Parameters
    ----------
    points
        (n, 2) float64, n ≥ 1.
    tolerance
        The furthest the new line may be from any point, same unit as `points`.

    Returns
    -------
    (k, 2) float64, 1 ≤ k ≤ n, with the first and the last point.
    """
    points = _thin(points, tolerance * 2 / 3)
    keep = np.ones(len(points), dtype=np.bool_)
    size = 2
    while size < len(points):
        keep[_flat_interior(points, size, tolerance / 3)] = False
        size *= 2
    return points[keep]


def _thin(points: Floats, step: float) -> Floats:
    """Keep one point for each `step` of travel, and both ends."""
    travel = np.cumsum(np.hypot(*np.diff(points, axis=0).T))
    mark = np.floor(np.concatenate([[0.0], travel]) / step)
    keep = np.concatenate([[True], mark[1:] != mark[:-1]])
    keep[-1] = True
    return np.asarray(points[keep], dtype=np.float64)


def _flat_interior(points: Floats, size: int, tolerance: float) -> Ints:
    """Index the inner points of those stretches of `size` chords that are flat."""
    stretches = (len(points) - 1) // size
    index = np.arange(stretches)[:, None] * size + np.arange(size + 1)
    flat = (_distance(points[index]) <= tolerance).all(axis=1)
    return index[flat, 1:-1].ravel()


def _distance(stretch: Floats) -> Floats:
    """Distance of each inner point from the chord, (m, k + 1, 2) to (m, k − 1)."""
    first, chord = stretch[:, :1], stretch[:, -1:] - stretch[:, :1]
    offset = stretch[:, 1:-1] - first
    square = np.maximum((chord**2).sum(axis=2), np.finfo(np.float64).tiny)
    share = np.clip((offset * chord).sum(axis=2) / square, 0.0, 1.0)
    gap = offset - share[..., None] * chord
    return np.asarray(np.hypot(gap[..., 0], gap[..., 1]), dtype=np.float64)
