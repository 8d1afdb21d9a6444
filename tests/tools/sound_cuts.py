"""How a shop cuts a contour: lead-in and lead-out, overcut, trim passes, a tab left to the last, corner loops."""

import math
import random
from itertools import pairwise
from typing import NamedTuple

from drawings import Arc, Line, Place
from sound_cam import Move, drawn_sweep
from sound_offset import offset
from sound_shapes import SHAPES, Shape, begun_within, cut, heading, length, placed, reverse, unit

OFFSET_UM = 100.0
"""Of 0.18 mm wire with a gap of 10 µm (docs/3b.md §5)."""


class Cut(NamedTuple):
    """Moves from a start, with a D before the moves `stops`; `fits_wire` where the path holds the offset."""

    name: str
    start: Place
    moves: list[Move]
    stops: tuple[int, ...]
    fits_wire: bool
    size: float


class WirePath(NamedTuple):
    """A contour as the wire runs it; `scrap` +1 with the scrap on its left, −1 on its right."""

    shape: Shape
    scrap: int

    @property
    def is_smooth(self) -> bool:
        """Whether the contour begins inside a line, or on a circle."""
        one_line = all(isinstance(move, Line) for move in (self.shape.moves[0], self.shape.moves[-1]))
        return (one_line or self.shape.name == "circle") and math.dist(*self._headings) < 1e-3

    @property
    def normal(self) -> Place:
        """Away from the part, at the start; at a corner in the middle between its sides."""
        (ax, ay), (bx, by) = self._headings
        x, y = unit((0.0, 0.0), (ax + bx, ay + by))
        return -y * self.scrap, x * self.scrap

    @property
    def _headings(self) -> tuple[Place, Place]:
        last = heading(_before_last(self.shape), self.shape.moves[-1], True)
        return last, heading(self.shape.start, self.shape.moves[0], False)


class _Nearer(NamedTuple):
    """Paths nearer to the part than the first one."""

    drawn: Shape
    offset_um: float
    round_corners: bool

    def by(self, um: float) -> Shape | None:
        return offset(self.drawn, self.offset_um - math.copysign(um, self.offset_um), self.round_corners)


def random_cut(rng: random.Random) -> Cut:
    size = math.exp(rng.uniform(math.log(200.0), math.log(300_000.0)))
    size = float(round(size)) if rng.random() < 0.5 else size
    shape = rng.choice(SHAPES)(rng, size)
    shape = placed(shape, rng.choice((0.0, 0.0, math.pi / 2, math.pi / 4, rng.uniform(0, 6.28))), rng.random() < 0.4)
    if rng.random() < 0.7:
        shape = begun_within(shape, rng.uniform(0.2, 0.8))
    punch, by, round_corners = rng.random() < 0.5, rng.choice((OFFSET_UM, OFFSET_UM, 105.0, 130.0)), rng.random() < 0.5
    drawn, fits = shape, False
    if shape.neck > 4.0 * by and rng.random() < 0.8:
        moved = offset(shape, by if punch else -by, round_corners)
        shape, fits = (moved, True) if moved else (shape, False)
    path = WirePath(shape, -1 if punch else 1)
    if rng.random() < 0.5:
        path = WirePath(reverse(path.shape), -path.scrap)
    style = rng.choice((_bare, _straight, _straight, _tangent, _overcut, _trimmed, _tabbed, _looped))
    start, moves, stops = style(rng, path, _Nearer(drawn, by if punch else -by, round_corners) if fits else None)
    name = f"{shape.name} {size:.0f} {'punch' if punch else 'die'}{' offset' if fits else ''} {style.__name__[1:]}"
    return Cut(name, start, moves, stops, fits, size)


_Styled = tuple[Place, list[Move], tuple[int, ...]]


