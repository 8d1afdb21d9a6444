"""Dense polylines to arcs: as few as the tolerance asks, never over it, through vertices, with corners kept."""

import time

import numpy as np
import pytest
import shapely
from drawings_dxf import drawn as drawn_file

from parser.drawing.fit import polylines
from parser.drawing.fit.curves import loops_with_arcs
from parser.drawing.fit.pieces import Fitted
from parser.drawing.fit.polylines import FEWEST_LINES, best_bulges, off_um
from parser.drawing.model import Drawing, DrawnLoop, Entity, running
from parser.drawing.read import read_drawing
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, curves_between, joined

ROUNDING_UM = 1e-6


def _lines(vertices: Floats) -> Curves:
    return curves_between(vertices[:-1], vertices[1:], vertices[1:], np.zeros(len(vertices) - 1))


def _closed(vertices: Floats) -> Curves:
    return _lines(np.concatenate([vertices, vertices[:1]]))


def arcs_of_lines(curves: Curves, tolerance_um: float, *, is_closed: bool) -> Fitted:
    """All of the curves as they are drawn."""
    return polylines.arcs_of_lines(curves, np.ones(len(curves), dtype=np.bool_), tolerance_um, is_closed=is_closed)


def _turn(number: int) -> Floats:
    return 2.0 * np.pi * np.arange(number) / number


def _polar(radius: Floats, angle: Floats) -> Floats:
    return radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def _ellipse(number: int) -> Floats:
    return np.column_stack([20_000.0 * np.cos(_turn(number)), 10_000.0 * np.sin(_turn(number))])


def _cam(number: int) -> Floats:
    angle = _turn(number)
    return _polar(20_000.0 + 4_000.0 * np.cos(angle) + 1_500.0 * np.cos(2.0 * angle), angle)


def _wild(seed: int) -> Floats:
    """Closed, of some hundred vertices at uneven steps, some of them corners, some rounded as files are."""
    rng = np.random.default_rng(seed)
    number = int(rng.integers(60, 500))
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, number)) if seed % 3 else _turn(number)
    radius = 10.0 ** rng.uniform(1.5, 4.5) * np.ones(number)
    for wave in range(1, 6):
        radius *= 1.0 + rng.uniform(-0.25, 0.25) / wave * np.cos(wave * angle + rng.uniform(0.0, 6.0))
    vertices = _polar(radius, angle)
    if seed % 2:
        vertices += rng.normal(0.0, rng.choice([0.01, 0.5, 3.0]), vertices.shape)
    vertices = np.round(vertices, 1) if seed % 5 == 0 else vertices
    return vertices[np.hypot(*(vertices - np.roll(vertices, 1, axis=0)).T) > 0.05]


def _on(curves: Curves, number: int = 60) -> Floats:
    """Places (n · number, 2) on curves, their ends among them."""
    row = np.repeat(np.arange(len(curves)), number)
    return places(curves, row, np.tile(np.linspace(0.0, 1.0, number), len(curves)))


def _from_arcs(place: Floats, curves: Curves) -> Floats:
    """Distances (p,) of places from the nearest of curves, by the closed form of each."""
    nearest = np.full(len(place), np.inf)
    for row in range(len(curves)):
        start, end = curves.start_um[row], curves.end_um[row]
        ends = np.minimum(np.hypot(*(place - start).T), np.hypot(*(place - end).T))
        if curves.is_arc[row]:
            out = place - curves.center_um[row]
            sweep = curves.sweep_rad[row]
            turned = ((np.arctan2(out[:, 1], out[:, 0]) - curves.start_angle_rad[row]) * np.sign(sweep)) % (2 * np.pi)
            beside = np.abs(np.hypot(*out.T) - curves.radius_um[row])
            off = np.where(turned <= abs(sweep), np.minimum(beside, ends), ends)
        else:
            share = np.clip(((place - start) @ (end - start)) / ((end - start) @ (end - start)), 0.0, 1.0)
            off = np.hypot(*(place - start - share[:, None] * (end - start)).T)
        nearest = np.minimum(nearest, off)
    return nearest


def _apart_um(drawn: Curves, fitted: Curves) -> float:
    """How far the farthest of many places on either lies off the other."""
    there = _from_arcs(_on(drawn, 9), fitted).max()
    ring = shapely.LineString(np.concatenate([drawn.start_um, drawn.end_um[-1:]]))
    back = shapely.distance(shapely.points(_on(fitted)), ring).max()
    return float(max(there, back))


