"""Offset block by block: exact curves, joined as C-type compensation joins them, from any lead-in to any lead-out."""

import itertools
import math
import random
from dataclasses import replace

import numpy as np
import pytest
import shapely
import sound_offset
from chunked import chunks_of
from depth import cases, examples
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import Pen, flipped
from sound_shapes import SHAPES, Shape, run_round

from controller.offset.chain import OffsetPath, RowOrigin, offset_toolpath
from controller.offset.compensate import compensate
from controller.offset.passes import PassedPath, in_passes
from controller.offset.shifted import OffsetSection, Side
from controller.stepping.steps import interpolate
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, curves_between, joined
from parser.geometry.distance import distance_to_curves
from parser.toolpath import Stop, Toolpath

SAME_UM = 1e-6


def drawn(shape: Shape, begin: tuple[float, float] | None = None) -> Toolpath:
    """The contour of a shape, behind a line from `begin`."""
    pen = Pen(*(begin or shape.start))
    if begin:
        pen.to(*shape.start)
    return run_round(pen, shape).path()


def random_shape(seed: int, largest_um: float = 50_000.0) -> tuple[Shape, float, Side]:
    """A contour, and an offset that may be more than parts of it have room for."""
    rng = random.Random(seed)
    shape = SHAPES[seed % len(SHAPES)](rng, rng.uniform(1000.0, largest_um))
    return shape, rng.choice((rng.uniform(10.0, 200.0), rng.uniform(200.0, 3000.0))), rng.choice(list(Side))


def polyline(places: Floats | list[tuple[float, float]]) -> Curves:
    places = np.array(places, dtype=float)
    n = len(places) - 1
    return curves_between(places[:-1], places[1:], np.full((n, 2), np.nan), np.zeros(n))


def once(toolpath: Toolpath) -> PassedPath:
    return in_passes(toolpath, [], [False])


def whole(curves: Curves, closed: bool = True) -> list[OffsetSection]:
    return [OffsetSection(0, len(curves) - 1, closed)]


def contour_of(path: OffsetPath) -> Curves:
    """The path without its leads."""
    return path.curves.picked(path.made != RowOrigin.LEAD)


def assert_sound(path: OffsetPath) -> None:
    """What holds for every path: no gap, no NaN, sources in order, arcs that go through their ends."""
    curves = path.curves
    assert np.array_equal(curves.start_um[1:], curves.end_um[:-1])
    for column in (curves.start_um, curves.end_um, curves.length_um, curves.sweep_rad):
        assert np.isfinite(column).all()
    assert (np.diff(path.source_row) >= 0).all()
    arc = curves.is_arc
    assert np.isnan(curves.radius_um[~arc]).all()
    assert (curves.radius_um[arc] > 0.0).all()


def assert_arcs_fit(curves: Curves, tolerance_um: float) -> None:
    """Centre, radius, start angle and sweep of arcs tell their ends."""
    arcs = curves.picked(curves.is_arc)
    for place, angle in (
        (arcs.start_um, arcs.start_angle_rad),
        (arcs.end_um, arcs.start_angle_rad + arcs.sweep_rad),
    ):
        told = arcs.center_um + arcs.radius_um[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        assert np.abs(told - place).max(initial=0.0) <= tolerance_um


def same_curves(one: Curves, other: Curves) -> bool:
    """Whether two closed paths are the same, wherever they begin."""
    if len(one) != len(other):
        return False
    if not len(one):
        return True
    nearest = int(np.argmin(np.hypot(*(other.start_um - one.start_um[0]).T)))
    other = other.picked(np.roll(np.arange(len(other)), -nearest))
    columns = ("start_um", "end_um", "center_um", "radius_um", "length_um", "kind")
    return all(np.allclose(getattr(one, c), getattr(other, c), rtol=0.0, atol=SAME_UM, equal_nan=True) for c in columns)


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(0, 520, 13))
def test_paths_are_whole_and_arcs_exact(seed: int) -> None:
    for shape, offset, side in (random_shape(k) for k in range(seed, seed + len(cases(2, 13)))):
        toolpath = drawn(shape, (shape.start[0] - 3000.0, shape.start[1] + 100.0))
        path = compensate(toolpath, [OffsetSection(1, len(toolpath) - 1, True)], offset, side)
        assert_sound(path)
        assert_arcs_fit(path.curves, 1e-5)
        arc, row = path.curves.is_arc, path.source_row
        moved = arc & (path.made == RowOrigin.SHIFTED)
        assert np.array_equal(path.curves.center_um[moved], toolpath.center_um[row[moved]])
        wanted = toolpath.radius_um - offset * side * np.sign(toolpath.sweep_rad)
        assert np.array_equal(path.curves.radius_um[moved], wanted[row[moved]])
        round_corner = arc & (path.made == RowOrigin.BRIDGE)
        assert (path.curves.radius_um[round_corner] == offset).all()
        corners = path.curves.center_um[round_corner]
        ends = toolpath.end_um[row[round_corner]]
        inside = row[round_corner] < len(toolpath) - 1  # the last corner closes the contour within rounding
        assert np.array_equal(corners[inside], ends[inside])
        assert np.allclose(corners, ends, rtol=0.0, atol=SAME_UM)
        every = np.union1d(row, path.vanished)
        assert np.array_equal(every, np.arange(len(toolpath)))
        assert not set(path.vanished.tolist()) & set(row[path.made == RowOrigin.SHIFTED].tolist())


