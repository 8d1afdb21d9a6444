"""The kerf of a run: the region that the wire removed, and how wide it is beside each block."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Ints
from parser.shape.contours import Contour
from parser.shape.passes import find_passes, leads_of
from parser.toolpath import Toolpath
from sim.cut.kerf.edges import Edges, Range, edges_of, ranges
from sim.cut.kerf.swept import Swept, swept_along
from sim.cut.kerf.ways import WireWay, wire_ways
from sim.cut.regions import Region, cut_by_blocks, union_all
from sim.table.trace import Trace


class Kerf(NamedTuple):
    """What the wire removed, c contours and n blocks.

    Attributes
    ----------
    offset_um
        Half the width that the wire cuts: its radius plus the spark gap.
    swept
        What the wire swept on each contour, with its polygon `region_um`.
    leads
        (n,) blocks that cut along no edge: ways to a pass and away from it.
    pass_edge
        (n,) number of the edge that each block's pass runs over, from 0; −1 of leads and jumps.
    region_um
        All of it: a shapely polygon or multipolygon.
    area_mm2
        Its area.
    edges
        Both edges at stations along the blocks.
    left, right, width
        How far the kerf reaches from the ideal path, and both together, by block.
    """

    offset_um: float
    swept: tuple[Swept, ...]
    leads: Bools
    pass_edge: Ints
    region_um: Region
    area_mm2: float
    edges: Edges
    left: Range
    right: Range
    width: Range


def kerf_of(toolpath: Toolpath, trace: Trace, contours: Sequence[Contour], offset_um: float) -> Kerf:
    """Kerf of a run by where the wire really was, an offset above 0 to all sides of it.

    RegionError with the blocks of a contour whose kerf could not be worked out.
    """
    ways = wire_ways(trace, contours, offset_um)
    swept = tuple(_swept(toolpath, contour, way, offset_um) for contour, way in zip(contours, ways, strict=True))
    region = union_all(one.region_um for one in swept)
    edges = edges_of(toolpath, ~toolpath.is_jump, ways, offset_um)
    left, right = edges.left_um, edges.right_um
    passes = find_passes(toolpath)
    edge_of = np.array([*(one.edge for one in passes.passes), -1], dtype=np.int64)
    return Kerf(
        offset_um=offset_um,
        swept=swept,
        leads=leads_of(passes, toolpath),
        pass_edge=edge_of[passes.of_row],
        region_um=region,
        area_mm2=region.area * 1e-6,
        edges=edges,
        left=ranges(edges, left, len(toolpath)),
        right=ranges(edges, right, len(toolpath)),
        width=ranges(edges, left + right, len(toolpath)),
    )


def _swept(toolpath: Toolpath, contour: Contour, way: WireWay, offset_um: float) -> Swept:
    with cut_by_blocks(contour.first, contour.last):
        return swept_along(toolpath, way, offset_um)
