"""The true offset: against shapely, against closed forms, and where walls touch, coincide and vanish."""

import itertools
import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
from capsules import CHORD_UM, contour_of, flattened, judged
from depth import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from paths import Pen, flipped
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from sound_shapes import SHAPES, Shape, begun_within, placed

from controller.offset.reach import OffsetLoop, Reached, reach
from controller.offset.shifted import Side
from parser.geometry.along import directions, places_at
from parser.geometry.curves import Curves, Floats, joined
from parser.geometry.distance import distance_to_curves

EXACT_UM = 2e-5
"""How exactly a loop keeps its distance: the tolerance that the reach states, and room for rounding."""
CHORDS_UM = 4.0 * CHORD_UM
"""Four polygons with chords are compared, none off by more than a chord."""


def distances(contour: Curves, place_um: Floats) -> Floats:
    """Distances (m,) from a contour, every curve looked at."""
    m, n = len(place_um), len(contour)
    x, y = (np.repeat(place_um[:, axis], n) for axis in (0, 1))
    return distance_to_curves(contour, np.tile(np.arange(n), m), x, y)[0].reshape(m, n).min(axis=1)


def farthest_from_offset(contour: Curves, reached: Reached, f: float) -> float:
    """Largest error µm of the distance of the loops from the contour, at five places of each curve."""
    places = [
        places_at(loop.curves, np.arange(len(loop.curves)), share * loop.curves.length_um)
        for loop in reached.loops
        for share in (0.0, 0.01, 0.4, 0.5, 0.99)
    ]
    return float(np.abs(distances(contour, np.concatenate(places)) - f).max()) if places else 0.0


def area(curves: Curves) -> float:
    """µm², by Green's formula, positive counter-clockwise."""
    start, end = curves.start_um, curves.end_um
    chords = 0.5 * (start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]).sum()
    sweep, radius = curves.sweep_rad, np.nan_to_num(curves.radius_um)
    return float(chords + 0.5 * (radius**2 * (sweep - np.sin(sweep))).sum())


def areas(reached: Reached) -> list[float]:
    return sorted(area(loop.curves) for loop in reached.loops)


def region(rings: list[Floats]) -> BaseGeometry:
    return shapely.union_all([shapely.make_valid(Polygon(ring)) for ring in rings if len(ring) > 2], grid_size=1e-4)


def sizeable(geometry: BaseGeometry) -> list[BaseGeometry]:
    """Parts that are more than a sliver left between chords."""
    return [part for part in shapely.get_parts(geometry) if not part.buffer(-CHORDS_UM).is_empty]


def assert_as_judged(contour: Curves, f: float, inside: bool, reached: Reached) -> None:
    """Contours are counter-clockwise: on the left lies the inside."""
    judge = judged(contour, f, inside)
    ours = region([flattened(loop.curves) for loop in reached.loops])
    if not inside:  # loops in pockets that have no way out are those of the inside of the judge's rings
        judge = shapely.union_all([Polygon(part.exterior) for part in shapely.get_parts(judge)])
        ours = shapely.union_all([Polygon(part.exterior) for part in shapely.get_parts(ours)])
    assert len(sizeable(ours)) == len(sizeable(judge))
    assert shapely.symmetric_difference(ours, judge).buffer(-CHORDS_UM).is_empty
    assert abs(ours.area - judge.area) <= CHORDS_UM * (ours.length + judge.length)


def assert_exact(contour: Curves, f: float, side: Side, reached: Reached) -> None:
    assert farthest_from_offset(contour, reached, f) < EXACT_UM
    for loop in reached.loops:
        curves, source = loop.curves, contour.picked(loop.source_row)
        assert np.array_equal(curves.end_um, np.roll(curves.start_um, -1, axis=0))
        own = curves.is_arc & ~loop.corner
        assert np.array_equal(own, source.is_arc & ~loop.corner)
        assert np.array_equal(curves.center_um[own], source.center_um[own])
        inward = f * side * np.sign(source.sweep_rad[own])
        assert np.array_equal(curves.radius_um[own], source.radius_um[own] - inward)
        assert np.array_equal(curves.center_um[loop.corner], source.end_um[loop.corner])
        assert curves.radius_um[loop.corner] == pytest.approx(f, rel=1e-9)


