"""Gouges and uncut material: on necks of known width, and against distances sampled densely."""

import math
import random
from dataclasses import fields

import numpy as np
import pytest
import shapely
from capsules import contour_of, flattened
from paths import Pen, flipped
from shapely.geometry import Polygon
from sound_shapes import SHAPES, Shape, placed

from controller.offset.gouges import Gouge, gouges, uncut_um
from controller.offset.reach import reach
from controller.offset.shifted import Side
from parser.geometry.along import places_at
from parser.geometry.curves import Curves, Floats
from parser.geometry.distance import distance_to_curves

F = 100.0
STEP_UM = 0.5
"""Between samples: a distance is off by less than half of it."""


def keyhole(neck: float) -> Curves:
    """A pocket, counter-clockwise: a circle of R 1000 about (0, 0), and a slot from it to x = 3000, closed there."""
    h = 0.5 * neck
    x = math.sqrt(1000.0**2 - h * h)
    pen = Pen(x, -h).to(3000.0, -h).to(3000.0, h).to(x, h)
    return pen.arc_to(x, -h, 0.0, 0.0, 1).path().picked(slice(None))


def along_the_walls(neck: float) -> Curves:
    """The offset of its blocks, lengthened and shortened to where neighbours meet, as a controller makes it.

    The slot's end has vanished: the way back begins where the two walls' offsets end.
    """
    y = F - 0.5 * neck
    x = math.sqrt(900.0**2 - y * y)
    pen = Pen(x, y).to(3000.0 - F, y).to(3000.0 - F, -y).to(x, -y)
    return pen.arc_to(x, y, 0.0, 0.0, 1).path().picked(slice(None))


def sampled(curves: Curves) -> tuple[Floats, np.ndarray]:
    """Places (m, 2) no farther than a step apart on each curve, ends included, and their rows."""
    number = np.ceil(curves.length_um / STEP_UM).astype(np.int64) + 1
    row = np.repeat(np.arange(len(curves)), number)
    at = np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)
    return places_at(curves, row, at / (number[row] - 1) * curves.length_um[row]), row


def distances(curves: Curves, place_um: Floats) -> Floats:
    m = len(place_um)
    rows = (np.full(m, row) for row in range(len(curves)))
    return np.min([distance_to_curves(curves, row, *place_um.T)[0] for row in rows], axis=0)


@pytest.mark.parametrize("neck", [90.0, 120.0, 150.0, 199.0])
def test_a_neck_narrower_than_the_kerf_is_found_with_both_walls_and_its_overlap(neck: float) -> None:
    found = gouges(keyhole(neck), along_the_walls(neck), F, Side.LEFT)
    walls = [gouge for gouge in found if gouge.row in (0, 2)]
    assert [(gouge.path_row, gouge.row) for gouge in walls] == [(0, 2), (2, 0)]
    # f less the signed distance from the wall across: beyond it, the distance counts in full.
    assert [gouge.depth_um for gouge in walls] == pytest.approx([2.0 * F - neck] * 2, abs=1e-9)


@pytest.mark.parametrize("neck", [199.96, 200.0, 201.0])
def test_a_neck_as_wide_as_the_kerf_is_not(neck: float) -> None:
    assert gouges(keyhole(neck), along_the_walls(neck), F, Side.LEFT) == ()


def test_a_gouge_below_the_tolerance_is_found_with_a_finer_one() -> None:
    found = gouges(keyhole(199.96), along_the_walls(199.96), F, Side.LEFT, 0.001)
    assert {(gouge.path_row, gouge.row) for gouge in found} >= {(0, 2), (2, 0)}


def test_backwards_on_the_other_side_the_depths_are_the_same() -> None:
    there = gouges(keyhole(120.0), along_the_walls(120.0), F, Side.LEFT)
    back = gouges(flipped(keyhole(120.0)), flipped(along_the_walls(120.0)), F, Side.RIGHT)
    assert sorted(g.depth_um for g in back) == pytest.approx(sorted(g.depth_um for g in there), abs=1e-9)


def test_the_wall_at_the_end_of_a_neck_is_a_gouge_of_its_own() -> None:
    """As where the end has vanished, and each wall's offset runs as far as the wall."""
    to_the_end = line((998, 40), (3000, 40), (3000, -40), (998, -40))
    found = gouges(keyhole(120.0), to_the_end, F, Side.LEFT)
    assert {gouge.row: round(gouge.depth_um, 6) for gouge in found} == {2: 80.0, 1: 100.0, 0: 80.0}


