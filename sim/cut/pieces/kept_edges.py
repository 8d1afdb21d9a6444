"""The edge of each block that is kept: that of the part, or of the frame where a slug falls out of it."""

from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.edges import Edges
from sim.cut.kerf.region import Kerf
from sim.cut.pieces.pieces import Piece, Pieces

_INTO_UM = 10.0  # from the edge into what lies beside it
_FRAME = 1
_WORTH = {"slug": 0, "part": 2}
_NONE = -1


class Kept(NamedTuple):
    """Kept edges of n blocks.

    Attributes
    ----------
    side
        (n,) int64: +1 the left edge is kept, −1 the right one, 0 neither or both: a lead-in, an open cut.
    piece
        (n,) int64, index of the piece that comes free beside the block; −1 where there is none.
    """

    side: Ints
    piece: Ints


def kept_edges(kerf: Kerf, pieces: Pieces) -> Kept:
    """Which edges are kept: rather a part's than the frame's, and the frame's rather than a slug's."""
    edges, rows = kerf.edges, len(kerf.width.mean_um)
    at = _middles(edges)
    place, out = edges.place_um[at], edges.left[at]
    left = _beside(pieces.freed, place + (edges.left_um[at] + _INTO_UM)[:, None] * out)
    right = _beside(pieces.freed, place - (edges.right_um[at] + _INTO_UM)[:, None] * out)
    worth = np.array([*(_WORTH[piece.kind] for piece in pieces.freed), _FRAME])
    side, beside = np.zeros(rows, dtype=np.int64), np.full(rows, _NONE)
    row = edges.row[at]
    side[row] = np.sign(worth[left] - worth[right])
    beside[row] = np.maximum(left, right)
    return Kept(side, beside)


def edge_places(edges: Edges, side: Ints) -> Floats:
    """Places (m, 2) on the edges to a side (m,) of the stations."""
    reach = np.where(side > 0, edges.left_um, -edges.right_um)
    places: Floats = edges.place_um + reach[:, None] * edges.left
    return places


def _middles(edges: Edges) -> Ints:
    """Indices of the middle inner stations that were cut, one of each row at most."""
    cut = np.flatnonzero(edges.inner & ~np.isnan(edges.left_um))
    row = edges.row[cut]
    first = np.flatnonzero(np.diff(row, prepend=-1))
    middle: Ints = cut[first + np.diff(first, append=len(row)) // 2]
    return middle


def _beside(pieces: tuple[Piece, ...], place_um: Floats) -> Ints:
    """Indices (m,) of the pieces that hold places (m, 2); −1 outside all."""
    found = np.full(len(place_um), _NONE)
    # The places are in the tree and the outlines query it: shapely prepares what queries, here few long outlines.
    tree = shapely.STRtree(list(shapely.points(place_um)))  # type: ignore[arg-type]
    piece, at = tree.query(np.array([piece.outline_um for piece in pieces], dtype=np.object_), predicate="contains")
    found[at] = piece
    return found
