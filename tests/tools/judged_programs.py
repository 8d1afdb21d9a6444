"""Random drawings of known truth, made into 3B, and the decoded path held against the truth by plain means.

``PYTHONPATH=.:tests/tools python tests/tools/judged_programs.py --drawings 1000``. The truth is the figures' own closed
forms, taken through the transformations of blocks; the path is what a plain decoder makes of the text. Neither the
reader of drawings, nor the offset, nor the decoder of the product has a part in the judgement.
"""

import argparse
import math
import random
import re
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import shapely
from drawings_dxf import new
from ezdxf.document import Drawing as Document
from ezdxf.layouts.blocklayout import BlockLayout
from ezdxf.layouts.layout import Modelspace
from plain import SIGNS, PlainBlock, plain_end
from runs import plain_scenario
from sound_cam import plain_sweep

from sim.make.cam.maker import MadeProgram, NotMade, made_program, unproved
from sim.make.wanted import Wanted
from sim.setup.making import Making

Points = npt.NDArray[np.float64]
UNITS_UM = {0: 1e3, 1: 25400.0, 2: 304800.0, 4: 1e3, 5: 1e4, 6: 1e6, 8: 0.0254, 9: 25.4, 10: 914400.0, 13: 1.0, 14: 1e5}
"""$INSUNITS: inch, foot, mm, cm, m, microinch, mil, yard, µm, dm; none is mm."""
CHORD_UM = 0.05
"""How far chords lie off the curves that they are taken for, at most."""
CLOSED_UM = 0.5
_BLOCK = re.compile(r"B(\d+)B(\d+)B(\d+)G([XY])(L|NR|SR)([1-4])")


class Truth(NamedTuple):
    """What was drawn: contours as closed rows of places, µm, each with whether it is a hole; and its greatest gap."""

    contours: list[tuple[Points, bool]]
    gap_um: float


class Verdict(NamedTuple):
    """How it ended: what is wrong, the worst distance from the true path, the worst closure, µm."""

    ending: str
    off_um: float = 0.0
    open_um: float = 0.0


class _Pen(NamedTuple):
    """Where a shape is drawn, how many units a mm is, and how far ends may be moved, mm."""

    rng: random.Random
    space: BlockLayout | Modelspace
    per_mm: float
    gap_mm: float


def arc(center: tuple[float, float], radius: float, low: float, high: float, ratio: float = 1.0) -> Points:
    """Places on an arc of a circle, or of an ellipse that lies along X, mm."""
    number = 2 + math.ceil(abs(high - low) / math.sqrt(8e-3 * CHORD_UM / radius))
    angle = np.linspace(low, high, number)
    return np.column_stack([center[0] + radius * np.cos(angle), center[1] + radius * ratio * np.sin(angle)])


def _rounded(pen: _Pen, x: float, y: float, size: float) -> Points:
    """A rectangle with round corners, of lines and arcs in any order and direction, or with bulges; ends moved."""
    rng, per = pen.rng, pen.per_mm
    w, h = size * rng.uniform(0.6, 1.0), size * rng.uniform(0.6, 1.0)
    r = min(w, h) * rng.uniform(0.15, 0.9)
    at = [(x + w - r, y - h + r), (x + w - r, y + h - r), (x - w + r, y + h - r), (x - w + r, y - h + r)]
    turns = [(-math.pi / 2 + k * math.pi / 2, k * math.pi / 2) for k in range(4)]
    arcs = [arc(center, r, *turn) for center, turn in zip(at, turns, strict=True)]
    if rng.random() < 0.5:
        bulged = [(*one[row] * per, math.tan(math.pi / 8) * (row == 0)) for one in arcs for row in (0, -1)]
        draw = pen.space.add_lwpolyline if rng.random() < 0.5 else pen.space.add_polyline2d
        draw(bulged, format="xyb", close=True)
        return np.concatenate(arcs)
    acts: list[Callable[[], object]] = []
    for k, (low, high) in enumerate(turns):
        angles = math.degrees(low), math.degrees(high)
        acts.append(partial(pen.space.add_arc, (at[k][0] * per, at[k][1] * per), r * per, *angles))
        ends = [arcs[k][-1], arcs[(k + 1) % 4][0]]
        ends = [end + np.array([rng.uniform(-1, 1), rng.uniform(-1, 1)]) * pen.gap_mm for end in ends]
        rng.shuffle(ends)
        acts += [partial(pen.space.add_line, ends[0] * per, ends[1] * per)] * rng.choice((1, 1, 1, 2))
    rng.shuffle(acts)
    for act in acts:
        act()
    return np.concatenate(arcs)


def _circle(pen: _Pen, x: float, y: float, size: float) -> Points:
    """A circle, drawn once, twice, or as two arcs."""
    per, kind = pen.per_mm, pen.rng.randrange(3)
    if kind < 2:
        pen.space.add_circle((x * per, y * per), size * per)
    if kind > 0:
        turn = pen.rng.uniform(0, 360)
        pen.space.add_arc((x * per, y * per), size * per, turn, turn + 180)
        pen.space.add_arc((x * per, y * per), size * per, turn + 180, turn)
    return arc((x, y), size, 0, 2 * math.pi)