def _counts(fitted: Fitted) -> tuple[int, int]:
    return int(fitted.curves.is_arc.sum()), int((~fitted.curves.is_arc).sum())


@pytest.mark.alike(3)
@pytest.mark.parametrize("tolerance_um", [0.5, 5.0])
@pytest.mark.parametrize("seed", range(12))
def test_what_is_fitted_lies_within_its_bound_of_what_is_drawn_and_the_bound_within_the_tolerance(seed, tolerance_um):
    drawn = _closed(_wild(seed))
    fitted = arcs_of_lines(drawn, tolerance_um, is_closed=True)
    assert _apart_um(drawn, fitted.curves) <= fitted.max_um + ROUNDING_UM
    assert fitted.max_um <= tolerance_um
    np.testing.assert_allclose(fitted.curves.end_um, np.roll(fitted.curves.start_um, -1, axis=0), atol=1e-9)
    vertices = {tuple(place) for place in drawn.start_um.tolist()}
    assert {tuple(place) for place in fitted.curves.start_um.tolist()} <= vertices
    assert fitted.curves.start_um.tolist() == drawn.start_um[fitted.of].tolist()
    arcs = fitted.curves.picked(fitted.curves.is_arc)
    ends = arcs.center_um + _polar(arcs.radius_um, arcs.start_angle_rad + arcs.sweep_rad)
    np.testing.assert_allclose(ends, arcs.end_um, atol=1e-6)


@pytest.mark.deeper
@pytest.mark.parametrize(
    ("vertices", "counts"),
    [
        # "Nodes on curve", one arc between neighbours: measured by another program on the curves themselves.
        (_ellipse(10_000), {1.0: 32, 2.0: 24, 5.0: 18}),
        (_cam(10_000), {1.0: 21, 2.0: 17, 5.0: 12}),
    ],
    ids=["ellipse", "cam"],
)
def test_a_curve_of_many_lines_becomes_as_many_arcs_as_the_curve_itself(vertices, counts):
    drawn = _closed(vertices)
    for tolerance_um, number in counts.items():
        arcs, lines = _counts(arcs_of_lines(drawn, tolerance_um, is_closed=True))
        assert arcs <= number
        assert lines == 0


@pytest.mark.parametrize("number", [36, 37, 360, 361, 1000])
def test_a_circle_of_many_lines_is_two_arcs_of_one_length(number):
    fitted = arcs_of_lines(_closed(_polar(np.full(number, 300.0), _turn(number))), 2.0, is_closed=True)
    assert _counts(fitted) == (2, 0)
    np.testing.assert_allclose(fitted.curves.radius_um, 300.0, atol=2.0)
    assert np.degrees(np.abs(fitted.curves.sweep_rad)).min() > 130.0


@pytest.mark.parametrize("size_um", [5.0, 50.0, 10_000.0])
@pytest.mark.parametrize("sides", range(3, 13))
def test_polygons_stay_as_they_are_however_small(sides, size_um):
    drawn = _closed(_polar(np.full(sides, size_um), _turn(sides)))
    fitted = arcs_of_lines(drawn, 2.0, is_closed=True)
    assert _counts(fitted) == (0, sides)
    assert fitted.max_um == 0.0


@pytest.mark.parametrize("sides", [13, 24, 100])
def test_lines_too_coarse_for_the_tolerance_stay_lines(sides):
    """The sagitta of a side is R (1 − cos(π/n)): what an arc through the corners lies off the middle of the side."""
    sagitta_um = 10_000.0 * (1.0 - np.cos(np.pi / sides))
    drawn = _closed(_polar(np.full(sides, 10_000.0), _turn(sides)))
    assert _counts(arcs_of_lines(drawn, 0.45 * sagitta_um, is_closed=True)) == (0, sides)
    assert _counts(arcs_of_lines(drawn, 1.05 * sagitta_um + 0.01, is_closed=True)) == (2, 0)


def test_lines_that_run_straight_on_become_one():
    side = np.linspace(0.0, 10_000.0, 40)[:-1]
    zero, full = np.zeros_like(side), np.full_like(side, 10_000.0)
    square = np.concatenate(
        [np.column_stack(part) for part in ((side, zero), (full, side), (full - side, full), (zero, full - side))]
    )
    fitted = arcs_of_lines(_closed(np.roll(square, 17, axis=0)), 2.0, is_closed=True)
    assert _counts(fitted) == (0, 4)
    assert fitted.max_um <= 0.001
    np.testing.assert_allclose(fitted.curves.length_um, 10_000.0)


