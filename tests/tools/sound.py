"""Sound programs as a correct CAM writes them, and how often a check says anything about one.

``PYTHONPATH=. python tests/tools/sound.py --programs 20000 --seed 1`` prints the findings that it gives, all of them
false, and the largest distance of an exact end from the drawing and from the end that the CAM worked out.
"""

import argparse
import math
import random
from collections import Counter
from typing import NamedTuple

from drawings import Arc, Line, Place
from sound_cam import Move, Pause, Post, Row
from sound_cuts import Cut, parting, random_cut

from parser.program import load_program
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.setup.machine.machine import load_machine


class Sound(NamedTuple):
    """A program's bytes, its blocks in order, and whether its path holds the usual wire's offset."""

    name: str
    data: bytes
    rows: list[Row]
    origin: Place
    fits_wire: bool


class Style(NamedTuple):
    """How a CAM spells its program."""

    label: str
    gap: str
    prints_ends: bool
    reduces: bool
    header: str
    newline: str


def sound_program(rng: random.Random) -> Sound:
    figures = 0 if rng.random() < 0.06 else rng.choice((1, 1, 1, 2, 3))
    cuts = [random_cut(rng) for _ in range(figures)] or [parting(rng)]
    at_nodes = len(cuts) > 1 and rng.random() < 0.4
    post = Post(cuts[0].start if rng.random() < 0.3 or at_nodes else (0.0, 0.0))
    moved = (post.at[0] - cuts[0].start[0], post.at[1] - cuts[0].start[1])
    for number, one in enumerate(cuts):
        here = moved if number == 0 else (moved[0] + sum(1.6 * c.size + 30_000.0 for c in cuts[:number]), moved[1])
        _write(rng, post, one, here, is_first=number == 0, at_nodes=at_nodes)
    text = program_text(rng, post)
    name = " + ".join(one.name for one in cuts) + (" nodes" if at_nodes else "")
    return Sound(name, text.encode(), post.blocks, post.origin, all(one.fits_wire for one in cuts))


def _write(rng: random.Random, post: Post, one: Cut, by: Place, *, is_first: bool, at_nodes: bool) -> None:
    start = one.start[0] + by[0], one.start[1] + by[1]
    if not is_first and at_nodes:
        start_rounded = round(start[0]) + 0.0, round(start[1]) + 0.0
        by = by[0] + start_rounded[0] - start[0], by[1] + start_rounded[1] - start[1]
        post.pause(start_rounded)
    elif not is_first:
        post.pause()
        post.move(Line(start), is_jump=True)
        if rng.random() < 0.7:
            post.pause()
    for number, move in enumerate(one.moves):
        if number in one.stops:
            post.pause()
        post.move(_shifted(move, by))


def _shifted(move: Move, by: Place) -> Move:
    to = move.to[0] + by[0], move.to[1] + by[1]
    return Line(to) if isinstance(move, Line) else Arc(to, (move.center[0] + by[0], move.center[1] + by[1]), move.turn)


def program_text(rng: random.Random, post: Post) -> str:
    style = Style(
        label=rng.choice(("", "N{}: ", "N {} : ", "{}: ")),
        gap=rng.choice(("", " ")),
        prints_ends=rng.random() < 0.5,
        reduces=rng.random() < 0.2,
        header=rng.choice(("", "caxa", "length")) or ("caxa" if post.origin != (0.0, 0.0) else ""),
        newline=rng.choice(("\n", "\r\n")),
    )
    lines = _header(style, post)
    number = 0
    for row in post.rows:
        if isinstance(row, Row):
            number += 1
            lines.append(style.label.format(number) + _block(style, row))
        elif isinstance(row, Pause):
            lines.append("D")
        else:
            lines.append(f"Start Point = {row.place[0] / 1000:.5f} , {row.place[1] / 1000:.5f} ; X , Y")
    return style.newline.join([*lines, "DD", ""])


