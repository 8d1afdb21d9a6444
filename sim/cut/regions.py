"""Regions that a cut makes: union and difference for every input, and outlines with fewer corners for who tells them.

GEOS nodes edges at full precision. Where kerfs of several passes abut or nearly coincide, rounding may put a node on
the wrong side of an edge, and GEOS gives up. Then the same is done once more on a grid, with outlines that do not cross
themselves: each corner moves by half a cell at most, and no rounding is left to go wrong (J. D. Hobby, Computational
Geometry 13 (1999) 199).

Outlines of what a cut leaves with fewer corners, for those who tell or draw them.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.errors import GEOSException
from shapely.geometry.base import BaseGeometry

from parser.geometry.curves import Ints, total_before

Region = BaseGeometry
"""A polygon or a multipolygon, µm."""

Regions = NDArray[np.object_]
"""(n,) of them; shapely's arrays have no type of their own."""

_GRID_UM = 1e-3  # far finer than the 0.1 µm that a kerf is exact to


class RegionError(ArithmeticError):
    """A region that GEOS could not work out, on any grid, and the first and last block that it was cut by."""

    def __init__(self, first: int, last: int) -> None:
        super().__init__(first, last)
        self.first, self.last = first, last


@contextmanager
def cut_by_blocks(first: int, last: int) -> Iterator[None]:
    """RegionError with these blocks where GEOS finds no answer to what is asked within."""
    try:
        yield
    except GEOSException as error:
        raise RegionError(first, last) from error


def union(this: Region, other: Region) -> Region:
    """Union of two regions."""
    return _robust(shapely.union, (this, other))


def unions(this: Regions, other: Regions) -> Regions:
    """Union of each of n regions with its partner, (n,)."""
    try:
        both: Regions = np.asarray(shapely.union(this, other), dtype=np.object_)
    except GEOSException:  # of one pair or more
        both = np.array([union(*pair) for pair in zip(this, other, strict=True)], dtype=np.object_)
    return both


def union_all(regions: Iterable[Region]) -> Region:
    """Union of all regions; empty of none."""
    return _robust(_union_all, tuple(regions))


def _union_all(*regions: Region, grid_size: float | None = None) -> Region:
    if grid_size is not None:
        return shapely.union_all(list(regions), grid_size=grid_size)
    apart: Region = shapely.disjoint_subset_union_all(list(regions))  # where most are, in a hundredth of the time
    return apart


def difference(this: Region, other: Region) -> Region:
    """What of a region lies outside of another."""
    return _robust(shapely.difference, (this, other))


def parted(stock_um: Region, kerf_um: Region) -> list[shapely.Polygon]:
    """Parts of a stock, µm, that a kerf leaves, each a polygon; none where it leaves nothing."""
    parts: list[shapely.Polygon] = shapely.get_parts(difference(stock_um, kerf_um)).tolist()
    return parts


def _robust(made: Callable[..., Region], regions: tuple[Region, ...]) -> Region:
    try:
        return made(*regions)
    except GEOSException:
        whole = shapely.make_valid(np.array(regions, dtype=np.object_), method="structure", keep_collapsed=False)
        return made(*whole, grid_size=_GRID_UM)


Outline = TypeVar("Outline", shapely.LinearRing, shapely.Polygon)


def simpler(outline: Outline, by_um: float) -> Outline:
    """An outline that leaves its own by no more than `by_um`, and never crosses itself.

    That is what ``shapely.simplify`` gives, which looks at every corner for crossings: 0.3 s for 365,000 corners. Here
    it is asked only where simplifying without looking has made a crossing, or left nothing: 0.03 s.
    """
    plain: Outline = shapely.simplify(outline, by_um, preserve_topology=False)
    if not plain.is_empty and plain.is_valid:
        return plain
    simplified: Outline = shapely.simplify(outline, by_um)
    return simplified


_STRING = 64  # corners, at most
_STRING_UM = 2000.0


def strings_of(rings: list[shapely.LinearRing]) -> tuple[Regions, Ints]:
    """Rings in strings of some corners and some length, and the ring of each: their boxes have few places in them."""
    corner, ring = shapely.get_coordinates(shapely.segmentize(rings, _STRING_UM), return_index=True)
    first = np.flatnonzero(np.diff(ring, prepend=-1))
    number = np.arange(len(ring)) - first[ring]
    last = np.append(first[1:], len(ring))[ring] - 1
    along = total_before(np.hypot(*np.diff(corner, axis=0).T))
    part = np.floor((along - along[first][ring]) / _STRING_UM)
    ends = (np.diff(part, prepend=-1.0) != 0.0) | (number % _STRING == 0)
    begin = np.flatnonzero(ends & (np.arange(len(ring)) < last))
    past = np.minimum(np.append(begin[1:], len(ring)), last[begin]) + 1
    of = np.repeat(np.arange(len(begin)), past - begin)
    at = np.arange(len(of)) - (np.cumsum(past - begin) - past)[of]
    return shapely.linestrings(corner[at], indices=of), ring[begin]
