"""Circles through many places, of many arcs at once."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints

_ROUNDS = 4  # of Gauss and Newton; each squares the error, which begins at some µm in mm


class Fits(NamedTuple):
    """Circles (k,) with centres (k, 2), and how far the places reach inside and outside of them together, all µm."""

    center_um: Floats
    radius_um: Floats
    form_um: Floats


def fitted_circles(place_um: Floats, of: Ints, center_um: Floats) -> Fits:
    """Circles that lie nearest to the places (m, 2) of each arc, by the sum of squares of the distances.

    `of` (m,) tells which of the k arcs a place is of, never falling and each occurring; `center_um` (k, 2) is near the
    centres. Gauss-Newton on the distances from the circle: r ≈ R + x cos φ + y sin φ.
    """
    first, center = np.flatnonzero(np.diff(of, prepend=-1)), center_um
    for _ in range(_ROUNDS):
        out = place_um - center[of]
        distance = np.hypot(out[:, 0], out[:, 1])
        columns = np.column_stack([np.ones(len(of)), out / distance[:, None]])
        normal = np.add.reduceat(columns[:, :, None] * columns[:, None, :], first, axis=0)
        right = np.add.reduceat(columns * distance[:, None], first, axis=0)
        solved = np.linalg.solve(normal, right[:, :, None])[:, :, 0]
        center = center + solved[:, 1:]
    distance = np.hypot(*(place_um - center[of]).T)
    form = np.maximum.reduceat(distance, first) - np.minimum.reduceat(distance, first)
    return Fits(center, np.add.reduceat(distance, first) / np.diff(first, append=len(of)), form)
