"""Bands of straight stretches: the union of their discs as GEOS makes it of circles, and as stars make it."""

import numpy as np
import pytest
import shapely
from paths import Pen
from traced import F, kerf_along

from parser.geometry.curves import Floats
from sim.cut.kerf.bands import are_straight, bands
from sim.cut.kerf.stars import SIMPLER_UM
from sim.cut.kerf.swept import Swept
from sim.cut.kerf.ways import WireWay, spacing_um

OFF_UM = 0.02 + SIMPLER_UM
"""What a chord between discs that lie 4 µm apart leaves out, or fills, and what is simplified."""
NOTCH_UM = 0.03
"""What more a chord fills of a notch between discs that differ by up to 1 µm; those of a table differ by 0.3."""


def way(rng: np.random.Generator, length_um: float, across_um: float) -> Floats:
    """Places of a wire that goes straight in some direction, now and then back by less than a step."""
    steps = rng.uniform(0.3, spacing_um(F), int(length_um / 2.0))
    back = rng.random(len(steps)) < 0.05
    back[1:] &= ~back[:-1]
    back[2:] &= ~back[:-2]
    along = np.cumsum(np.where(back, -0.4, steps))
    across = np.clip(np.cumsum(rng.normal(0.0, 0.1, len(steps))), -across_um / 2.0, across_um / 2.0)
    angle = rng.uniform(-np.pi, np.pi)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.stack([along, across], axis=1) @ turn + rng.uniform(-1e5, 1e5, 2)


@pytest.mark.alike(1)
@pytest.mark.parametrize("seed", range(12))
def test_a_band_is_the_union_of_its_discs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    place = way(rng, rng.uniform(250.0, 3200.0), 1.0)
    assert are_straight(place, np.zeros(1, dtype=np.int64)).all()
    (band,) = bands(place, np.array([[0, len(place)]]), F)
    discs = shapely.union_all(shapely.buffer(shapely.points(place), F, quad_segs=64))
    assert band.is_valid
    assert shapely.hausdorff_distance(band.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM
    assert band.area == pytest.approx(discs.area, rel=2e-4)


def test_a_band_of_an_even_way_has_straight_sides() -> None:
    place = np.stack([np.linspace(0.0, 3000.0, 1001), np.zeros(1001)], axis=1)
    (band,) = bands(place, np.array([[0, 1001]]), F)
    assert band.bounds == pytest.approx((-F, -F, 3000.0 + F, F), abs=1e-9)
    corners = np.array(band.exterior.coords)
    assert not ((corners[:, 0] > 1.0) & (corners[:, 0] < 2999.0)).any()


def test_what_is_no_straight_stretch_is_none() -> None:
    line = np.stack([np.linspace(0.0, 600.0, 301), np.zeros(301)], axis=1)
    bowed, back, still = line.copy(), line.copy(), np.zeros((5, 2))
    bowed[150, 1] = 2.5
    back[150:160, 0] -= 30.0
    first = np.array([0, 301, 602, 903])
    assert are_straight(np.concatenate([line, bowed, back, still]), first).tolist() == [True, False, False, False]


@pytest.mark.deeper
def test_what_is_swept_up_to_a_place_is_the_union_of_the_discs_so_far() -> None:
    """Also where that part of the way lies farther off its own chord than the whole does off its chord."""
    along = np.linspace(0.0, 3000.0, 1001)
    across = np.select([along < 120.0, along < 400.0, along < 1500.0, along < 3000.0], [0.0, 1.0, -0.95, 1.0])
    place = np.stack([along, across], axis=1)
    first, row = np.zeros(1, dtype=np.int64), np.zeros(1001, dtype=np.int64)
    assert are_straight(place, first).all()
    assert not are_straight(place[:502], first).any()
    swept = Swept(WireWay(place, along, along, row), np.array([0, 1001]), np.array([True]), F, (), ())
    for at in (0, 1, 20, 34, 100, 501, 700, 1000):
        discs = shapely.union_all(shapely.buffer(shapely.points(place[: at + 1]), F, quad_segs=64))
        region = swept.up_to(0, at)
        assert shapely.hausdorff_distance(region.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM, at
    for since, at in ((300, 310), (300, 400), (300, 1000)):
        discs = shapely.union_all(shapely.buffer(shapely.points(place[since : at + 1]), F, quad_segs=64))
        region = swept.up_to(0, at, since)
        assert shapely.hausdorff_distance(region.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM, at


def test_both_ways_of_sweeping_give_one_kerf(monkeypatch: pytest.MonkeyPatch) -> None:
    pen = Pen(0, 0)
    for x, y in ((4000, 0), (4000, 4000), (0, 4000), (0, 0)):
        pen.to(x, y)
    path = pen.path()
    by_bands = kerf_along(path)
    monkeypatch.setattr("sim.cut.kerf.swept.are_straight", lambda place, first: np.zeros(len(first), dtype=np.bool_))
    by_stars = kerf_along(path)
    assert by_bands.swept[0].is_band.any()
    assert not by_stars.swept[0].is_band.any()
    apart = shapely.hausdorff_distance(by_bands.region_um.boundary, by_stars.region_um.boundary, densify=0.1)
    assert apart <= 2.0 * OFF_UM
    assert len(by_bands.swept[0].is_band) < len(by_stars.swept[0].is_band) / 4
    assert shapely.get_num_coordinates(by_bands.region_um) < shapely.get_num_coordinates(by_stars.region_um) / 4
