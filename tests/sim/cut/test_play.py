"""A free piece moves until it touches: closed forms, and real touches of any outlines."""

import math

import numpy as np
import pytest
import shapely
from paths import Pen
from shapely import affinity
from traced import F, pieces_along, square

from parser.toolpath import Point
from sim.cut.play import play_between, plays_of

WIRE = 90.0
BESIDE = Point(0.0, 5100.0)


def disc(radius: float) -> shapely.Polygon:
    return shapely.Point(0, 0).buffer(radius, quad_segs=200)


def test_a_round_slug_shifts_by_the_kerf_in_every_direction_and_turns_freely():
    play = play_between(disc(5000.0), disc(5200.0).exterior, BESIDE, WIRE)
    for shift in play.shifts:
        assert shift.by_um == pytest.approx(200.0, abs=0.6)
        angle = math.radians(shift.toward_deg)
        assert shift.touches_um == pytest.approx((5200 * math.cos(angle), 5200 * math.sin(angle)), abs=300)
    assert [turn.by_deg for turn in play.turns] == [math.inf, -math.inf]


def test_a_square_slug_shifts_by_the_kerf_and_by_its_diagonal_and_turns_until_its_corners_touch():
    a, w = 4000.0, 200.0
    play = play_between(shapely.box(0, 0, a, a), shapely.box(-w, -w, a + w, a + w).exterior, Point(a + 100, 900), WIRE)
    by = {shift.toward_deg: shift.by_um for shift in play.shifts}
    assert [by[angle] for angle in (0, 90, 180, 270)] == pytest.approx([w] * 4)
    assert [by[angle] for angle in (45, 135, 225, 315)] == pytest.approx([w * math.sqrt(2)] * 4)
    assert by[22.5] == pytest.approx(w / math.cos(math.radians(22.5)))
    # Its corners run round on a circle of a/√2.
    angle = 45.0 - math.degrees(math.acos((a / 2 + w) / (a / math.sqrt(2))))
    assert [turn.by_deg for turn in play.turns] == pytest.approx([angle, -angle])


def test_a_small_square_turns_all_round():
    play = play_between(shapely.box(0, 0, 400, 400), shapely.box(-200, -200, 600, 600).exterior, Point(500, 0), WIRE)
    assert [turn.by_deg for turn in play.turns] == [math.inf, -math.inf]


def test_nothing_stops_a_piece_that_leaves_by_the_open_side():
    walls = shapely.LineString([(-100, 5000), (-100, -100), (2000, -100)])
    play = play_between(shapely.box(0, 0, 1000, 1000), walls, Point(-50, 500), 20.0)
    by = {shift.toward_deg: shift.by_um for shift in play.shifts}
    assert (by[0], by[45], by[90]) == (math.inf,) * 3
    assert (by[180], by[270]) == pytest.approx((100.0, 100.0))


@pytest.mark.parametrize("seed", range(12))
def test_moved_by_that_much_any_outline_touches_and_does_not_overlap(seed):
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * math.pi, 9))
    corners = rng.uniform(600, 2000, 9)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outline = shapely.Polygon(corners).buffer(0)
    outline = max(shapely.get_parts(outline), key=lambda part: part.area)
    opening = shapely.Polygon(outline.buffer(200.0, join_style="mitre").exterior)
    play = play_between(outline, opening.exterior, Point(*opening.exterior.coords[0]), WIRE)
    moved = [
        (affinity.translate(outline, *(shift.by_um * np.array([math.cos(a), math.sin(a)]))), shift.touches_um)
        for shift in play.shifts
        for a in [math.radians(shift.toward_deg)]
    ]
    moved += [
        (affinity.rotate(outline, turn.by_deg, outline.centroid), turn.touches_um)
        for turn in play.turns
        if math.isfinite(turn.by_deg)
    ]
    for pose, place in moved:
        assert pose.difference(opening).area < 1.0 * outline.length
        assert pose.exterior.distance(opening.exterior) < 1.0
        assert pose.exterior.distance(shapely.Point(place)) < 1.0
        assert opening.exterior.distance(shapely.Point(place)) < 1.0


def test_a_slug_that_shifts_by_the_kerf_pinches_a_wire_with_gaps_beside_it():
    pinch = play_between(disc(5000.0), disc(5200.0).exterior, BESIDE, WIRE).pinch
    assert pinch.wall_um == pytest.approx((0.0, 5200.0), abs=2.0)
    assert pinch.width_um == pytest.approx(2 * F, abs=0.6)
    assert pinch.narrowest_um < 1.0
    assert pinch.pinches
    assert pinch.after_um == pytest.approx(2 * F - 2 * WIRE, abs=0.6)


@pytest.mark.parametrize(("wire_radius", "pinches"), [(20.0, False), (25.0, True)])
def test_a_slug_that_tongues_hold_pinches_by_turning_alone(wire_radius, pinches):
    # 15 µm to the left and to the right it touches, and would leave the wire 85 µm; turned, it leaves it 45 µm.
    tongues = shapely.box(-100, 900, -15, 1100) | shapely.box(2015, 900, 2100, 1100)
    opening = shapely.box(-100, -100, 2100, 2100) - tongues
    pinch = play_between(shapely.box(0, 0, 2000, 2000), opening.exterior, Point(-50, 1500), wire_radius).pinch
    assert pinch.pinches == pinches
    assert 40.0 < pinch.narrowest_um < 50.0


def test_the_slug_of_a_die_has_the_play_of_its_kerf():
    pieces = pieces_along(Pen().to(2000, 0).arc(0, 0, 2 * math.pi).to(0, 0).path())
    (play,) = plays_of(pieces, WIRE)
    assert [shift.by_um for shift in play.shifts] == pytest.approx([2 * F] * 16, abs=2.0)
    assert play.pinch.pinches
    assert play.exact_to_um <= 1.0


def test_what_came_free_earlier_is_in_nobodys_way():
    pen = square(Pen(1000, 1000), 1000.0).jump(-1000, 0).to(0, 0)
    pieces = pieces_along(square(pen, 3000.0).path())
    for play in plays_of(pieces, WIRE):
        assert [shift.by_um for shift in play.shifts][::4] == pytest.approx([2 * F] * 4, abs=1.5)


def test_a_piece_that_is_parted_off_shifts_away_freely_and_toward_the_frame_by_the_kerf():
    work = (Point(0, 0), Point(10_000, 0), Point(10_000, 5000), Point(0, 5000))
    (play,) = plays_of(pieces_along(Pen(3000, -500).to(3000, 5500).path(), work), WIRE)
    by = {shift.toward_deg: shift.by_um for shift in play.shifts}
    assert by[0] == pytest.approx(2 * F, abs=1.5)
    assert (by[90], by[180], by[270]) == (math.inf,) * 3
    assert play.pinch.width_um == pytest.approx(2 * F, abs=1.5)


def test_a_slug_in_a_part_that_is_not_free_yet_touches_the_part():
    work = (Point(-500, -500), Point(4000, -500), Point(4000, 4000), Point(-500, 4000))
    pen = square(Pen(1000, 1000), 1000.0).jump(-1000, 0).to(0, 0)
    for play in plays_of(pieces_along(square(pen, 3000.0).path(), work), WIRE):
        assert [shift.by_um for shift in play.shifts][::4] == pytest.approx([2 * F] * 4, abs=1.5)
