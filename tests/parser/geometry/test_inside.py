"""Whether places lie within contours of lines and arcs, against polygons of shapely with chords far finer than 1 µm."""

import numpy as np
import pytest
import shapely
from drawings_dxf import points_on

from parser.geometry.curves import Curves, curves_between, is_inside

OFF_UM = 2.0
"""Places nearer to the contour than this are not asked about: the polygon's chords lie less than 1 µm off its arcs."""


def star(seed: int) -> Curves:
    """A contour round the origin, some of its sides arcs that bulge out or in; either way round."""
    chance = np.random.default_rng(seed)
    corners = int(chance.integers(4, 12))
    angle = 2.0 * np.pi * np.arange(corners) / corners
    ends = chance.uniform(8_000.0, 20_000.0, corners)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    if chance.random() < 0.5:
        ends = ends[::-1]
    start, end = ends, np.roll(ends, -1, axis=0)
    sweep = np.where(chance.random(corners) < 0.5, chance.uniform(-0.4, 0.4, corners), 0.0)
    chord = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        off = 0.5 / np.tan(sweep / 2.0)
    normal = np.stack([-chord[:, 1], chord[:, 0]], axis=1)
    center = np.where((sweep == 0.0)[:, None], np.nan, (start + end) / 2.0 + off[:, None] * normal)
    return curves_between(start, end, center, sweep)


@pytest.mark.alike(5)
@pytest.mark.parametrize("seed", range(20))
def test_places_are_inside_where_a_fine_polygon_holds_them(seed: int) -> None:
    contour = star(seed)
    each_once = points_on(contour, 400).reshape(-1, 400, 2)[:, :-1].reshape(-1, 2)
    polygon = shapely.Polygon(each_once)
    assert polygon.is_valid
    place = np.random.default_rng(seed).uniform(-22_000.0, 22_000.0, (2_000, 2))
    clear = shapely.distance(shapely.points(place), polygon.exterior) > OFF_UM
    expected = shapely.contains_xy(polygon, *place[clear].T)
    assert expected.any()
    assert np.array_equal(is_inside(contour, place[clear]), expected)


def test_full_circles_either_way_hold_what_is_nearer_than_their_radius() -> None:
    for turn in (2.0 * np.pi, -2.0 * np.pi):
        start = np.array([[1_000.0, 0.0]])
        circle = curves_between(start, start, np.zeros((1, 2)), np.array([turn]))
        place = np.array([[0.0, 0.0], [999.0, 0.0], [0.0, -999.0], [1_001.0, 0.0], [-700.0, 720.0]])
        assert is_inside(circle, place).tolist() == [True, True, True, False, False]


def test_the_middle_of_a_half_circle_lies_within_it() -> None:
    ends = np.array([[1_000.0, 0.0], [-1_000.0, 0.0]])
    half = curves_between(ends, ends[::-1], np.zeros((2, 2)), np.array([np.pi, np.pi]))
    assert is_inside(half, np.zeros((1, 2))).tolist() == [True]
