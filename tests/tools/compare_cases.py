"""Programs beside the drawings that they are cut from, for tests of their comparison."""

import math
from collections.abc import Sequence
from pathlib import Path

import ezdxf
import numpy as np
from drawings import Arc, Line, Place
from sound_cam import Move, Post, Row, drawn_sweep
from sound_offset import offset
from sound_shapes import Shape, heading, unit

from parser.drawing.model import Drawing, DrawnLoop, Entity
from parser.geometry.curves import Curves, Floats, Ints, curves_between, joined
from parser.program import parse_program
from parser.toolpath import Toolpath
from sim.measure.compare.result import Edge

MM = 1000.0
INCH = 25_400.0


def curves_of(start: Place, moves: Sequence[Move]) -> Curves:
    places = [start, *(move.to for move in moves)]
    sweep = [
        0.0 if isinstance(move, Line) else move.turn * drawn_sweep(at, move)
        for at, move in zip(places, moves, strict=False)
    ]
    center = [(0.0, 0.0) if isinstance(move, Line) else move.center for move in moves]
    return curves_between(np.array(places[:-1]), np.array(places[1:]), np.array(center), np.array(sweep))


def polygon(*corners: Place) -> Shape:
    """A closed contour of lines, in µm."""
    return Shape("polygon", corners[0], [Line(to) for to in (*corners[1:], corners[0])], 1.0)


def square(side: float, x: float = 0.0, y: float = 0.0) -> Shape:
    return polygon((x, y), (x + side, y), (x + side, y + side), (x, y + side))


def circle(radius: float, x: float = 0.0, y: float = 0.0) -> Shape:
    return Shape("circle", (x + radius, y), [Arc((x + radius, y), (x, y), 1)], radius)


def drawing_of(*shapes: Shape) -> Drawing:
    """The shapes as closed loops of one entity a curve."""
    return drawing_from([curves_of(shape.start, shape.moves) for shape in shapes])


def drawing_from(parts: Sequence[Curves], order: Ints | None = None) -> Drawing:
    """Closed loops of curves; `order` shuffles the rows."""
    curves = joined(parts)
    n = len(curves)
    order = np.arange(n) if order is None else order
    at = np.argsort(order)
    ends = np.cumsum([len(part) for part in parts])
    loops = tuple(
        DrawnLoop(at[end - len(part) : end], np.zeros(len(part), dtype=bool), closed=True, gap_um=0.0)
        for end, part in zip(ends, parts, strict=True)
    )
    entities = tuple(Entity("ARC" if arc else "LINE", f"{k:X}", "0", "") for k, arc in enumerate(curves.is_arc[order]))
    return Drawing("part.dxf", "R2010", "mm", curves.picked(order), np.arange(n), entities, loops, 0, 0.1, ())


def edge_from(parts: Sequence[Curves], part_side: int = 1) -> Edge:
    """An edge of closed loops, a block a curve."""
    curves = joined(parts)
    loop = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return Edge(curves, np.arange(1, len(curves) + 1), loop, np.full(len(curves), part_side))


def edge_of(*shapes: Shape) -> Edge:
    return edge_from([curves_of(shape.start, shape.moves) for shape in shapes])


def path_beside(shape: Shape, by: float) -> Shape:
    """The wire's path `by` µm outside of a contour, inside where negative, 0 on it."""
    moved = offset(shape, by, round_corners=False) if by else shape
    assert moved is not None
    return moved


def lead_from(path: Shape, length: float) -> Place:
    """A place straight off the start of a path, outside of it, inside where the length is negative."""
    before = path.moves[-2].to if len(path.moves) > 1 else path.start
    a, b = heading(before, path.moves[-1], True), heading(path.start, path.moves[0], False)
    x, y = unit((0.0, 0.0), (a[0] + b[0], a[1] + b[1]))
    return path.start[0] + y * length, path.start[1] - x * length


def text_of(path: Shape, lead: Place | None = None, out: Place | None = None) -> str:
    """A program of a closed path, with a lead-in and a lead-out where they are given; its start is (0, 0)."""
    start = lead or path.start
    moves = [*([Line(path.start)] if lead else []), *path.moves, *([Line(out)] if out else [])]
    post = Post(start)
    for move in moves:
        post.move(move)
    return "\n".join(row.block.text() for row in post.blocks) + "\nDD\n"


def punch(shape: Shape, by: float = 100.0, lead: float = 3000.0) -> str:
    path = path_beside(shape, by)
    return text_of(path, lead_from(path, lead), lead_from(path, lead))


def die(shape: Shape, by: float = 100.0, lead: float = 1000.0) -> str:
    path = path_beside(shape, -by)
    return text_of(path, lead_from(path, -lead), lead_from(path, -lead))


def toolpath(text: str) -> Toolpath:
    return parse_program(text).toolpath


def write_dxf(path: Path, shapes: Sequence[Shape], unit_um: float = MM, layers: Sequence[str] = ()) -> Path:
    """The shapes as LINE, ARC and CIRCLE; each on its layer where there are layers."""
    document = ezdxf.new("R2010", units=1 if unit_um == INCH else 4)
    space = document.modelspace()
    for number, shape in enumerate(shapes):
        attribs = {"layer": layers[number] if layers else "0"}
        at = shape.start
        for move in shape.moves:
            _draw(space, at, move, unit_um, attribs)
            at = move.to
    document.saveas(path)
    return path


def _draw(space: object, at: Place, move: Move, unit_um: float, attribs: dict[str, str]) -> None:
    def there(place: Place) -> Place:
        return place[0] / unit_um, place[1] / unit_um

    if isinstance(move, Line):
        space.add_line(there(at), there(move.to), attribs)
        return
    radius = math.dist(at, move.center) / unit_um
    if math.dist(at, move.to) < 1e-6:
        space.add_circle(there(move.center), radius, attribs)
        return
    first, last = (math.degrees(math.atan2(p[1] - move.center[1], p[0] - move.center[0])) for p in (at, move.to))
    ends = (first, last) if move.turn > 0 else (last, first)
    space.add_arc(there(move.center), radius, *ends, dxfattribs=attribs)


def spun(places: Floats, turn: float) -> Floats:
    c, s = math.cos(turn), math.sin(turn)
    return places @ np.array([[c, s], [-s, c]])


def together(*contours: tuple[Shape, Place]) -> str:
    """A program of several paths, each led in from its place and out to it again; jumps with D between them."""
    post = Post(contours[0][1])
    for number, (path, hole) in enumerate(contours):
        if number:
            post.pause()
            post.move(Line(hole), is_jump=True)
            post.pause()
        for move in (Line(path.start), *path.moves, Line(hole)):
            post.move(move)
    lines = [row.block.text() if isinstance(row, Row) else "D" for row in post.rows]
    return "\n".join([*lines, "DD", ""])
