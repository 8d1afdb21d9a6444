"""The last uncut bridge of a piece: where the wire closes on to an older kerf, how long the piece still held by it.

Where the program pauses in front of it, the operator can clamp the piece before the bridge is cut.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats
from parser.toolpath import Point
from sim.cut.kerf.makers import share_made
from sim.cut.kerf.ways import WireWay

_FRESH = 3.0  # offsets: so far back along its way the wire is in the kerf it is cutting, and closes on to nothing
_BRIDGE = 0.5  # of the outer edge of a piece, at most
_LAST_UM = 1000.0  # of way before a piece comes free: here it is still held well


class Bridge(NamedTuple):
    """What held a piece last.

    Attributes
    ----------
    place_um
        Half way between the wire and its older place that it closes on to; at the edge of the work, the wire's place.
    closes_on_block
        Block number of the older kerf; None where there is none, at the edge of the work.
    left_um
        How far the wire had to go at the start of the block that freed the piece.
    last_mm_block, last_mm_t_s
        Block number and time one millimetre of way before it came free; of a shorter contour, those at its start.
    """

    place_um: Point
    closes_on_block: int | None
    left_um: float
    last_mm_block: int
    last_mm_t_s: float


class Older(NamedTuple):
    """An older place of the wire: index of its contour, its index on that way, and its distance from the wire."""

    contour: int
    at: int
    off_um: float


def older_place(
    ways: Sequence[WireWay], earlier: Sequence[int], contour: int, at: int, offset_um: float
) -> Older | None:
    """The older place, on an earlier contour or on this one, that the wire closes on to; None at the work's edge."""
    way = ways[contour]
    wire = way.place_um[at]
    fresh = int(np.searchsorted(way.along_um, way.along_um[at] - _FRESH * offset_um))
    places = [(index, ways[index].place_um) for index in earlier] + [(contour, way.place_um[:fresh])]
    older = [_nearest(place, wire, index) for index, place in places if len(place)]
    nearest = min(older, key=lambda one: one.off_um, default=None)
    # Discs that touch are two offsets apart; a place farther off has no part in it.
    return nearest if nearest is not None and nearest.off_um < _FRESH * offset_um else None


def bridge_of(ways: Sequence[WireWay], contour: int, at: int, older: Older | None) -> Bridge:
    """The bridge that the wire cuts at a place of a contour, on to an older place."""
    way = ways[contour]
    wire = way.place_um[at]
    other = None if older is None else ways[older.contour]
    x, y = (wire if other is None or older is None else 0.5 * (wire + other.place_um[older.at])).tolist()
    begin = int(np.searchsorted(way.row, way.row[at]))
    last = int(np.searchsorted(way.along_um, way.along_um[at] - _LAST_UM))
    return Bridge(
        place_um=Point(x, y),
        closes_on_block=None if other is None or older is None else int(other.row[older.at]) + 1,
        left_um=float(way.along_um[at] - way.along_um[begin]),
        last_mm_block=int(way.row[last]) + 1,
        last_mm_t_s=float(way.t_s[last]),
    )


def held_after(
    edge_um: shapely.LinearRing, ways: Sequence[WireWay], freeing: int, pauses: Sequence[int], offset_um: float
) -> int | None:
    """How many blocks run before the pause at which a piece hangs on its last bridge; None where there is none.

    It is the last pause before the row `freeing`, if the wire has cut half of the piece's outer edge or more by then.
    `ways` are those that cut beside it, and `pauses` tell how many blocks run before each pause, in order.
    """
    at = int(np.searchsorted(pauses, freeing, side="right")) - 1
    if at < 0:
        return None
    before = [way.place_um[way.row < pauses[at]] for way in ways]
    return int(pauses[at]) if share_made(edge_um, before, offset_um) >= 1.0 - _BRIDGE else None


def _nearest(place: Floats, wire: Floats, contour: int) -> Older:
    off = np.hypot(place[:, 0] - wire[0], place[:, 1] - wire[1])
    at = int(np.argmin(off))
    return Older(contour, at, float(off[at]))
