"""Slow, plain re-implementations to prove the array code against: one step, one block at a time, no closed forms."""

import math
from itertools import pairwise
from typing import NamedTuple


class PlainBlock(NamedTuple):
    x: int
    y: int
    count: int
    axis: str  # "X" or "Y"
    sense: str  # "L", "NR", "SR"
    quadrant: int

    def text(self) -> str:
        return f"B{self.x} B{self.y} B{self.count} G{self.axis} {self.sense}{self.quadrant}"


SIGNS = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}


def plain_steps(block: PlainBlock, most: int = 2_000_000) -> list[tuple[int, int]]:
    """Places after each step, relative to the block's start, by the four beats: look at F, step, new F, count."""
    return _line(block, most) if block.sense == "L" else _arc(block, most)


def _line(block: PlainBlock, most: int) -> list[tuple[int, int]]:
    sx, sy = SIGNS[block.quadrant]
    first_is_x = block.quadrant in (1, 3)
    x = y = f = 0
    left = block.count
    places = []
    while left > 0:
        if (f >= 0) == first_is_x:
            x += sx
            f += -block.y if first_is_x else block.y
            left -= block.axis == "X"
        else:
            y += sy
            f += block.x if first_is_x else -block.x
            left -= block.axis == "Y"
        places.append((x, y))
        assert len(places) <= most, "endless"
    return places


def motion_quadrant(x: int, y: int, sense: str) -> int:
    if sense == "NR":
        if x > 0 and y >= 0:
            return 1
        if x <= 0 and y > 0:
            return 2
        return 3 if x < 0 and y <= 0 else 4
    if x >= 0 and y > 0:
        return 1
    if x > 0 and y <= 0:
        return 4
    return 3 if x <= 0 and y < 0 else 2


TOWARD_X = {"NR1": -1, "SR4": -1, "SR2": 1, "NR3": 1}  # F >= 0; else step Y away:
AWAY_Y = {"NR1": 1, "SR2": 1, "NR3": -1, "SR4": -1}
TOWARD_Y = {"SR1": -1, "NR2": -1, "SR3": 1, "NR4": 1}  # F >= 0; else step X away:
AWAY_X = {"SR1": 1, "NR4": 1, "SR3": -1, "NR2": -1}


def _arc(block: PlainBlock, most: int) -> list[tuple[int, int]]:
    sx, sy = SIGNS[block.quadrant]
    x0, y0 = x, y = sx * block.x, sy * block.y
    square = x * x + y * y
    left = block.count
    places = []
    while left > 0:
        motion = f"{block.sense}{motion_quadrant(x, y, block.sense)}"
        outside = x * x + y * y - square >= 0
        dx = dy = 0
        if motion in TOWARD_X:
            dx, dy = (TOWARD_X[motion], 0) if outside else (0, AWAY_Y[motion])
        else:
            dx, dy = (0, TOWARD_Y[motion]) if outside else (AWAY_X[motion], 0)
        x, y = x + dx, y + dy
        left -= abs(dx) if block.axis == "X" else abs(dy)
        places.append((x - x0, y - y0))
        assert len(places) <= most, "endless"
    return places


def plain_end(block: PlainBlock) -> tuple[float, float]:
    """Exact end of a block relative to its start."""
    return plain_arc_end(block) if block.sense != "L" else plain_line_end(block)


def plain_line_end(block: PlainBlock) -> tuple[float, float]:
    """Exact end of a line relative to its start: where its count is reached on the counted axis."""
    sx, sy = SIGNS[block.quadrant]
    share = block.count / (block.x if block.axis == "X" else block.y)
    return sx * block.x * share, sy * block.y * share


def plain_arc_end(block: PlainBlock) -> tuple[float, float]:
    """Exact end of an arc relative to its start, by counting off from extreme to extreme."""
    sx, sy = SIGNS[block.quadrant]
    x0, y0 = sx * block.x, sy * block.y
    radius = math.sqrt(x0 * x0 + y0 * y0)
    turn = 1 if block.sense == "NR" else -1
    # c, s: counted coordinate and the one that leads it by a quarter turn, running counter-clockwise in (c, s).
    c, s = (x0, y0 * turn) if block.axis == "X" else (y0, -x0 * turn)
    left = float(block.count)
    falling = s > 0 or (s == 0 and c > 0)
    while True:
        room = c + radius if falling else radius - c
        if left <= room:
            c += -left if falling else left
            break
        left -= room
        c = -radius if falling else radius
        falling = not falling
    s = math.sqrt(max(0.0, (radius - c) * (radius + c))) * (1 if falling else -1)
    x1, y1 = (c, s * turn) if block.axis == "X" else (-s * turn, c)
    return x1 - x0, y1 - y0


def counted_way(start: float, end: float, radius: float, axis: str) -> float:
    """Way on the counted axis between two angles, by its extremes in between."""
    low, high = sorted((start, end))
    shift = 0.0 if axis == "X" else math.pi / 2.0
    turns = [k * math.pi + shift for k in range(-8, 9) if low < k * math.pi + shift < high]
    places = [radius * math.cos(a - shift) for a in (low, *turns, high)]
    return sum(abs(b - a) for a, b in pairwise(places))
