"""Statistics of measured places: quantiles of Student's t, columns that explain one another, a circle to begin with."""

import math
from statistics import NormalDist

import numpy as np

from parser.geometry.curves import Floats


def student(share: float, free: int) -> float:
    """Quantile of Student's t, by its expansion about the normal one (Abramowitz and Stegun 26.7.5)."""
    z = NormalDist().inv_cdf(share)
    first = (z**3 + z) / 4.0
    second = (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0
    third = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0
    return z + first / free + second / free**2 + third / free**3


def explained(columns: Floats) -> Floats:
    """(p,) the share of each column's sum of squares that the others explain, 0 to 1."""
    shares = np.zeros(columns.shape[1])
    for at in range(columns.shape[1]):
        others = np.delete(columns, at, axis=1)
        left = columns[:, at] - others @ np.linalg.lstsq(others, columns[:, at], rcond=None)[0]
        shares[at] = 1.0 - float((left**2).sum()) / max(float((columns[:, at] ** 2).sum()), 1e-30)
    return shares


def algebraic_circle(place_um: Floats) -> tuple[Floats, float]:
    """Centre (2,) and radius µm of the circle through places (n, 2), by least squares of x² + y² (I. Kåsa, 1976)."""
    middle = place_um.mean(axis=0)
    x, y = (place_um - middle).T
    columns = np.column_stack([x, y, np.ones(len(x))])
    a, b, c = np.linalg.lstsq(columns, x**2 + y**2, rcond=None)[0].tolist()
    return middle + 0.5 * np.array([a, b]), math.sqrt(max(c + 0.25 * (a * a + b * b), 0.0))
