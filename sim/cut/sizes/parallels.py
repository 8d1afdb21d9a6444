"""Pairs of straight kept edges that run parallel and face each other: thicknesses of the part, widths of its slots."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.directions import to_left
from sim.cut.pieces.kept_edges import Kept

_MOST_LINES = 400  # the longest, that are paired with each other
_PARALLEL_RAD = 1e-3  # ends in whole µm turn a line of 1 mm by as much
_OVERLAP_UM = 1000.0  # or half the shorter line


class Pairs(NamedTuple):
    """Rows (k,) of two lines each, and where along the first of them, from its start, they overlap (k,) from and to."""

    one: Ints
    other: Ints
    from_um: Floats
    to_um: Floats


class _Lines(NamedTuple):
    """Lines (m,): rows, starts and unit directions (m, 2), lengths."""

    row: Ints
    start_um: Floats
    way: Floats
    length_um: Floats


def facing_pairs(curves: Curves, kept: Kept, contour_of_row: Ints) -> Pairs:
    """Each line with the nearest one that faces it, every pair once, along the same contour."""
    lines = _lines(curves, kept)
    row, way = lines.row, lines.way
    crossed = way[:, None, 0] * way[None, :, 1] - way[:, None, 1] * way[None, :, 0]
    facing = (way @ way.T < 0.0) & (np.abs(crossed) < _PARALLEL_RAD)
    facing &= (kept.side[row][:, None] == kept.side[row]) & (contour_of_row[row][:, None] == contour_of_row[row])
    low, high = _overlaps(lines)
    facing &= high - low >= np.minimum(_OVERLAP_UM, 0.5 * np.minimum(lines.length_um[:, None], lines.length_um))
    one, other = _nearest(lines, facing)
    return Pairs(row[one], row[other], low[one, other], high[one, other])


def _lines(curves: Curves, kept: Kept) -> _Lines:
    found = np.flatnonzero(~curves.is_arc & (kept.side != 0) & (curves.length_um > 0.0))
    row = np.sort(found[np.argsort(-curves.length_um[found], kind="stable")[:_MOST_LINES]])
    length = curves.length_um[row]
    return _Lines(row, curves.start_um[row], (curves.end_um[row] - curves.start_um[row]) / length[:, None], length)


def _overlaps(lines: _Lines) -> tuple[Floats, Floats]:
    """From where and to where along each line each other line lies beside it; both (m, m) µm."""
    ends = lines.start_um + lines.length_um[:, None] * lines.way
    along = [
        (lines.way @ place.T) - (lines.way * lines.start_um).sum(axis=1)[:, None] for place in (lines.start_um, ends)
    ]
    low, high = np.minimum(*along), np.maximum(*along)
    return np.maximum(low, 0.0), np.minimum(high, lines.length_um[:, None])


def _nearest(lines: _Lines, facing: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Pairs of each line with the nearest line that faces it, every pair once; indices of both."""
    across = to_left(lines.way)
    middle = lines.start_um + 0.5 * lines.length_um[:, None] * lines.way
    off = np.abs(across @ middle.T - (across * lines.start_um).sum(axis=1)[:, None])
    off[~facing] = np.inf
    one = np.flatnonzero(facing.any(axis=1))
    other = np.argmin(off[one], axis=1) if len(one) else one
    pairs = np.unique(np.sort(np.stack([one, other], axis=1), axis=1), axis=0).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]
