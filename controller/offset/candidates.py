"""All curves that lie at the offset from a block or a corner, wherever a part of the true offset may run."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.sections import Side
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between, joined
from parser.geometry.directions import directions, to_left

SNAP_UM = 1e-5
"""Places this near each other are one. Double precision keeps ends and crossings within 1e-9 µm over 1 m."""
_BACK_RAD = 1e-9  # within this of half a turn, a contour goes back on itself, and its end is an outer corner


class Candidates(NamedTuple):
    """m curves along the contour's direction, in its order.

    Attributes
    ----------
    curves
        Blocks moved aside, and arcs about outer corners.
    source_row
        (m,) row of the contour; of a corner's arc the one before the corner.
    corner
        (m,) True on arcs about corners.
    """

    curves: Curves
    source_row: Ints
    corner: NDArray[np.bool_]


class ClosedContour(NamedTuple):
    """A closed contour without gaps and blocks of no length: its curves, and the rows (n,) that they come from."""

    curves: Curves
    row: Ints


def closed_ring(contour: Curves) -> ClosedContour:
    """The contour with its gaps bridged by lines that belong to the block before them."""
    row = np.flatnonzero(contour.length_um > SNAP_UM)
    curves = contour.picked(row)
    start, end = curves.end_um, np.roll(curves.start_um, -1, axis=0)
    gap = np.flatnonzero(np.hypot(*(end - start).T) > SNAP_UM)
    bridges = curves_between(start[gap], end[gap], np.full((len(gap), 2), np.nan), np.zeros(len(gap)))
    order = np.argsort(np.concatenate([np.arange(len(row)), gap]), kind="stable")
    return ClosedContour(joined([curves, bridges]).picked(order), np.concatenate([row, row[gap]])[order])


def candidates(ring: ClosedContour, offset_um: float, side: Side) -> Candidates:
    """Blocks moved by the offset to the side, and arcs about the corners that point to it.

    An arc with a radius of no more than the offset has no place for it on its inner side, and is left out there.
    """
    contour = ring.curves
    leaving, arriving = directions(contour)
    kept, moved = _moved(contour, leaving, arriving, offset_um * side)
    at, corners = _corners(contour, np.roll(leaving, -1, axis=0), arriving, offset_um * side)
    order = np.argsort(np.concatenate([2 * kept, 2 * at + 1]), kind="stable")
    return Candidates(
        curves=joined([moved, corners]).picked(order),
        source_row=ring.row[np.concatenate([kept, at])[order]],
        corner=np.repeat([False, True], [len(kept), len(at)])[order],
    )


def _moved(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Rows of the blocks that have a place at the offset, and these moved to the left, or to the right if it is < 0."""
    radius = contour.radius_um - np.sign(contour.sweep_rad) * left_um
    kept = np.flatnonzero(~contour.is_arc | (radius * np.minimum(np.abs(contour.sweep_rad), 1.0) > SNAP_UM))
    shifted = Curves(
        kind=np.where(contour.is_arc, CurveKind.ARC, CurveKind.LINE).astype(np.int64),
        start_um=contour.start_um + left_um * to_left(leaving),
        end_um=contour.end_um + left_um * to_left(arriving),
        center_um=contour.center_um,
        radius_um=radius,
        start_angle_rad=contour.start_angle_rad,
        sweep_rad=contour.sweep_rad,
        length_um=np.where(contour.is_arc, radius * np.abs(contour.sweep_rad), contour.length_um),
    )
    return kept, shifted.picked(kept)


def _corners(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Blocks that end at an outer corner, and the arcs about those; `leaving` is that of the next block."""
    turn = np.arctan2(arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0], (arriving * leaving).sum(axis=1))
    outward = -np.sign(left_um)
    turn = np.where(np.abs(turn) > np.pi - _BACK_RAD, outward * np.abs(turn), turn)
    at = np.flatnonzero(outward * turn * abs(left_um) > SNAP_UM)
    about = contour.end_um[at]
    start, end = (about + left_um * to_left(way[at]) for way in (arriving, leaving))
    return at, curves_between(start, end, about, turn[at])
