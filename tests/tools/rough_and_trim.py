"""Programs of a rough cut and trims over the same edge, as a CAM writes them, at random, with what is true of them.

A path at an offset is the drawn contour moved aside (`sound_offset.py`), written as blocks by a post-processor of its
own (`sound_cam.py`). What is left is told by shapely alone: a wire of some reach leaves of a punch what a disc rolled
round it leaves (the drawing closed by the disc), and of a die an opening that the disc can fill (the drawing opened).
"""

import math
import random
from typing import NamedTuple

import shapely
from drawings import Arc, Line, Place
from sound import program_text
from sound_cam import Move, Post
from sound_cuts import WirePath, thread_hole
from sound_offset import offset
from sound_shapes import SHAPES, Shape, begun_within, cut, length, placed, reverse

REACH_UM = 100.0
"""Of 0.18 mm wire with a gap of 10 µm: the last pass runs so far from the drawing."""
BETWEEN = ("contour", "hole", "pause")
"""Where the wire goes between two passes: to the next path by a short step, to its hole, to its hole with a D there."""

_CHORD_UM = 0.01


class TruePass(NamedTuple):
    """One pass over an edge: its blocks, from 0, without leads, and its offset from the drawn contour."""

    edge: int
    number: int
    first: int
    last: int
    is_back: bool
    is_tab: bool
    offset_um: float


class Figure(NamedTuple):
    """One drawn contour, where it lies in the program, the passes over it and its start hole."""

    kind: str
    drawn: Shape
    between: str
    tab_um: float
    hole: Place
    passes: tuple[TruePass, ...]


class RoughAndTrim(NamedTuple):
    """A program: its text, its figures in the order they are cut, and how many blocks it has."""

    name: str
    text: str
    figures: tuple[Figure, ...]
    blocks: int

    @property
    def passes(self) -> list[TruePass]:
        return [one for figure in self.figures for one in figure.passes]


class _Plan(NamedTuple):
    """A contour to be cut: its paths, one a pass, all run the way of the first, and how they follow each other."""

    kind: str
    drawn: Shape
    paths: list[Shape]
    offsets_um: list[float]
    backs: list[bool]
    between: str
    tab_um: float
    tab_once: bool
    hole: Place


def rough_and_trim(rng: random.Random, *, most_um: float = 20_000.0, kind: str | None = None) -> RoughAndTrim:
    """A punch, a die, or a plate with holes and its outline: each contour roughed, then trimmed one to four times."""
    kind = kind or rng.choice(("punch", "die", "die", "plate"))
    kinds = {"punch": ["punch"], "die": ["die"]}.get(kind) or [*["die"] * rng.randint(1, 3), "punch"]
    plans = [_plan(rng, one, most_um) for one in kinds]
    post = Post((0.0, 0.0))
    figures, x = [], 0.0
    for number, plan in enumerate(plans):
        low = min(place[0] for place in outline(plan.drawn)) - 3000.0
        by: Place = (round(x - low), round(rng.uniform(-2000.0, 2000.0)))
        x += max(place[0] for place in outline(plan.drawn)) + 3000.0 - low
        if number == 0:
            by = (-plan.hole[0], -plan.hole[1])
            x = by[0] + max(place[0] for place in outline(plan.drawn)) + 3000.0
        else:
            post.pause()
            post.move(Line((plan.hole[0] + by[0], plan.hole[1] + by[1])), is_jump=True)
            post.pause()
        figures.append(_figure(post, _moved(plan, by), number))
    name = " + ".join(f"{p.kind} {p.drawn.name} {len(p.paths)} {p.between} {p.tab_um:.0f}" for p in plans)
    return RoughAndTrim(name, program_text(rng, post), tuple(figures), len(post.blocks))


def outline(shape: Shape) -> list[Place]:
    """Places round a contour, on arcs so many that chords lie 0.01 µm off at most."""
    places = [shape.start]
    for move in shape.moves:
        start = places[-1]
        if isinstance(move, Line):
            places.append(move.to)
            continue
        radius = math.dist(start, move.center)
        pieces = max(3, math.ceil(length(start, move) / math.sqrt(8.0 * radius * _CHORD_UM)))
        places += [cut(start, move, k / pieces) for k in range(1, pieces)] + [move.to]
    return places


def drawn_polygon(figure: Figure) -> shapely.Polygon:
    """The drawn contour, filled."""
    return shapely.Polygon(outline(figure.drawn))


def left_polygon(figure: Figure, reach_um: float = REACH_UM) -> shapely.Polygon:
    """What the last pass leaves: a punch without what the disc cannot reach into, or the opening of a die; µm."""
    by = reach_um if figure.kind == "punch" else -reach_um
    made: shapely.Polygon = drawn_polygon(figure).buffer(by, quad_segs=256).buffer(-by, quad_segs=256)
    return made


