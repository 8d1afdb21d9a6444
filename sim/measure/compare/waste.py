"""Waste between parts: what falls of the sheet where parts lie so near that their kerfs meet all round it.

Nothing in a program tells such a piece from a part. Its drawing does: no contour has it within, and all of its edge
lies a kerf from contours of others. A part that the drawing does not have lies farther off, somewhere at least.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np
import shapely

from sim.cut.pieces.pieces import Pieces

_SPARE_UM: Final = 10.0
"""What a cut may lie off where its kerf is held against a drawing; a corner of waste is rounded by less than a kerf."""


def with_waste(pieces: Pieces, drawn: Sequence[shapely.Polygon], kerf_um: float) -> Pieces:
    """The pieces with those as scrap that are waste between parts, by the contours of their drawing where they lie."""
    at = [index for index, piece in enumerate(pieces.freed) if piece.kind == "part"]
    if len(at) < 2 or not drawn:
        return pieces
    outlines = np.array([pieces.freed[index].outline_um for index in at], dtype=np.object_)
    shapes = np.array([shape for shape in drawn if not shape.is_empty], dtype=np.object_)
    inner, _ = shapely.STRtree(shapes).query(shapely.point_on_surface(outlines), predicate="within")
    around = np.bincount(inner, minlength=len(at))
    waste = [index for index, contours in zip(at, around.tolist(), strict=True) if not contours]
    if not waste or len(waste) == len(at):
        return pieces
    edges = shapely.union_all(shapely.boundary(shapes)).buffer(kerf_um + _SPARE_UM)
    freed = list(pieces.freed)
    for index in waste:
        if edges.covers(freed[index].outline_um.exterior):
            freed[index] = freed[index]._replace(kind="slug", is_scrap=True)
    return pieces._replace(freed=tuple(freed))