@pytest.mark.parametrize("corner_deg", [3.0, 8.0, 20.0, 60.0, 170.0])
def test_a_corner_between_dense_lines_stays_a_corner(corner_deg):
    """Two flanks of 5 mm radius, of lines of 0.06 mm, that meet at an angle."""
    angle = np.linspace(-0.6, 0.0, 51)
    flank = 5_000.0 * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    turn = np.radians(corner_deg)
    turned = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    vertices = np.concatenate([flank, (-flank[::-1] * (1.0, -1.0) @ turned)[1:]])
    fitted = arcs_of_lines(_lines(vertices), 2.0, is_closed=False)
    assert np.hypot(*fitted.curves.start_um.T).min() == 0.0
    assert _counts(fitted) == (2, 0)
    assert fitted.of.tolist() == [0, 50]


def test_arcs_and_long_lines_beside_dense_ones_stay_as_they_are():
    angle = np.linspace(-np.pi / 2, np.pi / 2, 91)
    dense = np.array([20_000.0, 3_000.0]) + 3_000.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    line = _lines(np.array([[0.0, 0.0], [20_000.0, 0.0]]))
    back = _lines(np.array([[20_000.0, 6_000.0], [0.0, 6_000.0]]))
    arc = curves_between(back.end_um, line.start_um, np.array([[0.0, 3_000.0]]), np.array([np.pi]))
    fitted = arcs_of_lines(joined([line, _lines(dense), back, arc]), 1.0, is_closed=True)
    assert _counts(fitted) == (2, 2)
    assert fitted.of.tolist() == [0, 1, 91, 92]
    assert fitted.curves.sweep_rad[[1, 3]] == pytest.approx([np.pi, np.pi], abs=1e-3)
    np.testing.assert_allclose(fitted.curves.radius_um[1], 3_000.0, atol=0.5)
    assert fitted.curves.center_um[3].tolist() == [0.0, 3_000.0]


@pytest.mark.parametrize("number", [*range(34, 44), 60, 90])
def test_no_few_lines_are_left_over_before_a_long_one(number):
    """A spiral of dense lines, which a straight line goes on from, is arcs to its last vertex whatever their number."""
    angle = np.linspace(0.3, 1.4, number)
    spiral = _polar(2_000.0 * (1.0 + angle), angle)
    way = np.exp(1.4j) * complex(2_000.0, 2_000.0 * 2.4)  # the derivative of r(θ) exp(iθ)
    vertices = np.concatenate([spiral, spiral[-1:] + np.array([[way.real, way.imag]])])
    fitted = arcs_of_lines(_lines(vertices), 1.3, is_closed=False)
    assert fitted.max_um <= 1.3
    assert fitted.curves.is_arc.tolist() == [True] * (len(fitted.of) - 1) + [False]
    assert fitted.of[-1] == number - 1


def test_an_open_polyline_keeps_its_ends_and_its_few_lines():
    vertices = _polar(np.full(FEWEST_LINES, 1_000.0), np.radians([0.0, 1.0, 2.0, 3.0]))
    assert _counts(arcs_of_lines(_lines(vertices), 2.0, is_closed=False)) == (0, FEWEST_LINES - 1)
    vertices = _polar(np.full(100, 1_000.0), np.radians(np.arange(100.0)))
    fitted = arcs_of_lines(_lines(vertices), 2.0, is_closed=False)
    assert _counts(fitted) == (1, 0)
    assert fitted.curves.start_um[0].tolist() == vertices[0].tolist()
    assert fitted.curves.end_um[0].tolist() == vertices[-1].tolist()


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", range(6))
def test_the_bulge_found_is_among_those_a_plain_search_finds(seed):
    """Of 1,500 bulges that are tried one by one, those within the tolerance are round the one that is found."""
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0.2, rng.uniform(0.6, 3.5), 30))
    vertices = _polar(rng.uniform(500.0, 5_000.0) * np.ones(30), angle) + rng.normal(0.0, 0.4, (30, 2))
    if seed % 2:
        vertices = vertices[::-1]
    tried = np.tan(np.linspace(-0.37 * np.pi, 0.37 * np.pi, 1_500))
    off = np.array([float(off_um(vertices, np.float64(bulge))) for bulge in tried])
    for within_um in (0.3, 1.0, 3.0):
        found = best_bulges(vertices, within_um)
        assert np.isnan(found) <= (off.min() > 0.7 * within_um)
        if not np.isnan(found):
            assert off_um(vertices, found) <= 1.5 * within_um


