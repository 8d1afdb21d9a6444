"""Feet: where on the path the deviation of a place is measured from."""

import numpy as np

from parser.geometry.along import along_um, places_at
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Toolpath

_BACK, _AHEAD = 50, 1
"""Blocks, before and after that of a sample, from which `sim.measure.deviation.across` may measure it."""


def feet_um(toolpath: Toolpath, row: Ints, place_um: Floats, away_um: Floats) -> Floats:
    """Feet (m, 2) of places (m, 2) that belong to the blocks `row` and lie (m,) from the path, on either side.

    Of the blocks that `sim.measure.deviation.across` looks at a foot lies on the one which is as far away as that.
    """
    tried = np.clip(row[:, None] + np.arange(_AHEAD, -_BACK - 1, -1), 0, len(toolpath) - 1)
    each = np.repeat(place_um, tried.shape[1], axis=0)
    x, y = np.ascontiguousarray(each[:, 0]), np.ascontiguousarray(each[:, 1])
    away, _ = distance_to_curves(toolpath, tried.ravel(), x, y)
    off = np.abs(away.reshape(tried.shape) - np.abs(away_um)[:, None])
    found = tried[np.arange(len(row)), np.argmin(off, axis=1)]
    return places_at(toolpath, found, along_um(toolpath, found, place_um))
