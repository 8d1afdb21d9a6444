"""Which of many curves lies nearest to a place, exactly, and how many may be looked at for that."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from parser.findings.errors import DrawingError
from parser.geometry.curves import Curves, Floats, Ints
from sim.measure.compare.box_tree import BoxTree, box_tree
from sim.measure.compare.nearest_loop import TOO_MANY, search
from sim.measure.curve_rows import curve_rows

MOST_HELD = 300_000_000
"""Curves, or pieces of long ones, that all places asked of one index are held against: some seconds. 50,000 curves laid
on 50,000 others need a tenth of it; thousands of curves at nearly one distance from thousands of places need more."""


@dataclass(slots=True)
class Effort:
    """How many curves have been looked at so far."""

    held: int = 0


class Index(NamedTuple):
    """Curves that can be asked for the nearest one.

    Attributes
    ----------
    curves
        n lines and arcs.
    tree
        Boxes about them.
    shape
        (n, 12), the curves as rows of numbers.
    effort
        How much has been asked of them.
    """

    curves: Curves
    tree: BoxTree
    shape: Floats
    effort: Effort


class Nearest(NamedTuple):
    """Rows (m,) of the nearest curves and the distances (m,) µm from them; of equally near ones the first."""

    row: Ints
    distance_um: Floats


def indexed(curves: Curves) -> Index:
    """The curves, one or more, with the tree over them."""
    return Index(curves, box_tree(curves), curve_rows(curves), Effort())


def nearest(index: Index, place_um: Floats) -> Nearest:
    """The nearest curves to places (m, 2), exactly.

    Raises DrawingError, without the name of the file, where all that were asked of the index take more than
    `MOST_HELD`.
    """
    found = Nearest(np.empty(len(place_um), dtype=np.int64), np.empty(len(place_um)))
    most = MOST_HELD - index.effort.held
    looked_at = search(np.ascontiguousarray(place_um), (*index.tree,), index.shape, most, (*found,))
    if looked_at == TOO_MANY:
        raise DrawingError(
            f"cannot be compared: more than {MOST_HELD:,} pairs of places and curves would have to be looked at; "
            "compare one layer, or a drawing of fewer curves"
        )
    index.effort.held += looked_at
    return found
