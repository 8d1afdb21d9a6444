"""What is still cut of a piece that is free."""

from collections.abc import Iterable

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Floats
from sim.cut.kerf.ways import Passage

_SPARED = 0.1  # offsets: a wire that reaches no deeper takes nothing but what closure and a second run leave


def cut_on_um(piece_um: shapely.Polygon, ways: Iterable[Passage], offset_um: float) -> float:
    """How far the wire goes on in a piece along some ways, not counting where it runs along its own kerf again."""
    shapely.prepare(piece_um)
    inside = [_inside(piece_um, way, offset_um) for way in ways]
    length = np.concatenate([np.diff(way.along_um, prepend=way.along_um[:1])[at] for way, at in inside])
    place = np.concatenate([way.place_um[at] for way, at in inside])
    return float(length[~_again(place, np.cumsum(length), offset_um)].sum())


def _inside(piece_um: shapely.Polygon, way: Passage, offset_um: float) -> tuple[Passage, NDArray[np.bool_]]:
    cuts = shapely.dwithin(piece_um, shapely.points(way.place_um), (1.0 - _SPARED) * offset_um)
    return way, np.asarray(cuts)


def _again(place_um: Floats, along_um: Floats, offset_um: float) -> NDArray[np.bool_]:
    """Which of the places (m, 2) lie on the way up to there, an offset and more behind along it (m,)."""
    points = np.asarray(shapely.points(place_um))
    one, other = shapely.STRtree(points).query(points, predicate="dwithin", distance=_SPARED * offset_um)
    again = np.zeros(len(points), dtype=np.bool_)
    again[one[along_um[one] - along_um[other] > offset_um]] = True
    return again