def test_lines_that_run_back_or_twice_round_are_no_arc():
    round_twice = _polar(np.full(41, 500.0), np.linspace(0.0, 3.2 * np.pi, 41))
    there_and_back = _polar(np.full(5, 500.0), np.array([0.0, 0.2, 0.1, 0.3, 0.4]))
    for vertices, sweep in ((round_twice, 1.2 * np.pi), (there_and_back, 0.4)):
        assert off_um(vertices, np.tan(0.25 * np.float64(sweep))) == np.inf


def test_loops_keep_their_entities_and_begin_at_their_leftmost_place():
    ring, square = _closed(_cam(400)), _closed(np.array([[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]) * 1_000.0)
    entity = np.repeat([0, 1, 2], [200, 200, 4])
    loops = (
        DrawnLoop(np.roll(np.arange(400), 7), np.zeros(400, dtype=np.bool_), True, 0.5),
        DrawnLoop(np.arange(403, 399, -1), np.ones(4, dtype=np.bool_), True, 0.0),
    )
    entities = tuple(Entity("LINE", str(number), "0", "") for number in range(3))
    drawing = Drawing("part", "R12", "mm", joined([ring, square]), entity, entities, loops, 0, 0.1, ())
    fitted = loops_with_arcs(drawing, 2.0)
    assert [(loop.closed, loop.gap_um) for loop in fitted.loops] == [(True, 0.5), (True, 0.0)]
    assert np.concatenate([loop.row for loop in fitted.loops]).tolist() == list(range(len(fitted.curves)))
    assert set(fitted.entity[fitted.loops[0].row].tolist()) == {0, 1}
    assert fitted.entity[fitted.loops[1].row].tolist() == [2, 2, 2, 2]
    for loop in fitted.loops:
        start = fitted.curves.start_um[loop.row]
        assert start[:, 0].argmin() == 0
    assert fitted.curves.sweep_rad[~np.isnan(fitted.curves.radius_um)].min() > 0.0


def test_ten_thousand_lines_are_fitted_in_a_moment():
    angle = _turn(10_000)
    drawn = _closed(_polar(20_000.0 + 300.0 * np.cos(100.0 * angle), angle))
    began = time.process_time()
    fitted = arcs_of_lines(drawn, 2.0, is_closed=True)
    assert time.process_time() - began < 3.0  # 0.25 s on an idle machine
    assert _counts(fitted)[0] < 800


def test_lines_that_were_fitted_to_other_curves_stay():
    drawn = _closed(_cam(400))
    is_drawn = np.arange(400) >= 200
    fitted = polylines.arcs_of_lines(drawn, is_drawn, 2.0, is_closed=True)
    assert sorted(set(range(200)) & set(fitted.of.tolist())) == list(range(200))
    assert len(fitted.of) < 230


def test_a_drawing_is_fitted_as_it_is_read(tmp_path):
    """A ring of dense lines, exploded and shuffled, an ellipse that has a bound of its own, and a hexagon."""

    def draw(space):
        places = (_cam(600) / 1_000.0).tolist()
        pairs = list(zip(places, [*places[1:], places[0]], strict=True))
        np.random.default_rng(3).shuffle(pairs)
        for start, end in pairs:
            space.add_line(start, end, {"layer": "Ring"})
        space.add_ellipse((100.0, 0.0), (20.0, 0.0), 0.5)
        space.add_lwpolyline(_polar(np.full(6, 3.0), _turn(6)).tolist(), close=True)

    path = drawn_file(tmp_path, draw)
    drawing, plain = read_drawing(path, fit_um=5.0), read_drawing(path)
    assert plain.fit is None
    assert drawing.fit is not None
    assert drawing.fit.max_um <= drawing.fit.tolerance_um == 5.0
    assert (drawing.fit.lines, drawing.fit.arcs) == (6, int(drawing.curves.is_arc.sum()))
    assert drawing.fit.arcs <= 13 + 18
    kinds = {drawing.entities[entity].kind for entity in drawing.entity.tolist()}
    assert kinds == {"LINE", "ELLIPSE", "LWPOLYLINE"}
    assert sorted(row for loop in drawing.loops for row in loop.row.tolist()) == list(range(len(drawing.curves)))
    for loop in drawing.loops:
        assert loop.closed
        ran = running(drawing.curves, loop.row, loop.backwards)
        np.testing.assert_allclose(ran.end_um, np.roll(ran.start_um, -1, axis=0), atol=1e-6)
