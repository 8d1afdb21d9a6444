"""A wire that leans: worked solids, contours of other heights, corners, blocks that turn over, and two contours."""

import math

import numpy as np
import pytest
from depth import cases
from tilted_paths import HEIGHTS, ROUND, SQUARE, SQUARE_UP, contour, lean, random_pair

from controller.taper.shifted_contour import Corner
from controller.taper.tilted import Heights, TiltedPath, tilted, told_lean
from controller.taper.two_contours import between_contours, matched_rows
from parser.geometry.along import places

T3 = math.radians(3.0)


def punch(corner: Corner, heights: Heights = HEIGHTS, angle_rad: float = T3) -> TiltedPath:
    """A punch of 20 × 20 mm, cut counter-clockwise with its upper end to the right, from the middle of an edge."""
    path = contour(SQUARE)
    return tilted(path, told_lean(lean(path, -1, angle_rad), path), heights, corner)


def area_mm2(path: TiltedPath, z_mm: float) -> float:
    (loop,) = path.loops
    return path.ruled.area_um2(loop, 1000.0 * z_mm) * 1e-6


def test_a_punch_with_sharp_corners_is_a_frustum() -> None:
    path = punch("sharp")
    assert area_mm2(path, 40.0) == pytest.approx(24.192622**2, rel=1e-7)
    assert path.ruled.volume_um3(path.loops[0], 0.0, 40_000.0) * 1e-9 == pytest.approx(19_588.472, abs=5e-4)
    assert math.degrees(path.lean_most_rad()) == pytest.approx(4.23877, abs=5e-6)
    assert path.uv_um() == pytest.approx((10_481.556, 14_823.158), abs=5e-4)


def test_a_punch_with_cone_corners_grows_by_steiners_formula() -> None:
    path = punch("cone")
    for z_mm in (0.0, 10.0, 40.0):
        grown = z_mm * math.tan(T3)
        assert area_mm2(path, z_mm) == pytest.approx(400.0 + 80.0 * grown + math.pi * grown**2, rel=1e-12)
    assert path.ruled.volume_um3(path.loops[0], 0.0, 40_000.0) * 1e-9 == pytest.approx(19_538.175, abs=5e-4)
    assert math.degrees(path.lean_most_rad()) == pytest.approx(3.0)
    assert path.uv_um() == pytest.approx((10_481.556, 10_481.556), abs=5e-4)


@pytest.mark.parametrize("corner", ["sharp", "cone"])
@pytest.mark.parametrize("program_mm", [0.0, 13.0, 40.0])
def test_sharp_corners_leave_the_program_plane_as_it_is(corner: Corner, program_mm: float) -> None:
    path = punch(corner, HEIGHTS._replace(program_um=1000.0 * program_mm))
    off = abs(area_mm2(path, program_mm) - 400.0)
    assert off < 1e-9 if corner == "sharp" or program_mm in {0.0, 40.0} else 0.01 < off < 0.2


def test_round_on_square_is_quadratic_in_height() -> None:
    path = between_contours(SQUARE_UP, matched_rows(SQUARE_UP, ROUND), HEIGHTS, (0.0, 40_000.0))
    areas = [area_mm2(path, z_mm) for z_mm in (0.0, 10.0, 20.0, 30.0, 40.0)]
    assert areas == pytest.approx([400.0, 345.6043, 294.3161, 246.1353, 201.0619], abs=5e-5)
    assert path.ruled.volume_um3(path.loops[0], 0.0, 40_000.0) * 1e-9 == pytest.approx(11_855.5087, abs=5e-5)
    row, half = np.array([1]), np.array([0.5])
    assert path.ruled.places(row, half, 20_000.0)[0] == pytest.approx([8695.5, 4030.7], abs=0.05)
    assert math.degrees(path.lean_most_rad()) == pytest.approx(8.730, abs=5e-4)


