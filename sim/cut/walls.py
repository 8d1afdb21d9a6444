"""The walls round a piece that comes free: rings of frame and pieces that still stand then, as far as they are near.

Rings do not cross each other. So of two, the one with the larger area holds the other or not, and one point tells.
"""

from typing import Final, NamedTuple

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from parser.geometry.curves import Bools, Floats, Ints, box_of
from parser.toolpath import Point
from sim.cut.pieces.pieces import Pieces
from sim.cut.regions import Regions

SIMPLER_UM: Final = 0.5
"""Outlines are simplified by so much, once, before anything is held against them."""

_TOGETHER = 64  # sides of a ring that are looked for together


class Walls(NamedTuple):
    """The rings of frame and pieces, r of them, each filled.

    Attributes
    ----------
    rings
        Shapely polygons in a tree.
    inside_um, area_um2
        (r, 2) and (r,) float64, a place in each, and its area.
    until_s
        (r,) float64, until when each stands.
    corner_um
        (c, 2) float64, corners of all rings, simplified by `SIMPLER_UM`, the first of each again as its last.
    runs
        (q, 3) int64, ring, first and last corner of runs of sides, in the order of the corners.
    run_boxes
        The boxes round the runs, in a tree.
    """

    rings: shapely.STRtree
    inside_um: Floats
    area_um2: Floats
    until_s: Floats
    corner_um: Floats
    runs: Ints
    run_boxes: shapely.STRtree

    def since(self, t_s: float) -> "Walls":
        """These walls without the runs of rings that stand no longer after a time."""
        standing = self.runs[self.until_s[self.runs[:, 0]] > t_s]
        return self._replace(runs=standing, run_boxes=_boxes(self.corner_um, standing))


class Room(NamedTuple):
    """Where a piece is when it comes free.

    Attributes
    ----------
    walls
        All of them.
    outline_um
        Of the piece, filled.
    boxes_um
        Two boxes, each lowest and highest (x, y): round the piece and the wire, and round all places it turns through.
    t_s
        When it comes free.
    opening
        Index of the smallest ring that holds it; None where none does.
    """

    walls: Walls
    outline_um: shapely.Polygon
    boxes_um: Floats
    t_s: float
    opening: int | None

    def within(self, far_um: float) -> tuple[BaseGeometry, bool]:
        """Walls as far as this from the piece and the wire, as lines, and whether there are no others."""
        (low, high), (turning_low, turning_high) = self.boxes_um
        low, high = np.minimum(low - far_um, turning_low), np.maximum(high + far_um, turning_high)
        lowest, highest = self._bounds_um()
        is_all = bool((low <= lowest).all() and (high >= highest).all())
        return self._lines(np.sort(self.walls.run_boxes.query(shapely.box(*low, *high)))), is_all

    def ahead(self, toward_deg: Floats, far_um: float) -> tuple[BaseGeometry, bool]:
        """Walls on the way of the piece as it shifts so far in some directions (d,); whether none lies farther."""
        angle = np.radians(toward_deg)
        by_um = far_um * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        corner = shapely.get_coordinates(self.outline_um.convex_hull)
        swept = np.stack([np.broadcast_to(corner, (len(by_um), *corner.shape)), corner + by_um[:, None]], axis=1)
        ways = shapely.convex_hull(shapely.multipoints(swept.reshape(len(by_um), -1, 2)))
        near = np.unique(self.walls.run_boxes.query(ways, predicate="intersects")[1])
        (lowest, highest), (low, high) = self._bounds_um(), box_of(corner)
        farthest_um = np.hypot(*(np.maximum(high, highest) - np.minimum(low, lowest)))
        return self._lines(near), bool(far_um >= farthest_um)

    def _bounds_um(self) -> Floats:
        """Lowest and highest (x, y) of all walls."""
        if self.opening is None:
            return box_of(self.walls.corner_um)
        bounds: Floats = shapely.bounds(self.walls.rings.geometries[self.opening]).reshape(2, 2)
        return bounds

    def _lines(self, near: Ints) -> BaseGeometry:
        """The walls among some runs; runs that follow each other make one line."""
        rings, of = np.unique(self.walls.runs[near, 0], return_inverse=True)
        ring, first, last = self.walls.runs[near[self._are_walls(rings)[of]]].T
        begins = np.append(True, (first[1:] != last[:-1]) | (ring[1:] != ring[:-1]))[: len(ring)]
        ends = np.append(begins[1:], True)[: len(ring)]
        first, number = first[begins], last[ends] + 1 - first[begins]
        of_line = np.repeat(np.arange(len(first)), number)
        corner = np.arange(len(of_line)) - (np.cumsum(number) - number)[of_line] + first[of_line]
        lines: BaseGeometry = shapely.multilinestrings(
            shapely.linestrings(self.walls.corner_um[corner], indices=of_line)
        )
        return lines

    def _are_walls(self, rings: Ints) -> Bools:
        """Which rings (k,) stand, outside of the piece, and are its opening or lie in that."""
        walls = self.walls
        x, y = walls.inside_um[rings].T
        area = walls.area_um2[rings]
        within = shapely.contains_xy(self.outline_um, x, y) & (area < self.outline_um.area)
        is_kept: Bools = (walls.until_s[rings] > self.t_s) & ~within
        if self.opening is not None:
            opening = walls.rings.geometries[self.opening]
            inside = shapely.contains_xy(opening, x, y) & (area < walls.area_um2[self.opening])
            is_kept &= inside | (rings == self.opening)
        return is_kept


