"""The way of the wire's centre beside a contour: held against discs that shapely rolls along it."""

import random

import numpy as np
import pytest
import shapely
from cam_contours import circle, contour, figure, fitted_ellipse, flat, grown, region, rounded, star

from controller.offset.reach import reach
from controller.offset.shifted import Side
from parser.geometry.curves import Curves
from sim.make.cam.convex import beside_convex
from sim.make.cam.model import CannotCutError
from sim.make.cam.offset_path import SHORT_UM, offset_path
from sim.setup.making import CORNERS, Corners

WITHIN_UM = 0.3
"""How far a way lies off the true offset at most."""
DRAWN_UM = 0.03  # what lines for arcs, and shapely's discs, are off by


def lies_between(way: Curves, closed: Curves, by_um: float, inside: bool, within_um: float = WITHIN_UM) -> None:
    """The way lies between the offsets that are less and more by what it may be off."""
    cut, drawn, sign = region(way), region(closed), -1.0 if inside else 1.0
    least, most = (grown(drawn, sign * by_um + by) for by in (-within_um - DRAWN_UM, within_um + DRAWN_UM))
    assert cut.is_valid
    assert cut.contains(least)
    assert most.contains(cut)


def is_closed(way: Curves) -> bool:
    return bool(np.abs(way.end_um - np.roll(way.start_um, -1, axis=0)).max() <= 1e-3)


@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_round_corners_are_the_true_offset(seed: int, inside: bool) -> None:
    rng = random.Random(seed)
    closed = star(rng, rng.randint(3, 12), arcs=seed % 2 == 0)
    by_um = rng.choice((10.0, 100.0, 180.0))
    way = offset_path(figure(closed, inside=inside), by_um, "round")
    assert is_closed(way)
    lies_between(way, closed, by_um, inside)


@pytest.mark.parametrize("inside", [True, False])
def test_sharp_corners_of_up_to_90_degrees_meet_where_lines_do(inside: bool) -> None:
    places = [
        (0, 0),
        (9000, 0),
        (9000, 4000),
        (5000, 4000),
        (5000, 7000),
        (8000, 7000),
        (8000, 8000),
        (7000, 9000),
        (0, 9000),
    ]
    way = offset_path(figure(contour([(float(x), float(y)) for x, y in places]), inside=inside), 100.0, "sharp")
    assert len(way) == len(places)
    drawn = shapely.Polygon(places)
    mitred = drawn.buffer(-100.0 if inside else 100.0, join_style="mitre", mitre_limit=3.0)
    assert shapely.symmetric_difference(region(way), mitred).area < 1e-3


@pytest.mark.parametrize("seed", range(12))
def test_sharp_corners_take_no_more_of_the_part_and_stay_near_it(seed: int) -> None:
    rng = random.Random(seed)
    closed, by_um = star(rng, rng.randint(3, 12), arcs=True), 120.0
    way = offset_path(figure(closed, inside=False), by_um, "sharp")
    off = shapely.distance(shapely.points(flat(way)), shapely.LinearRing(flat(closed)))
    assert is_closed(way)
    assert off.min() >= by_um - WITHIN_UM - DRAWN_UM
    assert off.max() <= by_um * 1.43
    assert region(way).buffer(0.05).contains(region(offset_path(figure(closed, inside=False), by_um, "round")))


def test_a_chamfer_is_the_mitred_corner_cut_across_at_the_offset() -> None:
    places = [(0.0, 0.0), (9000.0, 0.0), (9000.0, 4000.0), (6000.0, 7000.0), (0.0, 7000.0)]
    way = region(offset_path(figure(contour(places), inside=False), 100.0, "chamfer"))
    wanted = shapely.Polygon(places).buffer(100.0, join_style="mitre", mitre_limit=3.0)
    ring = np.array(places)
    for before, corner, behind in zip(np.roll(ring, 1, axis=0), ring, np.roll(ring, -1, axis=0), strict=True):
        out = sum((corner - other) / np.hypot(*(corner - other)) for other in (before, behind))
        out /= np.hypot(*out)
        far, across = corner + 100.0 * out, np.array([-out[1], out[0]])
        wanted -= shapely.Polygon([far + 500.0 * across, far - 500.0 * across, far + 500.0 * out])
    assert shapely.symmetric_difference(way, wanted).area < 1e-3
    assert len(way.exterior.coords) == 2 * len(places) + 1


