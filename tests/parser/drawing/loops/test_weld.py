"""A contour is the same contour as a polyline, as lines and arcs that come nanometres apart, reversed, and far away."""

import math
import random
from pathlib import Path

import numpy as np
import pytest

from parser.drawing.model import running
from parser.drawing.read import read_drawing
from sim.measure.compare.unreachable import reachable

TEETH, ROOT_MM, TIP_MM, REACH_UM = 12, 8.0, 11.0, 100.0
Place = tuple[float, float]
Piece = tuple[Place, Place, float, float]
"""Two ends, and the angles of an arc about (0, 0), both 0 for a line."""
HEAD = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
TAIL = "0\nENDSEC\n0\nEOF\n"


def sprocket() -> list[Piece]:
    """Twelve teeth of arcs and lines, with sharp inside corners at their roots, counter-clockwise."""
    pieces: list[Piece] = []
    wide = 2.0 * math.pi / TEETH
    for tooth in range(TEETH):
        angle = [wide * (tooth + share) for share in (0.0, 0.25, 0.4, 0.6, 0.75, 1.0)]
        radius = (ROOT_MM, ROOT_MM, TIP_MM, TIP_MM, ROOT_MM, ROOT_MM)
        corner = [(r * math.cos(a), r * math.sin(a)) for r, a in zip(radius, angle, strict=True)]
        for at in range(5):
            arc = (angle[at], angle[at + 1]) if at in (0, 2, 4) else (0.0, 0.0)
            pieces.append((corner[at], corner[at + 1], *arc))
    return pieces


def polyline(pieces: list[Piece], shift_mm: float) -> str:
    vertices = "".join(
        f"10\n{x + shift_mm:.10f}\n20\n{y + shift_mm:.10f}\n42\n{math.tan((high - low) / 4.0):.12f}\n"
        for (x, y), _, low, high in pieces
    )
    return f"{HEAD}0\nLWPOLYLINE\n8\n0\n90\n{len(pieces)}\n70\n1\n{vertices}{TAIL}"


def entities(pieces: list[Piece], shift_mm: float, apart_mm: float, rng: random.Random) -> str:
    """Lines and arcs one by one, in any order, lines run either way, their places beside where they should be."""

    def at(value: float) -> str:
        return f"{value + shift_mm + rng.uniform(-apart_mm, apart_mm):.12f}"

    drawn = []
    for start, end, low, high in pieces:
        if low or high:
            radius = math.hypot(*start) + rng.uniform(-apart_mm, apart_mm)
            places = f"10\n{at(0.0)}\n20\n{at(0.0)}\n40\n{radius:.12f}"
            drawn.append(f"0\nARC\n8\n0\n{places}\n50\n{math.degrees(low):.12f}\n51\n{math.degrees(high):.12f}\n")
        else:
            (ax, ay), (bx, by) = (start, end) if rng.random() < 0.5 else (end, start)
            drawn.append(f"0\nLINE\n8\n0\n10\n{at(ax)}\n20\n{at(ay)}\n11\n{at(bx)}\n21\n{at(by)}\n")
    rng.shuffle(drawn)
    return HEAD + "".join(drawn) + TAIL


def left_by_a_wire(path: Path, text: str, side: int) -> list[float]:
    """Depths, µm, of what a wire cannot reach, in order."""
    path.write_text(text, "ascii")
    drawing = read_drawing(path)
    assert [loop.closed for loop in drawing.loops] == [True]
    found = reachable(drawing, np.array([side]), REACH_UM)
    return sorted(one.depth_um for one in found.unreachable)


@pytest.mark.alike(2)
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("shift_mm", [0.0, 1e-9, 1e6])
def test_what_a_wire_leaves_of_a_contour_is_the_same_however_it_is_drawn(
    tmp_path: Path, side: int, shift_mm: float
) -> None:
    wanted = left_by_a_wire(tmp_path / "a.dxf", polyline(sprocket(), 0.0), side)
    assert len(wanted) == 2 * TEETH
    assert left_by_a_wire(tmp_path / "a.dxf", polyline(sprocket(), shift_mm), side) == pytest.approx(wanted, abs=0.01)
    for seed, apart_mm in enumerate((0.0, 1e-12, 5.5e-7, 1e-5)):
        text = entities(sprocket(), shift_mm, apart_mm, random.Random(seed))
        assert left_by_a_wire(tmp_path / "a.dxf", text, side) == pytest.approx(wanted, abs=0.05), apart_mm


def test_joints_are_one_place_and_arcs_end_on_their_circles(tmp_path: Path) -> None:
    (tmp_path / "a.dxf").write_text(entities(sprocket(), 0.0, 1e-5, random.Random(7)), "ascii")
    drawing = read_drawing(tmp_path / "a.dxf")
    (loop,) = drawing.loops
    ring = running(drawing.curves, loop.row, loop.backwards)
    assert np.abs(ring.end_um - np.roll(ring.start_um, -1, axis=0)).max() == 0.0
    arcs = ring.is_arc
    for place in (ring.start_um, ring.end_um):
        away = np.hypot(*(place - ring.center_um)[arcs].T)
        assert away == pytest.approx(ring.radius_um[arcs], abs=1e-6)
    turned = ring.start_angle_rad + ring.sweep_rad
    ends = ring.center_um + ring.radius_um[:, None] * np.stack([np.cos(turned), np.sin(turned)], axis=1)
    assert np.abs(ends - ring.end_um)[arcs].max() < 1e-6
