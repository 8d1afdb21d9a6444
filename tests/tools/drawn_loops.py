"""Drawings of lines and arcs without a file, and random ones whose parts are known before they are drawn."""

import itertools
import math
import random
from typing import NamedTuple

import numpy as np

from parser.drawing.loops.chain import chain, without_flat
from parser.drawing.loops.once import drawn_once
from parser.drawing.model import DEFAULT_GAP_UM, Drawing, Entity, LeftOut
from parser.geometry.curves import Curves, curves_between, joined

Place = tuple[float, float]


class Piece(NamedTuple):
    """A line or an arc in mm, one entity; the sweep is signed, 0 for a line."""

    start: Place
    end: Place
    center: Place = (0.0, 0.0)
    sweep: float = 0.0

    def turned(self) -> "Piece":
        return Piece(self.end, self.start, self.center, -self.sweep)

    def at(self, share: float) -> Place:
        if not self.sweep:
            return tuple(a + share * (b - a) for a, b in zip(self.start, self.end, strict=True))
        return turned_about(self.start, self.center, share * self.sweep)

    def between(self, first: float, last: float) -> "Piece":
        start = self.start if first == 0.0 else self.at(first)
        end = self.end if last == 1.0 else self.at(last)
        return Piece(start, end, self.center, self.sweep * (last - first))


def turned_about(place: Place, center: Place, angle: float) -> Place:
    x, y = place[0] - center[0], place[1] - center[1]
    cos, sin = math.cos(angle), math.sin(angle)
    return center[0] + x * cos - y * sin, center[1] + x * sin + y * cos


def curves_of(pieces: list[Piece]) -> Curves:
    start, end, center = (1000.0 * np.array([getattr(one, name) for one in pieces]) for name in Piece._fields[:3])
    return curves_between(start, end, center, np.array([one.sweep for one in pieces]))


def drawing_of(entities: list[list[Piece]], gap_um: float = DEFAULT_GAP_UM) -> Drawing:
    """The drawing of entities, each of one piece or of several that it runs through."""
    curves = joined([curves_of(pieces) for pieces in entities])
    entity = np.repeat(np.arange(len(entities)), [len(pieces) for pieces in entities])
    once = drawn_once(curves, entity)
    named = [Entity("LINE" if len(one) == 1 else "LWPOLYLINE", f"{at:X}", "0", "") for at, one in enumerate(entities)]
    loops = chain(once.curves, np.unique(once.entity, return_inverse=True)[1], gap_um).loops
    curves, entity, loops, flat = without_flat(once.curves, once.entity, loops)
    number, of = np.unique(entity, return_inverse=True)
    left = tuple(LeftOut(named[a.entity], "drawn-twice" if a.whole else "overlaps", a.place_um) for a in once.again)
    left += tuple(LeftOut(named[once.entity[a.row]], a.why, a.place_um) for a in flat)
    kept = tuple(named[at] for at in number.tolist())
    return Drawing("part.dxf", "R2010", "mm", curves, of, kept, loops, 0, 0.1, (), left)


def polygon(corners: list[Place]) -> list[Piece]:
    return [Piece(*ends) for ends in zip(corners, [*corners[1:], corners[0]], strict=True)]


def square(x: float, y: float, side: float) -> list[Piece]:
    return polygon([(x, y), (x + side, y), (x + side, y + side), (x, y + side)])


def circle(x: float, y: float, radius: float) -> list[Piece]:
    return [Piece((x + radius, y), (x + radius, y), (x, y), 2.0 * math.pi)]


def arc(x: float, y: float, radius: float, begin_deg: float, end_deg: float) -> list[Piece]:
    ends = [turned_about((x + radius, y), (x, y), math.radians(deg)) for deg in (begin_deg, end_deg)]
    return [Piece(ends[0], ends[1], (x, y), math.radians(end_deg - begin_deg))]


class Nested(NamedTuple):
    """A contour of a random drawing: its pieces, its area in mm², and which one it lies in, −1 for none."""

    pieces: list[Piece]
    area: float
    around: int


