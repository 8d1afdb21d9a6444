"""The true offset: loops on which the wire's centre comes as near to a contour as it can, cut of slices.

All curves that lie at the offset from a block or a corner, wherever a part of the true offset may run.

Contours that repeat, as the holes of a plate do: their loops are worked out once and placed.
"""

from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.shifted import Side
from controller.offset.slices import SNAP_UM, Slices, open_slices, stitched
from parser.geometry.along import directions, places_at, to_left
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, curves_between, joined
from parser.geometry.near import nearest_um

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
    slices, moved = _moved(contour, leaving, arriving, offset_um * side)
    at, corners = _corners(contour, np.roll(leaving, -1, axis=0), arriving, offset_um * side)
    order = np.argsort(np.concatenate([2 * slices, 2 * at + 1]), kind="stable")
    return Candidates(
        curves=joined([moved, corners]).picked(order),
        source_row=ring.row[np.concatenate([slices, at])[order]],
        corner=np.repeat([False, True], [len(slices), len(at)])[order],
    )


def _moved(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Rows of the blocks that have a place at the offset, and these moved to the left, or to the right if it is < 0."""
    radius = contour.radius_um - np.sign(contour.sweep_rad) * left_um
    kept_rows = np.flatnonzero(~contour.is_arc | (radius * np.minimum(np.abs(contour.sweep_rad), 1.0) > SNAP_UM))
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
    return kept_rows, shifted.picked(kept_rows)


def _corners(contour: Curves, leaving: Floats, arriving: Floats, left_um: float) -> tuple[Ints, Curves]:
    """Blocks that end at an outer corner, and the arcs about those; `leaving` is that of the next block."""
    turn = np.arctan2(arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0], (arriving * leaving).sum(axis=1))
    outward = -np.sign(left_um)
    turn = np.where(np.abs(turn) > np.pi - _BACK_RAD, outward * np.abs(turn), turn)
    at = np.flatnonzero(outward * turn * abs(left_um) > SNAP_UM)
    about = contour.end_um[at]
    start, end = (about + left_um * to_left(way[at]) for way in (arriving, leaving))
    return at, curves_between(start, end, about, turn[at])


TOLERANCE_UM = 1e-5
"""A loop lies at least the offset less this from its contour: a slot as wide as the kerf is reached."""


class OffsetLoop(NamedTuple):
    """One loop, m curves in the contour's direction, each from the end of the one before it, the first from the last.

    Attributes
    ----------
    curves
        Lines, and arcs with the centres of their blocks, or with a corner as centre and the offset as radius.
    source_row
        (m,) row of the contour that each comes from; of a corner's arc the one before the corner.
    corner
        (m,) True on arcs about corners.
    """

    curves: Curves
    source_row: Ints
    corner: NDArray[np.bool_]


class Reached(NamedTuple):
    """What the wire's centre reaches of a contour's offset: no loop, one, or several where a pocket falls apart."""

    loops: tuple[OffsetLoop, ...]


def reach(contour: Curves, offset_um: float, side: Side) -> Reached:
    """Loops that lie everywhere at the offset from a contour or farther, on its side, with arcs about outer corners.

    Parameters
    ----------
    contour
        One closed chain of lines and arcs of at most one turn, end to start. A gap is bridged by a line.
    offset_um
        More than 0.
    side
        Where the loops lie, along the contour's direction.

    Notes
    -----
    Go along a curve at the offset from its block. It comes too near to the contour, or clear of it again, only where
    it crosses another such curve, of a block or of a corner. So the curves are cut into slices at their crossings, and
    the middle of a slice tells whether the whole slice is kept.

    It is worked out with the contour's start at the origin. Of contours alike in all but their place, to 1e-6 µm, it is
    worked out once: a tenth of what `TOLERANCE_UM` allows.
    """
    if not len(contour):
        return Reached(())
    from_um = contour.start_um[0].copy()
    placed = _moved_by(contour, -from_um)
    if len(contour) > _MOST_CURVES:
        reached = _reach(placed, offset_um, side)
    else:
        reached = _reach_once(_shape_of(placed), offset_um, side)
    return Reached(tuple(_placed(loop, contour, from_um, offset_um * side) for loop in reached.loops))


_MOST_CURVES = 512  # of a contour that is likely to repeat


@dataclass(frozen=True)
class _Shape:
    """Curves that start at the origin; those that differ by rounding alone are one shape."""

    rounded: bytes
    curves: Curves = field(compare=False)


def _shape_of(placed: Curves) -> _Shape:
    places = np.concatenate([placed.start_um, placed.end_um, placed.center_um], axis=1)
    lengths = np.stack([placed.radius_um, placed.length_um], axis=1)
    angles = np.stack([placed.start_angle_rad, placed.sweep_rad], axis=1)
    rounded = [np.round(places, 6), np.round(lengths, 6), np.round(angles, 12)]
    return _Shape((np.concatenate(rounded, axis=1) + 0.0).tobytes(), placed)  # −0.0 + 0.0 is 0.0


def _moved_by(curves: Curves, by_um: Floats) -> Curves:
    start, end, center = (each + by_um for each in (curves.start_um, curves.end_um, curves.center_um))
    return replace(curves.picked(slice(None)), start_um=start, end_um=end, center_um=center)


def _placed(loop: OffsetLoop, contour: Curves, from_um: Floats, left_um: float) -> OffsetLoop:
    """A loop at the place of its contour, with the very centres and radii that come of the contour's own."""
    curves, source = _moved_by(loop.curves, from_um), contour.picked(loop.source_row)
    of_block, about_end = curves.is_arc & ~loop.corner, loop.corner & _are_near(curves.center_um, source.end_um)
    center = np.where(of_block[:, None], source.center_um, curves.center_um)
    center = np.where(about_end[:, None], source.end_um, center)
    radius = np.where(of_block, source.radius_um - np.sign(source.sweep_rad) * left_um, curves.radius_um)
    return loop._replace(curves=replace(curves, center_um=center, radius_um=radius))


def _are_near(this_um: Floats, other_um: Floats) -> Bools:
    """Which corners are at the end of their block, not at the end of a line that bridges a gap behind it."""
    near: Bools = np.hypot(*(this_um - other_um).T) <= SNAP_UM
    return near


@lru_cache(maxsize=64)
def _reach_once(shape: _Shape, offset_um: float, side: Side) -> Reached:
    return _reach(shape.curves, offset_um, side)


def _reach(contour: Curves, offset_um: float, side: Side) -> Reached:
    ring = closed_ring(contour)
    made = candidates(ring, offset_um, side)
    if not len(made.curves):
        return Reached(())
    cut = open_slices(made.curves, side)
    middle = places_at(made.curves, cut.row, 0.5 * (cut.first_um + cut.last_um))
    distance = nearest_um(ring.curves, middle, offset_um + TOLERANCE_UM)
    clear = np.flatnonzero(distance >= offset_um - TOLERANCE_UM)
    loops = stitched(cut.take(clear), middle[clear], distance[clear], 10.0 * SNAP_UM)
    return Reached(tuple(_loop(made, cut.take(clear[loop])) for loop in loops))


def _loop(made: Candidates, cut: Slices) -> OffsetLoop:
    """A loop of slices; slices that follow each other on one curve become one."""
    on = (cut.row[1:] == cut.row[:-1]) & (cut.first_um[1:] == cut.last_um[:-1])
    first, last = np.flatnonzero(np.append(True, ~on)), np.flatnonzero(np.append(~on, True))
    row = cut.row[first]
    begin, end = cut.first_um[first], cut.last_um[last]
    of = made.curves
    share = np.where(of.is_arc[row], (end - begin) / of.length_um[row], 0.0)
    start_um = cut.place_um[cut.tail[first]]
    end_um = cut.place_um[cut.head[last]]
    curves = Curves(
        kind=of.kind[row],
        start_um=start_um,
        end_um=end_um,
        center_um=of.center_um[row],
        radius_um=of.radius_um[row],
        start_angle_rad=of.start_angle_rad[row] + begin / of.length_um[row] * of.sweep_rad[row],
        sweep_rad=share * of.sweep_rad[row],
        length_um=end - begin,
    )
    return OffsetLoop(curves, made.source_row[row], made.corner[row])
