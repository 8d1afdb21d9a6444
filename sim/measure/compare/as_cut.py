"""The edge of a part as it was cut: the outlines that the kerf left of it, with the blocks that cut them."""

from collections.abc import Iterator

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from parser.geometry.along import places
from parser.geometry.curves import Curves, Ints, curves_between, joined
from parser.toolpath import Toolpath
from sim.cut.pieces.pieces import Pieces
from sim.measure.compare.edge import Edge
from sim.measure.compare.nearest import indexed, nearest

_PART_LEFT, _PART_RIGHT = 1, -1
_SIMPLER_UM = 0.05
"""Outlines are as exact as 0.1 µm; with half the corners they are compared twice as fast."""
_LONGEST_UM = 100.0  # of a side: two blocks may make one straight edge


def edge_as_cut(toolpath: Toolpath, pieces: Pieces, reach_um: float) -> Edge | None:
    """Outlines of all parts, and of the openings that slugs leave in the frame; None where nothing came free.

    The wire cut `reach_um` past its centre. Each side belongs to the block that ran nearest to its middle.
    """
    rings = list(_rings(pieces))
    if not rings:
        return None
    curves = [_sides(ring) for ring, _ in rings]
    number = [len(one) for one in curves]
    edge = joined(curves)
    return Edge(
        curves=edge,
        block=_blocks(toolpath, edge),
        loop=np.repeat(np.arange(len(rings)), number),
        part_side=np.repeat([side for _, side in rings], number),
        reach_um=reach_um,
    )


def _rings(pieces: Pieces) -> Iterator[tuple[shapely.LinearRing, int]]:
    """Closed edges, counter-clockwise round material, and the side that the part lies on."""
    for piece in pieces.freed:
        if piece.kind == "part":
            polygon = orient(_simpler(piece.outline_um))
            yield from ((ring, _PART_LEFT) for ring in (polygon.exterior, *polygon.interiors))
    for opening in pieces.frame.openings_um:
        within = [piece.kind for piece in pieces.freed if opening.contains(piece.outline_um)]
        if within and "part" not in within:
            yield orient(_simpler(opening)).exterior, _PART_RIGHT


def _simpler(polygon: shapely.Polygon) -> shapely.Polygon:
    simpler: shapely.Polygon = shapely.segmentize(shapely.simplify(polygon, _SIMPLER_UM), _LONGEST_UM)
    return simpler


def _sides(ring: shapely.LinearRing) -> Curves:
    corner = np.asarray(ring.coords)[:, :2]
    none = np.full((len(corner) - 1, 2), np.nan)
    return curves_between(corner[:-1], corner[1:], none, np.zeros(len(corner) - 1))


def _blocks(toolpath: Toolpath, edge: Curves) -> Ints:
    """Block (n,) of the program that ran nearest to the middle of each side; jumps cut nothing."""
    cut = np.flatnonzero(~toolpath.is_jump)
    middle = places(edge, np.arange(len(edge)), np.full(len(edge), 0.5))
    row: Ints = cut[nearest(indexed(toolpath.picked(cut)), middle).row]
    return toolpath.source.block[row]
