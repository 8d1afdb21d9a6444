"""When a piece comes free: the first place of the wire at which its kerf parts it from the frame."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from parser.geometry.curves import Floats
from sim.cut.kerf.stars import stars
from sim.cut.kerf.swept import Swept, middles
from sim.cut.kerf.ways import WireWay
from sim.cut.regions import Region, difference, union

_SPARED = 0.1  # offsets: a wire that reaches less deep into a piece only takes off what an earlier cut left on it


class FreeMoment(NamedTuple):
    """When a piece comes free.

    Attributes
    ----------
    contour
        Index of the contour.
    at
        Index of the place on the wire's way through it.
    piece_um
        The piece at that moment; what is cut later may still take from it.
    """

    contour: int
    at: int
    piece_um: shapely.Polygon


class FreeQuestion(NamedTuple):
    """The question whether a piece is free of its frame: the stock of both, a point in the piece, one in the frame."""

    stock_um: shapely.Polygon
    piece: shapely.Point
    frame: shapely.Point

    def free(self, kerf_um: Region) -> shapely.Polygon | None:
        """The piece, where a kerf parts it from the frame; else None."""
        part = next((part for part in parted(self.stock_um, kerf_um) if part.contains(self.piece)), None)
        return None if part is None or part.contains(self.frame) else part


def parted(stock_um: shapely.Polygon, kerf_um: Region) -> list[shapely.Polygon]:
    """Parts of a stock, µm, that a kerf leaves, each a polygon; none where it leaves nothing."""
    parts: list[shapely.Polygon] = shapely.get_parts(difference(stock_um, kerf_um)).tolist()
    return parts


def moment_of(
    question: FreeQuestion, swept: tuple[Swept, ...], contours: list[int], offset_um: float
) -> FreeMoment | None:
    """The first moment at which the kerfs of some contours, in the order they are cut, answer the question with yes."""
    before: Region = shapely.Polygon()
    for contour in contours:
        kerf = union(before, swept[contour].region_um)
        piece = question.free(kerf)
        if piece is not None:
            return _within(question, before, swept[contour], offset_um, FreeMoment(contour, -1, piece))
        before = kerf
    return None


def _within(question: FreeQuestion, before: Region, swept: Swept, offset_um: float, whole: FreeMoment) -> FreeMoment:
    """The moment on the wire's way whose whole kerf frees the piece: halves the stretches, then the places of one."""
    stretch = 0
    for level in swept.levels[-2::-1]:
        stretch *= 2
        if stretch + 1 < len(level):
            kerf = union(before, level[stretch])
            if question.free(kerf) is None:
                before, stretch = kerf, stretch + 1
    way = swept.way
    piece = question.free(union(before, swept.levels[0][stretch])) or whole.piece_um
    middle = middles(way, swept.first)[stretch : stretch + 1]
    first, past = np.append(swept.first, len(way.row))[stretch : stretch + 2].tolist()
    low, high = first - 1, past - 1
    while high - low > 1:
        at = (low + high) // 2
        star = stars(way.place_um[first : at + 1], np.zeros(1, dtype=np.int64), middle, offset_um)
        found = question.free(union(before, star[0]))
        low, high, piece = (at, high, piece) if found is None else (low, at, found)
    return FreeMoment(whole.contour, high, piece)


def cut_on_um(piece_um: shapely.Polygon, ways: Iterable[WireWay], offset_um: float) -> float:
    """How far the wire goes on in a piece along some ways, not counting where it runs along its own kerf again."""
    shapely.prepare(piece_um)
    inside = [_inside(piece_um, way, offset_um) for way in ways]
    length = np.concatenate([np.diff(way.along_um, prepend=way.along_um[:1])[at] for way, at in inside])
    place = np.concatenate([way.place_um[at] for way, at in inside])
    return float(length[~_again(place, np.cumsum(length), offset_um)].sum())


def _inside(piece_um: shapely.Polygon, way: WireWay, offset_um: float) -> tuple[WireWay, NDArray[np.bool_]]:
    cuts = shapely.dwithin(piece_um, shapely.points(way.place_um), (1.0 - _SPARED) * offset_um)
    return way, np.asarray(cuts)


def _again(place_um: Floats, along_um: Floats, offset_um: float) -> NDArray[np.bool_]:
    """Whether the way was at each of the places (m, 2) before: more than an offset earlier by its length (m,)."""
    points = np.asarray(shapely.points(place_um))
    one, other = shapely.STRtree(points).query(points, predicate="dwithin", distance=_SPARED * offset_um)
    again = np.zeros(len(points), dtype=np.bool_)
    again[one[along_um[one] - along_um[other] > offset_um]] = True
    return again
