"""The edge of a part as it was cut: the outlines that the kerf left of it, with the blocks that cut them.

Closed outlines with fewer corners, each of those left out within a stated distance of the side that replaces it.

From a corner that stays, a side may run to a later one as long as it passes all corners between within that distance:
each of them leaves open a sector of directions, and the side has to run within them all (Z. Zhao and A. Saalfeld,
Linear-time sleeve-fitting polyline simplification algorithms, 1997).
"""

import math
from collections.abc import Iterator

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from controller.compiled.loops import compiled
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.toolpath import Toolpath
from sim.cut.kerf.last_beside import NOBODY
from sim.cut.kerf.swept import Kerf
from sim.cut.kerf.ways import rows_that_made
from sim.cut.pieces.kept_edges import kept_shapes
from sim.cut.pieces.pieces import Pieces
from sim.measure.compare.edge import Edge
from sim.measure.compare.nearest import indexed, nearest

_FULL_TURN_RAD = 2.0 * math.pi


@compiled("i8(f8[:,::1], i8, f8)")
def _farthest(corner_um: Floats, from_: int, within_um: float) -> int:
    """The last corner that a side from the corner `from_` may run to; corners go away from that one all the way."""
    x, y, reached = corner_um[from_, 0], corner_um[from_, 1], from_ + 1
    ahead, low, high, farthest_um = 0.0, -math.pi, math.pi, 0.0
    for at in range(from_ + 1, len(corner_um)):
        by_x, by_y = corner_um[at, 0] - x, corner_um[at, 1] - y
        away_um = math.hypot(by_x, by_y)
        if away_um < farthest_um:
            break
        if away_um > within_um:
            if farthest_um <= within_um:
                ahead = math.atan2(by_y, by_x)
            turned = (math.atan2(by_y, by_x) - ahead + math.pi) % _FULL_TURN_RAD - math.pi
            if not low <= turned <= high:
                break
            aside = math.asin(within_um / away_um)
            low, high = max(low, turned - aside), min(high, turned + aside)
        reached, farthest_um = at, away_um
    return reached


@compiled("i8(f8[:,::1], f8, i8[::1])")
def _stay(corner_um: Floats, within_um: float, kept_rows: Ints) -> int:
    """Fill in which corners stay, and give how many."""
    number, from_, last = 0, 0, len(corner_um) - 1
    while from_ < last:
        kept_rows[number], number = from_, number + 1
        from_ = _farthest(corner_um, from_, within_um)
    kept_rows[number] = last
    return number + 1


def coarser(corner_um: Floats, within_um: float) -> Floats:
    """The corners (k, 2) that stay of a chain of corners (m, 2), the first and the last among them."""
    corner = np.empty(len(corner_um), dtype=np.int64)
    number = _stay(np.ascontiguousarray(corner_um), within_um, corner)
    return corner_um[corner[:number]]


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
    number = [len(curve) for curve in curves]
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
    row = rows_that_made([each.way for each in kerf.swept], middle, kerf.offset_um)
    nobody = np.flatnonzero(row == NOBODY)
    cut = np.flatnonzero(~toolpath.is_jump)
    row[nobody] = cut[nearest(indexed(toolpath.picked(cut)), middle[nobody]).row]
    return toolpath.source.block[row]
