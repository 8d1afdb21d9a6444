"""Sizes of what is kept, as cut and nominal (from the ideal path and the offset): boxes, radii, distances of edges."""

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Bools, Floats, Ints
from parser.toolpath import Point, Toolpath
from sim.cut.kerf.edges import Edges
from sim.cut.kerf.region import Kerf
from sim.cut.pieces.kept_edges import KeptEdges, kept_edges, lie_on, runs_of
from sim.cut.pieces.kept_shapes import KeptShape, kept_shapes
from sim.cut.pieces.pieces import Pieces, stock_of
from sim.cut.sizes.nominal_parts import NominalParts, nominal_parts
from sim.cut.sizes.parallels import KeptLines, facing_pairs, kept_lines
from sim.setup.obstacles import Outline

_LEAST_SWEEP_RAD = np.radians(30.0)  # on a shorter arc, 1 µm on the edge changes the radius by 30 µm and more
_LEAST_RADIUS_UM = 10.0  # of an edge: an arc about a sharp corner leaves less, and no circle to be measured
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


def sizes_of(toolpath: Toolpath, kerf: Kerf, pieces: Pieces, work_um: Outline | None) -> Sizes:
    """Sizes of parts and openings; what the ideal path would not leave has no nominal size and is left out."""
    shapes = kept_shapes(pieces)
    if not shapes:
        return Sizes((), (), ())
    kept = kept_edges(kerf, shapes)
    nominal = nominal_parts(toolpath, stock_of(kerf, work_um), shapes, kept, kerf.offset_um)
    kept = kept.picked(lie_on(shapely.get_rings(nominal.parts_um).tolist(), kept.nominal_um))
    return Sizes(
        tuple(_boxes(shapes, nominal)),
        tuple(_radii(toolpath, kerf, kept)),
        tuple(_distances(kept, kept_lines(toolpath, kerf.edges, kept))),
    )


def _boxes(shapes: tuple[KeptShape, ...], nominal: NominalParts) -> Iterator[BoxSize]:
    """Boxes of shapes with a nominal partner."""
    for shape in shapes:
        partner = nominal.partner(shape)
        if partner is not None:
            center, cut = _box(shape.outline_um)
            yield BoxSize(shape.what, shape.piece, center, cut, _box(partner)[1])


def _box(outline: shapely.Polygon) -> tuple[Point, Point]:
    """Centre of the box round an outline, and its widths."""
    low_x, low_y, high_x, high_y = outline.bounds
    return Point((low_x + high_x) / 2.0, (low_y + high_y) / 2.0), Point(high_x - low_x, high_y - low_y)


def _radii(toolpath: Toolpath, kerf: Kerf, kept: KeptEdges) -> Iterator[RadiusSize]:
    """Radii of 10 µm and more, of the arcs with 30° and more of a kept edge."""
    boss = np.sign(toolpath.sweep_rad[kept.row]) == kept.side
    nominal = toolpath.radius_um[kept.row] + np.where(boss, -kerf.offset_um, kerf.offset_um)
    first = runs_of(kept.row, kept.side)
    number = np.diff(first, append=len(kept.row))
    swept = np.abs(toolpath.sweep_rad[kept.row[first]]) * _shares(kerf.edges, kept, first, number)
    wanted = (number >= _FEWEST) & (swept >= _LEAST_SWEEP_RAD) & (np.nan_to_num(nominal[first]) >= _LEAST_RADIUS_UM)
    if not wanted.any():
        return
    at, first, number = np.flatnonzero(np.repeat(wanted, number)), first[wanted], number[wanted]
    of = np.repeat(np.arange(len(first)), number)
    fits = fitted_circles(kept.cut_um[at], of, toolpath.center_um[kept.row[first]])
    for center, radius, form, edge in zip(fits.center_um, fits.radius_um, fits.form_um, first.tolist(), strict=True):
        what: Literal["hole", "boss"] = "boss" if boss[edge] else "hole"
        block = int(kept.row[edge]) + 1
        yield RadiusSize(what, block, Point(*center.tolist()), float(radius), float(nominal[edge]), float(form))


def _shares(edges: Edges, kept: KeptEdges, first: Ints, number: Ints) -> Floats:
    """Share (k,) of its block, but for the corners, that each edge spans: k of them by first places and numbers."""
    inner = np.bincount(edges.row[edges.inner], minlength=int(edges.row.max(initial=0)) + 1)
    spanned = kept.station[first + number - 1] - kept.station[first]
    shares: Floats = spanned / np.maximum(inner[kept.row[first]] - 1, 1)
    return shares


def _distances(kept: KeptEdges, lines: KeptLines) -> Iterator[DistanceSize]:
    pairs = facing_pairs(lines)
    longest = np.sort(np.argsort(pairs.from_um - pairs.to_um, kind="stable")[:_MOST_PAIRS])
    for one, other, low, high in zip(*(column[longest].tolist() for column in pairs), strict=True):
        start, way = lines.start_um[one], lines.way[one]
        places = [kept.picked(slice(*lines.places[line].tolist())) for line in (one, other)]
        spans = [place.picked(_within((place.nominal_um - start) @ way, low, high)) for place in places]
        if all(len(span.row) for span in spans):
            out = np.array([-way[1], way[0]])
            cut, nominal = (
                float((last @ out).mean() - (first @ out).mean())
                for first, last in ((spans[0].cut_um, spans[1].cut_um), (spans[0].nominal_um, spans[1].nominal_um))
            )
            what: Literal["material", "slot"] = "material" if nominal > 0.0 else "slot"
            blocks = (int(lines.row[one]) + 1, int(lines.row[other]) + 1)
            yield DistanceSize(what, blocks, abs(cut), abs(nominal))


def _within(along_um: Floats, low_um: float, high_um: float) -> Bools:
    within: Bools = (along_um >= low_um) & (along_um <= high_um)
    return within


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