def random_case(rng: random.Random) -> tuple[Shape, float, bool]:
    """A contour, an offset up to where pockets fall apart or vanish, often as wide as half a slot; and the side."""
    size = 10.0 ** rng.uniform(2.3, 3.8)
    shape = placed(rng.choice(SHAPES)(rng, size), rng.choice((0.0, rng.uniform(0.0, 6.0))), rng.random() < 0.5)
    if rng.random() < 0.3:
        shape = begun_within(shape, rng.uniform(0.1, 0.9))
    f = rng.choice((shape.neck * rng.uniform(0.1, 1.2), 0.5 * shape.neck, size * 10.0 ** rng.uniform(-2.5, -0.3)))
    return shape, f, rng.random() < 0.7


@pytest.mark.deeper
@pytest.mark.parametrize("seed", range(8))
def test_the_loops_are_those_of_shapely_from_fine_chords(seed: int) -> None:
    rng = random.Random(seed)
    for _ in range(40):
        shape, f, inside = random_case(rng)
        contour, side = contour_of(shape), Side.LEFT if inside else Side.RIGHT
        reached = reach(contour, f, side)
        assert_exact(contour, f, side, reached)
        assert_as_judged(contour, f, inside, reached)


@pytest.mark.deeper
def test_the_area_is_that_of_shapelys_buffer_within_its_own_error() -> None:
    rng = random.Random(11)
    for _ in range(200):
        shape, f, inside = random_case(rng)
        contour = contour_of(shape)
        buffer = Polygon(flattened(contour)).buffer(-f if inside else f, quad_segs=256)
        if not inside:
            buffer = Polygon(buffer.exterior)
        # GEOS thins its input out by up to 1 % of the distance before it offsets it.
        allowed = (0.01 * f + CHORDS_UM) * contour.length_um.sum()
        ours = areas(reach(contour, f, Side.LEFT if inside else Side.RIGHT))
        assert abs((sum(ours) if inside else max(ours)) - buffer.area) <= allowed


@st.composite
def bulging(draw: st.DrawFn) -> Curves:
    """A ring of lines and arcs about (0, 0), counter-clockwise, with blocks from some µm up."""
    n = draw(st.integers(3, 9))
    gaps = np.cumsum(draw(st.lists(st.floats(0.01, 1.0), min_size=n, max_size=n)))
    angles = 2.0 * np.pi * gaps / gaps[-1]
    radii = np.array(draw(st.lists(st.floats(200.0, 1000.0), min_size=n, max_size=n)))
    corners = radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    pen = Pen(*corners[-1].tolist())
    for x, y in corners.tolist():
        _bulge_to(pen, x, y, draw(st.sampled_from((0.0, 0.0, 1e-7, -1e-3, 0.3, -0.5, 1.5))))
    contour = pen.path().picked(slice(None))
    assume(Polygon(flattened(contour)).is_valid and area(contour) > 0.0)
    # At a cusp two arcs may cross between two vertices of their chords.
    leaving, arriving = directions(contour)
    assume(np.all((np.roll(arriving, 1, axis=0) * leaving).sum(axis=1) > -0.99))
    return contour


def _bulge_to(pen: Pen, x: float, y: float, sweep: float) -> None:
    """A line, or an arc that sweeps so far."""
    chord = math.hypot(x - pen.x, y - pen.y)
    if not sweep or chord < 1.0:
        pen.to(x, y)
        return
    off = 0.5 / math.tan(0.5 * sweep)
    pen.arc(0.5 * (pen.x + x) - off * (y - pen.y), 0.5 * (pen.y + y) + off * (x - pen.x), sweep)
    pen.x, pen.y = x, y


