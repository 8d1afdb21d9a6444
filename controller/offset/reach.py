"""The true offset: loops on which the wire's centre comes as near to a contour as it can without cutting into it.

Slices put together, end to end, into loops.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.offset.sections import Side
from controller.offset.slices import SNAP_UM, Candidates, Slices, candidates, closed_ring, open_slices
from parser.geometry.along import places_at
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.near import nearest_um


def stitched(cut: Slices, middle_um: Floats, clear_um: Floats, same_um: float) -> tuple[Ints, ...]:
    """Indices of the slices of each loop, in order; a loop begins with its least index, and loops are in order of it.

    Parameters
    ----------
    middle_um, clear_um
        (k, 2) middles of the slices, and (k,) how far these are from the contour. Where more slices end at a place than
        leave it, or fewer, the one of the surplus that is least far from the contour is taken away.
    same_um
        Slices between the same places whose middles are this near are one.
    """
    pieces = _balanced(cut, _without_copies(cut, middle_um, same_um), clear_um)
    return _walks(pieces, _next(cut.take(pieces)))


def _without_copies(cut: Slices, middle_um: Floats, same_um: float) -> Ints:
    """Indices of the slices that are no copy of an earlier one, as where blocks run along the same way again."""
    order = np.lexsort((middle_um[:, 0], cut.head, cut.tail))
    same = (cut.tail[order][1:] == cut.tail[order][:-1]) & (cut.head[order][1:] == cut.head[order][:-1])
    same &= np.hypot(*np.diff(middle_um[order], axis=0).T) <= same_um
    return np.delete(np.arange(len(order)), order[1:][same])


def _balanced(cut: Slices, kept_rows: Ints, clear_um: Floats) -> Ints:
    """The slices that are left once as many of them end at each place as leave it."""
    while len(kept_rows):
        number = len(cut.place_um)
        surplus = np.bincount(cut.tail[kept_rows], minlength=number) - np.bincount(
            cut.head[kept_rows], minlength=number
        )
        if not surplus.any():
            break
        worst = [
            _least_clear(end[kept_rows], clear_um[kept_rows], sign * surplus > 0)
            for end, sign in ((cut.tail, 1), (cut.head, -1))
        ]
        kept_rows = np.delete(kept_rows, np.concatenate(worst))
    return kept_rows


def _least_clear(end: Ints, clear_um: Floats, surplus: NDArray[np.bool_]) -> Ints:
    """Of the slices at each place with too many, the one that keeps least clear."""
    there = np.flatnonzero(surplus[end])
    order = there[np.lexsort((clear_um[there], end[there]))]
    return order[np.diff(end[order], prepend=-1) > 0]


def _next(cut: Slices) -> Ints:
    """(k,) the slice that follows each; as many slices leave each place as end there.

    The next one in number follows where it can, since slices are in the contour's order.
    """
    count = len(cut.row)
    on = np.roll(np.arange(count), -1)
    follows = cut.tail[on] == cut.head
    result = np.where(follows, on, -1)
    left = np.ones(count, dtype=np.bool_)
    left[on[follows]] = False
    ending, leaving = np.flatnonzero(~follows), np.flatnonzero(left)
    by_head, by_tail = (np.argsort(end, kind="stable") for end in (cut.head[ending], cut.tail[leaving]))
    result[ending[by_head]] = leaving[by_tail]
    return result


def _walks(kept_rows: Ints, following: Ints) -> tuple[Ints, ...]:
    """Cycles of a permutation. They are walked slice by slice, since their order is asked for (0.1 µs a slice)."""
    order, ends, after = [], [0], following.tolist()
    for first in range(len(after)):
        at = first
        while after[at] >= 0:
            order.append(at)
            after[at], at = -1, after[at]
        if len(order) > ends[-1]:
            ends.append(len(order))
    row = kept_rows[np.array(order, dtype=np.int64)]
    return tuple(row[a:b] for a, b in pairwise(ends))


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
