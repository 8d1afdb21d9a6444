"""What is kept of the work: the parts with their holes, and the openings that slugs leave in the frame."""

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
import shapely

from sim.cut.pieces.pieces import Pieces


class KeptShape(NamedTuple):
    """A filled outline, and the index of the piece that it is, is in, or fell out of it: of several slugs the largest.

    A part itself still has its holes; each of them is a shape of its own besides.
    """

    what: Literal["part", "hole", "opening"]
    piece: int
    outline_um: shapely.Polygon


def kept_shapes(pieces: Pieces) -> tuple[KeptShape, ...]:
    """Shapes in the order of their pieces, each once; a slug out of a part left one of its holes."""
    shapes = [*_parts(pieces), *_openings(pieces)]
    return tuple(sorted(shapes, key=lambda shape: shape.piece))


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
