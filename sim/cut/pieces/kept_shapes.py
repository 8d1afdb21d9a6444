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
    """Openings of the frame that slugs fell out of, and no part: round a part it is the frame that is waste."""
    openings, freed = pieces.frame.openings_um, pieces.freed
    inside = [piece.outline_um.representative_point() for piece in freed]
    at, found = shapely.STRtree(inside).query(np.array(openings, dtype=np.object_), predicate="contains")
    for index, opening in enumerate(openings):
        within = found[at == index].tolist()
        if within and all(freed[piece].kind == "slug" for piece in within):
            yield KeptShape("opening", max(within, key=lambda piece: freed[piece].area_mm2), opening)
