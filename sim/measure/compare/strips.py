"""The strips between the edge of a cut and its drawing, where they lie farther apart than is allowed."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints
from parser.geometry.distance import feet
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import Comparison
from sim.measure.compare.starts import laid_loops

_PARTS: Final = 64
"""Of a curve of the edge, at most."""
_PART_UM: Final = 250.0


class Strips(NamedTuple):
    """Strips between an edge and a drawing, in the program's coordinates; one for each curve of the edge that is off.

    Attributes
    ----------
    drawn
        The drawing's loops as they are laid on the part.
    edge_um, foot_um
        (k, 2) places along the edge, and the nearest ones of what it was held against.
    strip
        (k,) which strip each place is of, rising.
    side
        (k,) −1 where the part is gouged, +1 where material is left.
    """

    drawn: tuple[Curves, ...]
    edge_um: Floats
    foot_um: Floats
    strip: Ints
    side: Ints

    @property
    def widest_um(self) -> float:
        """Width of the widest strip."""
        return float(np.hypot(*(self.edge_um - self.foot_um).T).max())


def strips_of(comparison: Comparison) -> Strips | None:
    """The strips of a comparison; None where the edge is nowhere off, or it is not known to which side."""
    found, edge = comparison.edge_to_drawing, comparison.edge.curves
    is_off = (found.max_um > comparison.request.tolerance_um) & (comparison.edge_side != 0.0)
    rows = np.flatnonzero(is_off)
    if not len(rows):
        return None
    parts = np.clip(np.ceil(edge.length_um[rows] / _PART_UM), 2, _PARTS).astype(np.int64)
    strip = np.repeat(np.arange(len(rows)), parts + 1)
    number = np.arange(len(strip)) - np.searchsorted(strip, strip)
    place = places(edge, rows[strip], number / parts[strip])
    foot = feet(comparison.laid, nearest(indexed(comparison.laid), place).row, place).place_um
    side = comparison.edge_side[rows].astype(np.int64)[strip]
    return Strips(tuple(laid_loops(comparison.drawing, comparison.placement)), place, foot, strip, side)
