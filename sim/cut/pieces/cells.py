"""Cells: what each stretch of the wire's way was the first to take, and what they touch.

Cells and parts together are all of the stock, each place in one of them. A part hangs together with what lies behind a
cell until the wire takes that cell.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from parser.geometry.curves import Bools, Ints
from sim.cut.kerf.swept import Box, Swept
from sim.cut.regions import Region, Regions, difference, strings_of, union, union_all

THIN_UM = 0.05
"""Kerfs are exact to 0.1 µm: where the wire runs on its own way again, slivers so thin are left between them."""
_GAP_UM = 0.06  # and what lies as near to each other as a sliver is thick touches
_CONTACT_UM = 0.5  # of border: less is a corner, which holds nothing
_FEW = 6  # kerfs that are taken off a stretch one by one; more are put together first
_WELL_WITHIN = 0.9  # of the reach: rounds on one way differ by less than a tenth of it, two passes mostly by more
_AREAL = 2
_REMADE = 4096  # regions of stretches that are there to be looked at again: some 20 MB of stars, 40 of arcs' bands
_CELLS = 1 << 15  # stretches whose cells are: a piece that is trimmed when it is loose has all its trims round it


class Cell(NamedTuple):
    """A cell, and its outline grown as far as it touches."""

    outline_um: shapely.Polygon
    grown_um: shapely.Polygon


class CellAt(NamedTuple):
    """A cell by its stretch, counted from 0 over all contours in the order they are cut, and its number among those."""

    stretch: int
    number: int


class Cells:
    """The cells of a cut, made where they are looked at; the last ones stay for who looks again.

    Attributes
    ----------
    parts_um
        What is left of the stock: the frame, and all other parts.
    borders_um
        Their borders.
    """

    def __init__(self, stock_um: shapely.Polygon, parts_um: list[shapely.Polygon], swept: Sequence[Swept]) -> None:
        self.parts_um = parts_um
        self._stock, self._swept = stock_um, swept
        shapely.prepare(stock_um)
        self._before = np.cumsum([0, *(len(each.is_band) for each in swept)])
        self._boxes = np.concatenate([np.empty((0, 4)), *(each.boxes[0] for each in swept)])
        self._stretches = shapely.STRtree(shapely.box(*self._boxes.T))
        lines = shapely.linestrings(np.concatenate([np.empty((0, 2, 2)), *(each.chord_um for each in swept)]))
        self._chords: Regions = np.asarray(lines, dtype=np.object_)
        self._reach_um = np.concatenate([np.empty(0), *(each.off_um + each.offset_um + _GAP_UM for each in swept)])
        self.borders_um = [part.boundary for part in parts_um]
        rings = [(ring, at) for at, part in enumerate(parts_um) for ring in (part.exterior, *part.interiors)]
        self._string, ring = strings_of([ring for ring, _ in rings])
        self._part_of_string = np.array([part for _, part in rings], dtype=np.int64)[ring]
        self._strings = shapely.STRtree(self._string)
        self._regions: dict[int, Region] = {}
        self._made: dict[int, list[Cell]] = {}
        self._touched: dict[CellAt, frozenset[int]] = {}

    def place_of(self, stretch: int) -> tuple[int, int]:
        """The contour of a stretch, and the index of the stretch among those of that contour."""
        contour = int(np.searchsorted(self._before, stretch, side="right")) - 1
        return contour, stretch - int(self._before[contour])

    def stretches_near(self, box: Box) -> Ints:
        """Stretches whose boxes come near a box, the last ones first."""
        low_x, low_y, high_x, high_y = box
        grown = shapely.box(low_x - _GAP_UM, low_y - _GAP_UM, high_x + _GAP_UM, high_y + _GAP_UM)
        near: Ints = np.sort(self._stretches.query(grown))[::-1]
        return near

    def near_line(self, line: BaseGeometry, stretches: Ints) -> Ints:
        """Those of some stretches whose regions come near some line or lines, in their order."""
        shapely.prepare(line)
        is_near = shapely.dwithin(line, self._chords[stretches], self._reach_um[stretches])  # type: ignore[call-overload]
        near: Ints = stretches[is_near]
        return near

    def of_stretch(self, stretch: int) -> list[Cell]:
        """The cells of a stretch: none where the wire went through what was cut already."""
        if stretch not in self._made:
            if len(self._made) > _CELLS:
                self._made.clear()
                self._touched.clear()
            self._made[stretch] = self._cells(stretch)
        return self._made[stretch]

    def cell(self, at: CellAt) -> Cell:
        """A cell."""
        return self.of_stretch(at.stretch)[at.number]

    def touched(self, at: CellAt) -> frozenset[int]:
        """Indices of the parts that a cell touches."""
        if at not in self._touched:
            self._touched[at] = self._touched_by(self.cell(at))
        return self._touched[at]

    def shared_um(self, cell: Cell, node: "int | CellAt") -> BaseGeometry:
        """What a cell has in common with the border of a part or of another cell."""
        if isinstance(node, CellAt):
            return shapely.intersection(self.cell(node).outline_um.boundary, cell.grown_um)
        string = self._strings.query(cell.grown_um)
        own = self._string[string[self._part_of_string[string] == node]]
        return shapely.union_all(shapely.intersection(own, cell.grown_um))

    def up_to(self, stretch: int, at: int, since: int, wider_um: float) -> Region:
        """What a wider wire sweeps on a stretch from a place to another, by their indices on the way."""
        contour, own = self.place_of(stretch)
        return self._swept[contour].up_to(own, at, since, wider_um)

    def _touched_by(self, cell: Cell) -> frozenset[int]:
        string = self._strings.query(cell.grown_um, predicate="intersects")
        if not len(string):
            return frozenset()
        length = shapely.length(shapely.intersection(self._string[string], cell.grown_um))
        total = np.bincount(self._part_of_string[string], weights=length)
        return frozenset(np.flatnonzero(total >= _CONTACT_UM).tolist())

    def _cells(self, stretch: int) -> list[Cell]:
        near = self._stretches.query(shapely.box(*self._boxes[stretch]))
        (left,) = self._regions_of([stretch])
        kerfs = np.array(self._regions_of(np.sort(near[near < stretch]).tolist()), dtype=np.object_)
        kerfs = kerfs[shapely.intersects(kerfs, left)]
        if len(kerfs) > _FEW and not len(thick(left := self._behind_repeats(stretch, left, kerfs))):
            return []
        for kerf in kerfs if len(kerfs) <= _FEW else [union_all(kerfs)]:
            left = difference(left, kerf)
        if not self._stock.contains(shapely.box(*self._boxes[stretch])):
            left = shapely.intersection(left, self._stock)
        parts = thick(left)
        return [Cell(*pair) for pair in zip(parts.tolist(), _grown(parts).tolist(), strict=True)]

    def _behind_repeats(self, stretch: int, left: Region, kerfs: Regions) -> Region:
        """What is left of a stretch behind the latest kerfs that reach to its sides and to both of its ends.

        Where the wire runs on its own way again, one of these takes all, and the union of many is saved.
        """
        first, last = shapely.get_coordinates(self._chords[stretch])
        ahead = (last - first) * _WELL_WITHIN * self._reach_um[stretch] / max(np.hypot(*(last - first)), THIN_UM)
        aside, middle = np.array([-ahead[1], ahead[0]]), (first + last) / 2.0
        for limit in (last + ahead, first - ahead, middle - aside, middle + aside):
            kerfs = kerfs[shapely.contains_xy(kerfs, *limit)]
        for kerf in kerfs[: -_FEW - 1 : -1]:
            left = difference(left, kerf)
            if not len(thick(left)):
                break
        return left

    def _regions_of(self, stretches: list[int]) -> list[Region]:
        if len(self._regions) > _REMADE:
            self._regions.clear()
        lacking = np.array([each for each in stretches if each not in self._regions], dtype=np.int64)
        contour = np.searchsorted(self._before, lacking, side="right") - 1
        for each in np.unique(contour).tolist():
            own = lacking[contour == each]
            regions: Regions = self._swept[each].of_stretches(own - self._before[each])
            self._regions.update(zip(own.tolist(), regions, strict=True))
        return [self._regions[each] for each in stretches]


def thick(region: Region) -> Regions:
    """The parts (k,) of a region that are no slivers: these are twice their area by their border thick."""
    parts = shapely.get_parts(region)
    parts = parts[shapely.get_dimensions(parts) == _AREAL]
    those: Regions = parts[2.0 * shapely.area(parts) > THIN_UM * shapely.length(parts)]
    return those


def contacts(shared_um: list[BaseGeometry]) -> Regions:
    """Regions (k,) along what cells have in common with others."""
    return _grown(np.array(shared_um, dtype=np.object_))


def are_in_contact(left_um: Regions, contact_um: Regions) -> Bools:
    """Whether what is left of a cell reaches one of its contacts, by more than a corner; arrays are broadcast."""
    area = shapely.area(shapely.intersection(left_um, contact_um))
    touches: Bools = area >= 0.5 * _GAP_UM * _CONTACT_UM
    return touches


def _grown(shapes: Regions) -> Regions:
    grown: Regions = shapely.buffer(shapes, _GAP_UM, quad_segs=1, cap_style="flat", join_style="mitre")
    return grown


def touch(cell: Cell, other: Cell) -> bool:
    """Whether two cells have more than a corner in common: grown, they overlap along it."""
    area = shapely.area(shapely.intersection(cell.grown_um, other.grown_um))
    return bool(area >= _GAP_UM * _CONTACT_UM)


def joined_um(polygons: list[shapely.Polygon], within: shapely.Point) -> shapely.Polygon:
    """Polygons that hang together as one, round a place of it; all but the first are grown to touch the others."""
    whole: Region = polygons[0]
    more = _grown(np.array(polygons[1:], dtype=np.object_))
    for each in more if len(more) <= _FEW else [union_all(more)]:
        whole = union(whole, each)
    parts = shapely.get_parts(whole)
    round_it: list[shapely.Polygon] = parts[shapely.contains(parts, within)].tolist()
    return round_it[0]