@settings(max_examples=examples(80), deadline=None)
@given(bulging(), st.floats(1.0, 400.0), st.booleans())
def test_as_well_on_any_ring_of_lines_and_arcs(contour: Curves, f: float, inside: bool) -> None:
    side = Side.LEFT if inside else Side.RIGHT
    reached = reach(contour, f, side)
    assert farthest_from_offset(contour, reached, f) < EXACT_UM
    assert_as_judged(contour, f, inside, reached)


def ring(*corners: tuple[float, float]) -> Curves:
    pen = Pen(*corners[-1])
    for x, y in corners:
        pen.to(x, y)
    return pen.path().picked(slice(None))


SQUARE = ring((1000, 0), (1000, 1000), (0, 1000), (0, 0))


def circle(radius: float, turn: int = 1) -> Curves:
    return Pen(radius, 0.0).arc(0.0, 0.0, turn * 2.0 * math.pi).path().picked(slice(None))


def test_a_square_has_corners_inside_and_arcs_about_corners_outside() -> None:
    assert areas(reach(SQUARE, 100.0, Side.LEFT)) == [pytest.approx(800.0**2, abs=1e-6)]
    outside = reach(SQUARE, 100.0, Side.RIGHT)
    assert areas(outside) == [pytest.approx(1000.0**2 + 4000.0 * 100.0 + math.pi * 100.0**2, abs=1e-6)]
    assert outside.loops[0].source_row.tolist() == [0, 0, 1, 1, 2, 2, 3, 3]
    assert outside.loops[0].corner.tolist() == [False, True] * 4


@pytest.mark.parametrize(("side", "turn", "radius"), [(1, 1, 400.0), (-1, 1, 600.0), (1, -1, 600.0), (-1, -1, 400.0)])
def test_a_circle_of_one_block_stays_one(side: int, turn: int, radius: float) -> None:
    (loop,) = reach(circle(500.0, turn), 100.0, Side(side)).loops
    assert loop.curves.radius_um.tolist() == [radius]
    assert loop.curves.sweep_rad.tolist() == [turn * 2.0 * math.pi]


@pytest.mark.parametrize("f", [500.0, 500.0 + 1e-9, 501.0, 3000.0])
def test_nothing_is_reached_in_a_hole_no_wider_than_the_kerf(f: float) -> None:
    assert reach(circle(500.0), f, Side.LEFT) == Reached(())
    assert areas(reach(SQUARE, f + 1.0, Side.LEFT)) == []


def dumbbell(neck: float) -> Curves:
    """Two pockets of 1000 with a neck of 500 in length between them."""
    h = 0.5 * neck
    left = [(0, -h), (0, -500), (-1000, -500), (-1000, 500), (0, 500), (0, h)]
    right = [(500, h), (500, 500), (1500, 500), (1500, -500), (500, -500), (500, -h)]
    return ring(*reversed([*left, *right]))


def test_a_pocket_falls_apart_where_its_neck_is_narrower_than_the_kerf() -> None:
    apart = areas(reach(dumbbell(199.0), 100.0, Side.LEFT))
    assert apart == [pytest.approx(800.0**2, rel=0.01)] * 2
    assert len(reach(dumbbell(201.0), 100.0, Side.LEFT).loops) == 1


def test_a_neck_as_wide_as_the_kerf_is_reached_and_one_of_a_nanometre_less_is_not() -> None:
    through = reach(dumbbell(200.0), 100.0, Side.LEFT)
    assert len(through.loops) == 1
    assert farthest_from_offset(dumbbell(200.0), through, 100.0) < EXACT_UM
    assert len(reach(dumbbell(200.0 - 1e-3), 100.0, Side.LEFT).loops) == 2


