"""Six more ways to write rough cuts and trims: round leads, tabs at corners, trims from elsewhere, open edges.

With those of `pass_styles.py` they are twelve. Each program comes with what is true of it, told by shapely alone.
"""

import math
import random
from itertools import pairwise

import numpy as np
import shapely
from drawings import Arc, Line, Place
from pass_styles import (
    STYLES,
    TAB_UM,
    Begun,
    Edge,
    Pen,
    Stray,
    Style,
    Threaded,
    Written,
    places_along,
    within_longest,
    written,
)
from shapely.geometry.base import BaseGeometry
from sound import program_text
from sound_cuts import WirePath, thread_hole
from sound_shapes import Shape, cut, heading, reverse

FAR_UM = 60_000.0
_CHORDS_UM2 = 1.0  # smaller bodies come of chords alone


def part_by_part(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """Each pass from the start hole and back to it, one edge after the other."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        for path in edge.paths:
            way = path if rng.random() < 0.5 or not pen.passes else reverse(path)
            pen.to(way.start)
            pen.cut(at, way.moves, back=way is not path)
            pen.to(edge.hole)


def arc_leads(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """In by a quarter circle that ends on the tangent, and out by another one, each pass from the start hole."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        for path in edge.paths:
            to, center, scrap = _quarter(edge, path)
            pen.to(to)
            pen.run([Arc(path.start, center, scrap)])
            pen.cut(at, path.moves)
            out = 2.0 * center[0] - to[0], 2.0 * center[1] - to[1]
            pen.run([Arc(out, center, scrap)])
            pen.to(edge.hole)


def _quarter(edge: Edge, path: Shape) -> tuple[Place, Place, int]:
    """Where a quarter circle to the start of a path begins, its centre, and which way it turns."""
    scrap = -1 if edge.kind == "punch" else 1
    (tx, ty), (nx, ny) = heading(path.start, path.moves[0], False), WirePath(path, scrap).normal
    far = (edge.hole[0] - path.start[0]) * nx + (edge.hole[1] - path.start[1]) * ny
    r = 0.5 * far
    center = path.start[0] + r * nx, path.start[1] + r * ny
    return (center[0] - r * tx, center[1] - r * ty), center, scrap


def _square_off(rng: random.Random, path: WirePath) -> Place:
    """A start hole straight off the start, so near that a circle of half the way fits beside it."""
    far = min(0.3 * path.shape.neck, 1500.0)
    (nx, ny), (x, y) = path.normal, path.shape.start
    return x + far * nx, y + far * ny


def tab_at_corner(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """There and back up to a tab that holds the piece round a corner; then through it, after a D."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        parted = [_before_corner(path) for path in edge.paths]
        for number, (main, _) in enumerate(parted):
            way = main if number % 2 == 0 else reverse(main)
            pen.to(way.start)
            pen.cut(at, way.moves, back=number % 2 == 1)
        ahead = len(parted) % 2 == 1
        pen.post.pause()
        tab = parted[-1][1] if ahead else reverse(parted[-1][1])
        pen.to(tab.start)
        pen.cut(at, tab.moves, back=not ahead, tab=True)
        if ahead:  # from behind the tab the way to the hole leads through the part
            pen.to(edge.hole)


def _before_corner(path: Shape) -> tuple[Shape, Shape]:
    """The way up to a tab before the last corner, and the way through it, round the corner, to the start."""
    places = [path.start, *(move.to for move in path.moves)]
    last = max(k for k in range(len(path.moves) - 1) if isinstance(path.moves[k], Line))
    at = cut(places[last], path.moves[last], 1.0 - TAB_UM / math.dist(places[last], places[last + 1]))
    main = path._replace(moves=[*path.moves[:last], Line(at)])
    return main, path._replace(start=at, moves=path.moves[last:])


def behind_corner(rng: random.Random, shape: Shape) -> Shape | None:
    """The contour begun a little behind a corner between two lines that are long enough for a tab round it."""
    places = [shape.start, *(move.to for move in shape.moves)]
    far = [math.dist(*ends) for ends in pairwise(places)]
    long = [
        k
        for k in range(len(far))
        if all(
            isinstance(shape.moves[j], Line) and math.dist(places[j], places[j + 1]) > 4.0 * TAB_UM for j in (k - 1, k)
        )
        if k > 0
    ]
    if not long:
        return None
    k = rng.choice(long)
    at = cut(places[k], shape.moves[k], 2.5 * TAB_UM / far[k])
    return shape._replace(start=at, moves=[*shape.moves[k:], *shape.moves[:k], Line(at)])


def trims_from_elsewhere(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """Each trim begins on another side than the pass before it, from a hole of its own, to hide the witness mark."""
    for at, edge in enumerate(edges):
        holes = [edge.hole]
        for number, path in enumerate(edge.paths):
            begun, hole = (path, edge.hole) if number == 0 else _elsewhere(rng, edge, path, holes)
            if at or number:
                pen.jump(hole)
            pen.to(begun.start)
            pen.cut(at, begun.moves)
            pen.to(hole)
            holes.append(hole)


def _elsewhere(rng: random.Random, edge: Edge, path: Shape, holes: list[Place]) -> tuple[Shape, Place]:
    """The path begun on some side, and a start hole there; apart from the others where there is room, else the first.

    Holes of 1 mm lie no nearer, and what is nearer to a contour than a kerf is wide is taken for no jump.
    """
    for _ in range(20):
        begun = _begun_elsewhere(rng, path)
        hole = thread_hole(rng, WirePath(begun, -1 if edge.kind == "punch" else 1))
        if all(math.dist(hole, other) > 1000.0 for other in holes):
            return begun, hole
    return path, edge.hole


def _begun_elsewhere(rng: random.Random, path: Shape) -> Shape:
    places = [path.start, *(move.to for move in path.moves)]
    lines = [k for k, m in enumerate(path.moves) if isinstance(m, Line) and math.dist(places[k], m.to) > 1000.0]
    k = rng.choice(lines)
    at = cut(places[k], path.moves[k], rng.uniform(0.3, 0.7))
    return path._replace(start=at, moves=[Line(path.moves[k].to), *path.moves[k + 1 :], *path.moves[:k], Line(at)])


def offsets_that_rise(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """The finest pass comes first: what follows cuts beside the edge in what is gone."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        for path in reversed(edge.paths):
            pen.to(path.start)
            pen.cut(at, path.moves)
            pen.to(edge.hole)


MORE: dict[Style, tuple[Begun, Threaded]] = {
    part_by_part: (within_longest, thread_hole),
    arc_leads: (within_longest, _square_off),
    tab_at_corner: (behind_corner, thread_hole),
    trims_from_elsewhere: (within_longest, thread_hole),
    offsets_that_rise: (within_longest, thread_hole),
}


def stepped_edge(rng: random.Random, stray: Stray | None = None) -> Written:
    """A staircase along a plate, cut there and back at falling offsets from beside it; it stays open."""
    corners: list[Place] = [(0.0, 0.0)]
    for k in range(2 * rng.randint(2, 6)):
        x, y = corners[-1]
        step = float(rng.randint(1500, 6000))
        corners.append((x + step, y) if k % 2 == 0 else (x, y + rng.choice((-1.0, 1.0)) * step))
    corners.append((corners[-1][0] + 4000.0, corners[-1][1]))
    side = rng.choice((1.0, -1.0))  # the waste lies to the left, or to the right
    offsets = [100.0 + by for by in sorted(rng.sample((0.0, 10.0, 25.0, 45.0), rng.randint(2, 3)))][::-1]
    ways = [_beside(corners, side * by) for by in offsets]
    x, y = ways[0][0]
    origin = (x - 3000.0, y)
    pen = Pen(stray)
    for number, way in enumerate(ways):
        run = way if number % 2 == 0 else way[::-1]
        there = [(to[0] - origin[0], to[1] - origin[1]) for to in run]
        pen.to(there[0])
        pen.cut(0, [Line(to) for to in there[1:]], back=number % 2 == 1)
    drawn = [(to[0] - origin[0], to[1] - origin[1]) for to in corners]
    shape = Shape("stairs", drawn[0], [Line(to) for to in drawn[1:]], 1500.0)
    edge = Edge([], (0.0, 0.0), "left" if side < 0.0 else "right", shape, offsets[-1])
    return Written("stepped_edge", program_text(rng, pen.post), pen.passes, [edge], pen.ways)


def _beside(corners: list[Place], by: float) -> list[Place]:
    """A line of right angles moved aside, to its left where positive."""
    normals = []
    for (x0, y0), (x1, y1) in pairwise(corners):
        far = math.hypot(x1 - x0, y1 - y0)
        normals.append((-(y1 - y0) / far, (x1 - x0) / far))
    normals = [normals[0], *normals, normals[-1]]
    moved = []
    for (x, y), one, other in zip(corners, normals, normals[1:], strict=False):
        both = {one, other}
        moved.append((x + by * sum(n[0] for n in both), y + by * sum(n[1] for n in both)))
    return moved


TWELVE: tuple[str, ...] = (*(style.__name__ for style in (*STYLES, *MORE)), "stepped_edge")


def of_style(rng: random.Random, name: str, stray: Stray | None = None) -> Written:
    """A program of one of the twelve styles, with a lead that strays where one is asked for."""
    if name == "stepped_edge":
        return stepped_edge(rng, stray)
    style = next(one for one in (*STYLES, *MORE) if one.__name__ == name)
    return written(rng, style, *MORE.get(style, (within_longest, thread_hole)), stray)


def random_stray(rng: random.Random) -> Stray:
    """One of the first leads comes by a place 0.2 to 0.6 mm from its end, in any direction: in the waste, or not."""
    far, angle = rng.uniform(200.0, 600.0), rng.uniform(0.0, 2.0 * math.pi)
    return Stray(rng.randint(1, 6), (far * math.cos(angle), far * math.sin(angle)))


def part_of(edge: Edge) -> BaseGeometry:
    """What is to stay of an edge, µm: a punch within its contour, what lies round a die, a plate on one side."""
    places = [edge.drawn.start]
    for move in edge.drawn.moves:
        places += places_along(places[-1], move)[1:]
    if edge.kind in ("left", "right"):
        deep = FAR_UM if edge.kind == "left" else -FAR_UM
        return shapely.Polygon([*places, (places[-1][0], deep), (places[0][0], deep)])
    inside = shapely.Polygon(places)
    return inside if edge.kind == "punch" else inside.buffer(FAR_UM / 10.0).difference(inside)


def gouge_um(program: Written) -> float:
    """How deep the wire, run along the ways as they are drawn, comes into the parts, µm."""
    deepest = 0.0
    swept = [shapely.LineString(way) for way in program.ways if len(way) > 1]
    for edge in program.edges:
        part = part_of(edge)
        for way in swept:
            hit = part.intersection(way.buffer(edge.reach_um, quad_segs=64))
            for body in shapely.get_parts(hit):
                ring = shapely.get_exterior_ring(body)
                if ring is not None and body.area > _CHORDS_UM2:
                    along = shapely.line_interpolate_point(ring, np.arange(0.0, ring.length, 5.0))
                    deepest = max(deepest, float(shapely.distance(along, part.boundary).max()))
    return deepest
