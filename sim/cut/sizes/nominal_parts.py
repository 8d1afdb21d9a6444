"""The parts that the ideal path would leave, as far as shapes that are kept tell of them."""

from collections.abc import Iterable

import numpy as np
import shapely

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from sim.cut.kerf.nominal import nominal_region
from sim.cut.pieces.frees import parted
from sim.cut.pieces.kept_edges import KeptEdges, KeptShape
from sim.cut.regions import Regions

_BESIDE = 2.0  # offsets from a shape to the border of its box: the kerf beside it, and what lies behind that


class NominalParts:
    """Parts, polygons `parts_um`, and the partners of shapes among them and their holes."""

    def __init__(self, parts_um: list[shapely.Polygon]) -> None:
        self.parts_um = parts_um
        holes = [shapely.Polygon(ring) for part in parts_um for ring in part.interiors]
        self._parts, self._holes = shapely.STRtree(parts_um), shapely.STRtree(holes)

    def partner(self, shape: KeptShape) -> shapely.Polygon | None:
        """Partner of a shape: of a part among the parts, of a hole or an opening the least among their holes."""
        tree = self._parts if shape.what == "part" else self._holes
        found = tree.geometries[tree.query(shape.outline_um.representative_point(), predicate="within")]
        return min(found.tolist(), key=lambda each: each.area, default=None)


def nominal_parts(
    toolpath: Toolpath,
    stock_um: shapely.Polygon,
    shapes: tuple[KeptShape, ...],
    kept_edges: KeptEdges,
    offset_um: float,
) -> NominalParts:
    """Parts that the ideal path leaves of a stock, true to shapes and to the nominal places of their kept edges.

    They are worked out in boxes round the shapes. What is closed in within its box is the same in all of the stock; if
    a partner is not, or is not found, all of the stock is cut.
    """
    boxes, cut = _boxes(shapes, kept_edges, _BESIDE * offset_um), ~toolpath.is_jump
    near = NominalParts(parted(stock_um, nominal_region(toolpath, cut, offset_um, boxes)))
    if _all_within(((near.partner(shape) for shape in shapes)), boxes):
        return near
    return NominalParts(parted(stock_um, nominal_region(toolpath, cut, offset_um)))


def _boxes(shapes: tuple[KeptShape, ...], kept_edges: KeptEdges, beside_um: float) -> Regions:
    """Boxes (s,) round shapes and what is kept of their edges."""
    bounds: Floats = shapely.bounds([shape.outline_um for shape in shapes])
    np.minimum.at(bounds[:, :2], kept_edges.shape, kept_edges.nominal_um)
    np.maximum.at(bounds[:, 2:], kept_edges.shape, kept_edges.nominal_um)
    low, high = bounds[:, :2] - beside_um, bounds[:, 2:] + beside_um
    boxes: Regions = np.asarray(shapely.box(*low.T, *high.T))
    return boxes


def _all_within(partners: Iterable[shapely.Polygon | None], boxes: Regions) -> bool:
    pairs = zip(partners, boxes.tolist(), strict=True)
    return all(each is not None and box.contains_properly(shapely.box(*each.bounds)) for each, box in pairs)
