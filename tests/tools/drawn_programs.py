"""Random programs on the contours of a drawing, as for a controller that adds the offset; in 3B, in whole µm."""

import math
import random
from typing import NamedTuple

from drawings import Arc, Line, Place
from sound import program_text
from sound_cam import Post
from sound_cuts import WirePath, thread_hole
from sound_shapes import SHAPES, Shape, begun_within, placed, reverse


class DrawnProgram(NamedTuple):
    """Its text, its contours as they are run, whether the wire runs to their left, and whether it goes back to holes.

    Each shape has its kind, punch or die, and its start hole.
    """

    text: str
    shapes: tuple[Shape, ...]
    kinds: tuple[str, ...]
    holes: tuple[Place, ...]
    to_left: bool
    returns: bool


def drawn_program(rng: random.Random, widest_um: float) -> DrawnProgram:
    """One to three punches and dies with room for the widest offset, each led in from a hole in the waste."""
    to_left, returns = rng.random() < 0.5, rng.random() < 0.7
    post = Post((0.0, 0.0))
    done: list[tuple[Shape, str, Place]] = []
    number = rng.choice((1, 1, 2, 3))
    while len(done) < number:
        one = _contour(rng, widest_um, to_left)
        if one is None:
            continue
        shape, kind, hole = _moved(one, (-one[2][0] + 50_000.0 * len(done), -one[2][1]))
        if done:
            post.pause()
            post.move(Line(hole), is_jump=True)
            post.pause()
        for move in (Line(shape.start), *shape.moves):
            post.move(move)
        # Short of the hole, on the way to it, the wire may end as well.
        share = 1.0 if returns else rng.uniform(0.3, 0.8)
        start = shape.start
        post.move(Line((start[0] + share * (hole[0] - start[0]), start[1] + share * (hole[1] - start[1]))))
        done.append((shape, kind, hole))
    shapes, kinds, holes = zip(*done, strict=True)
    return DrawnProgram(program_text(rng, post), shapes, kinds, holes, to_left, returns)


def _contour(rng: random.Random, widest_um: float, to_left: bool) -> tuple[Shape, str, Place] | None:
    shape = rng.choice(SHAPES)(rng, math.exp(rng.uniform(math.log(2000.0), math.log(20_000.0))))
    if shape.neck < 5.0 * widest_um:
        return None
    shape = begun_within(placed(shape, rng.choice((0.0, rng.uniform(0.0, 6.28))), False), rng.uniform(0.2, 0.8))
    kind = rng.choice(("punch", "die"))
    hole = thread_hole(rng, WirePath(shape, -1 if kind == "punch" else 1))
    if math.dist(hole, shape.start) < 3.0 * widest_um:
        return None
    # Counter-clockwise a punch has the wire on its right, a die on its left.
    return (shape if (kind == "die") == to_left else reverse(shape)), kind, hole


def _moved(one: tuple[Shape, str, Place], by: Place) -> tuple[Shape, str, Place]:
    def put(p: Place) -> Place:
        return p[0] + by[0], p[1] + by[1]

    shape, kind, hole = one
    moves = [Line(put(m.to)) if isinstance(m, Line) else Arc(put(m.to), put(m.center), m.turn) for m in shape.moves]
    return shape._replace(start=put(shape.start), moves=moves), kind, put(hole)