@pytest.mark.parametrize("f", [30.0, 99.0, 100.0, 120.0])
@pytest.mark.parametrize("side", list(Side))
def test_where_a_contour_begins_changes_nothing(f: float, side: Side) -> None:
    contour = dumbbell(200.0)
    loops = areas(reach(contour, f, side))
    for first in range(1, len(contour)):
        turned = contour.picked(np.roll(np.arange(len(contour)), -first))
        assert areas(reach(turned, f, side)) == pytest.approx(loops, abs=1e-3)


def test_backwards_on_the_other_side_the_loops_are_the_same_backwards() -> None:
    rng = random.Random(5)
    for _ in range(60):
        shape, f, inside = random_case(rng)
        side = Side.LEFT if inside else Side.RIGHT
        one = reach(contour_of(shape), f, side)
        other = reach(flipped(contour_of(shape)), f, Side(-side))
        length = contour_of(shape).length_um.sum()
        assert sum(areas(one)) == pytest.approx(-sum(areas(other)), abs=EXACT_UM * length)
        assert len(one.loops) == len(other.loops)


@pytest.mark.deeper
def test_offset_and_offset_back_is_the_contour_where_nothing_vanished() -> None:
    rng = random.Random(6)
    whole = 0
    for _ in range(60):
        shape, f, _ = random_case(rng)
        contour = contour_of(shape)
        out = max(reach(contour, f, Side.RIGHT).loops, key=lambda loop: area(loop.curves)).curves
        back = max(reach(out, f, Side.LEFT).loops, key=lambda loop: area(loop.curves)).curves
        ours, drawn = Polygon(flattened(back)), Polygon(flattened(contour))
        if area(back) > area(contour) + EXACT_UM * drawn.length:  # an inner corner that the wire does not reach
            continue
        whole += 1
        assert len(back) == len(contour)
        assert shapely.hausdorff_distance(ours.exterior, drawn.exterior) < CHORDS_UM
    assert whole > 20


def split(contour: Curves, parts: int) -> Curves:
    """The same contour with every line in equal parts."""
    pen = Pen(*contour.start_um[0].tolist())
    for start, end in zip(contour.start_um.tolist(), contour.end_um.tolist(), strict=True):
        for k in range(1, parts + 1):
            share = k / parts
            pen.to(start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1]))
    return pen.path().picked(slice(None))


@pytest.mark.alike(1)
@pytest.mark.parametrize("side", list(Side))
@pytest.mark.parametrize("f", [10.0, 100.0, 130.0])
def test_lines_in_collinear_parts_and_in_blocks_of_a_micrometre(f: float, side: Side) -> None:
    contour = dumbbell(200.0)
    whole = areas(reach(contour, f, side))
    for parts in (3, 500):
        reached = reach(split(contour, parts), f, side)
        assert areas(reached) == pytest.approx(whole, abs=0.1)
        assert farthest_from_offset(contour, reached, f) < EXACT_UM


@pytest.mark.parametrize("gap", [(0.0, -3.0), (0.0, 3.0), (2.0, 1.0), (1e-7, 0.0)])
@pytest.mark.parametrize("side", list(Side))
def test_a_gap_where_the_contour_closes_is_bridged(gap: tuple[float, float], side: Side) -> None:
    open_ = ring((1000, 0), (1000, 1000), (0, 1000), gap)
    start = open_.start_um.copy()
    start[0] = 0.0
    (loop,) = reach(replace(open_, start_um=start), 100.0, side).loops
    assert area(loop.curves) == pytest.approx(areas(reach(SQUARE, 100.0, side))[0], rel=0.01)
    assert set(loop.source_row.tolist()) <= {0, 1, 2, 3}