def walls_of(pieces: Pieces) -> Walls:
    """All walls that a piece may ever come to touch; at least one piece must have come free."""
    frame = pieces.frame
    standing = frame.openings_um if frame.outline_um is None else (frame.outline_um,)
    lines, of = shapely.get_rings([*standing, *(piece.outline_um for piece in pieces.freed)], return_index=True)
    rings: Regions = np.asarray(shapely.polygons(lines))
    shapely.prepare(rings)
    until = np.array([*(np.inf for _ in standing), *(piece.freed.t_s for piece in pieces.freed)])
    simple = shapely.simplify(lines, SIMPLER_UM, preserve_topology=False)
    corner, ring = shapely.get_coordinates(simple, return_index=True)
    runs = _runs(np.bincount(ring, minlength=len(rings)))
    inside = shapely.get_coordinates(shapely.point_on_surface(rings))
    area = np.asarray(shapely.area(rings))
    return Walls(shapely.STRtree(rings), inside, area, until[of], corner, runs, _boxes(corner, runs))


def room_of(walls: Walls, outline_um: shapely.Polygon, wire_um: Point, t_s: float) -> Room:
    """The room of a filled outline after a time, when the wire is at a place."""
    shapely.prepare(outline_um)
    center = shapely.get_coordinates(outline_um.centroid)[0]
    corner = np.vstack([shapely.get_coordinates(outline_um.exterior), wire_um])
    radius = np.hypot(*(corner[:-1] - center).T).max()
    boxes = np.array([box_of(corner), [center - radius, center + radius]])
    place = outline_um.representative_point()
    near = walls.rings.query(place)
    near = near[(walls.until_s[near] > t_s) & (walls.area_um2[near] > outline_um.area)]
    holding = near[shapely.contains_xy(walls.rings.geometries[near], place.x, place.y)]
    opening = min(holding.tolist(), key=lambda ring: float(walls.area_um2[ring]), default=None)
    return Room(walls, outline_um, boxes, t_s, opening)


def _runs(number: Ints) -> Ints:
    """Runs (q, 3) of rings with so many corners (r,): ring, first and last corner."""
    sides, begin = number - 1, np.cumsum(number) - number
    sides_at_once = -(-sides // _TOGETHER)
    ring = np.repeat(np.arange(len(number)), sides_at_once)
    nth = np.arange(len(ring)) - (np.cumsum(sides_at_once) - sides_at_once)[ring]
    first = nth * _TOGETHER
    last = np.minimum(first + _TOGETHER, sides[ring])
    return np.stack([ring, begin[ring] + first, begin[ring] + last], axis=1)


def _boxes(corner_um: Floats, runs: Ints) -> shapely.STRtree:
    first, last = runs[:, 1], runs[:, 2]
    # A ring's last corner is its first one again, so that it lies in the box of the run before it.
    low = np.minimum(np.minimum.reduceat(corner_um, first), corner_um[last])
    high = np.maximum(np.maximum.reduceat(corner_um, first), corner_um[last])
    boxes: Regions = np.asarray(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))
    return shapely.STRtree(boxes)
