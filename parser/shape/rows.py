"""Rows of a toolpath by the contour that they belong to."""

import numpy as np

from parser.geometry.curves import Ints
from parser.toolpath import Toolpath


def contour_rows(toolpath: Toolpath) -> Ints:
    """Contour number (n,) of each row, from 0 in the order they are cut; −1 on jumps, which part the contours."""
    jump = toolpath.is_jump
    begins = ~jump
    begins[1:] &= jump[:-1]
    return np.where(jump, -1, np.cumsum(begins, dtype=np.int64) - 1)