def _ellipse(pen: _Pen, x: float, y: float, size: float) -> Points:
    ratio, per = pen.rng.uniform(0.5, 0.95), pen.per_mm
    pen.space.add_ellipse((x * per, y * per), (size * per, 0), ratio)
    return arc((x, y), size, 0, 2 * math.pi, ratio)


def _polygon(pen: _Pen, x: float, y: float, size: float) -> Points:
    """A convex polygon of lines in any order and direction."""
    number, turn, per = pen.rng.randint(3, 7), pen.rng.uniform(0, 7), pen.per_mm
    angle = turn + 2 * np.pi * np.arange(number) / number
    places = np.column_stack([x + size * np.cos(angle), y + size * np.sin(angle)])
    sides = [(places[k] * per, places[k - 1] * per)[:: pen.rng.choice((1, -1))] for k in range(number)]
    pen.rng.shuffle(sides)
    for one, other in sides:
        pen.space.add_line(one, other)
    return places


def _spline(pen: _Pen, x: float, y: float, size: float) -> Points:
    """A closed smooth cubic spline of Bézier spans with threefold knots, perhaps rational with weights of 1."""
    number, rng = pen.rng.randint(4, 6), pen.rng
    angle = 2 * np.pi * np.arange(number) / number + rng.uniform(0, 1)
    radius = size * np.array([rng.uniform(0.8, 1.0) for _ in range(number)])
    nodes = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
    slopes = (np.roll(nodes, -1, axis=0) - np.roll(nodes, 1, axis=0)) / 6
    spans = np.stack([nodes, nodes + slopes, np.roll(nodes - slopes, -1, axis=0), np.roll(nodes, -1, axis=0)], axis=1)
    control = np.concatenate([spans[0][:1], spans[:, 1:].reshape(-1, 2)]) * pen.per_mm
    knots = [0.0] + [float(k) for k in range(number + 1) for _ in range(3)] + [float(number)]
    if rng.random() < 0.3:
        pen.space.add_rational_spline(control, [1.0] * len(control), degree=3, knots=knots)
    else:
        pen.space.add_open_spline(control, degree=3, knots=knots)
    t = np.linspace(0, 1, 400)[:, None]
    shares = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    return np.concatenate([sum(s * p for s, p in zip(shares, span, strict=True)) for span in spans])


_SHAPES = (_rounded, _circle, _ellipse, _polygon, _spline)


def random_drawing(rng: random.Random, path: Path) -> Truth:
    """A part with up to four holes, drawn flat or as a block that is turned, mirrored, stretched and arrayed."""
    unit = rng.choice(list(UNITS_UM))
    document = new(rng.choice(("R2000", "R2010", "R2018")), units=unit)
    per, gap = 1e3 / UNITS_UM[unit], rng.choice((0.0, 0.0, 0.002))
    space, in_block = document.modelspace(), rng.random() < 0.5
    inner: BlockLayout | Modelspace = document.blocks.new("PART") if in_block else space
    pen = _Pen(rng, inner, per, gap)
    size = rng.uniform(6, 15)
    contours = [(rng.choice(_SHAPES)(pen, 0.0, 0.0, size), False)]
    for k in rng.sample(range(4), rng.randint(0, 4)):
        x, y = 0.2 * size * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])[k]
        contours.append((rng.choice(_SHAPES)(pen, float(x), float(y), 0.13 * size), True))
    if in_block:
        contours = _inserted(rng, document, per, contours)
    document.saveas(path)
    return Truth([(places * 1e3, is_hole) for places, is_hole in contours], gap * 1e3 * 3)


def _inserted(
    rng: random.Random, document: Document, per: float, contours: list[tuple[Points, bool]]
) -> list[tuple[Points, bool]]:
    """The contours as the insert places them."""
    sx, sy, turn = rng.choice((1, -1)) * rng.uniform(1, 1.3), rng.choice((1.0, -1.0)), rng.uniform(0, 360)
    at, columns = np.array([rng.uniform(-50, 50), rng.uniform(-50, 50)]), rng.choice((1, 1, 2))
    document.blocks.new("OUTER").add_blockref("PART", (0, 0), {"xscale": sx, "yscale": sy})
    attributes = {"rotation": turn, "column_count": columns, "column_spacing": 60 * per}
    document.modelspace().add_blockref("OUTER", at * per, attributes)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    turned = np.array([[c, s], [-s, c]])
    return [
        ((places * (sx, sy) + (60.0 * column, 0)) @ turned + at, is_hole)
        for column in range(columns)
        for places, is_hole in contours
    ]