@pytest.mark.deeper
def test_back_by_the_same_offset_is_the_contour_again() -> None:
    compared = 0
    for seed in range(400):
        shape, offset, side = random_shape(seed)
        contour = drawn(shape)
        path = compensate(contour, whole(contour), offset, side)
        if len(path.vanished):
            continue
        there = contour_of(path)
        back = compensate(there, whole(there), offset, Side(-side))
        # Sharp corners on the inner side are on the outer side on the way back, and get an arc.
        if RowOrigin.BRIDGE in back.made:
            continue
        bridges = np.flatnonzero(path.made[path.made != RowOrigin.LEAD] == RowOrigin.BRIDGE)
        assert back.vanished.tolist() == bridges.tolist(), (seed, shape.name)
        assert same_curves(contour, contour_of(back)), (seed, shape.name)
        compared += 1
    assert compared > 150


@pytest.mark.deeper
def test_neither_start_nor_sense_of_a_contour_matters() -> None:
    for seed in cases(130, 800):
        shape, offset, side = random_shape(seed)
        contour = drawn(shape)
        wanted = contour_of(compensate(contour, whole(contour), offset, side))
        by = random.Random(seed).randrange(len(contour))
        rotated = contour.picked(np.roll(np.arange(len(contour)), -by))
        assert same_curves(wanted, contour_of(compensate(rotated, whole(rotated), offset, side))), (seed, shape.name)
        back = flipped(contour)
        reverse = contour_of(compensate(back, whole(back), offset, Side(-side)))
        assert same_curves(wanted, flipped(reverse)), (seed, shape.name)


@pytest.mark.deeper
def test_agrees_with_an_offset_of_other_make() -> None:
    compared = 0
    for seed in range(500):
        shape, offset, side = random_shape(seed)
        other = sound_offset.offset(shape, -offset * side, False)
        contour = drawn(shape)
        path = compensate(contour, whole(contour), offset, side)
        # The other one lengthens corners of up to 100°, and has no way where blocks vanish.
        if other is None or len(path.vanished) or len(other.moves) != len(contour_of(path)):
            continue
        wanted = drawn(other)
        assert same_curves(wanted, contour_of(path)), (seed, shape.name)
        compared += 1
    assert compared > 200


def test_lengthened_and_shortened_corners_of_polygons_are_their_mitres() -> None:
    rng = np.random.default_rng(7)
    for _ in range(200):
        n = int(rng.integers(4, 9))
        angle = 2.0 * np.pi * (np.arange(n) + rng.uniform(-0.1, 0.1, n)) / n
        corner = 10_000.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        if (np.diff(angle) >= 0.5 * np.pi).any() or angle[0] + 2.0 * np.pi - angle[-1] >= 0.5 * np.pi:
            continue
        contour = polyline(np.append(corner, corner[:1], axis=0))
        for side in Side:
            path = contour_of(compensate(contour, whole(contour), 100.0, side))
            assert len(path) == n
            for k in range(n):
                before, at, behind = corner[k - 1], corner[k], corner[(k + 1) % n]
                normals = np.array([[a[1] - b[1], b[0] - a[0]] for a, b in ((before, at), (at, behind))])
                normals /= np.hypot(normals[:, 0], normals[:, 1])[:, None]
                wanted = np.linalg.solve(normals, normals @ at + side * 100.0)
                assert np.abs(path.start_um[k] - wanted).max() <= SAME_UM


