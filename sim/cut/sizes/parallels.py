"""Pairs of straight kept edges that run parallel and face each other: thicknesses of the part, widths of its slots."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.directions import to_left
from sim.cut.kerf.edges import Edges
from sim.cut.pieces.kept_edges import KeptEdges, runs_of

_MOST_LINES = 400  # the longest, that are paired with each other
_PARALLEL_RAD = 1e-3  # ends in whole µm turn a line of 1 mm by as much
_OVERLAP_UM = 1000.0  # or half the shorter line


class KeptLines(NamedTuple):
    """Straight kept edges, m of them: each on one outline, as far as it is kept, run through with it on the left.

    Attributes
    ----------
    row, shape
        (m,) int64, row of the toolpath, and index of the shape whose outline it is.
    places
        (m, 2) int64, first of its places among the kept edges, and one past the last.
    start_um, way, length_um
        (m, 2), (m, 2), (m,) float64: start and unit direction on the wire's path beside it, and length.
    """

    row: Ints
    shape: Ints
    places: Ints
    start_um: Floats
    way: Floats
    length_um: Floats


class Pairs(NamedTuple):
    """Indices (k,) of two lines each, and from where to where along the first of them, from its start, they overlap."""

    one: Ints
    other: Ints
    from_um: Floats
    to_um: Floats


def kept_lines(curves: Curves, edges: Edges, kept: KeptEdges) -> KeptLines:
    """The longest of the straight edges, in the order of their rows.

    Short of a corner no edge is measured. An edge that is kept up to there counts up to the end of its block.
    """
    first = runs_of(kept.row, kept.side, kept.shape)
    past = np.append(first, len(kept.row))[1:]
    straight = ~curves.is_arc[kept.row[first]] & (curves.length_um[kept.row[first]] > 0.0)
    first, past = first[straight], past[straight]
    row, side = kept.row[first], kept.side[first]
    ahead = (curves.end_um[row] - curves.start_um[row]) / curves.length_um[row][:, None]
    begin, end = _reaching(curves, edges, row, kept.station[first], kept.station[past - 1])
    start = curves.start_um[row] + np.where(side > 0, begin, end)[:, None] * ahead
    places = np.stack([first, past], axis=1)
    length, way = end - begin, side[:, None] * ahead
    longest = np.sort(np.argsort(-length, kind="stable")[:_MOST_LINES])
    columns = row[longest], kept.shape[first][longest], places[longest]
    return KeptLines(*columns, start[longest], way[longest], length[longest])


def _reaching(curves: Curves, edges: Edges, row: Ints, first: Ints, last: Ints) -> tuple[Floats, Floats]:
    """From where to where along their rows (m,) edges reach that are kept from a `first` to a `last` station (m,)."""
    inner = np.flatnonzero(edges.inner)
    first_inner = inner[np.searchsorted(edges.row[inner], row)]
    last_inner = inner[np.searchsorted(edges.row[inner], row, side="right") - 1]
    low, high = (np.hypot(*(edges.place_um[station] - curves.start_um[row]).T) for station in (first, last))
    return np.where(first == first_inner, 0.0, low), np.where(last == last_inner, curves.length_um[row], high)


def facing_pairs(lines: KeptLines) -> Pairs:
    """Each line with the nearest one that faces it, every pair once, along the same outline."""
    way = lines.way
    crossed = way[:, None, 0] * way[None, :, 1] - way[:, None, 1] * way[None, :, 0]
    facing = (way @ way.T < 0.0) & (np.abs(crossed) < _PARALLEL_RAD)
    facing &= lines.shape[:, None] == lines.shape
    low, high = _overlaps(lines)
    facing &= high - low >= np.minimum(_OVERLAP_UM, 0.5 * np.minimum(lines.length_um[:, None], lines.length_um))
    one, other = _nearest(lines, facing)
    return Pairs(one, other, low[one, other], high[one, other])


def _overlaps(lines: KeptLines) -> tuple[Floats, Floats]:
    """From where and to where along each line each other line lies beside it; both (m, m) µm."""
    ends = lines.start_um + lines.length_um[:, None] * lines.way
    along = [
        (lines.way @ place.T) - (lines.way * lines.start_um).sum(axis=1)[:, None] for place in (lines.start_um, ends)
    ]
    low, high = np.minimum(*along), np.maximum(*along)
    return np.maximum(low, 0.0), np.minimum(high, lines.length_um[:, None])


def _nearest(lines: KeptLines, facing: Bools) -> tuple[Ints, Ints]:
    """Pairs of each line with the nearest line that faces it, every pair once; indices of both."""
    across = to_left(lines.way)
    middle = lines.start_um + 0.5 * lines.length_um[:, None] * lines.way
    off = np.abs(across @ middle.T - (across * lines.start_um).sum(axis=1)[:, None])
    off[~facing] = np.inf
    one = np.flatnonzero(facing.any(axis=1))
    other = np.argmin(off[one], axis=1) if len(one) else one
    pairs = np.unique(np.sort(np.stack([one, other], axis=1), axis=1), axis=0).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]
