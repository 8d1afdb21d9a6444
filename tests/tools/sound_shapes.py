"""Closed contours of sound drawings, counter-clockwise, in µm, from 0.2 mm to 300 mm; and their offset paths."""

import math
import random
from collections.abc import Callable, Sequence
from typing import NamedTuple

from drawings import Arc, Line, Place
from paths import Pen
from sound_cam import Move, drawn_sweep

_LEAST_FILLET_UM = 20.0  # below, every step of 1 µm shows: dozens of such arcs do end tens of µm off when stepped


class Shape(NamedTuple):
    """Moves from `start` back to it; `neck` is the narrowest width of part or gap."""

    name: str
    start: Place
    moves: list[Move]
    neck: float


def polar(radius: float, angle: float, about: Place = (0.0, 0.0)) -> Place:
    return about[0] + radius * math.cos(angle), about[1] + radius * math.sin(angle)


def filleted(name: str, corners: Sequence[Place], radius: float, neck: float) -> Shape:
    """A counter-clockwise polygon, each corner rounded where the radius is not 0 and its sides are long enough."""
    places: list[tuple[Place, Move]] = []
    for i, at in enumerate(corners):
        before, after = corners[i - 1], corners[(i + 1) % len(corners)]
        u, v = unit(before, at), unit(at, after)
        turn = math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
        cut = radius * abs(math.tan(turn / 2.0))
        room = 0.45 * min(math.dist(before, at), math.dist(at, after))
        if radius < _LEAST_FILLET_UM or cut > room or abs(turn) < 1e-3:
            places.append((at, Line(at)))
            continue
        a, b = (at[0] - u[0] * cut, at[1] - u[1] * cut), (at[0] + v[0] * cut, at[1] + v[1] * cut)
        side = math.copysign(1.0, turn)
        center = a[0] - u[1] * radius * side, a[1] + u[0] * radius * side
        places += [(a, Line(a)), (b, Arc(b, center, int(side)))]
    return Shape(name, places[-1][0], [move for _, move in places], neck)


def unit(a: Place, b: Place) -> Place:
    length = math.dist(a, b)
    return (b[0] - a[0]) / length, (b[1] - a[1]) / length


def regular(rng: random.Random, size: float) -> Shape:
    n = rng.randint(3, 12)
    corners = [polar(size / 2, 2 * math.pi * k / n) for k in range(n)]
    return filleted("polygon", corners, rng.choice((0.0, 0.0, 0.05 * size)), 0.3 * size)


def irregular(rng: random.Random, size: float) -> Shape:
    n = rng.randint(4, 14)
    corners = [
        polar(size / 2 * rng.uniform(0.6, 1.0), 2 * math.pi * (k + rng.uniform(-0.2, 0.2)) / n) for k in range(n)
    ]
    return filleted("irregular", corners, rng.choice((0.0, 0.02 * size)), 0.1 * size)


def star(rng: random.Random, size: float) -> Shape:
    n = rng.randint(4, 9)
    corners = [polar(size / 2 * (1.0 if k % 2 == 0 else 0.55), math.pi * k / n) for k in range(2 * n)]
    return filleted("star", corners, rng.choice((0.0, 0.02 * size)), 0.1 * size)


def rectangle(rng: random.Random, size: float) -> Shape:
    w, h = round(size), round(size * rng.uniform(0.3, 1.0))
    r = rng.choice((0.0, round(0.1 * size), round(0.02 * size, -1)))
    return filleted("rectangle", [(0, 0), (w, 0), (w, h), (0, h)], r, h)


def angle_plate(rng: random.Random, size: float) -> Shape:
    a, b = round(0.3 * size), round(0.4 * size)
    corners = [(0, 0), (size, 0), (size, a), (b, a), (b, size), (0, size)]
    return filleted("angle", corners, rng.choice((0.0, round(0.05 * size))), float(a))


def comb(rng: random.Random, size: float) -> Shape:
    n = rng.randint(2, 8)
    pitch = size / (2 * n - 1)
    corners: list[Place] = [(0.0, 0.0), (size, 0.0)]
    for k in reversed(range(n)):
        left, right = 2 * k * pitch, (2 * k + 1) * pitch
        corners += [(right, size * 0.6), (left, size * 0.6)]
        if k:
            corners += [(left, 0.3 * size), (left - pitch, 0.3 * size)]
    return filleted("comb", corners, rng.choice((0.0, 0.1 * pitch, 0.2 * pitch)), pitch)


def gear(rng: random.Random, size: float) -> Shape:
    n = rng.randint(6, 24)
    tooth = 2 * math.pi / n
    corners = [
        polar(size / 2 * r, tooth * (k + at))
        for k in range(n)
        for r, at in ((0.8, 0), (1.0, 0.12), (1.0, 0.4), (0.8, 0.52))
    ]
    return filleted("gear", corners, rng.choice((0.0, 0.005 * size, 0.01 * size)), 0.28 * tooth * size / 2)


def wave(rng: random.Random, size: float) -> Shape:
    """A gear of tangent arcs, tips and roots."""
    n = rng.randint(5, 16)
    gap = 2 * size / 2 * math.sin(math.pi / (2 * n))
    tip = gap * rng.uniform(0.4, 0.6)
    centers = [polar(size / 2, math.pi * k / n) for k in range(2 * n)]
    joints = []
    for k in range(2 * n):
        u = unit(centers[k], centers[(k + 1) % (2 * n)])
        own = tip if k % 2 == 0 else gap - tip
        joints.append((centers[k][0] + u[0] * own, centers[k][1] + u[1] * own))
    moves: list[Move] = [Arc(joints[k], centers[k], 1 if k % 2 == 0 else -1) for k in range(2 * n)]
    return Shape("wave", joints[-1], moves, min(tip, gap - tip))


