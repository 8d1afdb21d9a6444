"""The edge of a part as it was cut: the outlines that the kerf left of it, with the blocks that cut them."""

from collections.abc import Iterator

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from parser.geometry.along import places
from parser.geometry.curves import Curves, Ints, curves_between, joined
from parser.toolpath import Toolpath
from sim.cut.kerf.last_beside import NOBODY
from sim.cut.kerf.makers import rows_that_made
from sim.cut.kerf.region import Kerf
from sim.cut.pieces.kept_shapes import kept_shapes
from sim.cut.pieces.pieces import Pieces
from sim.measure.compare.coarser import coarser
from sim.measure.compare.edge import Edge
from sim.measure.compare.nearest import indexed, nearest

_PART_LEFT, _PART_RIGHT = 1, -1
_SIMPLER_UM = 0.05
"""Outlines are as exact as 0.1 µm; with half the corners they are compared twice as fast (docs/compare.md)."""
_LONGEST_UM = 100.0  # of a side: two blocks may make one straight edge


def edge_as_cut(toolpath: Toolpath, kerf: Kerf, pieces: Pieces) -> Edge | None:
    """Outlines of all parts with their holes, and of the openings that slugs leave in the frame; None without any.

    Each side belongs to the block whose wire made it.
    """
    rings = list(_rings(pieces))
    if not rings:
        return None
    curves = [_sides(ring) for ring, _ in rings]
    number = [len(one) for one in curves]
    edge = joined(curves)
    return Edge(
        curves=edge,
        block=_blocks(toolpath, edge, kerf),
        loop=np.repeat(np.arange(len(rings)), number),
        part_side=np.repeat([side for _, side in rings], number),
        reach_um=kerf.offset_um,
    )


def _rings(pieces: Pieces) -> Iterator[tuple[shapely.LinearRing, int]]:
    """Outlines, counter-clockwise, and the side that the part lies on."""
    for shape in kept_shapes(pieces):
        outline = orient(shapely.Polygon(shape.outline_um.exterior)).exterior
        corners = coarser(np.asarray(outline.coords)[:, :2], _SIMPLER_UM)
        longest = shapely.segmentize(shapely.LinearRing(corners), _LONGEST_UM)
        yield longest, _PART_LEFT if shape.what == "part" else _PART_RIGHT


def _sides(ring: shapely.LinearRing) -> Curves:
    corner = np.asarray(ring.coords)[:, :2]
    none = np.full((len(corner) - 1, 2), np.nan)
    return curves_between(corner[:-1], corner[1:], none, np.zeros(len(corner) - 1))


def _blocks(toolpath: Toolpath, edge: Curves, kerf: Kerf) -> Ints:
    """Block (n,) of the program whose wire made the middle of each side.

    Of what no wire made, as the edge of the work, it is the one that ran nearest; jumps cut nothing.
    """
    middle = places(edge, np.arange(len(edge)), np.full(len(edge), 0.5))
    row = rows_that_made([one.way for one in kerf.swept], middle, kerf.offset_um)
    nobody = np.flatnonzero(row == NOBODY)
    cut = np.flatnonzero(~toolpath.is_jump)
    row[nobody] = cut[nearest(indexed(toolpath.picked(cut)), middle[nobody]).row]
    return toolpath.source.block[row]
