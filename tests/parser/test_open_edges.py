"""Passes there and back over an edge that is left open: how far aside, how long, how much alike, and where they end."""

import numpy as np
import pytest
from paths import Pen

from parser.program import parse_program
from parser.shape.contours import contour_rows
from parser.shape.open_edges import find_turns, open_sections, sections_elsewhere

THERE, BACK = (1, 1, False), (3, 3, False)


def sections_of(pen: Pen) -> list[tuple[int, int, bool]]:
    path = pen.path()
    return [tuple(one) for one in open_sections(path, (0, len(path)), find_turns(path, contour_rows(path)))]


def there(length_um: float = 9000.0, aside_um: float = 40.0) -> Pen:
    """From the hole to the edge, along it, and the step aside: the blocks 0 to 2."""
    return Pen(0, -2000).to(0, 0).to(length_um, 0).to(length_um, aside_um)


@pytest.mark.parametrize(
    ("aside_um", "is_pass"),
    [(2.9, False), (3.1, True), (149.0, True), (151.0, False), (-2.9, False), (-3.1, True), (-149.0, True)],
)
def test_passes_lie_3_to_150_um_aside(aside_um: float, *, is_pass: bool) -> None:
    assert sections_of(there(aside_um=aside_um).to(0, aside_um)) == ([THERE, BACK] if is_pass else [])


@pytest.mark.parametrize(("length_um", "is_edge"), [(990.0, False), (1010.0, True)])
def test_an_edge_is_a_millimetre_long(length_um: float, *, is_edge: bool) -> None:
    assert sections_of(there(length_um).to(0, 40)) == ([THERE, BACK] if is_edge else [])


def test_passes_go_on_to_one_side_and_round_a_slot_the_wire_goes_back() -> None:
    assert sections_of(there().to(0, 40).to(0, 80).to(9000, 80)) == [THERE, BACK, (5, 5, False)]
    assert sections_of(there().to(0, 40).to(0, 0).to(9000, 0)) == []


@pytest.mark.parametrize(("off_um", "is_pass"), [(440.0, True), (460.0, False)])
def test_passes_over_one_edge_end_within_450_um(off_um: float, *, is_pass: bool) -> None:
    assert sections_of(there(aside_um=10.0).to(off_um, 10)) == ([THERE, BACK] if is_pass else [])


@pytest.mark.parametrize(("away_um", "is_pass"), [(2100.0, True), (2250.0, False)])
def test_six_tenths_of_a_pass_run_beside_the_other(away_um: float, *, is_pass: bool) -> None:
    """1 of 9 mm lies away, and the ways out and in: 8 of 13.2 mm, or of 13.5 mm."""
    pen = there().to(7000, 40).to(7000, 40 + away_um).to(6000, 40 + away_um).to(6000, 40).to(0, 40)
    assert sections_of(pen) == ([THERE, (3, 7, False)] if is_pass else [])


@pytest.mark.parametrize(
    ("aside_um", "more_um", "is_pass"), [(40.0, 15.9, True), (40.0, 16.1, False), (10.0, 4.9, True), (10.0, 5.1, False)]
)
def test_a_pass_lies_alike_aside_to_its_end(aside_um: float, more_um: float, *, is_pass: bool) -> None:
    """By four tenths of what it lies aside, or 5 µm."""
    pen = there(aside_um=aside_um).to(3000, aside_um).to(3000, aside_um + more_um).to(0, aside_um + more_um)
    assert sections_of(pen) == ([THERE, (3, 5, False)] if is_pass else [])


def test_most_of_a_pass_says_how_far_aside_it_lies() -> None:
    pen = there(aside_um=60.0).to(6100, 60).to(6100, 20).to(2900, 20).to(2900, 60).to(0, 60)
    assert sections_of(pen) == [THERE, (3, 7, False)]


@pytest.mark.parametrize(("off_um", "is_tab"), [(4.9, False), (5.1, True)])
def test_a_way_from_end_to_end_is_the_tab_unless_it_comes_by_the_hole(off_um: float, *, is_tab: bool) -> None:
    pen = there().to(0, 40).to(off_um, -2000).to(9000, -2000).to(9000, 40)
    assert sections_of(pen) == [THERE, BACK, *([(4, 6, True)] if is_tab else [])]


def test_a_contour_that_comes_nowhere_near_an_edge_has_no_pass_over_it() -> None:
    figure = "B1000B0B1000GXL1\nB0B1000B1000GYL2\nB1000B0B1000GXL3\nB0B1000B1000GYL4\n"
    toolpath = parse_program(f"{figure}D\nB90000B0B90000GXL1\nD\n{figure}DD\n").toolpath
    assert sections_elsewhere(toolpath, (5, 9), np.arange(1), 450.0) == []
