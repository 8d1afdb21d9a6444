"""Places spread over curves, each with the length that it stands for."""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

_WIDEST_RAD = np.radians(10.0)
_GAUSS = 0.5 / np.sqrt(3.0)  # of a stretch, from its middle: two places that integrate cubics exactly


class Spread(NamedTuple):
    """Places (m, 2), the rows (m,) that they lie on and their weights (m,), lengths in µm."""

    place_um: Floats
    row: Ints
    weight_um: Floats


def spread(curves: Curves, number: int, most: int | None = None) -> Spread:
    """At least `number` places, at least two on each curve; where these are more than `most`, every so many of them."""
    length = float(curves.length_um.sum())
    by_length = np.ceil(curves.length_um * (0.5 * number / length)) if length else 0.0
    stretches = np.maximum(np.maximum(by_length, np.ceil(np.abs(curves.sweep_rad) / _WIDEST_RAD)), 1.0)
    rows = np.repeat(np.arange(len(curves)), stretches.astype(np.int64))
    every = max(2 * len(rows) // number, 1) if most is not None and 2 * len(rows) > most else 1
    # First of the two places on all stretches, then the second ones.
    second, stretch = np.divmod(np.arange(0, 2 * len(rows), every), len(rows))
    row = rows[stretch]
    at = stretch - (np.cumsum(stretches) - stretches)[row]
    fraction = (at + 0.5 + (2.0 * second - 1.0) * _GAUSS) / stretches[row]
    return Spread(places(curves, row, fraction), row, 0.5 * (curves.length_um / stretches)[row])


def centroid(of: Spread) -> Floats:
    """Centre of gravity (2,) of the curves as wires."""
    weight = of.weight_um / of.weight_um.sum()
    middle: Floats = weight @ of.place_um
    return middle
