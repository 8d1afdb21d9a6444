"""Contours written as a CAM writes them, and such contours broken in one field of one block."""

import math
import random
from typing import NamedTuple

from drawings import Arc, Line, Place
from line_words import line_words
from plain import PlainBlock, counted_way, plain_end

from parser.threeb.decode import decode
from parser.threeb.reader import read_records
from parser.toolpath import Toolpath


class Damage(NamedTuple):
    """A program broken at `row`; `was` is what stood in `field`, `closes` whether it closes all the same."""

    program: list[PlainBlock]
    row: int
    field: str
    kind: str
    was: str
    closes: bool


def built(moves: list[Line | Arc]) -> list[PlainBlock]:
    """Blocks of a contour from (0, 0), each begun at the exact end of the last, as a CAM does."""
    at, program = (0.0, 0.0), []
    for move in moves:
        block = _line(at, move) if isinstance(move, Line) else _arc(at, move)
        program.append(block)
        end = plain_end(block)
        at = (at[0] + end[0], at[1] + end[1])
    return program


def _line(at: Place, move: Line) -> PlainBlock:
    words = line_words(move.to[0] - at[0], move.to[1] - at[1])
    return PlainBlock(words.x_um, words.y_um, words.count_um, words.count_axis.name, "L", words.quadrant)


def _arc(at: Place, move: Arc) -> PlainBlock:
    x0, y0 = round(at[0] - move.center[0]), round(at[1] - move.center[1])
    start, radius = math.atan2(y0, x0), math.hypot(x0, y0)
    sweep = (math.atan2(move.to[1] - move.center[1], move.to[0] - move.center[0]) - start) * move.turn
    sweep = sweep % (2.0 * math.pi)
    end = start + move.turn * (sweep if sweep > 1e-3 else sweep + 2.0 * math.pi)
    axis = "Y" if abs(math.cos(end)) > abs(math.sin(end)) else "X"
    quadrant = int((start + move.turn * 1e-9) % (2.0 * math.pi) // (math.pi / 2.0)) + 1
    count = max(1, round(counted_way(start, end, radius, axis)))
    return PlainBlock(abs(x0), abs(y0), count, axis, "NR" if move.turn > 0 else "SR", quadrant)


def decoded(program: list[PlainBlock]) -> Toolpath:
    return decode(read_records("\n".join(block.text() for block in program)))


def gap_um(toolpath: Toolpath) -> float:
    """How far from closed, at its start or at the end of a lead-in."""
    corners = toolpath.start_um[:2] - toolpath.end_um[-1]
    return float(min(math.hypot(*corner) for corner in corners))


def broken(rng: random.Random, sound: list[PlainBlock]) -> Damage:
    """One field of one block changed: a digit of X, Y or J, the axis, the quadrant or the sense."""
    row = rng.randrange(len(sound))
    block = sound[row]
    kind = rng.choice(("x", "y", "count", "axis", "quadrant", "sense"))
    if kind in ("x", "y", "count"):
        bad, field, text = with_digit(rng, block, kind, "changed"), kind, str(getattr(block, kind))
    elif kind == "axis":
        bad, field, text = on_other_axis(rng, block), "axis", f"G{block.axis}"
    elif kind == "quadrant":
        bad = in_other_quadrant(rng, block)
        field, text = "sense", f"{block.sense}{block.quadrant}"
    else:
        bad = block._replace(sense=rng.choice([s for s in ("L", "NR", "SR") if s != block.sense]))
        field, text = "sense", f"{block.sense}{block.quadrant}"
    program = [*sound[:row], bad, *sound[row + 1 :]]
    label = f"{'line' if block.sense == 'L' else 'arc'} {kind}"
    return Damage(program, row, field, label, text, gap_um(decoded(program)) <= 5.0)


def with_digit(rng: random.Random, block: PlainBlock, field: str, how: str) -> PlainBlock:
    """A block with a digit of X, Y or J changed, lost or doubled."""
    digits = str(getattr(block, field))
    at = rng.randrange(len(digits))
    other = rng.choice([d for d in "0123456789" if d != digits[at]])
    middle = {"changed": other, "lost": "", "doubled": digits[at] * 2}[how]
    return PlainBlock(**(block._asdict() | {field: int(digits[:at] + middle + digits[at + 1 :] or "0")}))


def on_other_axis(rng: random.Random, block: PlainBlock) -> PlainBlock:
    return block._replace(axis="Y" if block.axis == "X" else "X")


def in_other_quadrant(rng: random.Random, block: PlainBlock) -> PlainBlock:
    return block._replace(quadrant=rng.choice([q for q in (1, 2, 3, 4) if q != block.quadrant]))
