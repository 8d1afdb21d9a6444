"""Distances of an edge from a drawing, and the motion that lays one on the other, against closed forms."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
from compare_cases import circle, curves_of, drawing_from, drawing_of, edge_from, edge_of, polygon, square
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import flipped
from sound_shapes import SHAPES, Shape, placed

from parser.geometry.along import places
from parser.geometry.curves import Curves, curves_between
from parser.geometry.distance import distance_to_curves, feet
from sim.measure.compare.compare import compare
from sim.measure.compare.directed import directed
from sim.measure.compare.findings import by_block, by_entity, worst_places
from sim.measure.compare.nearest import indexed, nearest
from sim.measure.compare.result import FitRequest
from sim.measure.compare.starts import Placement
from sim.measure.compare.starts import placed as laid

L_SHAPE = polygon((0, 0), (30_000, 0), (30_000, 8000), (12_000, 8000), (12_000, 40_000), (0, 40_000))


def random_shape(seed: int, size: float = 20_000.0) -> Shape:
    rng = random.Random(seed)
    return placed(rng.choice(SHAPES)(rng, size), rng.uniform(0.0, 6.28), rng.random() < 0.5)


def curves(shape: Shape) -> Curves:
    return curves_of(shape.start, shape.moves)


def sampled_max(one: Curves, other: Curves, number: int = 400) -> float:
    """Largest distance at places all along the one, from every curve of the other."""
    row = np.repeat(np.arange(len(one)), number)
    at = places(one, row, np.tile(np.linspace(0.0, 1.0, number), len(one)))
    all_rows = np.arange(len(other))
    least = [distance_to_curves(other, all_rows, *(np.full(len(other), c) for c in p))[0].min() for p in at]
    return float(max(least))


@settings(max_examples=20)
@given(st.integers(0, 10**6), st.integers(0, 10**6))
def test_feet_are_nearest_places(seed: int, of_place: int) -> None:
    of = curves(random_shape(seed))
    place = np.random.default_rng(of_place).uniform(-20_000.0, 20_000.0, (len(of), 2))
    row = np.arange(len(of))
    foot = feet(of, row, place).place_um
    exact, _ = distance_to_curves(of, row, place[:, 0], place[:, 1])
    assert np.hypot(*(foot - place).T) == pytest.approx(exact, abs=1e-6)
    on, _ = distance_to_curves(of, row, foot[:, 0], foot[:, 1])
    assert on == pytest.approx(0.0, abs=1e-6)


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_the_nearest_curve_is_that_of_all_pairs(seed: int) -> None:
    of = curves(random_shape(seed))
    place = np.random.default_rng(seed).uniform(-15_000.0, 15_000.0, (40, 2))
    found = nearest(indexed(of), place)
    row = np.arange(len(of))
    for at, distance, near in zip(place, found.distance_um, found.row, strict=True):
        exact, _ = distance_to_curves(of, row, np.full(len(of), at[0]), np.full(len(of), at[1]))
        assert distance == pytest.approx(exact.min(), abs=1e-9)
        assert near == np.flatnonzero(exact <= exact.min())[0]


@pytest.mark.parametrize("seed", range(6))
def test_the_nearest_of_many_scattered_lines_and_arcs_is_that_of_all_pairs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start, center = np.round(rng.normal(0.0, 9000.0, (300, 2))), rng.normal(0.0, 9000.0, (300, 2))
    sweep = np.where(rng.random(300) < 0.5, 0.0, rng.uniform(-7.0, 7.0, 300))
    cos, sin, (x, y) = np.cos(sweep), np.sin(sweep), (start - center).T
    turned = center + np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)
    end = np.where(sweep[:, None] == 0.0, np.roll(start, -1, axis=0), turned)
    of, row = curves_between(start, end, center, sweep), np.arange(300)
    place = np.concatenate([rng.normal(0.0, 20_000.0, (40, 2)), start[:20], center[:20]])
    found = nearest(indexed(of), place)
    for at, distance, near in zip(place, found.distance_um, found.row, strict=True):
        exact, _ = distance_to_curves(of, row, np.full(len(of), at[0]), np.full(len(of), at[1]))
        assert distance == pytest.approx(exact.min(), abs=1e-9)
        assert near == np.flatnonzero(exact <= exact.min())[0]


@pytest.mark.deeper
@settings(max_examples=8)
@given(st.integers(0, 10**6), st.floats(-30.0, 30.0), st.floats(-30.0, 30.0), st.floats(-0.003, 0.003))
def test_the_largest_distance_is_right_to_a_hundredth_of_a_micrometre(
    seed: int, x: float, y: float, turn: float
) -> None:
    one = curves(random_shape(seed))
    other = laid(one, Placement(turn, (x, y), mirror=False))
    found = directed(one, indexed(other))
    row = np.arange(len(one))
    there, _ = distance_to_curves(other, found.other, found.where_um[:, 0], found.where_um[:, 1])
    assert there == pytest.approx(found.max_um, abs=1e-6)
    assert places(one, row, found.fraction) == pytest.approx(found.where_um, abs=1e-9)
    number = max(3, 2000 // len(one))
    assert found.max_um.max() >= sampled_max(one, other, number) - 0.01


def test_concentric_circles_are_their_difference_apart() -> None:
    found = directed(curves(circle(10_000.0)), indexed(curves(circle(10_003.5))))
    assert found.max_um == pytest.approx([3.5], abs=1e-9)
    assert found.rms_um == pytest.approx(3.5, abs=1e-9)


def test_a_chord_lies_its_sagitta_from_the_arc() -> None:
    corners = [(10_000 * math.cos(k * 0.02 * math.pi), 10_000 * math.sin(k * 0.02 * math.pi)) for k in range(100)]
    found = directed(curves(polygon(*corners)), indexed(curves(circle(10_000.0))))
    sagitta = 10_000 * (1 - math.cos(0.01 * math.pi))
    assert found.max_um == pytest.approx(sagitta, abs=0.01)
    # Of a parabola of height s the mean square is 8/15 s².
    assert found.rms_um == pytest.approx(math.sqrt(8 / 15) * sagitta, rel=1e-3)


def test_directions_agree_with_shapely_on_polygons() -> None:
    rng = np.random.default_rng(4)
    for _ in range(10):
        one, other = (shapely.Polygon(rng.uniform(0, 1000, (9, 2))) for _ in range(2))
        a, b = (curves(polygon(*shape.exterior.coords[:-1])) for shape in (one, other))
        found = max(directed(a, indexed(b)).max_um.max(), directed(b, indexed(a)).max_um.max())
        exact = shapely.hausdorff_distance(one.exterior, other.exterior, densify=0.001)
        assert exact - 1e-6 <= found <= exact + 1.0  # shapely's own is of places 1/1000 of a side apart


def test_one_side_moved_by_7_um_is_7_um_off() -> None:
    moved = polygon((0, 0), (30_007, 0), (30_007, 8000), (12_000, 8000), (12_000, 40_000), (0, 40_000))
    found = compare(edge_of(moved), drawing_of(L_SHAPE), FitRequest(5.0, fitted=False))
    assert found.edge_max_um == pytest.approx(7.0, abs=1e-9)
    assert found.drawing_to_edge.max_um.max() == pytest.approx(7.0, abs=1e-9)
    assert not found.passes
    assert compare(edge_of(moved), drawing_of(L_SHAPE), FitRequest(7.001, fitted=False)).passes
    blocks = {place.block: place for place in by_block(found)}
    assert blocks[2].deviation_um == pytest.approx(7.0)
    assert (blocks[2].entity, blocks[2].side) == (1, 1)  # counter-clockwise, the part on the left: 7 µm left on it
    assert blocks[5].deviation_um == pytest.approx(0.0, abs=1e-9)
    entities = {place.entity: place.deviation_um for place in by_entity(found)}
    assert entities[1] == pytest.approx(7.0)
    assert entities[4] == pytest.approx(0.0, abs=1e-9)


def test_too_small_a_part_is_gouged() -> None:
    small = curves(square(9_990.0, 5.0, 5.0))
    for edge, sides in ((edge_from([small]), {-1}), (edge_from([flipped(small)], part_side=-1), {-1})):
        found = compare(edge, drawing_of(square(10_000.0)), FitRequest(1.0, fitted=False))
        assert {place.side for place in by_block(found)} == sides
        assert {place.side for place in by_entity(found)} == sides
    as_hole = compare(edge_from([small], part_side=-1), drawing_of(square(10_000.0)), FitRequest(1.0, fitted=False))
    assert {place.side for place in by_block(as_hole)} == {1}
    unknown = compare(edge_from([small], part_side=0), drawing_of(square(10_000.0)), FitRequest(1.0, fitted=False))
    assert {place.side for place in by_block(unknown)} == {0}


@pytest.mark.parametrize("turn", [0.0, math.radians(33.0), 2.9, -1.5])
@pytest.mark.parametrize("mirror", [False, True])
def test_turn_shift_and_mirror_are_found(turn: float, mirror: bool) -> None:
    placement = Placement(turn, (123_456.7, -9876.5), mirror)
    edge = laid(curves(L_SHAPE), placement)
    found = compare(edge_from([edge]), drawing_of(L_SHAPE), FitRequest(5.0))
    assert found.placement.turn_rad == pytest.approx(turn, abs=1e-9)
    assert found.placement.shift_um == pytest.approx(placement.shift_um, abs=1e-4)
    assert found.placement.mirror is mirror
    assert found.max_um < 1e-4
    assert [named.name for named in found.names] == ["mirrored"] * mirror + ["turned"] * (turn != 0.0)


@settings(max_examples=8)
@given(st.integers(0, 10**6), st.floats(-3.1, 3.1), st.booleans())
def test_any_shape_is_laid_on_itself(seed: int, turn: float, mirror: bool) -> None:
    of = curves(random_shape(seed))
    edge = laid(of, Placement(turn, (5e4, -3e4), mirror))
    assert compare(edge_from([edge]), drawing_from([of]), FitRequest(5.0)).max_um < 1e-3


@pytest.mark.parametrize(
    "shape", [circle(10_000.0), square(10_000.0), polygon((0, 0), (9000, 0), (9000, 4000), (0, 4000))]
)
def test_a_symmetric_part_is_neither_turned_nor_mirrored(shape: Shape) -> None:
    edge = laid(curves(shape), Placement(0.0, (777.0, -55.0), mirror=True))
    found = compare(edge_from([edge]), drawing_of(shape), FitRequest(5.0))
    assert found.placement.turn_rad == pytest.approx(0.0, abs=1e-9)
    assert not found.placement.mirror
    assert found.names == ()
    assert found.max_um < 1e-6


@pytest.mark.parametrize("corners", [11, 13, 16])
def test_a_part_of_many_equal_corners_is_not_turned_by_its_rounding(corners: int) -> None:
    """Each of its turns fits a little better or worse than the next."""
    at = np.exp(2j * np.pi * np.arange(corners) / corners) * 20_000.0
    whole = polygon(*((round(corner.real), round(corner.imag)) for corner in at))
    found = compare(
        edge_of(whole), drawing_of(polygon(*((corner.real, corner.imag) for corner in at))), FitRequest(5.0)
    )
    assert found.names == ()
    assert abs(found.placement.turn_rad) < 1e-4
    assert found.max_um < 1.0


def test_a_hole_that_is_not_drawn_does_not_draw_the_rest_off_its_place() -> None:
    """The rest lies on the drawing as before, and the hole is as far off as its farthest place is from any curve."""
    hole = circle(2000.0, 6000.0, 30_000.0)
    found = compare(edge_of(L_SHAPE, hole), drawing_of(L_SHAPE), FitRequest(5.0))
    outline = len(curves_of(L_SHAPE.start, L_SHAPE.moves))
    assert found.edge_to_drawing.max_um[:outline].max() < 1e-3
    assert found.edge_to_drawing.max_um[outline:].max() > 1000.0
    assert found.names == ()
    assert found.placement.turn_rad == pytest.approx(0.0, abs=1e-9)


def test_a_hole_drawn_elsewhere_is_found_where_it_is_cut() -> None:
    """5 mm beside its place a hole of R 2 mm is off by those 5 mm at most, and nothing else is."""
    cut, drawn = circle(2000.0, 6000.0, 30_000.0), circle(2000.0, 6000.0, 25_000.0)
    found = compare(edge_of(L_SHAPE, cut), drawing_of(L_SHAPE, drawn), FitRequest(5.0))
    outline = len(curves_of(L_SHAPE.start, L_SHAPE.moves))
    assert found.edge_to_drawing.max_um[:outline].max() < 1e-3
    assert 2000.0 < found.edge_to_drawing.max_um[outline:].max() <= 5000.0
    assert found.names == ()


def test_a_hole_that_nobody_cut_is_a_deviation_of_the_drawing_alone() -> None:
    hole = circle(2000.0, 6000.0, 30_000.0)
    found = compare(edge_of(L_SHAPE), drawing_of(L_SHAPE, hole), FitRequest(5.0))
    assert found.edge_max_um < 1e-6
    assert found.drawing_to_edge.max_um.max() == pytest.approx(6000.0, abs=0.01)
    assert not found.passes
    assert worst_places(found)[0].measured_from == "drawing"


@pytest.mark.alike(3)
@pytest.mark.parametrize("scale", [25.4, 1 / 25.4, 1000.0, 1e-3, 10.0, 0.1, 2.54, 1 / 2.54])
def test_a_slip_of_units_is_named_and_not_fitted_away(scale: float) -> None:
    small = [(x * scale, y * scale) for x, y in ((0, 0), (30_000, 0), (30_000, 8000), (9000, 25_000))]
    found = compare(
        edge_of(polygon(*small)),
        drawing_of(polygon((0, 0), (30_000, 0), (30_000, 8000), (9000, 25_000))),
        FitRequest(5.0),
    )
    assert [named.name for named in found.names] == ["unit-slip"]
    assert found.scale == pytest.approx(scale)
    assert found.max_um > 1000.0
    assert not found.passes
    assert not replace(found, request=FitRequest(1e9)).passes  # however large the tolerance is


@pytest.mark.parametrize("scale", [1.05, 2.0, 25.0])
def test_any_other_scale_is_a_deviation(scale: float) -> None:
    found = compare(edge_of(square(10_000.0 * scale)), drawing_of(square(10_000.0)), FitRequest(5.0))
    assert found.scale == 1.0
    assert found.names == ()
    # Laid centre on centre, a square differs by half of the difference of their sides, at corners √2 of it.
    assert found.edge_max_um == pytest.approx(5000.0 * abs(scale - 1.0) * math.sqrt(2.0), rel=1e-6)


@settings(max_examples=8)
@given(st.integers(0, 10**6))
def test_order_of_entities_and_direction_of_the_edge_change_nothing(seed: int) -> None:
    of = curves(random_shape(seed))
    by = np.random.default_rng(seed).normal(0.0, 3.0, 2)
    edge = laid(of, Placement(0.0005, (float(by[0]), float(by[1])), mirror=False))
    plain = compare(edge_from([edge]), drawing_from([of]), FitRequest(5.0, fitted=False))
    order = np.random.default_rng(seed).permutation(len(of))
    other = compare(edge_from([flipped(edge)], part_side=-1), drawing_from([of], order), FitRequest(5.0, fitted=False))
    assert other.edge_max_um == pytest.approx(plain.edge_max_um, abs=0.01)
    assert other.drawing_to_edge.max_um.max() == pytest.approx(plain.drawing_to_edge.max_um.max(), abs=0.01)
    assert other.edge_to_drawing.rms_um == pytest.approx(plain.edge_to_drawing.rms_um, rel=1e-3)


def test_worst_places_are_apart_and_in_order() -> None:
    bent = polygon((0, 0), (15_000, 4), (30_000, 0), (30_000, 8000), (12_000, 8000), (12_000, 40_000), (0, 40_009))
    found = worst_places(compare(edge_of(bent), drawing_of(L_SHAPE), FitRequest(5.0, fitted=False)))
    sizes = [place.deviation_um for place in found]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] == pytest.approx(9.0, abs=0.01)
    where = [place.where_um for place in found]
    assert min(math.dist(a, b) for k, a in enumerate(where) for b in where[:k]) > 600.0


def test_a_line_of_no_length_and_more_than_a_turn_are_taken() -> None:
    start = np.array([[0.0, 0.0], [100.0, 0.0]])
    odd = curves_between(start, start, np.zeros((2, 2)), np.array([0.0, 2.5 * math.pi]))
    found = directed(odd, indexed(odd))
    assert found.max_um == pytest.approx(0.0, abs=1e-9)