def nested(rng: random.Random, most: int) -> list[Nested]:
    """Contours within and beside each other, none within 0.5 mm of another."""
    found: list[Nested] = []
    spots = [(x * 100.0, y * 100.0, 45.0, -1) for x in range(2) for y in range(2)]
    while spots and len(found) < most:
        x, y, radius, around = spots.pop(rng.randrange(len(spots)))
        number = len(found)
        pieces, area, inner = _shape(rng, x, y, radius)
        found.append(Nested(pieces, area, around))
        if inner > 6.0:
            step, first = inner * 0.5, rng.uniform(0.0, 2.0 * math.pi)
            for at in range(rng.choice([0, 1, 2, 4])):
                angle = first + 0.5 * math.pi * at
                room = step * 0.6
                spots.append((x + step * math.cos(angle), y + step * math.sin(angle), room, number))
    return found


def _shape(rng: random.Random, x: float, y: float, radius: float) -> tuple[list[Piece], float, float]:
    """A shape within a circle: its pieces, its area, and the radius of a circle about the same centre within it."""
    kind = rng.choice(["circle", "polygon", "slot", "flower"])
    turn = rng.uniform(0.0, 2.0 * math.pi)
    if kind == "circle":
        return circle(x, y, radius), math.pi * radius**2, radius
    if kind == "slot":  # two lines and two half-circles
        small = 0.5 * radius
        flat = [(x + small, y - small), (x + small, y + small), (x - small, y + small), (x - small, y - small)]
        a, b, c, d = (turned_about(place, (x, y), turn) for place in flat)
        ends = [turned_about((x + side * small, y), (x, y), turn) for side in (1.0, -1.0)]
        pieces = [Piece(a, b, ends[0], math.pi), Piece(b, c), Piece(c, d, ends[1], math.pi), Piece(d, a)]
        return pieces, 4.0 * small**2 + math.pi * small**2, small
    number = rng.randint(3, 9)
    corners = [turned_about((x + radius, y), (x, y), turn + 2.0 * math.pi * at / number) for at in range(number)]
    area = 0.5 * number * radius**2 * math.sin(2.0 * math.pi / number)
    inner = radius * math.cos(math.pi / number)
    if kind == "polygon":
        return polygon(corners), area, inner
    # Each side bends inwards, as an arc of a third of a turn over the angle of the side.
    bend = 0.5 * math.pi / number
    chord = 2.0 * radius * math.sin(math.pi / number)
    big = 0.5 * chord / math.sin(bend)
    pieces = []
    for one in polygon(corners):
        out = ((one.start[0] + one.end[0]) / 2 - x, (one.start[1] + one.end[1]) / 2 - y)
        scale = (inner + big * math.cos(bend)) / math.hypot(*out)
        pieces.append(Piece(one.start, one.end, (x + out[0] * scale, y + out[1] * scale), -2.0 * bend))
    segment = 0.5 * big**2 * (2.0 * bend - math.sin(2.0 * bend))
    return pieces, area - number * segment, inner - big * (1.0 - math.cos(bend))


def as_drawn(rng: random.Random, contours: list[Nested]) -> list[list[Piece]]:
    """Entities of contours as people draw them: some whole, some in pieces, split, turned, drawn again, shuffled."""
    entities: list[list[Piece]] = []
    for contour in contours:
        if rng.random() < 0.3:
            entities.append(contour.pieces)
            if rng.random() < 0.3:
                entities.append([piece.turned() for piece in contour.pieces[::-1]])
            continue
        for piece in contour.pieces:
            entities += [[one] for one in _split(rng, piece)]
            if rng.random() < 0.2:  # again, split otherwise
                entities += [[one] for one in _split(rng, piece)]
            if rng.random() < 0.1:  # again, a part of it
                low = rng.uniform(0.1, 0.4)
                entities.append([piece.between(low, rng.uniform(0.5, 0.9))])
    rng.shuffle(entities)
    return [[piece.turned() for piece in one[::-1]] if rng.random() < 0.5 else one for one in entities]


def _split(rng: random.Random, piece: Piece) -> list[Piece]:
    shares = rng.choice(
        [(0.0, 1.0), (0.0, rng.uniform(0.1, 0.9), 1.0), (0.0, rng.uniform(0.1, 0.4), rng.uniform(0.5, 0.9), 1.0)]
    )
    return [piece.between(*ends) for ends in itertools.pairwise(shares)]