def test_blocks_of_no_length_and_repeated_blocks_are_passed_over() -> None:
    wanted = areas(reach(SQUARE, 100.0, Side.LEFT))
    idle = joined([SQUARE.picked(slice(2)), ring((1000, 1000)), SQUARE.picked(slice(2, 4))])
    assert areas(reach(idle, 100.0, Side.LEFT)) == pytest.approx(wanted, abs=1e-3)
    twice = joined([SQUARE, SQUARE.picked(slice(2)), flipped(SQUARE.picked(slice(2)))])
    assert areas(reach(twice, 100.0, Side.LEFT)) == pytest.approx(wanted, abs=1e-3)


@pytest.mark.parametrize("turned", [0.0, 0.3, 0.5 * math.pi, 2.0, math.pi, 4.0])
@pytest.mark.parametrize("side", list(Side))
def test_a_spike_keeps_the_wire_off_on_all_sides(side: Side, turned: float) -> None:
    tip = (500, 400) if side == Side.LEFT else (500, -400)
    corners = np.array([(500, 0), tip, (500, 0), (1000, 0), (1000, 1000), (0, 1000), (0, 0)])
    c, s = math.cos(turned), math.sin(turned)
    spiked = ring(*map(tuple, corners @ np.array([[c, s], [-s, c]])))
    reached = reach(spiked, 50.0, side)
    plain = areas(reach(SQUARE, 50.0, side))
    taken = 100.0 * 350.0 + 0.5 * math.pi * 50.0**2
    assert areas(reached) == pytest.approx([plain[0] - side * taken], abs=1e-3)
    assert farthest_from_offset(spiked, reached, 50.0) < EXACT_UM


@pytest.mark.parametrize("short", [1e-9, 1e-6, 1e-4, 1e-2, 1.0])
@pytest.mark.parametrize("side", list(Side))
def test_arcs_that_almost_go_over_into_each_other(short: float, side: Side) -> None:
    """A slot whose ends are turned by a little beside its sides."""
    pen = Pen(0.0, -500.0).to(2000.0, -500.0).arc(2000.0, 0.0, math.pi - short / 500.0)
    pen.to(0.0, 500.0 + short).arc(0.0, short, math.pi)
    contour = pen.to(0.0, -500.0).path().picked(slice(None))
    for f in (100.0, 499.0, 499.9999):
        reached = reach(contour, f, side)
        assert farthest_from_offset(contour, reached, f) < EXACT_UM
        assert len(reached.loops) == 1


def test_the_loop_names_the_blocks_that_it_comes_from_in_the_contours_order() -> None:
    for seed, side in itertools.product(range(20), Side):
        contour = contour_of(random_case(random.Random(seed))[0])
        for loop in reach(contour, 5.0, side).loops:
            assert is_in_order(loop)


def is_in_order(loop: OffsetLoop) -> bool:
    return bool(np.all(np.diff(loop.source_row) >= 0))


@pytest.mark.parametrize("seed", range(3))
def test_contours_alike_but_for_their_place_have_loops_alike_but_for_their_place(seed: int) -> None:
    """As exactly as a loop keeps its distance, in whatever order they come; one 0.01 µm larger is another contour."""
    rng = random.Random(seed)
    shapes = [random_case(rng) for _ in range(4)]
    for _ in range(12):
        shape, f, inside = rng.choice(shapes)
        contour, side = contour_of(shape), Side.LEFT if inside else Side.RIGHT
        by_um, larger = np.array([rng.uniform(-1e6, 1e6), rng.uniform(-1e6, 1e6)]), 1.0 + 1e-2 / contour.length_um.max()
        there = replace(
            contour, **{name: getattr(contour, name) + by_um for name in ("start_um", "end_um", "center_um")}
        )
        grown = {name: getattr(there, name) * larger for name in ("start_um", "end_um", "center_um", "radius_um")}
        other = replace(there, **grown, length_um=there.length_um * larger)
        for moved in (there, other):
            reached = reach(moved, f, side)
            if moved is there:
                assert [len(loop.curves) for loop in reached.loops] == [
                    len(loop.curves) for loop in reach(contour, f, side).loops
                ]
            assert farthest_from_offset(moved, reached, f) < EXACT_UM