def _header(style: Style, post: Post) -> list[str]:
    if not style.header:
        return []
    cut = sum(row.length for row in post.blocks if not row.is_jump)
    length = cut if style.header == "caxa" else cut + sum(row.length for row in post.blocks if row.is_jump)
    rule = "*" * 40
    lines = [rule, "CAXAWEDM -Version 2.0 , Name : part D.3B"]
    lines.append(f"Conner R= 0.00000 , Offset F= 0.10000 ,Length= {length / 1000:.3f} mm")
    lines.append(rule)
    x, y = post.origin
    return [*lines, f"Start Point = {x / 1000:.5f} , {y / 1000:.5f} ; X , Y"]


def _block(style: Style, row: Row) -> str:
    block, g = row.block, style.gap
    factor = math.gcd(block.x, block.y) if style.reduces and block.sense == "L" else 1
    numbers = (block.x // factor, block.y // factor, block.count)
    text = g.join([*(f"B{g}{number}" for number in numbers), f"G{block.axis}", f"{block.sense}{block.quadrant}"])
    return text + (f" ; {row.end[0] / 1000:.3f} , {row.end[1] / 1000:.3f}" if style.prints_ends else "")


def checks(program: Sound) -> list[CheckResult]:
    """Of a program on its own, and where it fits with its wire and on a table."""
    wire = {"wire_diameter_um": 180.0, "spark_gap_um": 10.0} if program.fits_wire else {}
    table = {"machine": load_machine("dk7740"), "start_mm": start} if (start := _start_mm(program)) else {}
    settings = [CheckSettings(), *([CheckSettings(**wire, **table)] if wire or table else [])]
    return [check_file(Job(program.name, program.data, one)) for one in settings]


def _start_mm(program: Sound) -> tuple[float, float] | None:
    """Where the program begins on the table with all of it in the middle; None where it may not fit."""
    middle = []
    for axis, begin in enumerate(program.origin):
        low = min([0.0, *(row.end[axis] - begin - _bulge(row) for row in program.rows)])
        high = max([0.0, *(row.end[axis] - begin + _bulge(row) for row in program.rows)])
        if high - low > 390_000.0:
            return None
        middle.append((low + high) / 2000.0)
    return 200.0 - middle[0], 250.0 - middle[1]


def _bulge(row: Row) -> float:
    """How far at most a block runs from its end, aside from the way to its start."""
    return 0.0 if row.block.sense == "L" else 2.0 * math.hypot(row.block.x, row.block.y)


def off_um(program: Sound) -> tuple[float, float]:
    """Largest distances of the exact ends from those that the CAM worked out, and from the drawing."""
    toolpath = load_program(program.data, program.name).toolpath
    rows = {int(line): end for line, end in zip(toolpath.source.line, toolpath.end_um.tolist(), strict=True)}
    lines = [k for k, text in enumerate(program.data.decode().splitlines(), 1) if "GX" in text or "GY" in text]
    ends = [tuple(rows[line]) for line in lines]
    own = max(math.dist(end, row.end) for end, row in zip(ends, program.rows, strict=True))
    return own, max(math.dist(end, row.drawn_end) for end, row in zip(ends, program.rows, strict=True))


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--programs", type=int, default=20_000)
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--show", type=int, default=0, help="programs to print for each code")
    asked.add_argument("--text", action="store_true", help="with their text")
    options = asked.parse_args()
    rng = random.Random(options.seed)
    codes: Counter[str] = Counter()
    shown: Counter[str] = Counter()
    with_any, farthest = 0, (0.0, 0.0)
    for number in range(options.programs):
        program = sound_program(rng)
        own, drawn = off_um(program)
        farthest = max(farthest[0], own), max(farthest[1], drawn)
        found = {finding.code: finding for result in checks(program) for finding in result.findings}
        codes.update(found.keys())
        with_any += bool(found)
        for code, finding in found.items():
            shown[code] += 1
            if shown[code] <= options.show:
                print(f"--- {number} {code} {finding.block} {program.name} {dict(finding.values)}")
                if options.text:
                    print(program.data.decode())
    print(f"{options.programs} programs, {with_any} with findings: {dict(codes.most_common())}")
    print(f"exact ends off by {farthest[0]:.2g} µm from the CAM's own, {farthest[1]:.2f} µm from the drawing")


if __name__ == "__main__":
    main()
