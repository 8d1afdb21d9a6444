"""The kerf is what discs about all places of the wire remove, to a tenth of a µm, and its edges lie beside the path."""

import math
import random

import numpy as np
import pytest
import shapely
import shapely.affinity
from paths import Pen
from traced import F, contours_of, kerf_along, trace_of

from parser.toolpath import Toolpath
from sim.cut.kerf.edges import nominal_region
from sim.cut.kerf.swept import kerf_of
from sim.table.trace import Trace


def union_of_discs(trace: Trace, offset: float, spacing: float = 2.0) -> shapely.Geometry:
    """The same, plainly: a disc of 512 corners at each sample and at each 2 µm of the way between."""
    way = shapely.LineString(trace.wire_um)
    places = shapely.line_interpolate_point(way, np.arange(0.0, way.length + spacing, spacing))
    places = np.concatenate([places, shapely.points(trace.wire_um)])
    return shapely.union_all(shapely.buffer(places, offset, quad_segs=128))


def alike(one: shapely.Geometry, other: shapely.Geometry, within: float) -> bool:
    """Whether what is in one alone is nowhere thicker; where two edges meet at a flat angle it may be long."""
    return shapely.buffer(shapely.symmetric_difference(one, other), -within / 2.0).is_empty


def wandering(seed: int) -> tuple[Trace, Toolpath]:
    """A path with corners, tight arcs and straights, and a wire that strays a little from it, as steps make it."""
    rng = random.Random(seed)
    pen = Pen()
    for _ in range(6):
        if rng.random() < 0.5:
            pen.to(pen.x + rng.uniform(-400, 400), pen.y + rng.uniform(-400, 400))
        else:
            radius, angle = rng.choice((20.0, 60.0, 150.0, 500.0)), rng.uniform(0, 2 * math.pi)
            sweep = rng.uniform(-3.0, 3.0)
            pen.arc(pen.x + radius * math.cos(angle), pen.y + radius * math.sin(angle), sweep)
    noise = np.random.default_rng(seed)
    return trace_of(pen.path(), stray=lambda place, row: place + noise.uniform(-0.3, 0.3, place.shape)), pen.path()


@pytest.mark.alike(1)
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("offset", [40.0, 100.0])
def test_the_kerf_is_the_union_of_the_discs_about_all_places(seed, offset):
    trace, path = wandering(seed)
    assert alike(kerf_along(path, trace, offset).region_um, union_of_discs(trace, offset), 0.12)


def test_a_slot_has_the_area_of_a_rectangle_and_two_half_discs():
    kerf = kerf_along(Pen().to(3000, 4000).path())
    assert kerf.area_mm2 * 1e6 == pytest.approx(2 * F * 5000 + math.pi * F**2, rel=1e-4)


@pytest.mark.parametrize("spacing", [0.3, 5.0, 40.0])
def test_the_kerf_does_not_depend_on_how_densely_the_trace_is_sampled(spacing):
    path = Pen().to(3000, 1000).to(500, 2500).path()
    region = kerf_along(path, trace_of(path, spacing)).region_um
    assert alike(region, nominal_region(path, ~path.is_jump, np.full(len(path), F)), 0.05)


def test_a_wire_that_waits_removes_no_more():
    path = Pen().to(1000, 0).path()
    trace = trace_of(path)
    at = np.repeat(np.arange(len(trace)), np.where(np.arange(len(trace)) == 90, 5000, 1))
    waiting = Trace(
        1e-3 * np.arange(len(at)),
        *(column[at] for column in (trace.commanded_um, trace.table_um, trace.wire_um)),
        trace.row[at],
    )
    assert kerf_along(path, waiting).area_mm2 == pytest.approx(kerf_along(path, trace).area_mm2, rel=1e-6)


def test_jumps_cut_nothing():
    path = Pen().to(1000, 0).jump(5000, 0).to(6000, 0).path()
    kerf = kerf_along(path)
    assert len(kerf.swept) == 2
    assert [part.bounds for part in kerf.region_um.geoms] == [
        pytest.approx((-F, -F, 1000 + F, F), abs=0.02),
        pytest.approx((5000 - F, -F, 6000 + F, F), abs=0.02),
    ]
    assert np.isnan(kerf.width.mean_um).tolist() == [False, True, False]


def test_what_the_wire_does_not_come_to_is_not_cut():
    path = Pen().to(1000, 0).to(1000, 1000).jump(0, 3000).to(1000, 3000).path()
    kerf = kerf_along(path, trace_of(path).until(0.3))
    assert kerf.region_um.bounds[3] == pytest.approx(500.0 + F, abs=0.02)
    assert np.isnan(kerf.width.mean_um).tolist() == [False, False, True, True]
    assert kerf.swept[1].region_um.is_empty


def test_no_cut_at_all_leaves_no_kerf():
    path = Pen().jump(1000, 0).path()
    kerf = kerf_along(path)
    assert kerf.area_mm2 == 0.0
    assert kerf.region_um.is_empty
    assert np.isnan(kerf.left_reach.mean_um).all()


