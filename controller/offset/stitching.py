"""Slices put together, end to end, into loops."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from controller.offset.slices import Slices
from parser.geometry.curves import Floats, Ints


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
    kept = _balanced(cut, _without_copies(cut, middle_um, same_um), clear_um)
    return _walks(kept, _next(cut.take(kept)))


def _without_copies(cut: Slices, middle_um: Floats, same_um: float) -> Ints:
    """Indices of the slices that are no copy of an earlier one, as where blocks run along the same way again."""
    order = np.lexsort((middle_um[:, 0], cut.head, cut.tail))
    same = (cut.tail[order][1:] == cut.tail[order][:-1]) & (cut.head[order][1:] == cut.head[order][:-1])
    same &= np.hypot(*np.diff(middle_um[order], axis=0).T) <= same_um
    return np.delete(np.arange(len(order)), order[1:][same])


def _balanced(cut: Slices, kept: Ints, clear_um: Floats) -> Ints:
    """The slices that are left once as many of them end at each place as leave it."""
    while len(kept):
        number = len(cut.place_um)
        surplus = np.bincount(cut.tail[kept], minlength=number) - np.bincount(cut.head[kept], minlength=number)
        if not surplus.any():
            break
        worst = [
            _least_clear(end[kept], clear_um[kept], sign * surplus > 0) for end, sign in ((cut.tail, 1), (cut.head, -1))
        ]
        kept = np.delete(kept, np.concatenate(worst))
    return kept


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


def _walks(kept: Ints, following: Ints) -> tuple[Ints, ...]:
    """Cycles of a permutation. They are walked slice by slice, since their order is asked for (0.1 µs a slice)."""
    order, ends, after = [], [0], following.tolist()
    for first in range(len(after)):
        at = first
        while after[at] >= 0:
            order.append(at)
            after[at], at = -1, after[at]
        if len(order) > ends[-1]:
            ends.append(len(order))
    row = kept[np.array(order, dtype=np.int64)]
    return tuple(row[a:b] for a, b in pairwise(ends))
