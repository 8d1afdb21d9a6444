"""The true offset: loops on which the wire's centre comes as near to a contour as it can without cutting into it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.candidates import SNAP_UM, Candidates, candidates, closed_ring
from controller.offset.sections import Side
from controller.offset.slices import Slices, open_slices
from controller.offset.stitching import stitched
from parser.geometry.along import places_at
from parser.geometry.broad_phase_places import nearest_um
from parser.geometry.curves import Curves, Ints

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
    """
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
