"""Crossings: against every pair of blocks taken one at a time, with closed forms, and on shapes of known crossings."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from paths import Pen

from parser.shape.contours import contour_rows
from parser.shape.passes import find_passes
from sim.check.crossings import find_crossings


def crossings(pen: Pen) -> list[tuple[int, int]]:
    path = pen.path()
    return [(found.contour, found.crossings) for found in find_crossings(path, contour_rows(path), find_passes(path))]


def polyline(points: list[tuple[float, float]]) -> Pen:
    pen = Pen(*points[0])
    for point in points[1:]:
        pen.to(*point)
    return pen


def plain_line_crossings(points: list[tuple[float, float]]) -> int:
    blocks = list(itertools.pairwise(points))
    return sum(
        _cross(one, other) and not (i - j == 2 and is_corner_loop(other, blocks[j + 1], one))
        for i, one in enumerate(blocks)
        for j, other in enumerate(blocks[:i])
    )


def is_corner_loop(before, loop, after) -> bool:
    return math.dist(*loop) <= min(5000.0, math.dist(*before) / 2, math.dist(*after) / 2)


def _cross(one, other) -> bool:
    (ax, ay), (bx, by) = one
    (cx, cy), (dx, dy) = other
    ux, uy, vx, vy = bx - ax, by - ay, dx - cx, dy - cy
    cross = ux * vy - uy * vx
    lengths = math.hypot(ux, uy), math.hypot(vx, vy)
    if not all(lengths) or abs(cross) <= 0.05 * lengths[0] * lengths[1]:
        return False
    t, s = ((cx - ax) * vy - (cy - ay) * vx) / cross, ((cx - ax) * uy - (cy - ay) * ux) / cross
    ends = (t * lengths[0], (1 - t) * lengths[0], s * lengths[1], (1 - s) * lengths[1])
    return min(ends) * abs(cross) / (lengths[0] * lengths[1]) > 5.0


place = st.integers(-30, 30).map(lambda step: step * 17.0)


@given(st.lists(st.tuples(place, place), min_size=2, max_size=40))
def test_as_many_crossings_of_lines_as_pair_by_pair(points: list[tuple[float, float]]) -> None:
    number = plain_line_crossings(points)
    assert crossings(polyline(points)) == ([(0, number)] if number else [])


def test_as_many_on_a_long_walk_of_uneven_steps() -> None:
    rng = np.random.default_rng(5)
    steps = rng.normal(size=(700, 2)) * np.exp(rng.uniform(2, 8, size=(700, 1)))
    points = [tuple(point) for point in np.cumsum(steps, axis=0).tolist()]
    assert crossings(polyline(points)) == [(0, plain_line_crossings(points))]


@given(st.floats(0.0, 6.2), st.floats(0.4, 6.2), st.floats(-1500.0, 1500.0), st.booleans())
@example(
    start=3.3125, sweep=5.3125, height=0.0, first_the_line=False
)  # the way on cuts 2 µm deep into the arc that it leaves
def test_a_line_across_an_arc(start: float, sweep: float, height: float, first_the_line: bool) -> None:
    # The arc of R 1000 is flattened finely; away from its ends and from a touch both count the same.
    if abs(abs(height) - 1000.0) < 10.0:
        return
    half = math.sqrt(max(0.0, 1000.0**2 - height**2))
    angles = [math.atan2(height, x) for x in (-half, half)] if half else []
    turned = [(angle - start) % (2 * math.pi) for angle in angles]
    if any(min(t, abs(sweep - t), 2 * math.pi - t) < 0.1 for t in turned):
        return
    number = sum(t < sweep for t in turned)
    begin = (1000 * math.cos(start), 1000 * math.sin(start))
    end = (1000 * math.cos(start + sweep), 1000 * math.sin(start + sweep))
    if first_the_line:
        pen = Pen(-9000, height).to(9000, height).to(9000, 9000).to(*begin, kind=0)
        extra = plain_line_crossings([(-9000, height), (9000, height), (9000, 9000), begin])
        over = _on_arc((9000, 9000), begin, start, sweep)
        pen.arc(0, 0, sweep)
    else:
        pen = Pen(*begin).arc(0, 0, sweep).to(9000, 9000).to(9000, height).to(-9000, height)
        extra = plain_line_crossings([end, (9000, 9000), (9000, height), (-9000, height)])
        over = _on_arc((9000, 9000), end, start, sweep)
    if over is None:
        return
    total = number + extra + over
    assert crossings(pen) == ([(0, total)] if total else [])


def _on_arc(outside, on, start: float, sweep: float) -> int | None:
    """Crossings of the line from outside to a place on the circle with its arc; None where it is too near to call."""
    ux, uy = on[0] - outside[0], on[1] - outside[1]
    length = math.hypot(ux, uy)
    ux, uy = ux / length, uy / length
    toward = -(on[0] * ux + on[1] * uy)  # the other place on the circle lies 2 × toward further along
    overlap = 1000.0 - math.sqrt(1000.0**2 - toward**2)
    if abs(overlap - 5.0) < 0.1:
        return None
    if overlap < 5.0:  # a touch: line and circle overlap by less than crossings do
        return 0
    if toward > 0:
        return 0
    turned = (math.atan2(on[1] + 2 * toward * uy, on[0] + 2 * toward * ux) - start) % (2 * math.pi)
    if min(turned, 2 * math.pi - turned, abs(turned - sweep)) < 0.1:
        return None
    return int(turned < sweep)


@pytest.mark.parametrize(
    ("between", "number"), [(1500.0, 2), (1990.0, 2), (1999.0, 0), (2500.0, 0), (3.0, 0), (500.0, 2)]
)
def test_two_circles(between: float, number: int) -> None:
    # From and to places far from where they meet.
    pen = Pen(-1000, 0).arc(0, 0, 2 * math.pi).to(-1000, 3000).to(between + 1000, 3000).to(between + 1000, 0)
    pen.arc(between, 0, 2 * math.pi)
    assert crossings(pen) == ([(0, number)] if number else [])


def test_the_first_crossing_is_the_one_the_wire_meets_first() -> None:
    path = polyline([(0, 0), (1000, 0), (1000, 500), (300, 500), (300, -500), (700, -500), (700, 400)]).path()
    (found,) = find_crossings(path, contour_rows(path), find_passes(path))
    assert (found.crossings, found.first, found.is_complete) == (2, (3, 0, (300.0, 0.0)), True)


@pytest.mark.parametrize(
    "pen",
    [
        polyline([(0, 0), (1000, 0), (0, 0), (1000, 0)]),  # back and forth
        polyline([(0, 0), (1000, 0), (1000, 1000), (0, 1000), (0, 0), (500, 0), (500, -900)]),  # overcut and away
        Pen(0, 0).to(1000, 0).arc(0, 0, 2 * math.pi + 0.3).to(0, 0),  # more than a turn
        polyline([(0, 0), (0, 0), (9, 0), (9, 9), (4, 9), (4, -9)]),  # too short to tell
    ],
)
def test_no_crossing(pen: Pen) -> None:
    assert crossings(pen) == []


def test_consecutive_blocks_that_meet_again() -> None:
    assert crossings(Pen(-1000, 0).arc(0, 0, 1.7 * math.pi).to(588, -2500)) == [(0, 1)]


def test_contours_do_not_cross_each_other() -> None:
    pen = polyline([(0, 0), (1000, 0)]).jump(500, -500).to(500, 500)
    pen.jump(9000, 0).to(9900, 0).to(9900, 900).to(9500, 900).to(9500, -900)
    assert crossings(pen) == [(2, 1)]


def test_a_limit_on_the_pairs_is_said() -> None:
    path = polyline([(1000.0 * math.cos(3 * i), 1000.0 * math.sin(3 * i)) for i in range(60)]).path()
    (found,) = find_crossings(path, contour_rows(path), find_passes(path), most_pairs=10)
    assert not found.is_complete


def test_a_loop_round_a_sharp_corner_is_none() -> None:
    pen = Pen(0, 0).to(21000, 0).to(20000, -1000).to(20000, 20000).to(0, 20000).to(0, 0)
    assert crossings(pen) == []
    assert crossings(Pen(0, 0).to(26001, 0).to(20000, -6000).to(20000, 20000).to(0, 20000).to(0, 0)) == [(0, 1)]


@pytest.mark.parametrize(("side", "number"), [(2900, 0), (2800, 1)])
def test_a_loop_round_a_corner_is_no_longer_than_half_of_the_shorter_side(side: int, number: int) -> None:
    # The loop is 1000·sqrt(2) µm long.
    pen = Pen(0, 0).to(side, 0).to(side - 1000, -1000).to(side - 1000, 20000).to(0, 20000).to(0, 0)
    assert crossings(pen) == [(0, 1)] * number


@pytest.mark.parametrize(("beyond_um", "number"), [(4.9, 0), (5.1, 1)])
def test_a_crossing_is_clear_from_5_um_on_both_sides(beyond_um: float, number: int) -> None:
    assert crossings(polyline([(0, 0), (1000, 0), (1000, 500), (300, 500), (300, -beyond_um)])) == [(0, 1)] * number
    assert (
        crossings(polyline([(300 - beyond_um, 0), (1000, 0), (1000, 500), (300, 500), (300, -900)]))
        == [(0, 1)] * number
    )