def decoded(text: str, start: Points) -> list[list[Points]]:
    """Places along each block, figure by figure; jumps between figures are left out."""
    figures, at, is_jump = [list[Points]()], start, False
    for line in text.split():
        found = _BLOCK.fullmatch(line)
        if line == "D":
            is_jump = not is_jump
            figures += [] if is_jump else [[]]
        if found is None:
            continue
        x, y, count = map(int, found.groups()[:3])
        block = PlainBlock(x, y, count, found[4], found[5], int(found[6]))
        by = plain_end(block)
        if not is_jump:
            figures[-1].append(at + _along(block, by))
        at = at + by
    return figures


def _along(block: PlainBlock, by: tuple[float, float]) -> Points:
    if block.sense == "L":
        return np.array([(0.0, 0.0), by])
    sx, sy = SIGNS[block.quadrant]
    x, y, turn = sx * block.x, sy * block.y, 1 if block.sense == "NR" else -1
    low, radius = math.atan2(y, x), math.hypot(x, y)
    return arc((-x / 1e3, -y / 1e3), radius / 1e3, low, low + turn * plain_sweep(block, by)) * 1e3


def judged(done: MadeProgram, truth: Truth, offset_um: float) -> Verdict:
    """The written path held against the truth."""
    figures = decoded(done.data.decode(), np.asarray(done.draft.curves.start_um[0]))
    if len(figures) != len(truth.contours):
        return Verdict(f"{len(figures)} figures of {len(truth.contours)}")
    allowed = done.plan.making.tolerance_um + 1.0 + truth.gap_um
    outlines = [shapely.Polygon(places) for places, _ in truth.contours]
    material = shapely.union_all(
        [one for one, (_, is_hole) in zip(outlines, truth.contours, strict=True) if not is_hole]
    )
    for outline, (_, is_hole) in zip(outlines, truth.contours, strict=True):
        material = material.difference(outline) if is_hole else material
    shapely.prepare(material)
    worst, gap, seen = 0.0, 0.0, set[int]()
    for blocks in figures:
        ring = blocks[1:-1] if offset_um else blocks
        path = shapely.LineString(np.concatenate(ring))
        own = min(range(len(outlines)), key=lambda k: float(np.abs(np.subtract(outlines[k].bounds, path.bounds)).sum()))
        seen.add(own)
        beside = -offset_um if truth.contours[own][1] else offset_um
        wanted = outlines[own].buffer(beside, quad_segs=256).exterior if beside else outlines[own].exterior
        worst = max(worst, _off(path, wanted), _off(wanted, path))
        gap = max(gap, math.dist(ring[0][0], ring[-1][-1]))
        if shapely.LineString(np.concatenate(blocks)).distance(material) < offset_um - allowed:
            return Verdict("wire in the part", worst, gap)
    if len(seen) != len(figures):
        return Verdict("a contour is cut twice", worst, gap)
    if worst > allowed:
        return Verdict("off the true path", worst, gap)
    return Verdict("open" if gap > CLOSED_UM else "sound", worst, gap)


def _off(line: shapely.Geometry, other: shapely.Geometry) -> float:
    """How far the vertices of a line lie from another one at most."""
    ends = shapely.get_coordinates(other)
    tree = shapely.STRtree([shapely.LineString(pair) for pair in np.stack([ends[:-1], ends[1:]], axis=1)])
    places = shapely.points(shapely.get_coordinates(line))
    return float(tree.query_nearest(places, return_distance=True, all_matches=False)[1].max())


def verdict(number: int, folder: Path, *, is_proved: bool = False) -> Verdict:
    """What comes of the drawing of a number."""
    rng = random.Random(f"judged:{number}")
    path = folder / "part.dxf"
    truth = random_drawing(rng, path)
    offset = rng.choice((0.0, 100.0, 100.0, 137.0))
    making = Making(passes_um=(offset,), corners="round", direction=rng.choice(("one-side", "ccw", "cw")))
    done = (made_program if is_proved else unproved)(path, making, Wanted("3b"), plain_scenario())
    if isinstance(done, NotMade):
        return Verdict(f"refused as {done.refusal.why}")
    if done.proof is not None and done.proof.verdict != "pass":
        return Verdict(f"proof: {done.proof.verdict}")
    return judged(done, truth, offset)


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--drawings", type=int, default=1000)
    options.add_argument("--first", type=int, default=0)
    options.add_argument("--seconds", type=float, default=math.inf, help="begin nothing more after so long")
    options.add_argument("--proved", action="store_true", help="with the proof by a run")
    asked = options.parse_args()
    begin, endings = time.monotonic(), Counter[str]()
    worst = closure = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(asked.first, asked.first + asked.drawings):
            if time.monotonic() - begin > asked.seconds:
                break
            found = verdict(number, Path(folder), is_proved=asked.proved)
            endings[found.ending] += 1
            worst, closure = max(worst, found.off_um), max(closure, found.open_um)
            if found.ending != "sound":
                print(number, found, flush=True)
    print(dict(endings), f"worst {worst:.3f} µm off, {closure:.3f} µm open")


if __name__ == "__main__":
    main()
