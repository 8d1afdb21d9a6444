"""Sizes of what is kept: nominal where the wire is on its path, and off by what it strays."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from paths import Pen
from runs import scenario_run
from traced import STEEL, F, exactly, kerf_along, square, trace_of

from parser.toolpath import Toolpath
from sim.cut.kerf.swept import kerf_of
from sim.cut.pieces.pieces import pieces_of
from sim.cut.sizes import Sizes, fitted_circles, sizes_of


def sizes(path: Toolpath, stray=exactly) -> Sizes:
    kerf = kerf_along(path, trace_of(path, stray=stray))
    return sizes_of(path, kerf, pieces_of(kerf, None, STEEL), None, np.zeros((len(path), 2)))


def round_hole(radius: float) -> Toolpath:
    return Pen().to(radius, 0).arc(0, 0, 2 * math.pi).to(0, 0).path()


def block_of(path: Toolpath, rows: range):
    """A stray that moves the wire off its path to the right by 5 µm in some rows, straight ones."""
    way = (path.end_um - path.start_um) / path.length_um[:, None]
    right = np.stack([way[:, 1], -way[:, 0]], axis=1)
    return lambda place, row: place + 5.0 * np.isin(row, rows)[:, None] * right[row]


def test_the_radius_of_a_hole_is_that_of_the_path_and_the_offset():
    (radius,) = sizes(round_hole(3000.0)).radii
    assert (radius.what, radius.block) == ("hole", 2)
    assert radius.nominal_um == 3000.0 + F
    assert radius.cut_um == pytest.approx(3000.0 + F, abs=0.05)
    assert radius.form_um < 0.05
    assert radius.center_um == pytest.approx((0.0, 0.0), abs=0.01)


def test_a_circle_cut_larger_and_beside_its_place_is_measured_as_such():
    (radius,) = sizes(round_hole(3000.0), lambda place, row: place * 1.002 + (20.0, -30.0)).radii
    assert radius.cut_um == pytest.approx(3006.0 + F, abs=0.05)
    assert radius.center_um == pytest.approx((20.0, -30.0), abs=0.05)
    assert radius.nominal_um == 3000.0 + F


def test_a_circle_cut_out_of_round_has_that_form():
    def oval(place, row):
        bulge = 12.0 * (place[:, :1] * place[:, 1:] > 0.0) * np.abs(place[:, :1] * place[:, 1:]) / 4.5e6
        return place + bulge * place / 3000.0 * (row == 1)[:, None]

    (radius,) = sizes(round_hole(3000.0), oval).radii
    assert radius.form_um == pytest.approx(12.0, abs=0.3)


def test_an_outer_radius_is_a_boss():
    pen = Pen(-1000, 0).to(0, 0).to(2000, 0).arc(2000, 1000, math.pi).to(0, 2000).arc(0, 1000, math.pi)
    found = sizes(pen.path())
    assert [(size.what, size.block, size.nominal_um) for size in found.radii] == [
        ("boss", 3, 1000 - F),
        ("boss", 5, 1000 - F),
    ]
    assert [size.cut_um for size in found.radii] == pytest.approx([900.0, 900.0], abs=0.05)
    (distance,) = found.distances
    assert (distance.what, distance.blocks) == ("material", (2, 4))


def die(radius: float) -> Toolpath:
    """An opening whose path turns in four arcs, from its middle and back."""
    half, arc = 900.0, math.pi / 2.0
    pen = Pen().to(half, 0.0).to(half, half - radius).arc(half - radius, half - radius, arc)
    pen.to(radius - half, half).arc(radius - half, half - radius, arc)
    pen.to(-half, radius - half).arc(radius - half, radius - half, arc)
    pen.to(half - radius, -half).arc(half - radius, radius - half, arc)
    return pen.to(half, 0.0).to(0.0, 0.0).path()


@pytest.mark.parametrize("radius", [30.0, 100.0, 250.0])
def test_arcs_shorter_than_the_kerf_is_wide_have_radii_too(radius):
    found = sizes(die(radius)).radii
    assert [(size.what, size.block) for size in found] == [("hole", block) for block in (3, 5, 7, 9)]
    assert [size.nominal_um for size in found] == pytest.approx([radius + F] * 4, abs=1e-6)
    assert [size.cut_um for size in found] == pytest.approx([radius + F] * 4, abs=0.5)


def test_an_arc_about_a_sharp_corner_tells_no_radius():
    pen = Pen(-500, -F).to(0, -F).to(2000, -F).arc(2000, 0, math.pi / 2).to(2000 + F, 2000)
    pen.arc(2000, 2000, math.pi / 2).to(0, 2000 + F).arc(0, 2000, math.pi / 2).to(-F, 0).arc(0, 0, math.pi / 2)
    found = sizes(pen.path())
    assert [box.what for box in found.boxes] == ["part"]
    assert found.radii == ()


def test_arcs_of_less_than_30_degrees_tell_no_radius():
    short = Pen(-1000, 0).to(0, 0).to(2000, 0).arc(2000, 3000, math.radians(29)).to(0, 2000).to(0, 0)
    assert sizes(short.path()).radii == ()


def test_boxes_and_distances_of_a_punch_are_those_of_the_path_less_the_offset():
    path = square(Pen(-1000, 0).to(0, 0), 2000).path()
    found = sizes(path)
    (box,) = found.boxes
    assert (box.what, box.piece) == ("part", 0)
    for figure in (box.cut_um, box.nominal_um):
        assert figure == pytest.approx((1800, 1800), abs=0.05)
    assert box.center_um == pytest.approx((1000, 1000), abs=0.05)
    assert [(size.what, size.blocks, size.nominal_um) for size in found.distances] == [
        ("material", (2, 4), pytest.approx(1800.0)),
        ("material", (3, 5), pytest.approx(1800.0)),
    ]
    assert [size.cut_um for size in found.distances] == pytest.approx([1800.0] * 2, abs=0.05)


def test_a_punch_cut_5_um_outside_its_path_is_larger_by_twice_as_much():
    path = square(Pen(-1000, 0).to(0, 0), 2000).path()
    found = sizes(path, block_of(path, range(1, 5)))
    assert [size.cut_um - size.nominal_um for size in found.distances] == pytest.approx([10.0] * 2, abs=0.05)
    assert np.subtract(found.boxes[0].cut_um, found.boxes[0].nominal_um) == pytest.approx([10.0] * 2, abs=0.05)


def test_an_opening_is_measured_on_the_side_that_stays():
    path = Pen(1000, 1000).to(1000, 0).to(2000, 0).to(2000, 2000).to(0, 2000).to(0, 0).to(1000, 0).path()
    found = sizes(path, block_of(path, range(3, 5)))
    (box,) = found.boxes
    assert box.what == "opening"
    assert box.nominal_um == pytest.approx((2200, 2200), abs=0.05)
    assert [(size.what, size.blocks) for size in found.distances] == [
        ("slot", (2, 4)),
        ("slot", (3, 5)),
        ("slot", (4, 6)),
    ]
    # The top and the left side are cut 5 µm farther out.
    assert [size.cut_um - size.nominal_um for size in found.distances] == pytest.approx([5.0, 5.0, 5.0], abs=0.05)


def test_a_hole_in_a_part_has_a_box_too():
    pen = Pen(1000, 1000).to(1400, 1000).arc(1000, 1000, 2 * math.pi).to(1000, 1000).jump(-1000, 0).to(0, 0)
    found = sizes(square(pen, 2000).path())
    assert [box.what for box in found.boxes] == ["part", "hole"]
    assert found.boxes[1].cut_um == pytest.approx((1000, 1000), abs=0.05)
    assert found.boxes[1].nominal_um == pytest.approx((1000, 1000), abs=0.05)
    assert [(size.what, size.nominal_um) for size in found.radii] == [("hole", 500.0)]


def test_each_edge_is_paired_with_the_nearest_that_faces_it():
    # A comb of two slots, 1000 wide at the path, in a plate of 5000.
    pen = Pen(-1000, 0).to(0, 0).to(5000, 0).to(5000, 4000).to(4000, 4000).to(4000, 1000).to(3000, 1000)
    pen = pen.to(3000, 4000).to(2000, 4000).to(2000, 1000).to(1000, 1000).to(1000, 4000).to(0, 4000).to(0, 0)
    found = {size.blocks: (size.what, round(size.nominal_um, 3)) for size in sizes(pen.path()).distances}
    assert found[3, 5] == ("material", 800.0)
    assert found[5, 7] == ("slot", 1200.0) or found[7, 9] == ("material", 800.0)
    assert all(what == ("material" if nominal in (800.0, 3800.0) else "slot") for what, nominal in found.values())


def test_a_cut_that_frees_nothing_has_no_sizes():
    assert sizes(Pen().to(3000, 0).to(3000, 3000).path()) == ((), (), ())


def test_circles_are_found_from_places_on_parts_of_them():
    rng = np.random.default_rng(1)
    of = np.repeat(np.arange(40), 30)
    radius, center = rng.uniform(500, 9000, 40), rng.uniform(-1e5, 1e5, (40, 2))
    angle = rng.uniform(0, 6, 40)[of] + np.tile(np.linspace(0, 0.6, 30), 40)
    place = center[of] + radius[of][:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    fits = fitted_circles(place, of, center + rng.uniform(-20, 20, (40, 2)))
    np.testing.assert_allclose(fits.radius_um, radius, atol=1e-5)
    np.testing.assert_allclose(fits.center_um, center, atol=1e-5)
    assert fits.form_um.max() < 1e-5


def test_the_play_of_a_table_shows_in_the_size_of_its_square():
    run = scenario_run("backlash")
    kerf = kerf_of(run.toolpath, run.trace, run.contours, np.full(len(run.toolpath), run.scenario.wire.reach_um))
    found = sizes_of(run.toolpath, kerf, pieces_of(kerf, None, STEEL), None, np.zeros((len(run.toolpath), 2)))
    # The first side is cut on its line, the three others 5.13 to 5.16 µm off theirs: the part is small by that.
    assert [size.cut_um - size.nominal_um for size in found.distances] == pytest.approx([-5.2, -10.3], abs=0.1)


def test_sizes_do_not_depend_on_where_the_program_stands():
    path = square(Pen(-1000, 0).to(0, 0), 2000).path()
    moved = replace(path, start_um=path.start_um + 1e5, end_um=path.end_um + 1e5)
    for one, other in pairwise((sizes(path), sizes(moved))):
        for a, b in zip(one.distances, other.distances, strict=True):
            assert a.cut_um == pytest.approx(b.cut_um, abs=0.01)