@pytest.mark.parametrize("seed", range(12))
def test_chamfers_lie_between_round_and_sharp_corners(seed: int) -> None:
    rng = random.Random(seed)
    closed, by_um = star(rng, rng.randint(3, 12), arcs=True), 120.0
    ways = {corners: offset_path(figure(closed, inside=False), by_um, corners) for corners in CORNERS}
    off = shapely.distance(shapely.points(flat(ways["chamfer"])), shapely.LinearRing(flat(closed)))
    assert is_closed(ways["chamfer"])
    assert off.min() >= by_um - WITHIN_UM - DRAWN_UM
    assert off.max() <= by_um / np.cos(np.pi / 8.0) + WITHIN_UM
    assert region(ways["chamfer"]).buffer(0.05).contains(region(ways["round"]))
    assert region(ways["sharp"]).buffer(0.05).contains(region(ways["chamfer"]))


def test_a_sharp_corner_that_would_cut_the_other_side_of_a_gap_stays_round() -> None:
    # A corner of 90° points at an edge 210 µm away: an arc of 100 µm fits in between, a tip of 141 µm would cut it.
    places = [(0.0, 0.0), (9000.0, 0.0), (9000.0, 9000.0), (5210.0, 9000.0), (5210.0, 2000.0), (4300.0, 2000.0)]
    places += [(4300.0, 4000.0), (5000.0, 4700.0), (4300.0, 5400.0), (4300.0, 9000.0), (0.0, 9000.0)]
    closed = contour(places)
    way = offset_path(figure(closed, inside=False), 100.0, "sharp")
    off = shapely.distance(shapely.points(flat(way)), shapely.LinearRing(flat(closed)))
    assert off.min() >= 100.0 - 0.1 - DRAWN_UM
    assert way.is_arc.sum() == 1


@pytest.mark.alike(15)
@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("seed", range(25))
def test_a_contour_that_turns_one_way_is_offset_as_every_other_one(seed: int, inside: bool) -> None:
    rng = random.Random(seed)
    closed = circle(rng.uniform(200.0, 5000.0)) if seed % 9 == 0 else rounded(rng)
    by_um = rng.choice((10.0, 100.0, 180.0, 900.0))
    loops = reach(closed, by_um, Side.LEFT if inside else Side.RIGHT).loops
    fast = beside_convex(closed, by_um, inside)
    if fast is None:
        assert inside  # where the offset uses a curve up, the general way decides
        return
    assert len(loops) == 1
    assert fast.curves.length_um.sum() == pytest.approx(loops[0].curves.length_um.sum(), abs=1e-3)
    off = shapely.distance(shapely.points(flat(fast.curves)), shapely.LinearRing(flat(loops[0].curves)))
    assert off.max() <= 2.0 * DRAWN_UM
    assert fast.corner.sum() == loops[0].corner.sum()


def test_most_that_turns_one_way_is_not_left_to_the_general_way() -> None:
    made = [beside_convex(rounded(random.Random(seed)), 100.0, seed % 2 == 0) for seed in range(40)]
    assert sum(loop is not None for loop in made) >= 36


@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("corners", ["sharp", "round"])
@pytest.mark.parametrize("count", [18, 24, 60])
def test_joints_of_fitted_arcs_are_mended_without_a_block_more(count: int, corners: Corners, inside: bool) -> None:
    closed = fitted_ellipse(count)
    way = offset_path(figure(closed, inside=inside), 100.0, corners)
    assert len(way) == count
    assert way.length_um.min() > 100.0
    assert is_closed(way)
    lies_between(way, closed, 100.0, inside, 0.1)


def test_pieces_too_short_for_whole_um_are_gone() -> None:
    # Chamfers of 0.2 and 2 µm, and a step of 0.05 µm in an edge.
    places = [(0.0, 0.0), (4999.8, 0.0), (5000.0, 0.2), (5000.0, 2500.0), (5000.05, 2500.0), (5000.05, 4998.6)]
    places += [(4998.6, 5000.05), (0.0, 5000.05)]
    for inside in (True, False):
        closed = contour(places)
        way = offset_path(figure(closed, inside=inside), 100.0, "round")
        assert is_closed(way)
        lies_between(way, closed, 100.0, inside)
        assert way.length_um.min() >= SHORT_UM


