"""Which row's wire made an edge: the row that ran where the wire came nearest to it.

An edge that a cut leaves lies one reach, wire radius and gap, from a place of the wire's real way, and no place of any
way comes nearer to it. So the nearest place tells the row, whatever passes ran beside it.
"""

from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.last_beside import NOBODY, last_beside
from sim.cut.kerf.ways import WireWay

_INEXACT_UM = 0.2  # an edge may lie beside the discs of the wire by so much: outlines are simplified by 0.05 µm
_SPACING = 0.25  # reaches between the places of an edge that is looked at
_MOST_PLACES = 2000  # of them
_ALIKE_UM = 0.04  # passes on one way come equally near but for this: each way is known at places some 4 µm apart


def rows_that_made(ways: Iterable[WireWay], place_um: Floats, reach_um: float) -> Ints:
    """Rows (m,) of the toolpath whose wire made the places (m, 2) on an edge; NOBODY where none did.

    Where several ran over the same way, it is the last of them.
    """
    parts = [(way.place_um, way.row) for way in ways if len(way.row)]
    if not parts:
        return np.full(len(place_um), NOBODY, dtype=np.int64)
    wire, row = (np.concatenate(column) for column in zip(*parts, strict=True))  # ways are in the order they are cut
    last = last_beside(wire, place_um, reach_um + _INEXACT_UM, _ALIKE_UM)
    return np.where(last == NOBODY, NOBODY, row[last])


def share_made(edge_um: shapely.LinearRing, way_um: Sequence[Floats], reach_um: float) -> float:
    """Share of an edge that the wire made on some stretches of its way, each places (p, 2) one after the other."""
    way = shapely.MultiLineString([places for places in way_um if len(places) > 1])
    if way.is_empty:
        return 0.0
    spacing = max(_SPACING * reach_um, edge_um.length / _MOST_PLACES)
    places = shapely.line_interpolate_point(edge_um, np.arange(0.0, edge_um.length, spacing))
    shapely.prepare(way)
    return float(np.mean(shapely.dwithin(way, places, reach_um + _INEXACT_UM)))