def _plan(rng: random.Random, kind: str, most_um: float) -> _Plan:
    while True:
        size = math.exp(rng.uniform(math.log(2000.0), math.log(most_um)))
        turned = rng.choice((0.0, rng.uniform(0.0, 6.28)))
        drawn = begun_within(placed(rng.choice(SHAPES)(rng, size), turned, False), 0.4)
        sign = 1.0 if kind == "punch" else -1.0
        offsets = _offsets(rng)
        if drawn.neck < 5.0 * offsets[0]:
            continue
        round_corners = rng.random() < 0.5
        paths = [offset(drawn, sign * by, round_corners) for by in offsets]
        made = [path for path in paths if path is not None]
        if len(made) < len(paths) or any(math.dist(path.start, drawn.start) > 1.5 * offsets[0] for path in made):
            continue
        way, scrap = made[0], -1 if kind == "punch" else 1
        hole = thread_hole(rng, WirePath(way, scrap))
        if math.dist(hole, way.start) < 3.0 * offsets[0]:
            continue
        if rng.random() < 0.5:
            made = [reverse(path) for path in made]
        between, tab_um = rng.choice(BETWEEN), 0.0
        backs = [rng.random() < 0.5 and k > 0 for k in range(len(made))] if rng.random() < 0.5 else [False] * len(made)
        last = made[0].moves[-1]
        if rng.random() < 0.4 and isinstance(last, Line) and length(_before_last(made[0]), last) > 1200.0:
            # A tab is passed there and back: the wire never runs across it before the last.
            between, tab_um = "contour", 500.0
            backs = [k % 2 == 1 for k in range(len(made))]
        return _Plan(kind, drawn, made, offsets, backs, between, tab_um, rng.random() < 0.5, hole)


def _offsets(rng: random.Random) -> list[float]:
    """Falling offsets of two to five passes, the last one the reach; now and then the last one twice."""
    offsets = [REACH_UM]
    for _ in range(rng.randint(1, 4)):
        offsets.append(offsets[-1] + rng.choice((8.0, 15.0, 20.0, 40.0)))
    offsets.reverse()
    return [*offsets, REACH_UM] if len(offsets) < 5 and rng.random() < 0.1 else offsets


def _moved(plan: _Plan, by: Place) -> _Plan:
    def put(p: Place) -> Place:
        return p[0] + by[0], p[1] + by[1]

    def shifted(shape: Shape) -> Shape:
        moves: list[Move] = [
            Line(put(m.to)) if isinstance(m, Line) else Arc(put(m.to), put(m.center), m.turn) for m in shape.moves
        ]
        return shape._replace(start=put(shape.start), moves=moves)

    return plan._replace(drawn=shifted(plan.drawn), paths=[shifted(p) for p in plan.paths], hole=put(plan.hole))


def _figure(post: Post, plan: _Plan, edge: int) -> Figure:
    passes = _with_tab(post, plan, edge) if plan.tab_um else _closed(post, plan, edge)
    return Figure(plan.kind, plan.drawn, plan.between, plan.tab_um, plan.hole, tuple(passes))


def _closed(post: Post, plan: _Plan, edge: int) -> list[TruePass]:
    """Passes all round, one behind the other."""
    passes: list[TruePass] = []
    for number, (path, by, back) in enumerate(zip(plan.paths, plan.offsets_um, plan.backs, strict=True)):
        post.move(Line(path.start))
        moves = reverse(path).moves if back else path.moves
        passes.append(TruePass(edge, number + 1, *_run(post, moves), back, False, by))
        is_last = number + 1 == len(plan.paths)
        if is_last or plan.between != "contour":
            post.move(Line(plan.hole))
        if not is_last and plan.between == "pause":
            post.pause()
    return passes


def _with_tab(post: Post, plan: _Plan, edge: int) -> list[TruePass]:
    """Passes up to a tab and back; D, where the piece is held; then the tab, by as many passes or by one."""
    parted = [_at_tab(path, plan.tab_um) for path in plan.paths]
    passes: list[TruePass] = []
    ahead = True
    for is_tab in (False, True):
        todo = list(zip(parted, plan.offsets_um, strict=True))
        for (main, tab), by in todo[-1:] if is_tab and plan.tab_once else todo:
            way = tab if is_tab else main
            way = way if ahead else reverse(way)
            post.move(Line(way.start))
            # What the main passes run ahead, a tab pass that goes on from their end runs ahead too.
            passes.append(TruePass(edge, len(passes) + 1, *_run(post, way.moves), not ahead, is_tab, by))
            ahead = not ahead
        if not is_tab:
            post.pause()
            ahead = not ahead
    post.move(Line(plan.hole))
    return passes


def _at_tab(path: Shape, tab_um: float) -> tuple[Shape, Shape]:
    """The way up to the tab, and the way through it to the start."""
    start, last = _before_last(path), path.moves[-1]
    at = cut(start, last, 1.0 - tab_um / length(start, last))
    return path._replace(moves=[*path.moves[:-1], Line(at)]), path._replace(start=at, moves=[Line(path.start)])


def _run(post: Post, moves: list[Move]) -> tuple[int, int]:
    """Write moves; the first and the last of their blocks."""
    first = len(post.blocks)
    for move in moves:
        post.move(move)
    return first, len(post.blocks) - 1


def _before_last(shape: Shape) -> Place:
    return shape.start if len(shape.moves) == 1 else shape.moves[-2].to
