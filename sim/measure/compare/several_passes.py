"""The edge that several passes over it leave: of all their kerfs, whatever each of them leaves, or does not reach."""

from collections.abc import Iterator, Sequence

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from parser.geometry.along import places
from parser.geometry.curves import Floats, curves_between, joined
from parser.geometry.directions import headings_at
from parser.geometry.feet import feet
from sim.cut.kerf.nominal import nominal_region
from sim.cut.regions import cut_by_blocks, union_all
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.rings import PathLoop, PathPass

_SLIT_UM = 0.005  # half of what rounding may leave open between shapes of a kerf that abut
_SIMPLER_UM = 0.01
_CRUMB_UM2 = 1000.0  # 30 µm square: cusps between kerfs, no part
_OF_PART = 0.75  # of an outline: half of a band that two passes leave between them lies on the side of the waste


def left_by_passes(passes: Sequence[PathPass], part_side: int, offset_um: float) -> list[PathLoop]:
    """Loops of the edge on the side of the part, +1 on the left of the first pass; none where they leave a gap.

    Each side of them belongs to the pass that cut nearest, of equal ones to the last. Arcs are polylines, right to
    0.02 µm. RegionError where the kerfs could not be joined.
    """
    with cut_by_blocks(*(int(end(one.block)) for end, one in ((np.min, passes[0]), (np.max, passes[-1])))):
        kerf = union_all([nominal_region(one.curves, np.ones(len(one.curves), np.bool_), offset_um) for one in passes])
    kerf = kerf.buffer(_SLIT_UM, join_style="mitre").buffer(-_SLIT_UM, join_style="mitre")
    latest = list(reversed(passes))
    cut = joined([one.curves for one in latest])
    block = np.concatenate([one.block for one in latest])
    side = part_side * np.repeat([one.sense for one in latest], [len(one.curves) for one in latest])
    index, loops = indexed(cut), []
    for corner, of_part in _outlines(kerf):
        none = np.full((len(corner) - 1, 2), np.nan)
        curves = curves_between(corner[:-1], corner[1:], none, np.zeros(len(corner) - 1))
        middle = places(curves, np.arange(len(curves)), np.full(len(curves), 0.5))
        row = nearest(index, middle).row
        foot = feet(cut, row, middle).place_um
        way, out = headings_at(cut, row, foot), middle - foot
        beside = np.sign(way[:, 0] * out[:, 1] - way[:, 1] * out[:, 0]) == side[row]
        if float(np.average(beside, weights=curves.length_um)) >= _OF_PART:
            loops.append(PathLoop(curves, block[row], of_part))
    return loops


def _outlines(kerf: shapely.Geometry) -> Iterator[tuple[Floats, int]]:
    """Corners (m, 2) of the outlines of a kerf, counter-clockwise, and the side on which it does not lie."""
    for polygon in shapely.get_parts(kerf).tolist():
        rings = [(polygon.exterior, -1), *((ring, 1) for ring in polygon.interiors)]
        for ring, free_side in rings:
            filled = orient(shapely.simplify(shapely.Polygon(ring), _SIMPLER_UM))
            if filled.area >= _CRUMB_UM2:
                yield np.asarray(filled.exterior.coords)[:, :2], free_side
