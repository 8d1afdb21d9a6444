"""Arcs through two places that lie near what runs between them: all those that do are one range of bends."""

from typing import NamedTuple

import numpy as np

from parser.drawing.fit.fitted import FLATTEST_UM
from parser.geometry.curves import Bools, Floats

_FULLEST = 3.7  # tan of half the sweep, 75°: what runs on an arc then still runs along its chord
_TINY_OF_TOLERANCE = 0.5
_FAR = -7.0  # half as long is looked at next


class Chords(NamedTuple):
    """Lines (n,) from place to place: the middle (n, 2), the unit vector along (n, 2), and half the length (n,)."""

    middle_um: Floats
    along: Floats
    half_um: Floats


class Bends(NamedTuple):
    """The arc of each row that lies best.

    Attributes
    ----------
    bend
        (r,) 1 / distance of its centre from the chord, to the left of it, in 1/µm; 0 for the chord itself.
    is_near
        (r,) whether it lies within the tolerance of all places.
    spare
        (r,) how much of the tolerance is left, of the whole, near enough: below 0 where it lies farther off.
    """

    bend: Floats
    is_near: Bools
    spare: Floats


def chords_between(start_um: Floats, end_um: Floats) -> Chords:
    """The chords between places (n, 2); along X where they are the same."""
    by = end_um - start_um
    length = np.hypot(by[:, 0], by[:, 1])
    along = np.where(length[:, None] > 0.0, by / np.where(length > 0.0, length, 1.0)[:, None], (1.0, 0.0))
    return Chords(0.5 * (start_um + end_um), along, 0.5 * length)


def bends_near(place_um: Floats, tolerance_um: Floats) -> Bends:
    """The best arc through the first and the last of places (r, m, 2), of those within a tolerance (r,) of all.

    In the frame of the chord, of half length a, with the centre at (0, h): the arc passes (x, y) within t where
    |x² + y² − a² − t² − 2hy| ≤ 2t√(a² + h²). Squared, and with v = 1/h, that is a range between the two roots of
    (S² − 4t²a²)v² − 4Syv + 4(y² − t²), with S = x² + y² − a² − t². The ranges of all places have one in common.
    """
    x, y, half = _in_frame(place_um)
    t, a = tolerance_um[:, None], half[:, None]
    power = x**2 + y**2 - a**2 - t**2
    bound = power**2 - 4.0 * t**2 * a**2
    free = bound <= 1e-9 * power**2
    bound = np.where(free, 1.0, bound)
    root = 2.0 * t * np.sqrt(np.maximum(bound + 4.0 * a**2 * y**2, 0.0)) / bound
    best = 2.0 * power * y / bound
    fullest = _FULLEST / np.maximum(half, 1e-300)
    low = np.maximum(np.where(free, -np.inf, best - root).max(axis=1), -fullest)
    high = np.minimum(np.where(free, np.inf, best + root).min(axis=1), fullest)
    bend = 0.5 * (low + high)
    flat = np.abs(bend) * FLATTEST_UM < 1.0
    bend = np.where(flat, 0.0, bend)
    ahead = (np.diff(x, axis=1, prepend=-a, append=a) > 0.0).all(axis=1) & (power < 0.0).all(axis=1)
    near = ahead & (low <= high) & (~flat | ((low <= 0.0) & (high >= 0.0)))
    common = np.where(flat, 2.0 * np.minimum(high, -low), high - low)
    spare = common / np.minimum(2.0 * np.where(free, np.inf, root).min(axis=1), 2.0 * fullest)
    return _with_tiny(place_um, tolerance_um, Bends(bend, near, np.where(ahead, np.maximum(spare, _FAR), _FAR)))


def _in_frame(place_um: Floats) -> tuple[Floats, Floats, Floats]:
    """Places but the ends as x and y (r, m − 2) from the middle of the chord and along it, and half its length (r,)."""
    chord = chords_between(place_um[:, 0], place_um[:, -1])
    out = place_um[:, 1:-1] - chord.middle_um[:, None]
    x = out[:, :, 0] * chord.along[:, None, 0] + out[:, :, 1] * chord.along[:, None, 1]
    y = out[:, :, 1] * chord.along[:, None, 0] - out[:, :, 0] * chord.along[:, None, 1]
    return x, y, chord.half_um


def _with_tiny(place_um: Floats, tolerance_um: Floats, bends: Bends) -> Bends:
    """What lies within half the tolerance of its start may be a line, whatever it does there."""
    out = place_um - place_um[:, :1]
    tiny = ~bends.is_near & (np.hypot(out[:, :, 0], out[:, :, 1]).max(axis=1) <= _TINY_OF_TOLERANCE * tolerance_um)
    return Bends(np.where(tiny, 0.0, bends.bend), bends.is_near | tiny, np.where(tiny, 0.5, bends.spare))