def test_edges_lie_where_the_wire_strayed_to():
    path = Pen().to(4000, 3000).arc_to(4000, 9000, 4000, 6000, -1).path()
    left = np.array([-0.6, 0.8])

    def stray(place, row):
        out = (place - (4000, 6000)) / np.hypot(*(place - (4000, 6000)).T)[:, None]
        return place + np.where((row == 0)[:, None], 7.0 * left, 2.0 * out)

    kerf = kerf_along(path, trace_of(path, stray=stray))
    # Clockwise, the left of the path lies away from the centre.
    for sides, at in (
        (kerf.left_reach, (F + 7.0, F + 2.0)),
        (kerf.right_reach, (F - 7.0, F - 2.0)),
        (kerf.width, (2 * F, 2 * F)),
    ):
        for value in sides:
            np.testing.assert_allclose(value, at, atol=0.05)


def test_the_least_and_the_greatest_width_are_told_apart():
    path = Pen().to(10_000, 0).path()
    bump = kerf_along(path, trace_of(path, stray=lambda place, row: place + [[0.0, 1.0]] * (place[:, :1] > 7000)))
    assert bump.left_reach.min_um[0] == pytest.approx(F, abs=0.03)
    assert bump.left_reach.max_um[0] == pytest.approx(F + 1.0, abs=0.03)
    assert bump.left_reach.mean_um[0] == pytest.approx(F + 0.3, abs=0.03)


def test_corners_do_not_count_into_the_edges_of_their_blocks():
    path = Pen().to(1000, 0).to(1000, 1000).to(0, 1000).path()
    kerf = kerf_along(path)
    for sides in (kerf.left_reach, kerf.right_reach):
        np.testing.assert_allclose(np.stack(sides), F, atol=0.05)


@pytest.mark.parametrize("degrees", [0.0, 5.0, 30.0, 60.0, 90.0, 120.0])
def test_edges_count_from_where_those_of_both_blocks_meet(degrees):
    turn = math.radians(degrees)
    path = Pen().to(2000, 0).to(2000 + 2000 * math.cos(turn), 2000 * math.sin(turn)).path()
    edges = kerf_along(path).edges
    along = edges.place_um[edges.inner & (edges.row == 0), 0]
    # Plainly: the edges to the left are the lines at one offset; theirs meet there.
    lines = [shapely.LineString([(-9000, 0), (9000, 0)]).parallel_offset(F, "left")]
    lines.append(shapely.affinity.rotate(lines[0], degrees, origin=(0, 0)))
    met = min(-lines[0].intersection(lines[1]).x, F) if degrees else 0.0
    assert 2000 - along.max() == pytest.approx(met, abs=20.0)  # in whole stations
    assert 2000 - along.max() >= met - 1.0
    assert along.min() == pytest.approx(F, abs=20.0)


@pytest.mark.parametrize("length", [1.0, 30.0, 150.0])
def test_short_blocks_have_edges_too(length):
    path = Pen().to(500, 0).to(500 + length, 0).to(1200, 0).path()
    np.testing.assert_allclose(np.stack(kerf_along(path).width), 2 * F, atol=0.3)


def test_a_circle_of_two_turns_is_cut_once():
    path = Pen(1000.0, 0.0).arc(0, 0, 4 * math.pi).path()
    kerf = kerf_along(path)
    assert kerf.area_mm2 * 1e6 == pytest.approx(math.pi * (1100**2 - 900**2), rel=1e-4)
    np.testing.assert_allclose(np.stack(kerf.width), 2 * F, atol=0.05)


def test_the_nominal_kerf_is_that_of_a_wire_on_the_ideal_path():
    path = Pen().to(2000, 500).arc(1500, 1000, 2.0).arc(pen_x := 900, 2000, -4.0).to(pen_x, 5000).path()
    assert alike(
        nominal_region(path, ~path.is_jump, np.full(len(path), F)),
        kerf_along(path, trace_of(path, 2.0)).region_um,
        0.06,
    )


def test_arcs_within_the_offset_are_cut_to_their_middle():
    path = Pen().to(500, 0).arc(500, 60, math.pi).to(0, 120).path()
    region = nominal_region(path, ~path.is_jump, np.full(len(path), F))
    assert alike(region, union_of_discs(trace_of(path, 1.0), F), 0.06)
    assert sum(shapely.Polygon(ring).area for ring in region.interiors) < 0.1


def test_contours_keep_their_own_kerfs():
    path = Pen().to(1000, 0).jump(3000, 0).to(4000, 0).path()
    kerf = kerf_of(path, trace_of(path), contours_of(path), np.full(len(path), F))
    assert [one.region_um.area for one in kerf.swept] == pytest.approx([2 * F * 1000 + math.pi * F**2] * 2, rel=1e-4)
