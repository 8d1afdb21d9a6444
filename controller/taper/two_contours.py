"""Two contours of a tilted wire: matched block by block, as they are or offset in each plane, to the way of the wire.

A control of fast wire offsets each contour in its own plane (EDM_NC, g151152.cpp, 2014). Offsets insert rows at corners
and leave out blocks without a place, in one plane and not in the other: there one end of the wire stands.
"""

from typing import NamedTuple

import numpy as np

from controller.offset.chain import OffsetPath, Order
from controller.offset.shifted import rounds_of
from controller.taper.tilted import Heights, TiltedPath, gap_um, rows_between
from parser.geometry.curves import Curves, Ints, curves_between, joined
from parser.geometry.ruled import Ruled
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath


class Matched(NamedTuple):
    """Two contours, row by row, and the row (m,) of the toolpath that each row of both belongs to."""

    lower: Curves
    upper: Curves
    source_row: Ints


def matched_rows(toolpath: Toolpath, upper: Curves) -> Matched:
    """Two contours with as many rows, each row with its own."""
    return Matched(toolpath.picked(slice(None)), upper, np.arange(len(upper)))


def matched_offsets(lower: OffsetPath, upper: OffsetPath) -> Matched:
    """The offset paths of two contours, whose blocks are matched row by row.

    Rows that come from the same block, and have the same place among those, are partners. Where an offset leaves a
    block no place in one plane, or goes round a corner in one alone, that end of the wire stands.
    """
    keys = [of.source_row * len(Order) + of.place for of in (lower, upper)]
    both = np.union1d(*keys)
    low, high = (_standing_where(of.curves, own, both) for of, own in zip((lower, upper), keys, strict=True))
    return Matched(low, high, np.maximum(np.searchsorted(keys[0], both, side="right") - 1, 0))


def _standing_where(curves: Curves, own: Ints, wanted: Ints) -> Curves:
    """The curves by their keys, rising; a place where the curve before ends for each wanted key that they lack."""
    before = np.searchsorted(own, wanted, side="right") - 1
    has = (before >= 0) & (own[np.maximum(before, 0)] == wanted)
    at = np.where((before < 0)[:, None], curves.start_um[:1], curves.end_um[np.maximum(before, 0)])
    stands = curves_between(at, at, at, np.zeros(len(at)))
    return joined([curves.picked(slice(None)), stands]).picked(np.where(has, before, len(curves) + np.arange(len(at))))


def between_contours(
    toolpath: Toolpath, contours: Matched, heights: Heights, planes_um: tuple[float, float]
) -> TiltedPath:
    """The way of a wire along two contours at two heights; the lower one is that of the toolpath.

    Their contours at the faces of the work follow; arcs that differ are not arcs there, and are cut into chords.
    """
    ruled, source = Ruled(contours.lower, contours.upper, *planes_um), contours.source_row
    closed = [
        (section.first, section.last)
        for _, _, section in rounds_of(toolpath)
        if section.closed and _closes(contours, section.first, section.last)
    ]
    if planes_um != (0.0, heights.work_um):
        ruled, row = _at_faces(ruled, heights.work_um)
        source = source[row]
    loops = tuple(rows_between(source, *rows) for rows in closed)
    return TiltedPath(ruled, heights, source, loops, (), None)


def _closes(contours: Matched, first: int, last: int) -> bool:
    """Whether the upper contour closes along rows of the toolpath, from the first to the last."""
    rows = rows_between(contours.source_row, first, last)
    return gap_um(contours.upper, int(rows[0]), int(rows[-1])) <= CLOSED_WITHIN_UM


def _at_faces(ruled: Ruled, work_um: float) -> tuple[Ruled, Ints]:
    """The same surface from the bottom to the top of the work, and the row (k,) that each of its rows belongs to."""
    (lower, upper), row = ruled.sections((0.0, work_um))
    return Ruled(lower, upper, 0.0, work_um), row
