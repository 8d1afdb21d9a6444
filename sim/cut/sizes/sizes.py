"""Sizes of what is kept, as cut and nominal (from the ideal path and the offset): boxes, radii, distances of edges."""

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from parser.shape.contours import contour_rows
from parser.toolpath import Point, Toolpath
from sim.cut.kerf.edges import Edges
from sim.cut.kerf.nominal import nominal_region
from sim.cut.kerf.region import Kerf
from sim.cut.pieces.frees import parted
from sim.cut.pieces.kept_edges import Kept, edge_places, kept_edges
from sim.cut.pieces.pieces import Pieces, stock_of
from sim.cut.sizes.parallels import Pairs, facing_pairs
from sim.setup.obstacles import Outline

_LEAST_SWEEP_RAD = np.radians(30.0)  # on a shorter arc, 1 µm on the edge changes the radius by 30 µm and more
_MOST_PAIRS = 50  # more than anyone reads
_FEWEST = 4  # places of a circle that can tell its form
_ROUNDS = 4  # of Gauss-Newton; each squares the relative error, at first some µm in some mm


class BoxSize(NamedTuple):
    """Box round a part, round a hole in it, or round an opening in the frame that a slug fell out of.

    `piece` is the index of the part or the slug; `cut_um` and `nominal_um` are widths along X and Y.
    """

    what: Literal["part", "hole", "opening"]
    piece: int
    center_um: Point
    cut_um: Point
    nominal_um: Point


class RadiusSize(NamedTuple):
    """Radius of an arc's kept edge, inside of a hole or outside of a boss, with block number and centre as cut.

    `form_um` is the width of the ring that holds the edge.
    """

    what: Literal["hole", "boss"]
    block: int
    center_um: Point
    cut_um: float
    nominal_um: float
    form_um: float


class DistanceSize(NamedTuple):
    """Distance of two parallel straight edges, with material or a slot between them, and their block numbers."""

    what: Literal["material", "slot"]
    blocks: tuple[int, int]
    cut_um: float
    nominal_um: float


class Sizes(NamedTuple):
    """All sizes that were found; distances of at most 50 pairs of edges, those that face each other longest."""

    boxes: tuple[BoxSize, ...]
    radii: tuple[RadiusSize, ...]
    distances: tuple[DistanceSize, ...]


class _Shape(NamedTuple):
    """A filled outline to be measured, and what it is."""

    what: Literal["part", "hole", "opening"]
    piece: int
    outline_um: shapely.Polygon


def sizes_of(toolpath: Toolpath, kerf: Kerf, pieces: Pieces, work_um: Outline | None) -> Sizes:
    """Sizes of parts and openings; a shape that the ideal path would not leave has no nominal size and is left out."""
    kept = kept_edges(kerf, pieces)
    parts = parted(stock_of(kerf, work_um), nominal_region(toolpath, ~toolpath.is_jump, kerf.offset_um))
    return Sizes(
        tuple(_boxes(list(_shapes(pieces)), parts)),
        tuple(_radii(toolpath, kerf, kept)),
        tuple(_distances(toolpath, kerf, kept, facing_pairs(toolpath, kept, contour_rows(toolpath)))),
    )


def _shapes(pieces: Pieces) -> Iterator[_Shape]:
    """Parts, holes in them, and openings that slugs left in the frame; a slug out of a part left one of the holes."""
    parts = [shapely.Polygon(piece.outline_um.exterior) for piece in pieces.freed if piece.kind == "part"]
    openings = pieces.frame.openings_um
    for index, piece in enumerate(pieces.freed):
        inside = piece.outline_um.representative_point()
        if piece.kind == "part":
            yield _Shape("part", index, piece.outline_um)
            yield from (_Shape("hole", index, shapely.Polygon(ring)) for ring in piece.outline_um.interiors)
        elif not shapely.contains(parts, inside).any():
            yield from (
                _Shape("opening", index, openings[at]) for at in np.flatnonzero(shapely.contains(openings, inside))
            )


def _boxes(shapes: list[_Shape], nominal_parts: list[shapely.Polygon]) -> Iterator[BoxSize]:
    """Boxes of shapes with a nominal partner: of a part among the parts, of a hole or an opening among their holes."""
    holes = [shapely.Polygon(ring) for part in nominal_parts for ring in part.interiors]
    trees = shapely.STRtree(nominal_parts), shapely.STRtree(holes)
    for what, piece, outline in shapes:
        tree = trees[0] if what == "part" else trees[1]
        found = tree.geometries[tree.query(outline.representative_point(), predicate="within")]
        if len(found):
            nominal = min(found.tolist(), key=lambda one: one.area)
            center, cut = _box(outline)
            yield BoxSize(what, piece, center, cut, _box(nominal)[1])


