"""Which row's wire made an edge: the row that ran where the wire came nearest to it.

An edge that a cut leaves lies one reach, wire radius and gap, from a place of the wire's real way, and no place of any
way comes nearer to it. So the nearest place tells the row, whatever passes ran beside it.
"""

from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.ways import WireWay

NOBODY = -1
"""In place of a row: no wire came within its reach, as at the edge of the work."""

_INEXACT_UM = 0.2  # an edge may lie beside the discs of the wire by so much: outlines are simplified by 0.05 µm
_SPACING = 0.25  # reaches between the places of an edge that is looked at
_MOST_PLACES = 2000  # of them
_ALIKE_UM = 0.04  # passes on one way come equally near but for this: each way is known at places some 4 µm apart


def rows_that_made(ways: Iterable[WireWay], place_um: Floats, reach_um: float) -> Ints:
    """Rows (m,) of the toolpath whose wire made the places (m, 2) on an edge; NOBODY where none did.

    Where several ran over the same way, it is the last of them.
    """
    parts = [(way.place_um, way.row) for way in ways if len(way.row)]
    made = np.full(len(place_um), NOBODY, dtype=np.int64)
    if not parts or not len(place_um):
        return made
    wire, row = (np.concatenate(column) for column in zip(*parts, strict=True))
    within = reach_um + _INEXACT_UM
    order, spans = _in_cells(wire, place_um, within + _ALIKE_UM)
    last = _last_of_nearest(wire[order], order, np.ascontiguousarray(place_um), spans, within)
    made[last >= 0] = row[last[last >= 0]]
    return made


def _in_cells(wire: Floats, place_um: Floats, cell_um: float) -> tuple[Ints, Ints]:
    """Order (p,) of the wire's places in square cells, and where in it those near to each place (m, 2) stand.

    They are spans (m, 3, 2), each from the first to one past the last: three cells one above the other, in the column
    of the place and those beside it.
    """
    low = np.minimum(wire.min(axis=0), place_um.min(axis=0))
    cells, near = (np.floor((place - low) / cell_um).astype(np.int64) for place in (wire, place_um))
    high = max(int(cells[:, 1].max()), int(near[:, 1].max())) + 3  # an empty cell below and above each column
    key = cells[:, 0] * high + cells[:, 1]
    order = np.argsort(key, kind="stable")
    middle = (near[:, :1] + np.arange(-1, 2)) * high + near[:, 1:]
    begin, past = np.searchsorted(key[order], middle - 1), np.searchsorted(key[order], middle + 1, "right")
    return order, np.stack([begin, past], axis=2)


@compiled("i8[::1](f8[:,::1], i8[::1], f8[:,::1], i8[:,:,::1], f8)")
def _last_of_nearest(wire: Floats, index: Ints, place: Floats, spans: Ints, within: float) -> Ints:
    """The last (m,) of the wire's places that come equally near to each place (m, 2); −1 where none is `within`.

    `wire` (p, 2) with the index of each; of these, each place has those near to it in spans (m, 3, 2).
    """
    found = np.full(place.shape[0], -1)
    for at in range(place.shape[0]):
        least = within * within
        for again in range(2):  # how near, then which
            for begin, past in spans[at]:
                for near in range(begin, past):
                    off_x, off_y = wire[near, 0] - place[at, 0], wire[near, 1] - place[at, 1]
                    square = off_x * off_x + off_y * off_y
                    if again == 0:
                        least = min(least, square)
                    elif square <= least:
                        found[at] = max(found[at], index[near])
            if least >= within * within:
                break
            least = (np.sqrt(least) + _ALIKE_UM) ** 2
    return found


def share_made(edge_um: shapely.LinearRing, way_um: Sequence[Floats], reach_um: float) -> float:
    """Share of an edge that the wire made on some stretches of its way, each places (p, 2) one after the other."""
    way = shapely.MultiLineString([places for places in way_um if len(places) > 1])
    if way.is_empty:
        return 0.0
    spacing = max(_SPACING * reach_um, edge_um.length / _MOST_PLACES)
    places = shapely.line_interpolate_point(edge_um, np.arange(0.0, edge_um.length, spacing))
    shapely.prepare(way)
    return float(np.mean(shapely.dwithin(way, places, reach_um + _INEXACT_UM)))
