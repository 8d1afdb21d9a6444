"""Loops of contours that close several: where they are, and which of them end at a corner."""

from collections.abc import Callable
from math import pi

import pytest
from paths import Pen

from parser.shape.contours import contour_rows
from parser.shape.loops import several_loops


def loops_of(pen: Pen) -> list[tuple[int, int, bool]]:
    """First and last row of each loop, and whether it ends at a corner."""
    path = pen.path()
    return list(zip(*(column.tolist() for column in several_loops(path, contour_rows(path))), strict=True))


@pytest.mark.parametrize(
    ("figure", "is_loop"),
    [
        (lambda pen: pen.to(-5000, 800).to(-5000, 0), False),  # a slit, out and back
        (lambda pen: pen.arc(-5000, 3000, 1.0).arc(-5000, 3000, -1.0), False),  # the same along an arc
        (lambda pen: pen.arc(-5000, 3000, pi).arc(-5000, 3000, pi), True),  # a circle by its halves
        (lambda pen: pen.arc_to(-3000, 0, -4000, 2000, 1).arc_to(-5000, 0, -4000, 0, -1), True),  # a crescent
        (lambda pen: pen.arc_to(-3000, 0, -4000, 2000, 1).to(-5000, 0), True),  # an arc and its chord
        (lambda pen: pen.to(-3000, 0).arc_to(-5000, 0, -4000, 0, 1), True),
    ],
)
def test_two_blocks_close_a_loop_unless_they_run_out_and_back(figure: Callable[[Pen], Pen], *, is_loop: bool) -> None:
    pen = figure(Pen(-9000, 0).to(-5000, 0)).to(0, 0).to(1000, 0)
    pen.arc(0, 0, pi).arc(0, 0, pi).to(1050, 0).arc(0, 0, 2 * pi)
    assert loops_of(pen) == [(1, 2, is_loop), (5, 6, True), (8, 8, True)]


@pytest.mark.parametrize(("off_um", "is_found"), [(11.5, True), (12.5, False)])
def test_loops_that_end_at_no_corner_pass_within_12_um_of_where_they_began(off_um: float, *, is_found: bool) -> None:
    pen = Pen().to(1000, 0).arc(0, 0, 2 * pi)
    for x in (20_000, 40_000, 60_000):
        pen.to(x, 0).to(x + 9000, 0).to(x + 9000, 9000).to(x - off_um, 9000).to(x - off_um, -500)
    assert loops_of(pen) == ([(1, 1, True), (3, 6, False), (8, 11, False), (13, 16, False)] if is_found else [])


def test_contours_that_close_one_loop_have_not_several() -> None:
    pen = Pen().to(1000, 0).arc(0, 0, 2 * pi).to(0, 0)
    pen.jump(9000, 0).to(8000, 0).arc(9000, 0, 2 * pi).to(9000, 0).jump(20_000, 0)
    pen.to(21_000, 0).arc(20_000, 0, 2 * pi).to(20_000, 0).to(21_050, 0).arc(20_000, 0, 2 * pi)
    assert loops_of(pen) == [(9, 9, True), (12, 12, True)]
