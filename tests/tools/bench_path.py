"""Paths for the benchmark, of blocks of 0.1 mm: a walk in all directions, and contours that close."""

import math
import random
from pathlib import Path

from drawings import Arc, Line
from line_words import line_words
from plain import PlainBlock, counted_way
from sound_cam import Post

LENGTH_UM = 100.0
_WAVES = 7
_BLOCKS_A_LOOP = 100
_LOOPING = 3.0  # times the radius over which a contour would stand still: more, and it crosses itself in each loop


def write_path(path: Path, blocks: int) -> list[PlainBlock]:
    """A walk, two lines to one arc, that never closes: what is read, stepped and checked, and no part."""
    rng = random.Random(20260101)
    made = [_arc(rng) if row % 3 == 2 else _line(rng) for row in range(blocks)]
    path.write_text("\n".join(block.text() for block in made) + "\nDD\n", encoding="ascii")
    return made


def contour_text(blocks: int, *, crosses: bool) -> str:
    """A closed contour, every third block an arc: a wavy ring, or a ring of small loops, each of which crosses it."""
    place = _looped if crosses else _wavy
    places = [place(row / blocks * 2.0 * math.pi, blocks) for row in range(blocks)]
    post = Post(places[0])
    for row, (to, since) in enumerate(zip([*places[1:], places[0]], places, strict=True)):
        post.move(_bent(since, to) if row % 3 == 2 else Line(to))
    return "\n".join(row.block.text() for row in post.blocks) + "\nDD\n"


def _wavy(angle: float, blocks: int) -> tuple[float, float]:
    radius = LENGTH_UM * blocks / (2.0 * math.pi) * (1.0 + 0.2 * math.sin(_WAVES * angle))
    return radius * math.cos(angle), radius * math.sin(angle)


def _looped(angle: float, blocks: int) -> tuple[float, float]:
    """An epitrochoid with a loop for each `_BLOCKS_A_LOOP` blocks, and at least one."""
    loops = max(1, blocks // _BLOCKS_A_LOOP)
    radius = LENGTH_UM * blocks / (2.0 * math.pi) / _LOOPING
    small = _LOOPING * radius / (loops + 1)
    x = radius * math.cos(angle) - small * math.cos((loops + 1) * angle)
    return x, radius * math.sin(angle) - small * math.sin((loops + 1) * angle)


def _bent(start: tuple[float, float], to: tuple[float, float]) -> Arc:
    """An arc of 0.3 rad, counter-clockwise, on the chord of two places."""
    off = 0.5 / math.tan(0.15)
    by = to[0] - start[0], to[1] - start[1]
    return Arc(to, (0.5 * (start[0] + to[0]) - off * by[1], 0.5 * (start[1] + to[1]) + off * by[0]), 1)


def _line(rng: random.Random) -> PlainBlock:
    angle = rng.uniform(0.0, 2.0 * math.pi)
    words = line_words(LENGTH_UM * math.cos(angle), LENGTH_UM * math.sin(angle))
    return PlainBlock(words.x_um, words.y_um, words.count_um, words.count_axis.name, "L", words.quadrant)


def _arc(rng: random.Random) -> PlainBlock:
    """An arc of 0.1 mm on a radius of 0.05 to 2 mm, counted on the axis that is stepped last."""
    radius, start, turn = rng.uniform(50.0, 2000.0), rng.uniform(0.0, 2.0 * math.pi), rng.choice((1, -1))
    x0, y0 = round(radius * math.cos(start)), round(radius * math.sin(start))
    start, radius = math.atan2(y0, x0), math.hypot(x0, y0)
    end = start + turn * LENGTH_UM / radius
    x1, y1 = radius * math.cos(end), radius * math.sin(end)
    axis = "Y" if abs(x1) > abs(y1) else "X"
    count = counted_way(start, end, radius, axis)
    quadrant = int((start + turn * 1e-9) % (2.0 * math.pi) // (math.pi / 2.0)) + 1
    return PlainBlock(abs(x0), abs(y0), max(1, round(count)), axis, "NR" if turn > 0 else "SR", quadrant)
