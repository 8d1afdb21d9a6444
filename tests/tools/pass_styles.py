"""Rough cuts and trims in further ways of writing: the same passes over one edge, with other ways between them."""

import math
import random
from collections.abc import Callable
from typing import NamedTuple

from drawings import Line, Place
from sound import program_text
from sound_cam import Move, Post
from sound_cuts import WirePath, thread_hole
from sound_offset import offset
from sound_shapes import SHAPES, Shape, begun_within, cut, length, placed, reverse

TAB_UM = 600.0


class Edge(NamedTuple):
    """Paths over one edge at falling offsets, all run one way, and the hole that they are threaded in.

    `kind` is punch or die; `drawn` the contour that a wire of the last offset leaves, `reach_um`.
    """

    paths: list[Shape]
    hole: Place
    kind: str
    drawn: Shape
    reach_um: float

    @property
    def begin(self) -> Place:
        return self.paths[0].start


class Written(NamedTuple):
    """A program, and for each pass in the order cut: edge, its blocks from 0, whether it runs back, and over a tab.

    `ways` are the places that the wire cuts along, from jump to jump, as they are drawn.
    """

    name: str
    text: str
    passes: list[tuple[int, int, int, bool, bool]]
    edges: list[Edge]
    ways: list[list[Place]]


class Stray(NamedTuple):
    """A lead that goes out of its way: the number of the lead, from 1, and how far aside of its end it comes by, µm."""

    lead: int
    aside: Place


class Pen:
    """Writes moves of edges, noting passes; leads are lines, and one of them may stray."""

    def __init__(self, stray: Stray | None = None) -> None:
        self.post = Post((0.0, 0.0))
        self.stray, self.leads = stray, 0
        self.passes: list[tuple[int, int, int, bool, bool]] = []
        self.ways: list[list[Place]] = [[(0.0, 0.0)]]

    def to(self, place: Place) -> None:
        self.leads += 1
        if self.stray and self.stray.lead == self.leads:
            self._move(Line((place[0] + self.stray.aside[0], place[1] + self.stray.aside[1])))
        self._move(Line(place))

    def jump(self, place: Place) -> None:
        if place != self.post.drawn:
            self.post.pause()
            self.post.move(Line(place), is_jump=True)
            self.ways.append([place])
        self.post.pause()

    def run(self, moves: list[Move]) -> None:
        for move in moves:
            self._move(move)

    def cut(self, edge: int, moves: list[Move], *, back: bool = False, tab: bool = False) -> None:
        first = len(self.post.blocks)
        self.run(moves)
        self.passes.append((edge, first, len(self.post.blocks) - 1, back, tab))

    def _move(self, move: Move) -> None:
        self.ways[-1] += places_along(self.ways[-1][-1], move)[1:]
        self.post.move(move)


def places_along(start: Place, move: Move) -> list[Place]:
    """Places along a move, on arcs so many that chords lie 0.01 µm off at most."""
    if isinstance(move, Line):
        return [start, move.to]
    pieces = max(3, math.ceil(length(start, move) / math.sqrt(8.0 * 0.01 * math.dist(start, move.center))))
    return [cut(start, move, k / pieces) for k in range(pieces)] + [move.to]


Begun = Callable[[random.Random, Shape], Shape | None]
Threaded = Callable[[random.Random, WirePath], Place]


def within_longest(rng: random.Random, shape: Shape) -> Shape:
    """The contour begun inside its longest line."""
    return begun_within(shape, 0.4)


def random_edge(
    rng: random.Random,
    kind: str,
    most_um: float = 15_000.0,
    begun: Begun = within_longest,
    threaded: Threaded = thread_hole,
) -> tuple[Edge, float]:
    """An edge with its start hole at (0, 0), and how far it reaches from there."""
    while True:
        size = math.exp(rng.uniform(math.log(5000.0), math.log(most_um)))
        drawn = begun(rng, placed(rng.choice(SHAPES)(rng, size), rng.choice((0.0, rng.uniform(0, 6.28))), False))
        offsets = [100.0 + by for by in sorted(rng.sample((0.0, 10.0, 25.0, 45.0, 70.0), rng.randint(2, 4)))][::-1]
        sign = 1.0 if kind == "punch" else -1.0
        if drawn is None or drawn.neck < 5.0 * offsets[0]:
            continue
        made = [path for path in (offset(drawn, sign * by, True) for by in offsets) if path]
        last = made[0].moves[-1] if made else None
        if len(made) < len(offsets) or not isinstance(last, Line) or length(_before_last(made[0]), last) < 2.0 * TAB_UM:
            continue
        if any(math.dist(path.start, drawn.start) > 1.5 * offsets[0] for path in made):
            continue
        hole = threaded(rng, WirePath(made[0], -1 if kind == "punch" else 1))
        if math.dist(hole, made[0].start) < 3.0 * offsets[0]:
            continue
        return moved(Edge(made, hole, kind, drawn, offsets[-1]), (-hole[0], -hole[1])), 2.0 * size


def moved(edge: Edge, by: Place) -> Edge:
    hole = edge.hole[0] + by[0], edge.hole[1] + by[1]
    return edge._replace(paths=[_moved(path, by) for path in edge.paths], hole=hole, drawn=_moved(edge.drawn, by))


