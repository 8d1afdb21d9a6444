"""A CAM's post-processor written from docs/3b.md §1 alone: moves of a drawing in, 3B blocks and their ends out.

It shares no code with the product, so that the two prove each other.
"""

import math
from itertools import pairwise
from typing import NamedTuple

from drawings import Arc, Line, Place
from plain import PlainBlock, motion_quadrant, plain_arc_end

Move = Line | Arc


class Row(NamedTuple):
    """A block with the place where it ends, exactly and on the drawing, and its length."""

    block: PlainBlock
    end: Place
    drawn_end: Place
    length: float
    is_jump: bool = False


class Pause(NamedTuple):
    """D."""


class Node(NamedTuple):
    """Start node after a pause: the next figure begins there."""

    place: Place


class Post:
    """Writes moves as blocks, each from the decoded end of the last; what rounds to nothing is left out."""

    def __init__(self, at: Place = (0.0, 0.0)) -> None:
        self.origin = self.at = self.drawn = at
        self.rows: list[Row | Pause | Node] = []

    def move(self, move: Move, is_jump: bool = False) -> None:
        block = line_block(self.at, move.to) if isinstance(move, Line) else arc_block(self.at, self.drawn, move)
        self.drawn = move.to
        if block is None:
            return
        by = plain_end(block)
        self.at = self.at[0] + by[0], self.at[1] + by[1]
        length = math.hypot(*by) if block.sense == "L" else math.hypot(block.x, block.y) * abs(plain_sweep(block, by))
        self.rows.append(Row(block, self.at, move.to, length, is_jump))

    def pause(self, node: Place | None = None) -> None:
        self.rows.append(Pause())
        if node:
            self.rows.append(Node(node))
            self.at = self.drawn = node

    @property
    def blocks(self) -> list[Row]:
        return [row for row in self.rows if isinstance(row, Row)]


def line_block(at: Place, to: Place) -> PlainBlock | None:
    dx, dy = round(to[0] - at[0]), round(to[1] - at[1])
    if not dx and not dy:
        return None
    quadrant = line_quadrant(dx, dy)
    x, y = abs(dx), abs(dy)
    axis = "X" if x > y or (x == y and quadrant in (2, 4)) else "Y"
    return PlainBlock(x, y, max(x, y), axis, "L", quadrant)


def line_quadrant(dx: int, dy: int) -> int:
    """+X 1, +Y 2, −X 3, −Y 4; between them the quadrant."""
    if dx > 0 and dy >= 0:
        return 1
    if dx <= 0 and dy > 0:
        return 2
    return 3 if dx < 0 else 4


def arc_block(at: Place, drawn: Place, move: Arc) -> PlainBlock | None:
    """Arc from the place reached about the drawing's centre; J ends it abreast of the drawing's end."""
    x0, y0 = round(at[0] - move.center[0]), round(at[1] - move.center[1])
    if x0 * x0 + y0 * y0 <= 1:
        return line_block(at, move.to)
    radius, start = math.hypot(x0, y0), math.atan2(y0, x0)
    end = math.atan2(move.to[1] - at[1] + y0, move.to[0] - at[0] + x0)
    turn_wanted = drawn_sweep(drawn, move)
    turned = (end - start) * move.turn
    turned += 2.0 * math.pi * round((turn_wanted - turned) / (2.0 * math.pi))
    end = start + move.turn * turned
    axis = "Y" if abs(math.cos(end)) > abs(math.sin(end)) else "X"
    count = round(radius * counted(start, end, axis))
    if turned <= 0.0 or count == 0:
        return line_block(at, move.to)
    sense = "NR" if move.turn > 0 else "SR"
    return PlainBlock(abs(x0), abs(y0), count, axis, sense, motion_quadrant(x0, y0, sense))


def drawn_sweep(start: Place, move: Arc) -> float:
    """Angle in (0, 2π] that an arc of the drawing turns."""
    (cx, cy), (x, y) = move.center, move.to
    sweep = (math.atan2(y - cy, x - cx) - math.atan2(start[1] - cy, start[0] - cx)) * move.turn % (2.0 * math.pi)
    full = sweep < 1e-6 or sweep > 2.0 * math.pi - 1e-6
    return 2.0 * math.pi if full else sweep


def counted(start: float, end: float, axis: str) -> float:
    """Way on an axis between two angles of the unit circle, from extreme to extreme."""
    low, high = sorted((start, end))
    shift = 0.0 if axis == "X" else math.pi / 2.0
    stops = [low, *(k * math.pi + shift for k in range(-8, 9) if low < k * math.pi + shift < high), high]
    return sum(abs(math.cos(b - shift) - math.cos(a - shift)) for a, b in pairwise(stops))


def plain_end(block: PlainBlock) -> Place:
    """Exact end of a block relative to its start."""
    if block.sense != "L":
        return plain_arc_end(block)
    sx, sy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[block.quadrant]
    share = block.count / (block.x if block.axis == "X" else block.y)
    return sx * block.x * share, sy * block.y * share


def plain_sweep(block: PlainBlock, by: Place) -> float:
    """Angle that an arc of about one turn at most turns, from its start, its end and its count."""
    sx, sy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[block.quadrant]
    x0, y0 = sx * block.x, sy * block.y
    turn = 1 if block.sense == "NR" else -1
    sweep = (math.atan2(y0 + by[1], x0 + by[0]) - math.atan2(y0, x0)) * turn % (2.0 * math.pi)
    radius = math.hypot(x0, y0)
    start = math.atan2(y0, x0)
    choices = [sweep + k * 2.0 * math.pi for k in (-1, 0, 1) if sweep + k * 2.0 * math.pi >= 0.0]
    return min(choices, key=lambda a: abs(radius * counted(start, start + turn * a, block.axis) - block.count))