def _bare(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    return path.shape.start, list(path.shape.moves), ()


def _straight(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """In along a line, square to the contour or not, and out the same way, or left at the contour."""
    hole = thread_hole(rng, path)
    out: list[Move] = [Line(hole)] if rng.random() < 0.7 else []
    return hole, [Line(path.shape.start), *path.shape.moves, *out], ()


def _tangent(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """In along a quarter circle that ends on the contour's tangent; out the same way, or by another quarter circle."""
    at, n = path.shape.start, path.normal
    t = heading(at, path.shape.moves[0], False)
    if not path.is_smooth:
        return _straight(rng, path, nearer)
    r = min(0.2 * _room(path), 0.3 * path.shape.neck, 0.1 * length(at, path.shape.moves[0]), 2000.0)
    center = at[0] + n[0] * r, at[1] + n[1] * r
    a, b = (center[0] - t[0] * r, center[1] - t[1] * r), (center[0] + t[0] * r, center[1] + t[1] * r)
    hole = a[0] + n[0] * r, a[1] + n[1] * r
    into: list[Move] = [Line(a), Arc(at, center, path.scrap)]
    out: list[Move] = rng.choice(
        ([], [Arc(a, center, -path.scrap), Line(hole)], [Arc(b, center, path.scrap), Line(hole)])
    )
    return hole, [*into, *path.shape.moves, *out], ()


def _overcut(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """Past the start by some of the first move, and there an end, or back and out."""
    hole, first, start = thread_hole(rng, path), path.shape.moves[0], path.shape.start
    share = min(rng.uniform(0.1, 0.4), 2000.0 / length(start, first))
    over = cut(start, first, share)
    ahead = Line(over) if isinstance(first, Line) else first._replace(to=over)
    back = Line(start) if isinstance(first, Line) else Arc(start, first.center, -first.turn)
    out: list[Move] = rng.choice(([], [back, Line(hole)]))
    return hole, [Line(start), *path.shape.moves, ahead, *out], ()


def _trimmed(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """A second pass 10 to 30 µm nearer to the part, forward or back."""
    way = nearer and nearer.by(rng.choice((10.0, 20.0, 30.0)))
    if not way:
        return _straight(rng, path, nearer)
    way = way if rng.random() < 0.5 else reverse(way)
    hole = thread_hole(rng, path)
    return hole, [Line(path.shape.start), *path.shape.moves, Line(way.start), *way.moves, Line(hole)], ()


def _tabbed(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """The last of the contour stays until the part is held: a D before it."""
    start, last = _before_last(path.shape), path.shape.moves[-1]
    if length(start, last) < 300.0:
        return _straight(rng, path, nearer)
    hole = thread_hole(rng, path)
    tab = cut(start, last, 0.7)
    most = Line(tab) if isinstance(last, Line) else last._replace(to=tab)
    moves = [Line(path.shape.start), *path.shape.moves[:-1], most, last, Line(hole)]
    return hole, moves, (len(moves) - 2,)


def _looped(rng: random.Random, path: WirePath, nearer: _Nearer | None) -> _Styled:
    """Sharp outer corners run past and come back to from behind, through the scrap."""
    sharp = path.shape.name in ("polygon", "rectangle") and all(isinstance(m, Line) for m in path.shape.moves)
    if not sharp or path.scrap * _turned(path.shape) > 0.0:
        return _straight(rng, path, nearer)
    starts = [path.shape.start, *(move.to for move in path.shape.moves)]
    size = min(rng.uniform(200.0, 1500.0), 0.2 * min(math.dist(a, b) for a, b in pairwise(starts)))
    hole = thread_hole(rng, path)
    moves: list[Move] = [Line(starts[0])]
    for k, move in enumerate(path.shape.moves):
        moves.append(move)
        if k + 1 == len(path.shape.moves):
            break
        u, v = heading(starts[k], move, True), heading(starts[k + 1], path.shape.moves[k + 1], False)
        if abs(u[0] * v[1] - u[1] * v[0]) < 0.3:
            continue
        at = move.to
        moves[-1] = Line((at[0] + u[0] * size, at[1] + u[1] * size))
        moves.append(Line((at[0] - v[0] * size, at[1] - v[1] * size)))
    return hole, [*moves, Line(hole)], ()


def _turned(shape: Shape) -> float:
    """Twice the signed area of a polygon."""
    places = [shape.start, *(move.to for move in shape.moves)]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in pairwise(places))


def _before_last(shape: Shape) -> Place:
    """Where the last move starts."""
    return shape.start if len(shape.moves) == 1 else shape.moves[-2].to


def thread_hole(rng: random.Random, path: WirePath) -> Place:
    """Where the wire is threaded: in the scrap, off the start, square to the contour or up to 40° aside."""
    room = min(_room(path), 10_000.0)
    angle = rng.choice((0.0, rng.uniform(-0.7, 0.7))) if path.is_smooth else 0.0
    n = path.normal
    u = math.cos(angle) * n[0] - math.sin(angle) * n[1], math.sin(angle) * n[0] + math.cos(angle) * n[1]
    far = rng.uniform(0.2, 0.4) * min(room, _room(path, u))
    return path.shape.start[0] + far * u[0], path.shape.start[1] + far * u[1]


def _room(path: WirePath, way: Place | None = None) -> float:
    """How far the scrap reaches from the start, in its direction; 20 mm where nothing is in the way."""
    at, u = path.shape.start, way or path.normal
    places = [at]
    for move in path.shape.moves:
        places += _flat(places[-1], move)
    nearest = 20_000.0
    for a, b in pairwise(places):
        d = b[0] - a[0], b[1] - a[1]
        cross = u[0] * d[1] - u[1] * d[0]
        if abs(cross) < 1e-9:
            continue
        w = a[0] - at[0], a[1] - at[1]
        along, share = (w[0] * d[1] - w[1] * d[0]) / cross, (w[0] * u[1] - w[1] * u[0]) / cross
        if along > 1e-3 and -1e-9 <= share <= 1.0 + 1e-9:
            nearest = min(nearest, along)
    return nearest


def _flat(start: Place, move: Move) -> list[Place]:
    if isinstance(move, Line):
        return [move.to]
    pieces = 1 + int(drawn_sweep(start, move) / 0.1)
    return [cut(start, move, k / pieces) for k in range(1, pieces)] + [move.to]


def parting(rng: random.Random) -> Cut:
    """A cut across a bar: lines and arcs that always run forward, begun and ended outside."""
    places, moves = [(0.0, 0.0)], []
    for _ in range(rng.randint(1, 6)):
        x, y = places[-1]
        to = x + rng.uniform(2000, 30_000), y + rng.uniform(-0.8, 0.8) * 2000
        if rng.random() < 0.4 and len(places) > 1:
            mid = (x + to[0]) / 2, (y + to[1]) / 2
            side, half = rng.choice((1, -1)), math.dist((x, y), to) / 2
            u = (to[0] - x) / (2 * half), (to[1] - y) / (2 * half)
            center = mid[0] - u[1] * side * 2 * half, mid[1] + u[0] * side * 2 * half
            moves.append(Arc(to, center, side))
        else:
            moves.append(Line(to))
        places.append(to)
    turned = rng.uniform(0, 6.28)
    made = placed(Shape("parting", places[0], moves, 1e6), turned, False)
    return Cut("parting", made.start, made.moves, (), True, 100_000.0)
