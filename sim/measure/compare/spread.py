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


def spread(curves: Curves, number: int) -> Spread:
    """At least `number` places, at least two on each curve."""
    length = float(curves.length_um.sum())
    by_length = np.ceil(curves.length_um * (0.5 * number / length)) if length else 0.0
    stretches = np.maximum(np.maximum(by_length, np.ceil(np.abs(curves.sweep_rad) / _WIDEST_RAD)), 1.0)
    row = np.repeat(np.arange(len(curves)), stretches.astype(np.int64))
    at = np.arange(len(row)) - (np.cumsum(stretches) - stretches)[row]
    fraction = [(at + 0.5 + side * _GAUSS) / stretches[row] for side in (-1.0, 1.0)]
    weight = 0.5 * (curves.length_um / stretches)[row]
    both = np.concatenate([row, row])
    return Spread(places(curves, both, np.concatenate(fraction)), both, np.concatenate([weight, weight]))


def centroid(of: Spread) -> Floats:
    """Centre of gravity (2,) of the curves as wires."""
    weight = of.weight_um / of.weight_um.sum()
    middle: Floats = weight @ of.place_um
    return middle