def _box(outline: shapely.Polygon) -> tuple[Point, Point]:
    """Centre of the box round an outline, and its widths."""
    low_x, low_y, high_x, high_y = outline.bounds
    return Point((low_x + high_x) / 2.0, (low_y + high_y) / 2.0), Point(high_x - low_x, high_y - low_y)


def _radii(toolpath: Toolpath, kerf: Kerf, kept: Kept) -> Iterator[RadiusSize]:
    """Radii of the arcs of 30° and more with a kept edge."""
    boss = np.sign(toolpath.sweep_rad) == kept.side
    nominal = toolpath.radius_um + np.where(boss, -kerf.offset_um, kerf.offset_um)
    wanted = toolpath.is_arc & (np.abs(toolpath.sweep_rad) >= _LEAST_SWEEP_RAD) & (kept.side != 0) & (nominal > 0.0)
    edges = kerf.edges
    at = np.flatnonzero(edges.inner & ~np.isnan(edges.left_um) & wanted[edges.row])
    row, of, number = np.unique(edges.row[at], return_inverse=True, return_counts=True)
    at, row = at[(number >= _FEWEST)[of]], row[number >= _FEWEST]
    if not len(row):
        return
    place = edge_places(edges, kept.side[edges.row])[at]
    fits = fitted_circles(place, np.searchsorted(row, edges.row[at]), toolpath.center_um[row])
    for center, radius, form, block in zip(fits.center_um, fits.radius_um, fits.form_um, row.tolist(), strict=True):
        what: Literal["hole", "boss"] = "boss" if boss[block] else "hole"
        yield RadiusSize(what, block + 1, Point(*center.tolist()), float(radius), float(nominal[block]), float(form))


def _distances(toolpath: Toolpath, kerf: Kerf, kept: Kept, pairs: Pairs) -> Iterator[DistanceSize]:
    edges, side = kerf.edges, kept.side[kerf.edges.row]
    cut, nominal = edge_places(edges, side), edges.place_um + (side * kerf.offset_um)[:, None] * edges.left
    longest = np.sort(np.argsort(pairs.from_um - pairs.to_um, kind="stable")[:_MOST_PAIRS])
    for one, other, low, high in zip(*(column[longest].tolist() for column in pairs), strict=True):
        start = toolpath.start_um[one]
        way = (toolpath.end_um[one] - start) / toolpath.length_um[one]
        out = kept.side[one] * np.array([-way[1], way[0]])
        at = [_within(edges, row, (edges.place_um - start) @ way, (low, high)) for row in (one, other)]
        if all(len(stations) for stations in at):
            by = [float((place[at[1]] @ out).mean() - (place[at[0]] @ out).mean()) for place in (cut, nominal)]
            what: Literal["material", "slot"] = "material" if by[1] > 0.0 else "slot"
            yield DistanceSize(what, (one + 1, other + 1), abs(by[0]), abs(by[1]))


def _within(edges: Edges, row: int, along_um: Floats, span_um: tuple[float, float]) -> Ints:
    """Inner stations of a row that the wire cut and that lie in a span along the other line."""
    found = (edges.row == row) & edges.inner & ~np.isnan(edges.left_um)
    return np.flatnonzero(found & (along_um >= span_um[0]) & (along_um <= span_um[1]))


class Fits(NamedTuple):
    """Circles (k,): centres (k, 2), radii, and the width of the ring that holds the places of each, all µm."""

    center_um: Floats
    radius_um: Floats
    form_um: Floats


def fitted_circles(place_um: Floats, of: Ints, center_um: Floats) -> Fits:
    """Circles that lie nearest to the places (m, 2) of each arc, by the sum of squares of the distances.

    `of` (m,) is the index of each place's arc; it never falls, and each of the k arcs has a place. `center_um` (k, 2)
    are first guesses of the centres. Gauss-Newton on the distances from the circle: r ≈ R + x cos φ + y sin φ.
    """
    first, center = np.flatnonzero(np.diff(of, prepend=-1)), center_um
    for _ in range(_ROUNDS):
        out = place_um - center[of]
        distance = np.hypot(out[:, 0], out[:, 1])
        columns = np.column_stack([np.ones(len(of)), out / distance[:, None]])
        normal = np.add.reduceat(columns[:, :, None] * columns[:, None, :], first, axis=0)
        right = np.add.reduceat(columns * distance[:, None], first, axis=0)
        solved = np.linalg.solve(normal, right[:, :, None])[:, :, 0]
        center = center + solved[:, 1:]
    distance = np.hypot(*(place_um - center[of]).T)
    form = np.maximum.reduceat(distance, first) - np.minimum.reduceat(distance, first)
    return Fits(center, np.add.reduceat(distance, first) / np.diff(first, append=len(of)), form)
