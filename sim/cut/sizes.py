"""The sizes of what is kept, beside their nominal ones; the border type is `Sizes`.

The parts that the ideal path would leave, as far as shapes that are kept tell of them.

Sizes of what is kept, as cut and nominal (from the ideal path and the offset): boxes, radii, distances of edges.

Pairs of straight kept edges that run parallel and face each other: thicknesses of the part, widths of its slots.
"""

from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.along import to_left
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.toolpath import Point, Toolpath
from sim.cut.kerf.edges import Edges, nominal_region
from sim.cut.kerf.swept import Kerf
from sim.cut.pieces.kept_edges import KeptEdges, KeptShape, kept_edges, kept_shapes, lie_on, runs_of
from sim.cut.pieces.pieces import Pieces, stock_of
from sim.cut.regions import Regions, parted
from sim.setup.obstacles import Outline

_BESIDE = 2.0  # offsets from a shape to the border of its box: the kerf beside it, and what lies behind that


class NominalParts:
    """Parts, polygons `parts_um`, and the partners of shapes among them and their holes."""

    def __init__(self, parts_um: list[shapely.Polygon]) -> None:
        self.parts_um = parts_um
        holes = [shapely.Polygon(ring) for part in parts_um for ring in part.interiors]
        self._parts, self._holes = shapely.STRtree(parts_um), shapely.STRtree(holes)

    def partner(self, shape: KeptShape) -> shapely.Polygon | None:
        """Partner of a shape: of a part among the parts, of a hole or an opening the least among their holes."""
        tree = self._parts if shape.what == "part" else self._holes
        found = tree.geometries[tree.query(shape.outline_um.representative_point(), predicate="within")]
        return min(found.tolist(), key=lambda each: each.area, default=None)


def nominal_parts(
    toolpath: Toolpath,
    stock_um: shapely.Polygon,
    shapes: tuple[KeptShape, ...],
    kept_edges: KeptEdges,
    wire_um: Floats,
) -> NominalParts:
    """Parts that the ideal path leaves of a stock, true to shapes and to the nominal places of their kept edges.

    They are worked out in boxes round the shapes. What is closed in within its box is the same in all of the stock; if
    a partner is not, or is not found, all of the stock is cut.
    """
    boxes, cut = _boxes_round(shapes, kept_edges, _BESIDE * float(wire_um.max())), ~toolpath.is_jump
    near = NominalParts(parted(stock_um, nominal_region(toolpath, cut, wire_um, boxes)))
    if _all_within(((near.partner(shape) for shape in shapes)), boxes):
        return near
    return NominalParts(parted(stock_um, nominal_region(toolpath, cut, wire_um)))


def _boxes_round(shapes: tuple[KeptShape, ...], kept_edges: KeptEdges, beside_um: float) -> Regions:
    """Boxes (s,) round shapes and what is kept of their edges."""
    bounds: Floats = shapely.bounds([shape.outline_um for shape in shapes])
    np.minimum.at(bounds[:, :2], kept_edges.shape, kept_edges.nominal_um)
    np.maximum.at(bounds[:, 2:], kept_edges.shape, kept_edges.nominal_um)
    low, high = bounds[:, :2] - beside_um, bounds[:, 2:] + beside_um
    boxes: Regions = np.asarray(shapely.box(*low.T, *high.T))
    return boxes


def _all_within(partners: Iterable[shapely.Polygon | None], boxes: Regions) -> bool:
    pairs = zip(partners, boxes.tolist(), strict=True)
    return all(each is not None and box.contains_properly(shapely.box(*each.bounds)) for each, box in pairs)


_MOST_LINES = 400  # the longest, that are paired with each other
_PARALLEL_RAD = 1e-3  # ends in whole µm turn a line of 1 mm by as much
_OVERLAP_UM = 1000.0  # or half the shorter line


class KeptLines(NamedTuple):
    """Straight kept edges, m of them: each on one outline, as far as it is kept, run through with it on the left.

    Attributes
    ----------
    row, shape
        (m,) int64, row of the toolpath, and index of the shape whose outline it is.
    places
        (m, 2) int64, first of its places among the kept edges, and one past the last.
    start_um, way, length_um
        (m, 2), (m, 2), (m,) float64: start and unit direction on the wire's path beside it, and length.
    """

    row: Ints
    shape: Ints
    places: Ints
    start_um: Floats
    way: Floats
    length_um: Floats


class Pairs(NamedTuple):
    """Indices (k,) of two lines each, and from where to where along the first of them, from its start, they overlap."""

    this: Ints
    other: Ints
    from_um: Floats
    to_um: Floats


