"""The deviation of places from the ideal path by whole arrays: what the compiled loops are held against."""

import numpy as np

from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Toolpath


def plain_deviation(toolpath: Toolpath, row: Ints, x_um: Floats, y_um: Floats) -> Floats:
    """Deviations (m,) µm of (m,) positions that belong to the blocks of `row`; past an end the neighbour counts too."""
    result, beyond = distance_to_curves(toolpath, row, x_um, y_um)
    past = np.flatnonzero(beyond)
    neighbour = np.clip(row[past] + beyond[past], 0, len(toolpath) - 1)
    result[past] = np.minimum(result[past], distance_to_curves(toolpath, neighbour, x_um[past], y_um[past])[0])
    return result
