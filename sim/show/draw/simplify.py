"""Fewer points for the same line: a trace has one for each pulse, a picture only so many pixels."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats

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
    x, y = np.ascontiguousarray(points.T)
    keep = np.ones(len(points), dtype=np.bool_)
    size = 2
    while size < len(points):
        flat = _distance(_stretches(x, size), _stretches(y, size)).max(axis=0) <= tolerance / 3
        keep[: size * len(flat)].reshape(-1, size)[flat, 1:] = False
        size *= 2
    return points[keep]


def _thin(points: Floats, step: float) -> Floats:
    """Keep one point for each `step` of travel, and both ends."""
    travel = np.cumsum(np.hypot(*np.diff(points, axis=0).T))
    mark = np.floor(np.concatenate([[0.0], travel]) / step)
    keep = np.concatenate([[True], mark[1:] != mark[:-1]])
    keep[-1] = True
    return np.asarray(points[keep], dtype=np.float64)


class _Stretches(NamedTuple):
    """One coordinate of m stretches, from their first points on: to the last (m,), and to the inner ones (k, m)."""

    chord: Floats
    inner: Floats


def _stretches(values: Floats, size: int) -> _Stretches:
    """Stretches of `size` chords of a line (n,); what is left at its end makes none."""
    whole = (len(values) - 1) // size * size
    points = np.ascontiguousarray(values[:whole].reshape(-1, size).T)
    return _Stretches(values[size : whole + 1 : size] - points[0], points[1:] - points[0])


def _distance(x: _Stretches, y: _Stretches) -> Floats:
    """Distance (k, m) of each inner point from its chord."""
    square = np.maximum(x.chord**2 + y.chord**2, np.finfo(np.float64).tiny)
    share = np.clip((x.inner * x.chord + y.inner * y.chord) / square, 0.0, 1.0)
    return np.asarray(np.hypot(x.inner - share * x.chord, y.inner - share * y.chord), dtype=np.float64)
