"""Swings of an axis as they are stored: the courses of each, and what they put into its record."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.table.history import PEAKS, VALUES, Bins

SWINGS = 64
"""Swings that are stored of an axis: a power of two."""
COURSES = 32
"""Most courses of a swing that is stored, with the rest at its end."""
FIELDS = 5
"""Of a stored course: way, velocity, lag, speed of the motor, force."""


class Swings(NamedTuple):
    """Swings of one axis, n of them: what a step from rest did until the slide rested again.

    Attributes
    ----------
    lag_um, step_um
        (n,), lag at which the slide stood, NaN where none is stored, and the step.
    lasts_s, reach_um
        (n,), time until the slide rests, and the most that it was away from where it stood.
    courses
        (n,), how many courses each has; the rest at its end is stored behind them.
    begins_s, fields, holds
        (n * COURSES,), (n * COURSES * FIELDS,), (n * COURSES * 3,), of each course: when it began, its numbers, and
        side, grip and way.
    bins
        Lowest, highest and integral of each of the values of a bin, as of n bins; the following error without what was
        lost.
    peaks, peak_s, peak_way_um
        (n * PEAKS,), of each: highest force, speed and lag, and the time and the way of each since it began.
    """

    lag_um: Floats
    step_um: Floats
    lasts_s: Floats
    reach_um: Floats
    courses: Ints
    begins_s: Floats
    fields: Floats
    holds: Ints
    bins: Bins
    peaks: Floats
    peak_s: Floats
    peak_way_um: Floats


def no_swings() -> Swings:
    """Room for swings, none of them stored."""
    low, high, area = (np.zeros(SWINGS * VALUES) for _ in range(3))
    step, lasts, reach = (np.zeros(SWINGS) for _ in range(3))
    peaks, peak_s, peak_way = (np.zeros(SWINGS * PEAKS) for _ in range(3))
    return Swings(
        lag_um=np.full(SWINGS, np.nan),
        step_um=step,
        lasts_s=lasts,
        reach_um=reach,
        courses=np.zeros(SWINGS, dtype=np.int64),
        begins_s=np.zeros(SWINGS * COURSES),
        fields=np.zeros(SWINGS * COURSES * FIELDS),
        holds=np.zeros(SWINGS * COURSES * 3, dtype=np.int64),
        bins=Bins(np.zeros(SWINGS + 1), low, high, area),
        peaks=peaks,
        peak_s=peak_s,
        peak_way_um=peak_way,
    )