def corner(turn_deg: float) -> Curves:
    turn = math.radians(turn_deg)
    return polyline([(0, 0), (1000, 0), (1000 + 1000 * math.cos(turn), 1000 * math.sin(turn))])


@pytest.mark.parametrize("turn_deg", [-30.0, -89.0, -90.0])
def test_outer_corners_up_to_a_right_angle_are_lengthened(turn_deg: float) -> None:
    path = compensate(corner(turn_deg), whole(corner(turn_deg), closed=False), 100.0, Side.LEFT)
    moved = path.curves.picked(path.made == RowOrigin.SHIFTED)
    assert RowOrigin.BRIDGE not in path.made
    assert moved.end_um[0] == pytest.approx([1000 - 100 * math.tan(math.radians(turn_deg / 2)), 100.0], abs=SAME_UM)


@pytest.mark.parametrize("turn_deg", [-91.0, -135.0, -179.0, 180.0])
def test_sharper_outer_corners_are_bridged_by_an_arc(turn_deg: float) -> None:
    curves = corner(turn_deg)
    path = compensate(curves, whole(curves, closed=False), 100.0, Side.LEFT)
    assert path.made.tolist() == [
        RowOrigin.LEAD,
        RowOrigin.SHIFTED,
        RowOrigin.BRIDGE,
        RowOrigin.SHIFTED,
        RowOrigin.LEAD,
    ]
    bridge = path.curves.picked(slice(2, 3))
    assert np.array_equal(bridge.center_um, curves.end_um[:1])
    assert bridge.radius_um.tolist() == [100.0]
    assert bridge.sweep_rad == pytest.approx([math.radians(-abs(turn_deg))])
    assert path.source_row.tolist() == [0, 0, 0, 1, 1]


@pytest.mark.parametrize("turn_deg", [30.0, 90.0, 150.0])
def test_inner_corners_are_shortened(turn_deg: float) -> None:
    path = compensate(corner(turn_deg), whole(corner(turn_deg), closed=False), 100.0, Side.LEFT)
    moved = path.curves.picked(path.made == RowOrigin.SHIFTED)
    assert RowOrigin.BRIDGE not in path.made
    assert moved.end_um[0] == pytest.approx([1000 - 100 * math.tan(math.radians(turn_deg / 2)), 100.0], abs=SAME_UM)


def test_a_side_of_an_arc_is_lengthened_along_its_circle() -> None:
    arc = Pen(0, 0).to(1000, 0).arc(1000, -1000, -1.0).path()
    turned = Pen(0, 0).to(1000, 0).arc(1300, -1000, -1.0).path()  # 17° to the right into the arc
    for curves in (arc, turned):
        path = compensate(curves, whole(curves, closed=False), 100.0, Side.LEFT)
        moved = path.curves.picked(path.made == RowOrigin.SHIFTED)
        assert RowOrigin.BRIDGE not in path.made
        assert moved.end_um[0, 1] == pytest.approx(100.0, abs=SAME_UM)
        assert math.dist(moved.end_um[0], moved.center_um[1]) == pytest.approx(moved.radius_um[1], abs=SAME_UM)


def test_offset_zero_is_the_toolpath() -> None:
    toolpath = drawn(random_shape(8)[0])
    path = compensate(toolpath, whole(toolpath), 0.0, Side.LEFT)
    assert same_curves(toolpath, contour_of(path))
    assert len(path.vanished) == 0


# Leads


def test_a_line_leads_to_the_offset_path_and_back() -> None:
    toolpath = Pen(0, -500).to(0, 0).to(1000, 0).to(1000, 1000).to(0, 1000).to(0, 0).to(-700, 0).jump(9, 9).path()
    path = compensate(toolpath, [OffsetSection(1, 4, True)], 100.0, Side.RIGHT)
    shifted = [RowOrigin.SHIFTED] * 4
    assert path.made.tolist() == [RowOrigin.LEAD, *shifted, RowOrigin.LEAD, RowOrigin.AS_IT_IS]
    assert path.curves.start_um[0].tolist() == [0, -500]
    assert path.curves.start_um[[1, 5]] == pytest.approx(np.array([[-100, -100], [-100, -100]]), abs=SAME_UM)
    assert path.curves.end_um[5].tolist() == [-700, 0]
    assert path.curves.kind[-1] == CurveKind.JUMP
    assert path.source_row.tolist() == list(range(7))


