"""Sound 4B programs at random: tangent outlines with their marks; ``PYTHONPATH=. python tests/tools/sound_4b.py``.

The drawing is a star-shaped polygon with a fillet in every corner. Which fillets are convex follows from the corners of
the polygon alone.
"""

import argparse
import math
import random
from collections import Counter
from typing import NamedTuple

from drawings import Arc, Line, Place
from sound_cam import Post, Row

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings


class Corner(NamedTuple):
    """A corner with its fillet: where it begins and ends, its centre, its turn, whether it is convex, its angle."""

    begin: Place
    end: Place
    center: Place
    turn: int
    is_convex: bool
    angle: float
    radius: float


class Outline(NamedTuple):
    """A program's lines of text, its corners as they are cut, and whether its lead-in comes from within."""

    text: str
    corners: list[Corner]
    is_die: bool


def outline_4b(rng: random.Random, radii_um: tuple[float, float] = (300.0, 8000.0)) -> Outline:
    """A punch or a die, counter-clockwise or clockwise, with a lead-in square to the middle of a side."""
    corners = _corners(rng, radii_um)
    while corners is None:
        corners = _corners(rng, radii_um)
    side = corners[-1].end, corners[0].begin
    start = (side[0][0] + side[1][0]) / 2.0, (side[0][1] + side[1][1]) / 2.0
    to = rng.choice((-1, 1))  # the hole lies to the left of the path, or to the right
    way = math.atan2(side[1][1] - side[0][1], side[1][0] - side[0][0]) + to * math.pi / 2.0
    hole = start[0] + 3000.0 * math.cos(way), start[1] + 3000.0 * math.sin(way)
    post = Post()
    shift = -hole[0], -hole[1]
    marks = [""]
    post.move(Line(_shifted(start, shift)))
    for corner in corners:
        post.move(Line(_shifted(corner.begin, shift)))
        post.move(Arc(_shifted(corner.end, shift), _shifted(corner.center, shift), corner.turn))
        marks += ["", "D" if corner.is_convex else "DD"]
    post.move(Line(_shifted(start, shift)))
    post.move(Line((0.0, 0.0)))
    marks += ["", ""]
    assert len(post.blocks) == len(marks)
    runs = corners[0].turn if corners[0].is_convex else -corners[0].turn
    return Outline("".join(map(block_4b, post.blocks, marks)) + "DD\n", corners, is_die=to == runs)


def block_4b(row: Row, mark: str) -> str:
    block = row.block
    radius = 0 if block.sense == "L" else round(math.hypot(block.x, block.y))
    return f"B{block.x}B{block.y}B{block.count}B{radius}G{block.axis}{mark}{block.sense}{block.quadrant}\n"


def _corners(rng: random.Random, radii_um: tuple[float, float]) -> list[Corner] | None:
    n = rng.randint(3, 9)
    angles = [2.0 * math.pi * (k + rng.uniform(0.1, 0.9)) / n for k in range(n)]
    places = [(r * math.cos(a), r * math.sin(a)) for a in angles for r in [rng.uniform(8e3, 3e4)]]
    if rng.random() < 0.5:
        places.reverse()
    area = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(places, places[1:] + places[:1], strict=True))
    beside = zip(places[-1:] + places[:-1], places, places[1:] + places[:1], strict=True)
    made = [_corner(rng, three, math.copysign(1.0, area), radii_um) for three in beside]
    return [corner for corner in made if corner] if all(made) else None


def _corner(
    rng: random.Random, places: tuple[Place, Place, Place], orientation: float, radii_um: tuple[float, float]
) -> Corner | None:
    before, at, after = places
    coming = math.atan2(at[1] - before[1], at[0] - before[0])
    going = math.atan2(after[1] - at[1], after[0] - at[0])
    angle = math.remainder(going - coming, 2.0 * math.pi)
    room = 0.35 * min(math.dist(before, at), math.dist(at, after))
    most = room / math.tan(abs(angle) / 2.0) if abs(angle) > 0.05 else 0.0
    if most < radii_um[0] or abs(angle) > 2.9:
        return None
    radius = round(rng.uniform(radii_um[0], min(most, radii_um[1])))
    turn = 1 if angle > 0.0 else -1
    back = radius * math.tan(abs(angle) / 2.0)
    begin = at[0] - back * math.cos(coming), at[1] - back * math.sin(coming)
    end = at[0] + back * math.cos(going), at[1] + back * math.sin(going)
    center = begin[0] - turn * radius * math.sin(coming), begin[1] + turn * radius * math.cos(coming)
    return Corner(begin, end, center, turn, turn == orientation, abs(angle), radius)


def _shifted(place: Place, by: Place) -> Place:
    return place[0] + by[0], place[1] + by[1]


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--programs", type=int, default=1000)
    options.add_argument("--seed", type=int, default=1)
    asked = options.parse_args()
    rng = random.Random(asked.seed)
    found: Counter[str] = Counter()
    for _ in range(asked.programs):
        text = outline_4b(rng).text
        result = check_file(Job("a.4b", text.encode(), CheckSettings(wire_diameter_um=180.0)))
        codes = {finding.code for finding in result.findings} - {"3B110"}
        found.update(codes)
        if codes:
            print(text, *((finding.code, finding.block, dict(finding.values)) for finding in result.findings))
    print(f"{asked.programs} programs, findings but for 3B110: {dict(found)}")


if __name__ == "__main__":
    main()
