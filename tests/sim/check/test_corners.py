"""Tight corners: the four cases of the side that an arc's centre lies on, in dies and punches, either way round."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from paths import Pen

from parser.shape.contours import contour_rows
from parser.shape.loops import find_loops
from parser.shape.passes import find_passes
from sim.check.geometry import tight_corners

OFFSET = 100.0


def notched(start: tuple[float, float] | None, radius: float, inward: bool, turn: int) -> Pen:
    """A square of 10 mm with one rounded corner, its centre inside the square, or outside (bitten off)."""
    corner = (10000.0 - radius, 0.0), (10000.0, radius)
    center = (10000.0 - radius, radius) if inward else (10000.0, 0.0)
    pen = Pen(*start).to(5000, 0) if start else Pen(5000, 0)
    if turn > 0:
        pen.to(*corner[0]).arc_to(*corner[1], *center, 1 if inward else -1)
        return pen.to(10000, 10000).to(0, 10000).to(0, 0).to(5000, 0)
    pen.to(0, 0).to(0, 10000).to(10000, 10000).to(*corner[1])
    return pen.arc_to(*corner[0], *center, -1 if inward else 1).to(5000, 0)


def tight(pen: Pen, is_drawing: bool = False) -> list[int]:
    path = pen.path()
    return tight_corners(path, contour_rows(path), find_passes(path), OFFSET, is_drawing).tolist()


@pytest.mark.parametrize("turn", [1, -1])
@pytest.mark.parametrize("inward", [True, False])
@pytest.mark.parametrize("drawing", [True, False])
@pytest.mark.parametrize(("start", "die"), [((5000, 3000), True), ((5000, -3000), False)])
@pytest.mark.parametrize("radius", [60.0, 94.0, 99.0, 300.0])
def test_the_side_of_the_centre_tells(
    *, radius: float, start: tuple[float, float], die: bool, drawing: bool, inward: bool, turn: int
) -> None:
    center_on_scrap = inward == die
    wrong = radius < OFFSET - 5.0 and center_on_scrap == drawing
    assert tight(notched(start, radius, inward, turn), drawing) == ([2 if turn > 0 else 5] if wrong else [])


def test_without_a_lead_in_a_small_arc_may_be_sound() -> None:
    assert tight(notched(None, 60.0, True, 1)) == tight(notched(None, 60.0, False, 1)) == []


def test_without_a_loop_a_small_arc_may_be_sound() -> None:
    assert tight(Pen().to(1000, 0).arc(1000, 60, 1.0).to(3000, 3000)) == []


def test_a_small_lead_in_arc_and_a_jump_are_none() -> None:
    pen = Pen(4950, 300).to(4950, 50).arc(5000, 50, math.pi / 2).to(10000, 0).to(10000, 9000).to(5000, 0)
    assert tight(pen) == []
    assert tight(pen.jump(50000, 0).to(51000, 0)) == []


place = st.integers(-9000, 9000).map(float)


@given(place, place, st.booleans(), st.integers(0, 3))
def test_the_part_lies_opposite_the_start_hole(x: float, y: float, reverse: bool, sides: int) -> None:
    """A figure of two half circles and two lines: inside is known in closed form."""
    off = max(abs(x) - 3000.0, 0.0)
    away = math.hypot(off, y) - 2000.0
    if abs(away) < 10.0 or math.hypot(x, y + 2000.0) < 20.0:
        return
    pen = Pen(x, y).to(0, -2000)
    if reverse:
        pen.to(-3000, -2000).arc(-3000, 0, -math.pi).to(3000, 2000).arc(3000, 0, -math.pi)
    else:
        pen.to(3000, -2000).arc(3000, 0, math.pi).to(-3000, 2000).arc(-3000, 0, math.pi)
    pen.to(0, -2000)
    pen.to(-500 * sides if reverse else 500 * sides, -2000)  # overcut, or a block of length 0
    path = pen.path()
    loops = find_loops(path, contour_rows(path), contour_rows(path)[:1])
    assert (loops.first.tolist(), loops.last.tolist()) == ([1], [5])
    assert loops.part_side.tolist() == [(-1 if away < 0 else 1) * (-1 if reverse else 1)]