def test_without_a_row_that_leads_one_is_inserted() -> None:
    square = [(1000, 0), (1000, 1000), (0, 1000), (0, 0)]
    pen = Pen()
    for x, y in square:
        pen.to(x, y)
    pen.jump(5000, 0)
    for x, y in square:
        pen.to(5000 + x, y)
    toolpath = pen.path()
    path = compensate(toolpath, [OffsetSection(0, 3, True), OffsetSection(5, 8, True)], 100.0, Side.LEFT)
    one = [RowOrigin.LEAD, *[RowOrigin.SHIFTED] * 4, RowOrigin.LEAD]
    assert path.made.tolist() == [*one, RowOrigin.AS_IT_IS, *one]
    assert path.source_row.tolist() == [0, 0, 1, 2, 3, 3, 4, 5, 5, 6, 7, 8, 8]
    for lead, out in ((0, 5), (7, 12)):
        assert path.curves.start_um[lead].tolist() == path.curves.end_um[out].tolist()
        assert path.curves.end_um[lead] == pytest.approx(path.curves.start_um[lead] + [100, 100], abs=SAME_UM)
    assert_sound(path)


def test_sections_side_by_side_lead_out_and_in_between_them() -> None:
    toolpath = Pen().to(1000, 0).to(2000, 0).to(3000, 0).path()
    path = compensate(toolpath, [OffsetSection(0, 0, False), OffsetSection(1, 2, False)], 100.0, Side.LEFT)
    assert path.made.tolist() == [
        RowOrigin.LEAD,
        RowOrigin.SHIFTED,
        RowOrigin.LEAD,
        RowOrigin.LEAD,
        *[RowOrigin.SHIFTED] * 2,
        RowOrigin.LEAD,
    ]
    assert path.curves.end_um[2].tolist() == [1000.0, 0.0]
    assert_sound(path)


def test_an_arc_that_leads_becomes_a_line() -> None:
    toolpath = Pen(0, 1000).arc(0, 500, math.pi).to(1000, 0).arc(1000, 500, math.pi / 2).path()
    path = compensate(toolpath, [OffsetSection(1, 1, False)], 100.0, Side.LEFT)
    assert path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.LEAD]
    assert path.curves.kind.tolist() == [CurveKind.LINE] * 3
    assert path.curves.start_um[1] == pytest.approx([0.0, 100.0], abs=SAME_UM)
    assert path.curves.end_um[1] == pytest.approx([1000.0, 100.0], abs=SAME_UM)


def test_a_bridge_where_a_contour_closes_is_cut_last() -> None:
    toolpath = Pen(-500, 0).to(0, 0).to(1000, 400).to(1000, -400).to(0, 0).to(-500, 0).path()
    path = compensate(toolpath, [OffsetSection(1, 3, True)], 100.0, Side.LEFT)
    made = [RowOrigin.LEAD, *[RowOrigin.SHIFTED, RowOrigin.BRIDGE] * 3, RowOrigin.LEAD]
    assert path.made.tolist() == made
    assert np.array_equal(path.curves.end_um[0], path.curves.end_um[6])
    assert path.source_row.tolist() == [0, 1, 1, 2, 2, 3, 3, 4]


def test_without_sections_nothing_changes() -> None:
    toolpath = Pen().to(10, 0).arc(10, 10, 1.0).path()
    path = compensate(toolpath, [], 100.0, Side.LEFT)
    assert path.made.tolist() == [RowOrigin.AS_IT_IS] * 2
    assert np.array_equal(path.curves.end_um, toolpath.end_um)


# Closing


@pytest.mark.parametrize(("dx", "dy"), [(0, 3), (-2, 0), (3, -4), (1e-9, 0.0)])
@pytest.mark.parametrize("side", Side)
def test_a_contour_that_closes_within_some_um_is_joined_at_its_corner(dx: float, dy: float, side: Side) -> None:
    places = [(0, 0), (1000, 0), (1000, 1000), (0, 1000), (dx, dy)]
    path = contour_of(compensate(polyline(places), whole(polyline(places)), 100.0, side))
    assert len(path) == 4
    assert np.array_equal(path.start_um[0], path.end_um[-1])
    # The last side runs from (0, 1000) through (dx, dy); it and the first one are moved aside to y = ±100.
    length = math.hypot(dx, dy - 1000.0)
    normal = (1000.0 - dy) / length, dx / length
    wanted_y = side * 100.0
    wanted_x = (side * 100.0 - normal[1] * (wanted_y - 1000.0)) / normal[0]
    assert path.start_um[0] == pytest.approx([wanted_x, wanted_y], abs=SAME_UM)


