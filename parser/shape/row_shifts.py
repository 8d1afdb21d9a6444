"""How far each block of an earlier pass lies from the last pass over its edge."""

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.geometry.directions import headings
from parser.shape.beside import neighbours
from parser.shape.passes import Passes
from parser.toolpath import Toolpath

_SHARES = np.array([1.0, 3.0, 5.0]) / 6.0  # of a block, at which it is held against the last pass


def row_shifts_um(toolpath: Toolpath, passes: Passes) -> Floats:
    """(n,) how far µm the blocks of earlier passes lie from the last pass, at the place where they come nearest to it.

    Positive on the side of the waste. NaN where there is no later pass, or none beside the block, or the side of the
    part is not known; passes over a tab are held against the last one over it.
    """
    shift = np.full(len(toolpath), np.nan)
    last = {(one.edge, one.is_tab): number for number, one in enumerate(passes.passes)}
    later = np.array([last[one.edge, one.is_tab] for one in passes.passes], dtype=np.int64)
    side = np.array([one.part_side for one in passes.passes], dtype=np.int64)
    same = np.array([not one.is_back for one in passes.passes], dtype=np.int64) * 2 - 1
    held = (later != np.arange(len(later))) & (side != 0)
    if not held.any():
        return shift
    row = np.flatnonzero((passes.of_row >= 0) & held[passes.of_row])
    is_last = np.isin(passes.of_row, later[held])
    at, share = np.repeat(row, len(_SHARES)), np.tile(_SHARES, len(row))
    beside = neighbours(toolpath, np.flatnonzero(is_last), places(toolpath, at, share), headings(toolpath, at, share))
    mine, other = passes.of_row[at[beside.at]], passes.of_row[beside.row]
    own = np.flatnonzero((other == later[mine]) & (beside.sense == same[mine] * same[other]))
    # The last pass lies to the left of the place by so much; the part may lie there too.
    return _least(shift, at[beside.at[own]], beside.at[own], (beside.aside_um * side[mine])[own])


def _least(shift: Floats, row: Ints, place: Ints, aside: Floats) -> Floats:
    """The rows' shifts (n,) filled in: at each place the nearest neighbour counts, in each row the lowest shift."""
    order = np.lexsort((np.abs(aside), place))
    once = order[np.flatnonzero(np.diff(place[order], prepend=-1))]
    np.fmin.at(shift, row[once], aside[once])
    return shift