def line(*places: tuple[float, float]) -> Curves:
    pen = Pen(*places[0])
    for place in places[1:]:
        pen.to(*place)
    return pen.path().picked(slice(None))


WALL = line((0, 0), (1000, 0), (2000, 0), (3000, 0))


def test_a_path_on_the_offset_or_beyond_cuts_nothing() -> None:
    assert gouges(WALL, line((0, F), (3000, F)), F, Side.LEFT) == ()
    assert gouges(WALL, line((-500, 500), (3500, 120)), F, Side.LEFT) == ()


def test_one_place_is_one_gouge_and_two_places_are_two() -> None:
    dips = line((0, F), (500, 60), (1500, 60), (1800, F), (2400, F), (2600, 80), (3000, F))
    assert gouges(WALL, dips, F, Side.LEFT) == (Gouge(1, 0, (500.0, 0.0), 40.0), Gouge(5, 2, (2600.0, 0.0), 20.0))


def test_what_is_cut_on_both_sides_of_a_corner_are_two_walls() -> None:
    corner = line((0, 0), (1000, 0), (1000, 1000))
    found = gouges(corner, line((0, F), (940, F), (940, 1000)), F, Side.LEFT)
    assert [(gouge.row, gouge.depth_um) for gouge in found] == [(1, pytest.approx(40.0))]
    found = gouges(corner, line((0, 70), (940, 70), (940, 1000)), F, Side.LEFT)
    assert {(gouge.row, round(gouge.depth_um, 6)) for gouge in found} == {(0, 30.0), (1, 40.0)}


@pytest.mark.parametrize(("low", "depth"), [(60.0, 40.0), (0.0, 100.0), (-30.0, 130.0), (-99.0, 199.0)])
def test_depth_is_the_offset_less_the_signed_distance(low: float, depth: float) -> None:
    (gouge,) = gouges(WALL, line((0, F), (1500, low), (3000, F)), F, Side.LEFT)
    assert gouge == Gouge(0, 1, (pytest.approx(1500.0), pytest.approx(0.0)), pytest.approx(depth))


def test_a_path_right_through_a_wall_cuts_by_the_offset_at_least() -> None:
    (gouge,) = gouges(WALL, line((1500, 5000), (1501, -5000)), F, Side.LEFT)
    assert gouge.depth_um >= F
    assert gouge.row == 1


def test_a_wall_met_from_behind_is_cut_by_what_the_kerf_reaches_beyond_it() -> None:
    """A web of 50 between two pockets: a path 10 beyond its one wall is 40 behind the other."""
    web = line((0, 0), (1000, 0), (1000, -50), (0, -50))
    found = gouges(web, line((300, -10), (700, -10)), F, Side.LEFT)
    assert {(gouge.row, round(gouge.depth_um, 6)) for gouge in found} == {(0, 110.0), (2, 60.0)}


@pytest.mark.parametrize("by", [40.0, 99.0])
def test_a_path_too_near_all_round_is_one_gouge_of_the_difference(by: float) -> None:
    for seed in range(40):
        contour = contour_of(random_shape(random.Random(seed)))
        for loop in reach(contour, by, Side.LEFT).loops:
            found = gouges(contour, loop.curves, F, Side.LEFT)
            assert max(gouge.depth_um for gouge in found) == pytest.approx(F - by, abs=1e-4)


def random_shape(rng: random.Random) -> Shape:
    return placed(rng.choice(SHAPES)(rng, rng.uniform(800.0, 3000.0)), rng.uniform(0.0, 6.0), rng.random() < 0.5)


def test_no_loop_of_the_true_offset_gouges_anywhere() -> None:
    for seed in range(200):
        rng = random.Random(seed)
        contour, f, side = contour_of(random_shape(rng)), rng.uniform(5.0, 300.0), rng.choice(list(Side))
        for loop in reach(contour, f, side).loops:
            assert gouges(contour, loop.curves, f, side, 1e-4) == ()


def shifted(curves: Curves, x: float, y: float) -> Curves:
    by = {"start_um", "end_um", "center_um"}
    columns = {field.name: getattr(curves, field.name) for field in fields(Curves)}
    return Curves(**{name: column + np.array([x, y]) if name in by else column for name, column in columns.items()})