def kept_lines(curves: Curves, edges: Edges, edges_of_part: KeptEdges) -> KeptLines:
    """The longest of the straight edges, in the order of their rows.

    Short of a corner no edge is measured. An edge that is kept up to there counts up to the end of its block.
    """
    first = runs_of(edges_of_part.row, edges_of_part.side, edges_of_part.shape)
    past = np.append(first, len(edges_of_part.row))[1:]
    straight = ~curves.is_arc[edges_of_part.row[first]] & (curves.length_um[edges_of_part.row[first]] > 0.0)
    first, past = first[straight], past[straight]
    row, side = edges_of_part.row[first], edges_of_part.side[first]
    ahead = (curves.end_um[row] - curves.start_um[row]) / curves.length_um[row][:, None]
    begin, end = _reaching(curves, edges, row, edges_of_part.station[first], edges_of_part.station[past - 1])
    start = curves.start_um[row] + np.where(side > 0, begin, end)[:, None] * ahead
    places = np.stack([first, past], axis=1)
    length, way = end - begin, side[:, None] * ahead
    longest = np.sort(np.argsort(-length, kind="stable")[:_MOST_LINES])
    columns = row[longest], edges_of_part.shape[first][longest], places[longest]
    return KeptLines(*columns, start[longest], way[longest], length[longest])


def _reaching(curves: Curves, edges: Edges, row: Ints, first: Ints, last: Ints) -> tuple[Floats, Floats]:
    """From where to where along their rows (m,) edges reach that are kept from a `first` to a `last` station (m,)."""
    inner = np.flatnonzero(edges.inner)
    first_inner = inner[np.searchsorted(edges.row[inner], row)]
    last_inner = inner[np.searchsorted(edges.row[inner], row, side="right") - 1]
    low, high = (np.hypot(*(edges.place_um[station] - curves.start_um[row]).T) for station in (first, last))
    return np.where(first == first_inner, 0.0, low), np.where(last == last_inner, curves.length_um[row], high)


def facing_pairs(lines: KeptLines) -> Pairs:
    """Each line with the nearest one that faces it, every pair once, along the same outline."""
    way = lines.way
    crossed = way[:, None, 0] * way[None, :, 1] - way[:, None, 1] * way[None, :, 0]
    facing = (way @ way.T < 0.0) & (np.abs(crossed) < _PARALLEL_RAD)
    facing &= lines.shape[:, None] == lines.shape
    low, high = _overlaps(lines)
    facing &= high - low >= np.minimum(_OVERLAP_UM, 0.5 * np.minimum(lines.length_um[:, None], lines.length_um))
    this, other = _nearest(lines, facing)
    return Pairs(this, other, low[this, other], high[this, other])


def _overlaps(lines: KeptLines) -> tuple[Floats, Floats]:
    """From where and to where along each line each other line lies beside it; both (m, m) µm."""
    ends = lines.start_um + lines.length_um[:, None] * lines.way
    along = [
        (lines.way @ place.T) - (lines.way * lines.start_um).sum(axis=1)[:, None] for place in (lines.start_um, ends)
    ]
    low, high = np.minimum(*along), np.maximum(*along)
    return np.maximum(low, 0.0), np.minimum(high, lines.length_um[:, None])


def _nearest(lines: KeptLines, facing: Bools) -> tuple[Ints, Ints]:
    """Pairs of each line with the nearest line that faces it, every pair once; indices of both."""
    across = to_left(lines.way)
    middle = lines.start_um + 0.5 * lines.length_um[:, None] * lines.way
    off = np.abs(across @ middle.T - (across * lines.start_um).sum(axis=1)[:, None])
    off[~facing] = np.inf
    this = np.flatnonzero(facing.any(axis=1))
    other = np.argmin(off[this], axis=1) if len(this) else this
    pairs = np.unique(np.sort(np.stack([this, other], axis=1), axis=1), axis=0).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]


_LEAST_SWEEP_RAD = np.radians(30.0)  # on a shorter arc, 1 µm on the edge changes the radius by 30 µm and more
_LEAST_RADIUS_UM = 10.0  # of an edge: an arc about a sharp corner leaves less, and no circle to be measured
_MOST_PAIRS = 50  # more than anyone reads
_FEWEST = 4  # places of a circle that can tell its form
_ROUNDS = 4  # of Gauss-Newton; each squares the relative error, at first some µm in some mm