def test_blocks_that_close_side_by_side_close_midway() -> None:
    lines = Pen(500, 0).to(1000, 0).to(1000, 1000).to(0, 1000).to(0, 4).to(500, 4).path()
    path = contour_of(compensate(lines, whole(lines), 100.0, Side.LEFT))
    assert path.start_um[0] == pytest.approx([500.0, 102.0], abs=0.5)  # the lines now lean by 4 µm in 1000
    assert np.array_equal(path.start_um[0], path.end_um[-1])


@pytest.mark.parametrize("missing_um", [-3.0, 0.0, 3.0])
@pytest.mark.parametrize("side", Side)
def test_a_circle_keeps_its_sweep(missing_um: float, side: Side) -> None:
    sweep = 2.0 * math.pi - missing_um / 5000.0
    circle = Pen(5000, 0).arc(0, 0, sweep).path()
    path = compensate(circle, whole(circle), 100.0, side)
    ring = path.curves.picked(path.made == RowOrigin.SHIFTED)
    assert ring.radius_um.tolist() == [5000.0 - 100.0 * side]
    assert ring.sweep_rad == pytest.approx([sweep], abs=1e-12)
    assert_sound(path)


# What vanishes


@pytest.mark.parametrize("radius", [20.0, 99.0, 100.0])
def test_a_fillet_smaller_than_the_offset_vanishes(radius: float) -> None:
    toolpath = Pen().to(1000 - radius, 0).arc(1000 - radius, radius, math.pi / 2).to(1000, 1000).path()
    path = compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [1]
    assert path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.SHIFTED, RowOrigin.LEAD]
    assert path.curves.end_um[1] == pytest.approx([900.0, 100.0], abs=SAME_UM)


def test_a_fillet_little_larger_than_the_offset_stays() -> None:
    toolpath = Pen().to(899, 0).arc(899, 101, math.pi / 2).to(1000, 1000).path()
    path = compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.LEFT)
    assert len(path.vanished) == 0
    assert path.curves.radius_um[2] == 1.0


def test_a_small_arc_that_no_longer_reaches_its_line_vanishes() -> None:
    toolpath = Pen().to(1000, 0).arc(900, 60, 2.0).to(0, 500).path()
    path = compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [1]
    assert RowOrigin.BRIDGE not in path.made


def test_a_large_arc_stays_where_a_spike_before_it_vanishes() -> None:
    turn = math.radians(170.0)
    x, y = 1000.0 + math.cos(turn), math.sin(turn)
    for center_x in (x - 30.0, x, x + 30.0):
        toolpath = Pen().to(1000, 0).to(x, y).arc(center_x, 10_000, 1.0).path()
        path = compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.LEFT)
        assert path.vanished.tolist() == [1]
        assert_sound(path)


