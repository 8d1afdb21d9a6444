"""Sizes of measured features by least squares: circles, and pairs of parallel faces, with their uncertainties."""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.measure.statistics import algebraic_circle

LEAST_PLACES: Final = {"circle": 5, "width": 5}
"""Of a feature: one more than what is solved for, and one besides."""


class Size(NamedTuple):
    """A size as places tell it.

    Attributes
    ----------
    size_um, error_um
        With its standard error.
    form_um, noise_um
        How far the places lie off the form, from the highest to the lowest, and their standard deviation.
    free
        Degrees of freedom of that.
    """

    size_um: float
    error_um: float
    form_um: float
    noise_um: float
    free: int


def circle_size(place_um: Floats) -> Size:
    """The diameter of the circle through places (n, 2), of least squared distances (Gauss and Newton, from Kåsa's)."""
    center, radius = algebraic_circle(place_um)
    for _ in range(5):
        out = place_um - center
        away = np.hypot(out[:, 0], out[:, 1])
        columns = np.column_stack([out / away[:, None], np.ones(len(out))])
        step = np.linalg.lstsq(columns, away - radius, rcond=None)[0]
        center, radius = center + step[:2], radius + float(step[2])
    off = np.hypot(*(place_um - center).T) - radius
    noise, error, free = _error(columns, off, 2)
    return Size(2.0 * radius, 2.0 * error, float(np.ptp(off)), noise, free)


def width_size(place_um: Floats, across_rad: float) -> Size | None:
    """The distance of two parallel faces across a direction; None where either has fewer than two places."""
    across = place_um @ np.array([math.cos(across_rad), math.sin(across_rad)])
    along = place_um @ np.array([-math.sin(across_rad), math.cos(across_rad)])
    far = across > 0.5 * (across.min() + across.max())
    if min(int(far.sum()), int((~far).sum())) < 2:
        return None
    columns = np.column_stack([~far, far, along - along.mean()]).astype(np.float64)
    near_um, far_um, slope = np.linalg.lstsq(columns, across, rcond=None)[0].tolist()
    off = across - columns @ np.array([near_um, far_um, slope])
    tilt = math.hypot(1.0, slope)
    noise, error, free = _error(np.column_stack([columns[:, 0] + columns[:, 1], columns[:, 1], columns[:, 2]]), off, 1)
    form = max(float(np.ptp(off[side])) for side in (far, ~far)) / tilt
    return Size((far_um - near_um) / tilt, error / tilt, form, noise / tilt, free)


def _error(columns: Floats, off: Floats, at: int) -> tuple[float, float, int]:
    """The standard deviation of what is off, the standard error of what a column stands for, and degrees of freedom."""
    free = len(off) - columns.shape[1]
    noise = math.sqrt(float((off**2).sum()) / free)
    return noise, noise * math.sqrt(float(np.linalg.pinv(columns.T @ columns)[at, at])), free
