"""When a piece comes free: the first place of the wire at which its kerf parts it from the frame."""

from typing import NamedTuple

import numpy as np
import shapely

from sim.cut.kerf.swept import Region, Swath, middles, stars


class Moment(NamedTuple):
    """When a piece comes free.

    Attributes
    ----------
    contour
        Index of the contour.
    at
        Index of the place on its passage.
    piece_um
        The piece at that moment; what is cut later may still take from it.
    """

    contour: int
    at: int
    piece_um: shapely.Polygon


class Question(NamedTuple):
    """Is a piece free? Of a stock, by a point of the piece and one of the frame."""

    stock_um: shapely.Polygon
    piece: shapely.Point
    frame: shapely.Point

    def free(self, kerf_um: Region) -> shapely.Polygon | None:
        """The piece, where a kerf parts it from the frame; else None."""
        part = next((part for part in parted(self.stock_um, kerf_um) if part.contains(self.piece)), None)
        return None if part is None or part.contains(self.frame) else part


def parted(stock_um: shapely.Polygon, kerf_um: Region) -> list[shapely.Polygon]:
    """Parts of a stock, µm, that a kerf leaves, each a polygon; none where it leaves nothing."""
    parts: list[shapely.Polygon] = shapely.get_parts(shapely.difference(stock_um, kerf_um)).tolist()
    return parts


def moment_of(question: Question, swaths: tuple[Swath, ...], contours: list[int], offset_um: float) -> Moment | None:
    """The first moment at which the kerfs of some contours, in the order they are cut, answer the question with yes."""
    before: Region = shapely.Polygon()
    for contour in contours:
        kerf = shapely.union(before, swaths[contour].region_um)
        piece = question.free(kerf)
        if piece is not None:
            return _within(question, before, swaths[contour], offset_um, Moment(contour, -1, piece))
        before = kerf
    return None


def _within(question: Question, before: Region, swath: Swath, offset_um: float, whole: Moment) -> Moment:
    """The moment on a passage that frees the piece as a whole: by halves of its stretches, then by its places."""
    stretch = 0
    for level in swath.levels[-2::-1]:
        stretch *= 2
        if stretch + 1 < len(level):
            kerf = shapely.union(before, level[stretch])
            if question.free(kerf) is None:
                before, stretch = kerf, stretch + 1
    passage, piece = swath.passage, whole.piece_um
    middle = middles(passage, swath.first)[stretch : stretch + 1]
    first, past = np.append(swath.first, len(passage.row))[stretch : stretch + 2].tolist()
    low, high = first - 1, past - 1
    while high - low > 1:
        at = (low + high) // 2
        star = stars(passage.place_um[first : at + 1], np.zeros(1, dtype=np.int64), middle, offset_um)
        found = question.free(shapely.union(before, star[0]))
        low, high, piece = (at, high, piece) if found is None else (low, at, found)
    return Moment(whole.contour, high, piece)