class BoxSize(NamedTuple):
    """Box round a part, round a hole in it, or round an opening in the frame that a slug fell out of.

    `piece` is the index of the part or the slug, None where none fell; `cut_um` and `nominal_um` are widths along X
    and Y, `least_um` and `most_um` between which these lie as cut, as the gap of the last pass has its interval.
    """

    what: Literal["part", "hole", "opening"]
    piece: int | None
    center_um: Point
    cut_um: Point
    nominal_um: Point
    least_um: Point
    most_um: Point


class RadiusSize(NamedTuple):
    """Radius of an arc's kept edge, inside of a hole or outside of a boss, with block number and centre as cut.

    `form_um` is the width of the ring that holds the edge. Between `least_um` and `most_um` the radius lies as the gap
    has its interval, and as far as the form of so short an arc may feign another radius.
    """

    what: Literal["hole", "boss"]
    block: int
    center_um: Point
    cut_um: float
    nominal_um: float
    form_um: float
    least_um: float
    most_um: float


class DistanceSize(NamedTuple):
    """Distance of two parallel straight edges, with material or a slot between them, and their block numbers.

    Between `least_um` and `most_um` it lies as the gaps of both have their intervals.
    """

    what: Literal["material", "slot"]
    blocks: tuple[int, int]
    cut_um: float
    nominal_um: float
    least_um: float
    most_um: float


class Sizes(NamedTuple):
    """All sizes that were found; distances of at most 50 pairs of edges, those that face each other longest."""

    boxes: tuple[BoxSize, ...]
    radii: tuple[RadiusSize, ...]
    distances: tuple[DistanceSize, ...]


def sizes_of(toolpath: Toolpath, kerf: Kerf, pieces: Pieces, work_um: Outline | None, spread_um: Floats) -> Sizes:
    """Sizes of parts and openings; what the ideal path would not leave has no nominal size and is left out.

    `spread_um` (n, 2) is by how much the kerf of each row may reach less far, below 0, and farther.
    """
    shapes = kept_shapes(pieces)
    if not shapes:
        return Sizes((), (), ())
    edges = kept_edges(kerf, shapes)
    nominal = nominal_parts(toolpath, stock_of(kerf, work_um), shapes, edges, kerf.usual_um)
    edges = edges.picked(lie_on(shapely.get_rings(nominal.parts_um).tolist(), edges.nominal_um))
    return Sizes(
        tuple(_boxes(shapes, nominal, _widest(edges, spread_um, len(shapes)))),
        tuple(_radii(toolpath, kerf, edges, spread_um)),
        tuple(_distances(edges, kept_lines(toolpath, kerf.edges, edges), spread_um)),
    )


def _widest(edges: KeptEdges, spread_um: Floats, shapes: int) -> Floats:
    """By how much the kerfs round each shape (k, 2) may reach less far, and farther, where they may most."""
    widest = np.zeros((shapes, 2))
    np.minimum.at(widest[:, 0], edges.shape, spread_um[edges.row, 0])
    np.maximum.at(widest[:, 1], edges.shape, spread_um[edges.row, 1])
    return widest


def _boxes(shapes: tuple[KeptShape, ...], nominal: NominalParts, spread_um: Floats) -> Iterator[BoxSize]:
    """Boxes of shapes with a nominal partner; `spread_um` (k, 2) is of the kerfs round each."""
    for shape, (less_um, more_um) in zip(shapes, spread_um.tolist(), strict=True):
        partner = nominal.partner(shape)
        if partner is not None:
            center, cut = _box(shape.outline_um)
            low, high = (-2.0 * more_um, -2.0 * less_um) if shape.what == "part" else (2.0 * less_um, 2.0 * more_um)
            least, most = (Point(cut.x + by, cut.y + by) for by in (low, high))
            yield BoxSize(shape.what, shape.piece, center, cut, _box(partner)[1], least, most)


def _box(outline: shapely.Polygon) -> tuple[Point, Point]:
    """Centre of the box round an outline, and its widths."""
    low_x, low_y, high_x, high_y = outline.bounds
    return Point((low_x + high_x) / 2.0, (low_y + high_y) / 2.0), Point(high_x - low_x, high_y - low_y)


