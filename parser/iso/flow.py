"""Flow: the order in which the blocks of a program run."""

import numpy as np

from parser.geometry.curves import Ints
from parser.iso.given import Given


def run_order(given: Given) -> Ints:
    """(e,) blocks as they run, from 0."""
    blocks = given.listing.blocks
    on_tape = int(np.searchsorted(blocks.first, given.listing.tape_end))
    ends = np.flatnonzero(given.m("end")[:on_tape])
    return np.arange(ends[0] + 1 if len(ends) else on_tape)