def test_an_inside_fillet_turns_over_at_its_radius_over_the_tangent() -> None:
    # An opening cut clockwise that grows narrower upwards, with a fillet of 2 mm.
    places = [(0, 0), (0, 10), (-8, 10), (-10, 8), (-10, -10), (10, -10), (10, 10), (0, 10), (0, 0)]
    path = contour(places, {2: ((-8, 8), math.pi / 2.0)})
    inward = tilted(path, told_lean(lean(path, 1, T3), path), HEIGHTS, "sharp")
    (turned,) = inward.turned
    assert (turned.row, turned.z_um) == (2, pytest.approx(38_162.27, abs=0.01))
    outward = tilted(path, told_lean(lean(path, -1, T3), path), HEIGHTS, "sharp")
    assert outward.turned == ()


# Of two partners the shorter contour had the larger radius, and chords were as long as that one allows: 0.15 µm off.
SMALL_UNDER_LARGE = (502, 893)


@pytest.mark.deep
@pytest.mark.parametrize("seed", sorted({*cases(10, 1000), *SMALL_UNDER_LARGE}))
@pytest.mark.parametrize("planes_mm", [(0.0, 40.0), (5.0, 30.0)])
def test_sections_are_those_of_an_independent_ruled_surface(seed: int, planes_mm: tuple[float, float]) -> None:
    toolpath, upper, walk = random_pair(seed)
    planes = (1000.0 * planes_mm[0], 1000.0 * planes_mm[1])
    path = between_contours(toolpath, matched_rows(toolpath, upper), HEIGHTS, planes)
    for z_um in (0.0, 10_000.0, 20_000.0, 30_000.0, 40_000.0):
        curves, row = path.ruled.section(z_um)
        source = path.source_row[row]
        parts = np.bincount(source)[source]
        number = np.arange(len(source)) - np.searchsorted(source, source)
        height = (z_um - planes[0]) / (planes[1] - planes[0])
        off = [
            np.hypot(*(found - walk(source, (number + by) / parts, height)).T).max()
            for found, by in ((curves.end_um, 1.0), (places(curves, np.arange(len(row)), np.full(len(row), 0.5)), 0.5))
        ]
        assert max(off) <= 0.1
        assert np.abs(curves.end_um[:-1] - curves.start_um[1:]).max() < 1e-6


@pytest.mark.parametrize("angle_deg", [0.5, 1.0, 3.0, 10.0])
def test_taper_is_the_offset_of_each_height(angle_deg: float) -> None:
    # A stadium: its offset is a stadium, whose area is known in closed form.
    places = [(0, 0), (0, -5), (20, -5), (20, 5), (-20, 5), (-20, -5), (0, -5), (0, 0)]
    path = contour(places, {2: ((20, 0), math.pi), 4: ((-20, 0), math.pi)})
    angle = math.radians(angle_deg)
    out = tilted(path, told_lean(lean(path, -1, angle), path), HEIGHTS._replace(program_um=20_000.0), "sharp")
    for z_mm in (0.0, 15.0, 40.0):
        radius = 5.0 + (z_mm - 20.0) * math.tan(angle)
        assert area_mm2(out, z_mm) == pytest.approx(40.0 * 2.0 * radius + math.pi * radius**2, rel=1e-12)


def test_walls_may_have_angles_of_their_own() -> None:
    path = contour(SQUARE)
    degrees = np.array([1.0, 1.0, 2.0, 0.5, 2.0, 1.0, 0.0])
    taper = lean(path, -1, 0.0)
    own = type(taper)(taper.side, np.radians(degrees))
    out = tilted(path, told_lean(own, path), HEIGHTS, "sharp")
    low, high = out.ruled.upper.start_um.min(axis=0), out.ruled.upper.end_um.max(axis=0)
    grown = [40_000.0 * math.tan(math.radians(angle)) for angle in (1.0, 2.0, 0.5, 2.0)]
    assert high - [20_000.0, 20_000.0] == pytest.approx([grown[1], grown[2]])
    assert (out.ruled.upper.end_um[5, 1], low[0]) == (pytest.approx(-grown[0]), pytest.approx(-grown[3]))
