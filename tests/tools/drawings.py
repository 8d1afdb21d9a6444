"""Closed contours as drawings have them: moves from (0, 0), at random, in µm."""

import math
import random
from collections.abc import Callable
from typing import NamedTuple

Place = tuple[float, float]


class Line(NamedTuple):
    """To a place in µm."""

    to: Place


class Arc(NamedTuple):
    """Round a centre to a place, +1 counter-clockwise or −1 clockwise; a full turn where start and end are one."""

    to: Place
    center: Place
    turn: int


def contour(rng: random.Random) -> tuple[str, list[Line | Arc]]:
    """A closed contour from (0, 0), some with a lead-in, some of those with a lead-out; whole µm, as a drawing has."""
    name, shape = rng.choice(
        [
            ("rounded", rounded),
            ("slot", slot),
            ("polygon", polygon),
            ("keyhole", keyhole),
            ("plate", plate),
            ("hole", hole),
        ]
    )
    start, moves = shape(rng)
    led = rng.choice(("", "in", "in", "in and out")) if name != "hole" else "in and out"
    if led:  # across the first move, square to it or not
        across, along = _size(rng, 1, 5), rng.choice((0.0, 0.0, _size(rng, 0.1, 1)))
        hole_at = (start[0] - across, start[1] + along) if name == "hole" else (start[0] + along, start[1] - across)
        moves = [Line(start), *moves, *([Line(hole_at)] if led == "in and out" else [])]
        start = hole_at
    if rng.random() < 0.4:
        start, moves = turned(start, moves, rng.uniform(0.0, 2.0 * math.pi))
    moves = moved(moves, start)
    if rng.random() < 0.5:
        moves = mirrored(moves)
    return f"{name} {led}", moves


def _size(rng: random.Random, low: float, high: float) -> float:
    """µm between two mm, to 0.1 mm, or with an offset of 0.1 mm and something, or to 1 µm."""
    size = rng.uniform(low, high) * 1000.0
    return float(round(size, rng.choice((-2, -1, 0))))


def rounded(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    w, h, r = _size(rng, 10, 60), _size(rng, 10, 60), _size(rng, 0.5, 4)
    moves: list[Line | Arc] = []
    for (x, y), (cx, cy), (ex, ey) in (
        ((w - r, 0), (w - r, r), (w, r)),
        ((w, h - r), (w - r, h - r), (w - r, h)),
        ((r, h), (r, h - r), (0, h - r)),
        ((0, r), (r, r), (r, 0)),
    ):
        moves += [Line((x, y)), Arc((ex, ey), (cx, cy), 1)]
    return (r, 0.0), moves


def slot(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    w, r = _size(rng, 5, 50), _size(rng, 1, 15)
    return (0.0, -r), [Line((w, -r)), Arc((w, r), (w, 0.0), 1), Line((0.0, r)), Arc((0.0, -r), (0.0, 0.0), 1)]


def polygon(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    n = rng.randint(3, 10)
    if rng.random() < 0.4:
        r = _size(rng, 5, 40)
        places = [(r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n)) for k in range(n)]
    elif rng.random() < 0.5:
        x = _size(rng, 5, 30)
        steps = [(_size(rng, 1, 9), _size(rng, 1, 9)) for _ in range(n // 2 + 1)]
        places = [(0.0, 0.0), (x + 50000.0, 0.0)]
        for across, up in steps:  # stairs back
            places += [(places[-1][0], places[-1][1] + up), (places[-1][0] - across, places[-1][1] + up)]
        places += [(0.0, places[-1][1])]
    else:
        angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(n))
        places = [(r * math.cos(a), r * math.sin(a)) for a in angles for r in [_size(rng, 5, 40)]]
    return places[0], [Line(place) for place in [*places[1:], places[0]]]


def keyhole(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    r, w, h = _size(rng, 10, 50), _size(rng, 20, 80), _size(rng, 2, 8)
    x = math.sqrt(r * r - h * h)
    cx = w + x
    return (0.0, h), [
        Arc((0.0, -h), (0.0, 0.0), 1),
        Line((w, -h)),
        Arc((w, h), (cx, 0.0), 1),
        Line((0.0, h)),
    ]


def plate(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    w, h, r, c = _size(rng, 20, 60), _size(rng, 20, 60), _size(rng, 1, 5), _size(rng, 1, 5)
    m = w / 2
    return (0.0, 0.0), [
        Line((m - r, 0.0)),
        Arc((m + r, 0.0), (m, 0.0), rng.choice((1, -1))),
        Line((w, 0.0)),
        Line((w, h - c)),
        Line((w - c, h)),
        Line((r, h)),
        Arc((0.0, h - r), (r, h - r), 1) if rng.random() < 0.5 else Arc((0.0, h - r), (0.0, h), -1),
        Line((0.0, 0.0)),
    ]


def hole(rng: random.Random) -> tuple[Place, list[Line | Arc]]:
    r = _size(rng, 2, 30)
    return (r, 0.0), [Arc((r, 0.0), (0.0, 0.0), rng.choice((1, -1)))]


def turned(start: Place, moves: list[Line | Arc], angle: float) -> tuple[Place, list[Line | Arc]]:
    c, s = math.cos(angle), math.sin(angle)

    def spin(p: Place) -> Place:
        return p[0] * c - p[1] * s, p[0] * s + p[1] * c

    return spin(start), [_mapped(move, spin) for move in moves]


def moved(moves: list[Line | Arc], by: Place) -> list[Line | Arc]:
    return [_mapped(move, lambda p: (p[0] - by[0], p[1] - by[1])) for move in moves]


def mirrored(moves: list[Line | Arc]) -> list[Line | Arc]:
    flat = [_mapped(move, lambda p: (-p[0], p[1])) for move in moves]
    return [move._replace(turn=-move.turn) if isinstance(move, Arc) else move for move in flat]


def _mapped(move: Line | Arc, place: Callable[[Place], Place]) -> Line | Arc:
    if isinstance(move, Arc):
        return Arc(place(move.to), place(move.center), move.turn)
    return Line(place(move.to))