def _radii(toolpath: Toolpath, kerf: Kerf, edges: KeptEdges, spread_um: Floats) -> Iterator[RadiusSize]:
    """Radii of 10 µm and more, of the arcs with 30° and more of a kept edge."""
    boss = np.sign(toolpath.sweep_rad[edges.row]) == edges.side
    nominal = toolpath.radius_um[edges.row] + np.where(boss, -1.0, 1.0) * kerf.usual_um[edges.row]
    first = runs_of(edges.row, edges.side)
    number = np.diff(first, append=len(edges.row))
    swept = np.abs(toolpath.sweep_rad[edges.row[first]]) * _shares(kerf.edges, edges, first, number)
    wanted = (number >= _FEWEST) & (swept >= _LEAST_SWEEP_RAD) & (np.nan_to_num(nominal[first]) >= _LEAST_RADIUS_UM)
    if not wanted.any():
        return
    at, first, number = np.flatnonzero(np.repeat(wanted, number)), first[wanted], number[wanted]
    of = np.repeat(np.arange(len(first)), number)
    fits = fitted_circles(edges.cut_um[at], of, toolpath.center_um[edges.row[first]])
    columns = (fits.center_um, *(column.tolist() for column in fits[1:]), first.tolist())
    for center, radius, form, within, edge in zip(*columns, strict=True):
        what: Literal["hole", "boss"] = "boss" if boss[edge] else "hole"
        less, more = spread_um[edges.row[edge]].tolist()
        low, high = (-more, -less) if boss[edge] else (less, more)
        least, most = radius + low - within, radius + high + within
        block = int(edges.row[edge]) + 1
        yield RadiusSize(what, block, Point(*center.tolist()), radius, float(nominal[edge]), form, least, most)


def _shares(edges: Edges, edges_of_part: KeptEdges, first: Ints, number: Ints) -> Floats:
    """Share (k,) of its block, but for the corners, that each edge spans: k of them by first places and numbers."""
    inner = np.bincount(edges.row[edges.inner], minlength=int(edges.row.max(initial=0)) + 1)
    spanned = edges_of_part.station[first + number - 1] - edges_of_part.station[first]
    shares: Floats = spanned / np.maximum(inner[edges_of_part.row[first]] - 1, 1)
    return shares


def _distances(edges: KeptEdges, lines: KeptLines, spread_um: Floats) -> Iterator[DistanceSize]:
    pairs = facing_pairs(lines)
    longest = np.sort(np.argsort(pairs.from_um - pairs.to_um, kind="stable")[:_MOST_PAIRS])
    for this, other, low, high in zip(*(column[longest].tolist() for column in pairs), strict=True):
        start, way = lines.start_um[this], lines.way[this]
        places = [edges.picked(slice(*lines.places[line].tolist())) for line in (this, other)]
        spans = [place.picked(_within((place.nominal_um - start) @ way, low, high)) for place in places]
        if all(len(span.row) for span in spans):
            out = np.array([-way[1], way[0]])
            cut, nominal = (
                float((last @ out).mean() - (first @ out).mean())
                for first, last in ((spans[0].cut_um, spans[1].cut_um), (spans[0].nominal_um, spans[1].nominal_um))
            )
            what: Literal["material", "slot"] = "material" if nominal > 0.0 else "slot"
            rows = [int(lines.row[this]), int(lines.row[other])]
            less, more = spread_um[rows].sum(axis=0).tolist()
            least, most = (-more, -less) if what == "material" else (less, more)
            blocks = (rows[0] + 1, rows[1] + 1)
            yield DistanceSize(what, blocks, abs(cut), abs(nominal), abs(cut) + least, abs(cut) + most)


def _within(along_um: Floats, low_um: float, high_um: float) -> Bools:
    within: Bools = (along_um >= low_um) & (along_um <= high_um)
    return within


class Fits(NamedTuple):
    """Circles of k arcs, all µm.

    Attributes
    ----------
    center_um, radius_um
        (k, 2) and (k,).
    form_um
        (k,) width of the ring that holds the places of each.
    within_um
        (k,) by how much half of that width, in its worst course along the arc, may change the radius.
    """

    center_um: Floats
    radius_um: Floats
    form_um: Floats
    within_um: Floats


def fitted_circles(place_um: Floats, of: Ints, center_um: Floats) -> Fits:
    """Circles that lie nearest to the places (m, 2) of each arc, by the sum of squares of the distances.

    A deviation d(φ) of ±f moves the radius by Σ a(φ) d(φ) with weights a of the least squares: by Σ |a| f at most. `of`
    (m,) is the index of each place's arc; it never falls, and each of the k arcs has a place. `center_um` (k, 2)
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
    weight = (np.linalg.inv(normal)[:, 0][of] * columns).sum(axis=1)
    within = 0.5 * form * np.add.reduceat(np.abs(weight), first)
    return Fits(center, np.add.reduceat(distance, first) / np.diff(first, append=len(of)), form, within)