def _moved(shape: Shape, by: Place) -> Shape:
    def put(p: Place) -> Place:
        return p[0] + by[0], p[1] + by[1]

    moves: list[Move] = [
        Line(put(m.to)) if isinstance(m, Line) else m._replace(to=put(m.to), center=put(m.center)) for m in shape.moves
    ]
    return shape._replace(start=put(shape.start), moves=moves)


def by_jumps(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """All edges are roughed, then all trimmed, a jump before each."""
    for number in range(max(len(edge.paths) for edge in edges)):
        for at, edge in enumerate(edges):
            if number < len(edge.paths):
                if pen.passes:
                    pen.jump(edge.hole)
                back = number > 0 and rng.random() < 0.5
                path = reverse(edge.paths[number]) if back else edge.paths[number]
                pen.to(path.start)
                pen.cut(at, path.moves, back=back)
                pen.to(edge.hole)


def without_lead_out(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """From pass to pass by a step, and off at the end of the last one."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        for number, path in enumerate(edge.paths):
            back = number % 2 == 1
            pen.to(path.start)
            pen.cut(at, reverse(path).moves if back else path.moves, back=back)


def overcut(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """Each pass goes on past its start, and the next one begins there, back."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        pen.to(edge.begin)
        for number, path in enumerate(edge.paths):
            way = path if number % 2 == 0 else reverse(path)
            first = way.moves[0]
            over = cut(way.start, first, min(0.3, 300.0 / length(way.start, first)))
            pen.to(way.start)
            pen.cut(at, way.moves, back=number % 2 == 1)
            pen.run([Line(over), Line(way.start)])
        pen.to(edge.hole)


def _tabbed(edge: Edge) -> list[tuple[Shape, Shape]]:
    parted = []
    for path in edge.paths:
        start, last = _before_last(path), path.moves[-1]
        at = cut(start, last, 1.0 - TAB_UM / length(start, last))
        main = path._replace(moves=[*path.moves[:-1], Line(at)])
        parted.append((main, path._replace(start=at, moves=[Line(path.start)])))
    return parted


def tab_by_hole(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """Up to the tab, and back to the hole by its own way; the tab from its far end, after a D or not."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        parted = _tabbed(edge)
        for main, _ in parted:
            pen.to(main.start)
            pen.cut(at, main.moves)
            pen.to(edge.hole)
        if rng.random() < 0.5:
            pen.post.pause()
        tab = reverse(parted[-1][1])
        pen.to(tab.start)
        pen.cut(at, tab.moves, back=True, tab=True)
        pen.to(edge.hole)


def tab_at_once(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """There and back up to the tab, then through it by one cut and off to the hole, without a D."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        parted = _tabbed(edge)
        for number, (main, _) in enumerate(parted):
            way = main if number % 2 == 0 else reverse(main)
            pen.to(way.start)
            pen.cut(at, way.moves, back=number % 2 == 1)
        ahead = len(parted) % 2 == 1
        tab = parted[-1][1] if ahead else reverse(parted[-1][1])
        pen.to(tab.start)
        pen.cut(at, tab.moves, back=not ahead, tab=True)
        pen.to(edge.hole)


def tab_by_jump(rng: random.Random, pen: Pen, edges: list[Edge]) -> None:
    """There and back up to the tabs of all edges; then the tabs, a jump before each."""
    for at, edge in enumerate(edges):
        if at:
            pen.jump(edge.hole)
        for number, (main, _) in enumerate(_tabbed(edge)):
            way = main if number % 2 == 0 else reverse(main)
            pen.to(way.start)
            pen.cut(at, way.moves, back=number % 2 == 1)
        pen.to(edge.hole)
    for at, edge in enumerate(edges):
        pen.jump(edge.hole)
        tab = reverse(_tabbed(edge)[-1][1])
        pen.to(tab.start)
        pen.cut(at, tab.moves, back=True, tab=True)
        pen.to(edge.hole)


Style = Callable[[random.Random, Pen, list[Edge]], None]
STYLES: tuple[Style, ...] = (*(by_jumps, without_lead_out, overcut, tab_by_hole, tab_at_once, tab_by_jump),)


def written(
    rng: random.Random,
    style: Style,
    begun: Begun = within_longest,
    threaded: Threaded = thread_hole,
    stray: Stray | None = None,
) -> Written:
    """One to three edges in a style, each 5 mm and more from the next."""
    edges, x = [], 0.0
    for _ in range(rng.randint(2, 3) if style in (by_jumps, tab_by_jump) else rng.randint(1, 2)):
        edge, reach = random_edge(rng, rng.choice(("punch", "die")), begun=begun, threaded=threaded)
        x += reach if edges else 0.0
        edges.append(moved(edge, (round(x), 0.0)))
        x += reach + 5000.0
    pen = Pen(stray)
    style(rng, pen, edges)
    return Written(style.__name__, program_text(rng, pen.post), pen.passes, edges, pen.ways)


def _before_last(shape: Shape) -> Place:
    return shape.start if len(shape.moves) == 1 else shape.moves[-2].to