def slot(rng: random.Random, size: float) -> Shape:
    r = size * rng.choice((0.02, 0.1, 0.4))
    w = size
    return Shape("slot", (0, -r), [Line((w, -r)), Arc((w, r), (w, 0), 1), Line((0, r)), Arc((0, -r), (0, 0), 1)], 2 * r)


def thin(rng: random.Random, size: float) -> Shape:
    h = max(60.0, size * rng.choice((0.01, 0.03)))
    return filleted("thin", [(0, 0), (size, 0), (size, h), (0, h)], 0.0, h)


def keyhole(rng: random.Random, size: float) -> Shape:
    r, big, w = 0.1 * size, 0.2 * size, 0.5 * size
    x = math.sqrt(big * big - r * r)
    moves = [Line((w, -r)), Arc((w, r), (w + x, 0.0), 1), Line((0.0, r)), Arc((0.0, -r), (0.0, 0.0), 1)]
    return Shape("keyhole", (0.0, -r), moves, 2 * r)


def d_shape(rng: random.Random, size: float) -> Shape:
    r, flat = size / 2, rng.uniform(-0.3, 0.3) * size
    y = math.sqrt(r * r - flat * flat)
    return Shape("D", (flat, -y), [Arc((flat, y), (0.0, 0.0), 1), Line((flat, -y))], 0.4 * size)


def circle(rng: random.Random, size: float) -> Shape:
    n, turned = rng.choice((1, 2, 3, 4)), rng.choice((0.0, math.pi / 2, rng.uniform(0, 6)))
    joints = [polar(size / 2, turned + 2 * math.pi * k / n) for k in range(n)]
    return Shape("circle", joints[0], [Arc(to, (0.0, 0.0), 1) for to in [*joints[1:], joints[0]]], size)


SHAPES: tuple[Callable[[random.Random, float], Shape], ...] = (
    *(regular, irregular, star, rectangle, angle_plate, comb, gear, wave),
    *(slot, thin, keyhole, d_shape, circle),
)


def placed(shape: Shape, angle: float, mirror: bool) -> Shape:
    """Turned about (0, 0), and mirrored; still counter-clockwise."""
    c, s, flip = math.cos(angle), math.sin(angle), -1.0 if mirror else 1.0

    def put(p: Place) -> Place:
        return flip * (p[0] * c - p[1] * s), p[0] * s + p[1] * c

    moves: list[Move] = [
        Line(put(m.to)) if isinstance(m, Line) else Arc(put(m.to), put(m.center), m.turn * int(flip))
        for m in shape.moves
    ]
    made = shape._replace(start=put(shape.start), moves=moves)
    return reverse(made) if mirror else made


def reverse(shape: Shape) -> Shape:
    starts = [shape.start, *(move.to for move in shape.moves)]
    moves = [
        Line(starts[k]) if isinstance(move, Line) else Arc(starts[k], move.center, -move.turn)
        for k, move in reversed(list(enumerate(shape.moves)))
    ]
    return shape._replace(start=starts[-1], moves=moves)


def heading(start: Place, move: Move, at_end: bool) -> Place:
    """Unit direction at the start or the end of a move."""
    if isinstance(move, Line):
        return unit(start, move.to)
    x, y = unit(move.center, move.to if at_end else start)
    return -y * move.turn, x * move.turn


def cut(start: Place, move: Move, share: float) -> Place:
    """The place at a share of a move."""
    if isinstance(move, Line):
        return start[0] + share * (move.to[0] - start[0]), start[1] + share * (move.to[1] - start[1])
    angle = math.atan2(start[1] - move.center[1], start[0] - move.center[0])
    return polar(math.dist(start, move.center), angle + share * move.turn * drawn_sweep(start, move), move.center)


def begun_within(shape: Shape, share: float) -> Shape:
    """The same contour, begun inside its longest line; inside its first arc where it has no line."""
    starts = [shape.start, *(move.to for move in shape.moves)]
    lines = [k for k, move in enumerate(shape.moves) if isinstance(move, Line)]
    k = max(lines, key=lambda k: math.dist(starts[k], starts[k + 1])) if lines else 0
    at, move = cut(starts[k], shape.moves[k], share), shape.moves[k]
    head = Line(at) if isinstance(move, Line) else move._replace(to=at)
    return shape._replace(start=at, moves=[move, *shape.moves[k + 1 :], *shape.moves[:k], head])


def length(start: Place, move: Move) -> float:
    if isinstance(move, Line):
        return math.dist(start, move.to)
    return math.dist(start, move.center) * drawn_sweep(start, move)


def run_round(pen: Pen, shape: Shape) -> Pen:
    """The pen behind the moves of a shape; a shape of one arc is a whole turn."""
    for move in shape.moves:
        if isinstance(move, Line):
            pen.to(*move.to)
        elif len(shape.moves) == 1:
            pen.arc(*move.center, move.turn * 2.0 * math.pi)
        else:
            pen.arc_to(*move.to, *move.center, move.turn)
    return pen