@pytest.mark.deeper
def test_the_deepest_gouge_is_as_deep_as_samples_of_the_path_say() -> None:
    compared = 0
    for seed in range(60):
        rng = random.Random(seed)
        contour, f = contour_of(random_shape(rng)), rng.uniform(10.0, 200.0)
        polygon = Polygon(flattened(contour))
        way = rng.uniform(0.0, 6.3)
        for loop in reach(contour, f, Side.LEFT).loops:
            by = rng.uniform(0.1, 0.9) * f
            path = shifted(loop.curves, by * math.cos(way), by * math.sin(way))
            place, _ = sampled(path)
            assert shapely.contains_xy(polygon, *place.T).all()  # moved by less than f: still on its side
            depth = f - distances(contour, place).min()
            found = gouges(contour, path, f, Side.LEFT)
            assert max((gouge.depth_um for gouge in found), default=0.0) == pytest.approx(depth, abs=0.5 * STEP_UM)
            assert all(abs(distances(contour, np.array([gouge.place_um]))[0]) < 1e-6 for gouge in found)
            compared += 1
    assert compared > 30


def test_depth_and_place_of_each_gouge_are_those_of_its_two_blocks() -> None:
    for seed in range(60):
        rng = random.Random(seed)
        contour, f = contour_of(random_shape(rng)), rng.uniform(10.0, 200.0)
        for loop in reach(contour, f, Side.LEFT).loops:
            path = shifted(loop.curves, 0.5 * f, 0.0)
            for gouge in gouges(contour, path, f, Side.LEFT):
                place = np.array([gouge.place_um])
                own, row = path.picked(slice(gouge.path_row, gouge.path_row + 1)), slice(gouge.row, gouge.row + 1)
                assert distances(contour.picked(row), place)[0] < 1e-6
                assert distances(own, place)[0] == pytest.approx(f - gouge.depth_um, abs=1e-6)


def test_nothing_gouged_of_nothing() -> None:
    empty = WALL.picked(slice(0))
    assert gouges(WALL, empty, F, Side.LEFT) == ()


def test_gouges_come_in_the_order_of_the_path_and_the_same_again() -> None:
    path = line((0, 50), (3000, 50), (3000, 500), (0, 500), (0, 40), (900, F))
    found = gouges(WALL, path, F, Side.LEFT)
    assert [gouge.path_row for gouge in found] == sorted(gouge.path_row for gouge in found)
    assert found == gouges(WALL, path, F, Side.LEFT)


def test_a_square_corner_keeps_its_diagonal_less_the_radius() -> None:
    square = line((0, 0), (1000, 0), (1000, 1000), (0, 1000), (0, 0))
    (loop,) = reach(square, F, Side.LEFT).loops
    left = uncut_um(square, loop.curves, F, np.array([0, 2]))
    assert left == pytest.approx([(math.sqrt(2.0) - 1.0) * F] * 2, abs=0.01)


def test_an_inner_fillet_smaller_than_the_wire_is_left_standing() -> None:
    """Of a corner of 90° with R = 40: the wire's edge stays (√2 − 1)(f − R) from its middle."""
    pen = Pen(0.0, 1000.0).to(0.0, 40.0).arc(40.0, 40.0, math.pi / 2.0)
    contour = pen.to(1000.0, 0.0).path().picked(slice(None))
    path = line((F, 1000.0), (F, F), (1000.0, F))
    left = uncut_um(contour, path, F, np.array([1, 0]))
    assert left[0] == pytest.approx((math.sqrt(2.0) - 1.0) * (F - 40.0), abs=0.01)
    assert left[1] <= left[0]


def test_a_slot_that_the_wire_does_not_enter_is_left_to_its_end() -> None:
    contour = keyhole(90.0)
    (loop,) = reach(contour, F, Side.LEFT).loops
    place, _ = sampled(contour.picked(slice(1, 2)))
    wanted = distances(loop.curves, place).max() - F
    assert uncut_um(contour, loop.curves, F, np.array([1, 3])) == pytest.approx([wanted, 0.0], abs=0.01)


def test_uncut_is_what_dense_samples_say() -> None:
    for seed in range(4):
        rng = random.Random(seed)
        contour, f = contour_of(random_shape(rng)), rng.uniform(20.0, 200.0)
        for loop in reach(contour, f, Side.LEFT).loops[:1]:
            place, row = sampled(contour)
            left = np.maximum(distances(loop.curves, place) - f, 0.0)
            wanted = [left[row == k].max() for k in range(len(contour))]
            ours = uncut_um(contour, loop.curves, f, np.arange(len(contour)))
            assert ours == pytest.approx(wanted, abs=0.5 * STEP_UM + 0.01)
            assert np.all(ours >= np.array(wanted) - 0.011)