def test_a_short_side_between_others_vanishes() -> None:
    sides = polyline([(0, 0), (1000, 0), (1010, 10), (1010, 1000)])
    path = compensate(sides, whole(sides, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [1]
    assert path.curves.end_um[1] == pytest.approx([910.0, 100.0], abs=SAME_UM)


def test_an_open_section_begins_and_ends_with_the_blocks_that_are_left() -> None:
    sides = polyline([(0, 0), (10, 0), (10, 1000), (0, 1000)])
    path = compensate(sides, whole(sides, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [0, 2]
    assert path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.LEAD]
    assert path.curves.start_um[1:] == pytest.approx(np.array([[-90, 0], [-90, 1000]]), abs=SAME_UM)


def test_a_slot_too_narrow_is_bridged_by_a_line() -> None:
    slot = polyline([(0, 0), (1000, 0), (1000, 150), (0, 150)])
    path = compensate(slot, whole(slot, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [1]
    assert path.made.tolist() == [
        RowOrigin.LEAD,
        RowOrigin.SHIFTED,
        RowOrigin.BRIDGE,
        RowOrigin.SHIFTED,
        RowOrigin.LEAD,
    ]
    assert path.curves.kind[2] == CurveKind.LINE
    assert_sound(path)


def test_the_longest_of_sides_too_sharp_for_each_other_stays() -> None:
    """A spike of 1 µm, turned back by 170°, asks 1.1 mm of both sides; it vanishes, and the long side does not."""
    turn = math.radians(170.0)
    spike = (1000.0 + math.cos(turn), math.sin(turn))
    sides = polyline([(0, 0), (1000, 0), spike, (spike[0] + 1000.0, spike[1] - 50.0)])
    path = compensate(sides, whole(sides, closed=False), 100.0, Side.LEFT)
    assert path.vanished.tolist() == [1]
    assert_sound(path)


def test_sides_on_one_line_with_nothing_left_between_them_are_bridged_along_it() -> None:
    for off in (0.0, 1e-13, -1e-13):  # rounding does not decide where they meet
        notch = polyline([(0, 0), (1000, 0), (1050, -10), (1100, off), (2000, 0)])
        path = compensate(notch, whole(notch, closed=False), 1000.0, Side.LEFT)
        assert path.vanished.tolist() == [1, 2]
        assert path.made.tolist() == [
            RowOrigin.LEAD,
            RowOrigin.SHIFTED,
            RowOrigin.BRIDGE,
            RowOrigin.SHIFTED,
            RowOrigin.LEAD,
        ]
        assert path.curves.end_um[1:3] == pytest.approx(np.array([[1000, 1000], [1100, 1000]]), abs=SAME_UM)


@pytest.mark.parametrize("closed", [True, False])
def test_a_contour_that_vanishes_as_a_whole_leaves_a_path(closed: bool) -> None:
    square = Pen(-500, 0).to(0, 0).to(90, 0).to(90, 90).to(0, 90).to(0, 0)
    for toolpath in (square.path(), square.to(-500, 0).path()):
        path = compensate(toolpath, [OffsetSection(1, 4, closed)], 100.0 if closed else 1000.0, Side.LEFT)
        if closed:
            assert path.vanished.tolist() == [1, 2, 3, 4]
            assert path.curves.end_um[0].tolist() == [0.0, 0.0]
        assert_sound(path)
        assert path.curves.end_um[-1].tolist() == toolpath.end_um[-1].tolist()


@pytest.mark.parametrize("chords", [20, 333])
def test_a_tight_bend_of_chords_leaves_its_sides_crossing(chords: int) -> None:
    """Of a parabola whose radius at the bottom is half the offset; the exact offset crosses itself above it."""
    x = np.linspace(-300.0, 300.0, chords + 1)
    bend = polyline(np.stack([x, x * x / 100.0], axis=1))
    path = compensate(bend, whole(bend, closed=False), 100.0, Side.LEFT)
    assert RowOrigin.BRIDGE not in path.made
    assert len(path.vanished) > 2
    run = shapely.LineString(np.append(path.curves.start_um[1:], path.curves.end_um[-1:], axis=0)[:-1])
    drawing = shapely.LineString(np.append(bend.start_um, bend.end_um[-1:], axis=0))
    assert run.is_simple
    assert run.distance(drawing) == pytest.approx(100.0, abs=0.01)


@pytest.mark.deeper
def test_steps_of_a_um_and_turns_of_a_thousandth_change_nothing_much() -> None:
    rng = random.Random(3)
    for _ in range(300):
        places, heading = [(0.0, 0.0)], rng.uniform(0, 6)
        for _ in range(12):
            length = rng.choice((1.0, 2.0, 500.0, 5000.0))
            turn = 0.0 if length < 3.0 else rng.uniform(-1e-3, 1e-3)
            x, y = places[-1]
            dx, dy = length * math.cos(heading + turn), length * math.sin(heading + turn)
            places.append((round(x + dx), round(y + dy)))
        curves = polyline([p for p, q in itertools.pairwise(places) if p != q] + places[-1:])
        path = compensate(curves, whole(curves, closed=False), 100.0, Side.LEFT)
        assert_sound(path)
        run = contour_of(path)
        run = shapely.LineString(np.append(run.start_um, run.end_um[-1:], axis=0))
        wanted = shapely.LineString(np.array(places)).buffer(100.0, quad_segs=64).boundary
        inner = shapely.LineString(np.array(places))
        assert run.hausdorff_distance(inner) < 250.0, places
        # Lengthened corners of up to 90° stand 41 µm out of the round ones.
        assert max(wanted.distance(shapely.Point(p)) for p in run.coords) < 43.0, places


def test_nearly_tangent_curves_meet_near_their_ends() -> None:
    for off_rad in (-1e-4, -1e-6, -1e-9, 1e-9, 1e-6, 1e-4):
        for radius in (150.0, 1e4, 1e6):
            for side in Side:
                pen = Pen().to(1000, 0)
                center = 1000 - radius * math.sin(off_rad), radius * math.cos(off_rad)
                curves = pen.arc(*center, 0.5).path()
                path = compensate(curves, whole(curves, closed=False), 100.0, side)
                assert path.made.tolist() == [RowOrigin.LEAD, RowOrigin.SHIFTED, RowOrigin.SHIFTED, RowOrigin.LEAD]
                joint = path.curves.end_um[1]
                assert joint == pytest.approx([1000.0, 100.0 * side], abs=0.02)


# Anything


@st.composite
def chains(draw: st.DrawFn) -> Toolpath:
    """Lines and arcs end to end, sound or not, on whole µm or off them."""
    pen = Pen(cam=draw(st.booleans()))
    unit = draw(st.sampled_from((1.0, 20.0, 1000.0)))
    length = st.integers(-6, 6)
    for _ in range(draw(st.integers(1, 8))):
        dx, dy = unit * draw(length), unit * draw(length)
        if draw(st.booleans()) or math.hypot(dx, dy) < 2.0:
            pen.to(pen.x + dx, pen.y + dy)
        else:
            pen.arc(pen.x + dx, pen.y + dy, draw(st.sampled_from((-6.0, -3.0, -1.0, -0.01, 0.01, 1.0, 3.0, 6.0))))
    return pen.path()


@settings(max_examples=examples(300), deadline=None)
@given(chains(), st.sampled_from((1.0, 20.0, 100.0, 5000.0)), st.sampled_from(list(Side)), st.booleans(), st.data())
def test_whatever_is_drawn_gives_a_path(
    toolpath: Toolpath, offset: float, side: Side, closed: bool, data: st.DataObject
) -> None:
    first = data.draw(st.integers(0, len(toolpath) - 1))
    last = data.draw(st.integers(first, len(toolpath) - 1))
    path = compensate(toolpath, [OffsetSection(first, last, closed)], offset, side)
    assert_sound(path)
    assert np.array_equal(path.curves.start_um[0], toolpath.start_um[0])
    assert np.array_equal(path.curves.end_um[-1], toolpath.end_um[-1])
    assert np.array_equal(np.union1d(path.source_row, path.vanished), np.arange(len(toolpath)))
    if closed and path.made.tolist().count(RowOrigin.SHIFTED) > 1:
        around = np.isin(path.made, (RowOrigin.SHIFTED, RowOrigin.BRIDGE))
        run = path.curves.picked(around)
        assert np.array_equal(run.start_um[0], run.end_um[-1])


# The path as a toolpath


def stepped_ends(toolpath: Toolpath) -> Floats:
    """Distances (n,) of stepped ends from exact ends, all on one table."""
    off = interpolate(toolpath).corner_um[1:] + toolpath.start_um[0] - toolpath.end_um
    return np.hypot(off[:, 0], off[:, 1])


def test_steps_end_where_the_path_does() -> None:
    off_lines, off_arcs = [0.0], [0.0]
    for seed in range(150):
        shape, offset, side = random_shape(seed)
        toolpath = drawn(shape, (shape.start[0] - 3000.0, shape.start[1] + 100.0))
        path = compensate(toolpath, [OffsetSection(1, len(toolpath) - 1, True)], min(offset, 200.0), side)
        stepped = offset_toolpath(once(toolpath), path)
        off = stepped_ends(stepped)
        off_lines += off[~stepped.is_arc].tolist()
        off_arcs += off[stepped.is_arc].tolist()
    assert max(off_lines) <= math.sqrt(0.5) + SAME_UM
    assert max(off_arcs) < 6.0
    assert np.percentile(off_arcs, 95.0) < 3.0


def along(n: int, radius: tuple[float, float], seed: int) -> Toolpath:
    """n arcs, each tangent to the one before it."""
    rng = random.Random(seed)
    pen, heading = Pen(), 0.0
    for _ in range(n):
        r, sweep = rng.uniform(*radius), rng.uniform(0.05, 0.5) * rng.choice((-1, 1))
        side = math.copysign(r, sweep)
        pen.arc(pen.x - side * math.sin(heading), pen.y + side * math.cos(heading), sweep)
        heading += sweep
    return pen.path()


def test_steps_do_not_stray_over_ten_thousand_arcs() -> None:
    toolpath = along(10_000, (300.0, 20_000.0), 1)
    stepped = offset_toolpath(once(toolpath), compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.LEFT))
    off = stepped_ends(stepped)
    assert off.max() < 3.0
    assert off[-1000:].mean() == pytest.approx(off[:1000].mean(), abs=0.1)


def test_every_step_is_near_its_block() -> None:
    toolpath = along(300, (300.0, 20_000.0), 2)
    stepped = offset_toolpath(once(toolpath), compensate(toolpath, whole(toolpath, closed=False), 100.0, Side.RIGHT))
    for chunk in chunks_of(interpolate(stepped)):
        x, y = chunk.x_um + stepped.start_um[0, 0], chunk.y_um + stepped.start_um[0, 1]
        off, _ = distance_to_curves(stepped, chunk.row.astype(np.int64), x, y)
        assert off.max() < 4.0


def test_rows_bear_the_source_of_their_blocks() -> None:
    pen = Pen(-500, 0).to(0, 0).to(1000, 400).to(1000, -400).to(0, 0).to(-500, 0).jump(5000, 0).to(6000, 0)
    toolpath = pen.path()
    stops = (Stop("pause", 5, 1), Stop("pause", 6, 1), Stop("end", 7, 1))
    toolpath = replace(toolpath, stops=stops, printed_end_um=toolpath.end_um.copy())
    path = compensate(toolpath, [OffsetSection(1, 3, True)], 100.0, Side.LEFT)
    made = offset_toolpath(once(toolpath), path)
    assert made.source.block.tolist() == [1, 2, 2, 3, 3, 4, 4, 5, 6, 7]
    assert [stop.after for stop in made.stops] == [8, 9, 10]
    assert made.kind[-2] == CurveKind.JUMP
    is_printed = ~np.isnan(made.printed_end_um[:, 0])
    assert is_printed.tolist() == [False] * 8 + [True] * 2
    assert np.array_equal(made.end_um, path.curves.end_um)
    assert set(made.words.radius_um.tolist()) == {-1}


def rows_of(path: OffsetPath, made: RowOrigin) -> Ints:
    return np.flatnonzero(path.made == made)


def test_two_contours_do_not_touch_each_other() -> None:
    one, other = drawn(random_shape(3)[0]), drawn(random_shape(5)[0])
    offset = 50.0
    far = replace(
        other.picked(slice(None)),
        start_um=other.start_um + 1e6,
        end_um=other.end_um + 1e6,
        center_um=other.center_um + 1e6,
    )
    jump = polyline([tuple(one.end_um[-1]), tuple(far.start_um[0])])
    jump = replace(jump, kind=np.array([CurveKind.JUMP]))
    both = joined([one.picked(slice(None)), jump, far])
    sections = [OffsetSection(0, len(one) - 1, True), OffsetSection(len(one) + 1, len(both) - 1, True)]
    path = compensate(both, sections, offset, Side.RIGHT)
    alone = compensate(one, whole(one), offset, Side.RIGHT)
    early = path.source_row < len(one)
    assert same_curves(alone.curves, path.curves.picked(early))
    assert len(rows_of(path, RowOrigin.AS_IT_IS)) == 1


def test_arcs_that_nearly_are_one_circle_are_joined_where_they_end() -> None:
    """Of whole µm, two arcs of one circle about centres 0.5 µm apart, they cross a second time far round it."""
    pen = Pen().to(0, -2000).arc(0, 0, 1.5483).to(6000, -45).arc_to(6000, 45, 8000, 0, 1).to(1999.5, 45)
    path = pen.arc_to(0.48, -1999.48, 0.49, 0.03, 1).to(0.48, 0).path()
    made = compensate(path, [OffsetSection(1, 5, closed=True)], 100.0, Side.LEFT)
    assert len(made.vanished) == 0
    assert made.curves.end_um[0] == pytest.approx([0.24, -1899.74], abs=0.02)
    assert made.curves.sweep_rad[1] == pytest.approx(1.5708 + 55.0 / 1900.0, abs=1e-3)