def test_a_slot_narrower_than_the_wire_is_named_with_its_place_and_width() -> None:
    with pytest.raises(CannotCutError) as error:
        offset_path(figure(_with_slot(150.0, 2000.0), inside=True, number=7), 100.0, "sharp")
    refusal = error.value.refusal
    assert refusal.why == "narrow-slot"
    assert refusal.places_um == (pytest.approx((5000.0, 2000.0)),)
    assert dict(refusal.values) == {"figure": "7", "offset_mm": "0.1", "kerf_mm": "0.2", "width_mm": "0.15"}


def test_lips_that_are_round_or_all_but_let_the_wire_in_make_a_slot_and_sides_that_run_together_none() -> None:
    rounded_lips = [(0.0, 0.0), (5000.0, 0.0), (5000.0, 1700.0), (5200.0, 1910.0), (7000.0, 1910.0), (7000.0, 2090.0)]
    rounded_lips += [(5200.0, 2090.0), (5000.0, 2300.0), (5000.0, 4000.0), (0.0, 4000.0)]
    lips = contour(rounded_lips, [0.0, 0.0, -0.38, 0.0, 0.0, 0.0, -0.38, 0.0, 0.0, 0.0])
    for closed in (lips, _with_slot(199.9, 2000.0), _with_slot(199.9, 300.0)):
        with pytest.raises(CannotCutError) as error:
            offset_path(figure(closed, inside=True), 100.0, "sharp")
        assert error.value.refusal.why == "narrow-slot"
    # Between arcs that bend toward the wire, the corner is deeper than between lines, and a corner still.
    places = [(0.0, 0.0), (3000.0, 1000.0), (0.0, 2000.0), (-3000.0, 2000.0), (-3000.0, 0.0)]
    corner = contour(places, [-0.1, -0.1, 0.0, 0.0, 0.0])
    lies_between(offset_path(figure(corner, inside=True), 100.0, "round"), corner, 100.0, True)


def test_a_slot_as_wide_as_the_wire_and_a_step_lower_than_the_wire_are_none() -> None:
    step = _with_slot(1500.0, 50.0)
    lies_between(offset_path(figure(step, inside=True), 100.0, "round"), step, 100.0, True)
    way = offset_path(figure(_with_slot(200.0, 2000.0), inside=True), 100.0, "round")
    assert way.end_um[:, 0].max() == pytest.approx(6900.0)  # to the bottom of the slot, and back on the same line


def test_a_neck_is_named_where_the_wire_does_not_pass() -> None:
    places = [(0, 0), (5000, 0), (5000, 1925), (6000, 1925), (6000, 0), (9000, 0), (9000, 4000), (6000, 4000)]
    places += [(6000, 2075), (5000, 2075), (5000, 4000), (0, 4000)]
    with pytest.raises(CannotCutError) as error:
        offset_path(figure(contour([(float(x), float(y)) for x, y in places]), inside=True), 100.0, "sharp")
    refusal = error.value.refusal
    assert refusal.why == "narrow-neck"
    assert sorted(place.x for place in refusal.places_um) == pytest.approx([5000.0, 6000.0])


def test_a_hole_that_the_wire_does_not_fit_in_is_named() -> None:
    for closed in (circle(90.0), contour([(0.0, 0.0), (150.0, 0.0), (150.0, 900.0), (0.0, 900.0)])):
        with pytest.raises(CannotCutError) as error:
            offset_path(figure(closed, inside=True), 100.0, "sharp")
        assert error.value.refusal.why == "too-small"


def _with_slot(wide_um: float, deep_um: float) -> Curves:
    low, high = 2000.0 - 0.5 * wide_um, 2000.0 + 0.5 * wide_um
    slot = [(5000.0, low), (5000.0 + deep_um, low), (5000.0 + deep_um, high), (5000.0, high)]
    return contour([(0.0, 0.0), (5000.0, 0.0), *slot, (5000.0, 4000.0), (0.0, 4000.0)])
