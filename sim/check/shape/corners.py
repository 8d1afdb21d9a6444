"""Corners too tight for the wire: arcs of a radius that no path with the wire's offset can have."""

import numpy as np

from parser.geometry.curves import Ints
from parser.shape.passes import Passes
from parser.toolpath import Toolpath

ROUNDING_UM = 5.0
"""A small arc in whole µm, begun where the last block ended, is some µm off its radius."""


def tight_corners(toolpath: Toolpath, contour_of_row: Ints, passes: Passes, offset_um: float, is_drawing: bool) -> Ints:
    """Rows (k,) of arcs too small for the offset.

    Parameters
    ----------
    contour_of_row
        (n,) contour number of each row, −1 on jumps; see `parser.shape.contours`.
    passes
        Those of the toolpath.
    offset_um
        Of the wire's centre from the part: wire radius and spark gap.
    is_drawing
        Whether the path is the drawing's contour; else it is that of the wire's centre.

    Notes
    -----
    The wire's centre runs round an outer corner of the part with R + f, about a centre on the part's side: never less
    than f. On an inner corner it runs with R − f, which may be anything. On a drawing it is the other way round: an
    inner corner, its centre on the scrap's side, has to be R ≥ f. Without a lead-in the sides are not known, and a
    small arc may be either.
    """
    small = toolpath.is_arc & (contour_of_row >= 0) & (np.nan_to_num(toolpath.radius_um) < offset_um - ROUNDING_UM)
    row = np.flatnonzero(small)
    if not len(row):
        return row
    of = passes.of_row[row]
    side = np.array([pass_.part_side if pass_.number == 1 else 0 for pass_ in passes.passes] + [0])[
        of
    ]  # on leads the last
    center_side = np.sign(toolpath.sweep_rad[row])
    wrong_side = -side if is_drawing else side
    tight: Ints = row[(side != 0) & (center_side == wrong_side)]
    return tight
