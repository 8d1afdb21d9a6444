"""The edges that are kept, at stations along the blocks: where a block's wire made the outline of a shape that is kept.

They come from the region that the wire left. A pass whose edge another pass cut away has none there, and what stays of
it beside a tab has one. Of several on the same way it is the last.

What is kept of the work: the parts with their holes, and the openings that slugs leave in the frame.
"""

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Bools, Floats, Ints
from sim.cut.kerf.swept import Kerf
from sim.cut.kerf.ways import rows_that_made
from sim.cut.pieces.pieces import Pieces
from sim.cut.regions import strings_of


class KeptShape(NamedTuple):
    """A filled outline, and the index of the piece that it is, is in, or fell out of it: of several slugs the largest.

    A part itself still has its holes; each of them is a shape of its own besides. No piece fell out of an opening that
    the wire cleared.
    """

    what: Literal["part", "hole", "opening"]
    piece: int | None
    outline_um: shapely.Polygon


def kept_shapes(pieces: Pieces) -> tuple[KeptShape, ...]:
    """Shapes in the order of their pieces, each once, and cleared openings; a slug of a part left one of its holes."""
    shapes = [*_parts(pieces), *_openings(pieces)]
    cleared = (KeptShape("opening", None, opening) for opening in pieces.frame.cleared_um)
    return (*sorted(shapes, key=lambda shape: shape.piece or 0), *cleared)


def _parts(pieces: Pieces) -> Iterator[KeptShape]:
    for index, piece in enumerate(pieces.freed):
        if piece.kind == "part":
            yield KeptShape("part", index, piece.outline_um)
            yield from (KeptShape("hole", index, shapely.Polygon(ring)) for ring in piece.outline_um.interiors)


def _openings(pieces: Pieces) -> Iterator[KeptShape]:
    """Openings of the frame that slugs fell out of; round a part the frame is waste, and so is a scrap beside it."""
    openings, freed = pieces.frame.openings_um, pieces.freed
    slugs = [index for index, piece in enumerate(freed) if piece.kind == "slug" and not piece.is_scrap]
    inside = np.array([freed[index].outline_um.representative_point() for index in slugs], dtype=np.object_)
    parts = [shapely.Polygon(piece.outline_um.exterior) for piece in freed if piece.kind == "part"]
    _, in_part = shapely.STRtree(inside).query(np.array(parts, dtype=np.object_), predicate="contains")
    at, found = shapely.STRtree(inside).query(np.array(openings, dtype=np.object_), predicate="contains")
    within = ~np.isin(found, in_part)
    largest: dict[int, int] = {}
    for index, slug in sorted(zip(at[within].tolist(), found[within].tolist(), strict=True)):
        piece, other = slugs[slug], largest.get(index)
        if other is None or freed[piece].area_mm2 > freed[other].area_mm2:
            largest[index] = piece
    yield from (KeptShape("opening", piece, openings[index]) for index, piece in largest.items())


_ON_UM = 0.2  # a region is exact to 0.1 µm, and so is the edge of a block
_NONE = -1


class KeptEdges(NamedTuple):
    """Kept edges at k places, in the order of their blocks, those on the left of the path first.

    Attributes
    ----------
    station
        (k,) int64, indices of the stations, inner ones.
    row
        (k,) int64.
    side
        (k,) int64, +1 on the left of the path, −1 on the right.
    shape
        (k,) int64, index of the shape whose outline it is.
    cut_um, nominal_um
        (k, 2) float64, the edge as the wire left it, and as the ideal path would.
    """

    station: Ints
    row: Ints
    side: Ints
    shape: Ints
    cut_um: Floats
    nominal_um: Floats

    def picked(self, which: Bools | Ints | slice) -> "KeptEdges":
        """Some of them."""
        return KeptEdges(
            station=self.station[which],
            row=self.row[which],
            side=self.side[which],
            shape=self.shape[which],
            cut_um=self.cut_um[which],
            nominal_um=self.nominal_um[which],
        )


def kept_edges(kerf: Kerf, shapes: tuple[KeptShape, ...]) -> KeptEdges:
    """Edges of shapes that are kept."""
    edges = kerf.edges
    inner = np.flatnonzero(edges.inner & ~np.isnan(edges.left_um))
    station, side = np.tile(inner, 2), np.repeat(np.array([1, -1]), len(inner))
    out = side[:, None] * edges.left[station]
    offset_um = kerf.reach_um[edges.row[station]]
    reach = np.where(side > 0, edges.left_um[station], edges.right_um[station])
    cut, ideal = edges.place_um[station] + reach[:, None] * out, edges.place_um[station] + offset_um[:, None] * out
    shape = _rings_at([kept_shape.outline_um.exterior for kept_shape in shapes], cut)
    edges_of_part = KeptEdges(station, edges.row[station], side, shape, cut, ideal).picked(shape != _NONE)
    made = rows_that_made((each.way for each in kerf.swept), edges_of_part.cut_um, kerf.offset_um)
    edges_of_part = edges_of_part.picked(made == edges_of_part.row)
    return edges_of_part.picked(np.lexsort((edges_of_part.station, -edges_of_part.side, edges_of_part.row)))


def runs_of(*columns: Ints) -> Ints:
    """First indices of the runs in which none of some columns (k,) changes."""
    if not len(columns[0]):
        return np.empty(0, dtype=np.int64)
    changes = [np.diff(column) != 0 for column in columns]
    return np.append(0, np.flatnonzero(np.any(changes, axis=0)) + 1)


def lie_on(rings: list[shapely.LinearRing], place_um: Floats) -> Bools:
    """Whether places (m, 2) lie on some of the rings."""
    on: Bools = _rings_at(rings, place_um) != _NONE
    return on


def _rings_at(rings: list[shapely.LinearRing], place_um: Floats) -> Ints:
    """Indices (m,) of the rings that places (m, 2) lie on; −1 on none."""
    found = np.full(len(place_um), _NONE)
    # The places are in the tree and the strings query it: shapely prepares what queries.
    tree = shapely.STRtree(list(shapely.points(place_um)))  # type: ignore[arg-type]
    string, ring = strings_of(rings)
    piece_of_string, at = tree.query(string, predicate="dwithin", distance=_ON_UM)
    found[at] = ring[piece_of_string]
    return found
