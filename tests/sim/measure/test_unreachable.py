"""What a wire must leave in inside corners, against a disc that is rolled along the drawing by shapely."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
from compare_cases import die, drawing_of, polygon, punch, square, toolpath
from drawings import Arc, Line
from rough_and_trim import outline
from sound_shapes import SHAPES, Shape, placed

from sim.measure.compare.compare import compare_program
from sim.measure.compare.findings import by_entity, corner_places
from sim.measure.compare.result import FitRequest
from sim.measure.compare.rings import polygon as filled
from sim.measure.compare.unreachable import reachable

F = 100.0
SHARP = polygon((0, 0), (30_000, 0), (30_000, 8000), (12_000, 8000), (12_000, 40_000), (0, 40_000))
ROLLED_UM = 0.02
"""Chords of 0.01 µm stand for arcs, and 1024 sides for the disc: f (1 − cos(π / 1024)) = 0.0005 µm."""


def rolled(shape: Shape, side: int) -> shapely.Polygon:
    """The shape closed by a disc that rolls outside of it, or opened by one inside."""
    by = F * side
    made: shapely.Polygon = shapely.Polygon(outline(shape)).buffer(by, quad_segs=256).buffer(-by, quad_segs=256)
    return made


@pytest.mark.alike(1)
@pytest.mark.parametrize("seed", range(8))
def test_a_drawing_with_fillets_is_what_a_disc_leaves_of_it(seed: int) -> None:
    rng = random.Random(seed)
    shape = placed(SHAPES[seed % len(SHAPES)](rng, rng.uniform(3000.0, 9000.0)), rng.uniform(0.0, 6.28), mirror=False)
    drawing = drawing_of(shape)
    part_on_left = 1 if shapely.Polygon(outline(shape)).exterior.is_ccw else -1
    for side in (1, -1) if shape.neck > 2.0 * F else (1,):
        made = reachable(drawing, np.array([side * part_on_left]), F)
        assert filled(made.curves).exterior.hausdorff_distance(rolled(shape, side).exterior) < 0.1 + ROLLED_UM
        assert np.abs(made.curves.start_um - np.roll(made.curves.end_um, 1, axis=0)).max() < 1e-5


@pytest.mark.parametrize("angle_deg", [20.0, 60.0, 90.0, 150.0])
def test_a_corner_keeps_what_its_angle_says(angle_deg: float) -> None:
    """A wedge of this angle cut out as an opening: f (1 / sin(θ/2) − 1) stays in its point."""
    x, y = (40_000.0 * by for by in (math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))))
    (corner,) = [
        place
        for place in reachable(drawing_of(polygon((0, 0), (40_000, 0), (x, y))), np.array([-1]), F).unreachable
        if math.hypot(*place.where_um) < 1.0
    ]
    assert corner.depth_um == pytest.approx(F / math.sin(math.radians(angle_deg) / 2.0) - F, abs=1e-6)
    assert math.degrees(corner.angle_rad) == pytest.approx(angle_deg, abs=1e-6)


def test_an_arc_tighter_than_the_wire_is_as_a_corner() -> None:
    """An opening of 10 mm with one corner of R 40 µm: of its √2 · 60 µm to the middle of the fillet, 60 are within."""
    fillet = Arc((10_000.0, 40.0), (9960.0, 40.0), 1)
    shape = Shape(
        "one fillet", (0, 0), [Line((9960, 0)), fillet, Line((10_000, 10_000)), Line((0, 10_000)), Line((0, 0))], 1.0
    )
    tight = [
        place for place in reachable(drawing_of(shape), np.array([-1]), F).unreachable if place.where_um.x > 9900.0
    ]
    assert [place.entity for place in tight if place.where_um.y < 50.0] == [0]
    assert min(place.depth_um for place in tight) == pytest.approx((math.sqrt(2.0) - 1.0) * 60.0, abs=1e-6)


@pytest.mark.parametrize("past_um", [0.0002, 0.001, 3.0])
def test_a_corner_whose_sides_run_past_each_other_is_a_corner(past_um: float) -> None:
    """Files round the ends of a line and of the arc behind it; ends that lie apart by less than a gap are joined."""
    wedge = polygon((0, 0), (40_000, 0), (20_000, 20_000 * math.sqrt(3.0)))
    drawing = drawing_of(wedge)
    drawing.curves.end_um[0, 0] += past_um
    if past_um > 0.001:
        drawing = replace(drawing, loops=tuple(replace(loop, gap_um=past_um) for loop in drawing.loops))
    corners = sorted(reachable(drawing, np.array([-1]), F).unreachable, key=lambda place: place.where_um.x)
    assert [place.depth_um for place in corners] == pytest.approx([F, F, F], abs=past_um)


def test_a_slot_that_is_too_narrow_is_no_corner() -> None:
    """A notch of 150 µm in the side of an opening: a wire of 200 µm never enters, and nothing of it is told."""
    side, low, high = 10_000.0, 4925.0, 5075.0
    notched = polygon(
        (0, 0), (side, 0), (side, low), (side + 500, low), (side + 500, high), (side, high), (side, side), (0, side)
    )
    made = reachable(drawing_of(notched), np.array([-1]), F)
    assert sorted((place.where_um.x, place.where_um.y) for place in made.unreachable) == [
        (0.0, 0.0),
        (0.0, side),
        (side, 0.0),
        (side, side),
    ]
    found = compare_program(toolpath(die(square(side))), F, drawing_of(notched), FitRequest(5.0))
    assert found.max_um == pytest.approx(math.hypot(500.0, 0.0), abs=1.0)
    assert not found.passes


@pytest.mark.parametrize(("make", "corners"), [(punch, 1), (die, 5)])
def test_a_right_program_passes_and_its_corners_are_told(make: object, corners: int) -> None:
    found = compare_program(toolpath(make(SHARP)), F, drawing_of(SHARP), FitRequest(0.01))
    assert found.passes
    assert found.max_um < 1e-6
    places = corner_places(found)
    assert len(places) == corners
    assert [place.depth_um for place in places] == pytest.approx([(math.sqrt(2.0) - 1.0) * F] * corners)
    assert [note.name for note in found.notes] == ["sharp-corners"]
    assert {place.entity for place in by_entity(found)} == set(range(6))


def test_a_wire_that_leaves_more_than_it_must_fails() -> None:
    """A corner cut with R 500 where the drawing has none: (√2 − 1) · 400 µm more than the wire must leave."""
    moves = [Line((30_000, 0)), Line((30_000, 19_500)), Arc((29_500, 20_000), (29_500, 19_500), 1), Line((0, 20_000))]
    blunt = Shape("one fillet", (0.0, 0.0), [*moves, Line((0.0, 0.0))], 500.0)
    sharp = polygon((0, 0), (30_000, 0), (30_000, 20_000), (0, 20_000))
    found = compare_program(toolpath(die(blunt)), F, drawing_of(sharp), FitRequest(5.0))
    # A fit moves it by a little of what is left.
    assert found.max_um == pytest.approx((math.sqrt(2.0) - 1.0) * 400.0, abs=3.0)
    assert not found.passes
    assert len(found.unreachable) == 4
