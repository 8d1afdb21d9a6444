"""Bands of even stretches, straight or bent: the union of their discs as GEOS makes it of circles, and as stars do."""

import numpy as np
import pytest
import shapely
from paths import Pen
from traced import F, kerf_along

from parser.geometry.curves import Floats
from sim.cut.kerf.bands import are_even, bands
from sim.cut.kerf.stars import SIMPLER_UM
from sim.cut.kerf.swept import Swept
from sim.cut.kerf.ways import WireWay, spacing_um

OFF_UM = 0.02 + SIMPLER_UM
"""What a chord between discs that lie 4 µm apart leaves out, or fills, and what is simplified."""
NOTCH_UM = 0.03
"""What more a chord fills of a notch between discs that differ by up to 1 µm; those of a table differ by 0.3."""


STRAIGHT = np.zeros((1, 3))
RADII_UM = (3.0 * F, 7.0 * F, 3000.0, 1e5, 1e7)


def straight(rng: np.random.Generator, length_um: float, across_um: float) -> Floats:
    """Places along and across a straight way, now and then back by less than a step."""
    steps = rng.uniform(0.3, spacing_um(F), int(length_um / 2.0))
    back = rng.random(len(steps)) < 0.05
    back[1:] &= ~back[:-1]
    back[2:] &= ~back[:-2]
    along = np.cumsum(np.where(back, -0.4, steps))
    across = np.clip(np.cumsum(rng.normal(0.0, 0.1, len(steps))), -across_um / 2.0, across_um / 2.0)
    return np.stack([along, across], axis=1)


def way(rng: np.random.Generator, length_um: float, across_um: float) -> Floats:
    """Places of a wire that goes straight in some direction."""
    angle = rng.uniform(-np.pi, np.pi)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return straight(rng, length_um, across_um) @ turn + rng.uniform(-1e5, 1e5, 2)


def bent_way(rng: np.random.Generator, radius_um: float, across_um: float) -> tuple[Floats, Floats]:
    """Places of a wire that goes along an arc about some centre, one way or the other, and (1, 3) that arc."""
    along, across = straight(rng, min(radius_um * rng.uniform(0.5, 1.4), 3000.0), across_um).T
    turn, centre = rng.choice([-1.0, 1.0]), rng.uniform(-1e5, 1e5, 2)
    angle = rng.uniform(-np.pi, np.pi) + turn * along / radius_um
    place = centre + (radius_um + across)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return place, np.array([[*centre, turn * radius_um]])


def discs_of(place: Floats) -> shapely.Polygon:
    return shapely.union_all(shapely.buffer(shapely.points(place), F, quad_segs=64))


@pytest.mark.alike(1)
@pytest.mark.parametrize("seed", range(12))
def test_a_band_is_the_union_of_its_discs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    place = way(rng, rng.uniform(250.0, 3200.0), 1.0)
    assert are_even(place, np.zeros(1, dtype=np.int64), STRAIGHT).all()
    (band,) = bands(place, np.array([[0, len(place)]]), STRAIGHT, F)
    discs = discs_of(place)
    assert band.is_valid
    assert shapely.hausdorff_distance(band.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM
    assert band.area == pytest.approx(discs.area, rel=2e-4)


@pytest.mark.alike(1)
@pytest.mark.parametrize("radius_um", RADII_UM)
@pytest.mark.parametrize("seed", range(6))
def test_a_band_along_an_arc_is_the_union_of_its_discs(seed: int, radius_um: float) -> None:
    place, bend = bent_way(np.random.default_rng(seed), radius_um, 1.0)
    assert are_even(place, np.zeros(1, dtype=np.int64), bend).all()
    (band,) = bands(place, np.array([[0, len(place)]]), bend, F)
    discs = discs_of(place)
    assert band.is_valid
    assert shapely.hausdorff_distance(band.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM
    assert band.area == pytest.approx(discs.area, rel=2e-4)


def uneven_way(rng: np.random.Generator, offset_um: float) -> tuple[Floats, Floats]:
    """Places as rough across the way as a stretch may be, and (1, 3) the arc that they follow or none."""
    radius = float(rng.choice([0.0, 3.0 * offset_um, 5.0 * offset_um, 30.0 * offset_um, 1e6]))
    number = int(rng.integers(3, 400))
    steps = rng.uniform(0.3, 0.98 * spacing_um(offset_um), number)
    back = rng.random(number) < 0.05
    back[1:] &= ~back[:-1]
    back[2:] &= ~back[:-2]
    along, high = np.cumsum(np.where(back, -0.4, steps)), rng.choice([0.2, 1.0, 1.9])
    along = along[along < 1.45 * radius] if radius else along
    noise = np.clip(np.cumsum(rng.normal(0.0, 0.3, len(along))), -high, high)
    waves = high * np.sin(along / rng.uniform(5.0, 300.0))
    across = (rng.uniform(-high, high, len(along)), waves, noise)[rng.integers(0, 3)]
    if not radius:
        return np.stack([along, across], axis=1), STRAIGHT
    turn, centre = rng.choice([-1.0, 1.0]), rng.uniform(-1e5, 1e5, 2)
    angle = rng.uniform(-np.pi, np.pi) + turn * along / radius
    place = centre + (radius + across)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return place, np.array([[*centre, turn * radius]])


@pytest.mark.alike(3)
@pytest.mark.parametrize("seed", range(60))
def test_a_band_of_any_even_way_is_the_union_of_its_discs_but_for_holes(seed: int) -> None:
    """Also where each place lies aside by more than it lies ahead, of thin wires and thick ones."""
    rng, looked_at = np.random.default_rng(seed), 0
    for _ in range(8):
        offset_um = float(rng.choice([20.0, 50.0, 75.0, 100.0, 200.0]))
        place, bend = uneven_way(rng, offset_um)
        if len(place) < 3 or not are_even(place, np.zeros(1, dtype=np.int64), bend).all():
            continue
        (band,) = bands(place, np.array([[0, len(place)]]), bend, offset_um)
        discs = shapely.union_all(shapely.buffer(shapely.points(place), offset_um, quad_segs=128))
        assert band.is_valid
        assert shapely.hausdorff_distance(band.exterior, discs.exterior, densify=0.2) <= OFF_UM + 0.04
        looked_at += 1
    assert looked_at > 2


def test_a_band_of_an_even_way_has_straight_sides() -> None:
    place = np.stack([np.linspace(0.0, 3000.0, 1001), np.zeros(1001)], axis=1)
    (band,) = bands(place, np.array([[0, 1001]]), STRAIGHT, F)
    assert band.bounds == pytest.approx((-F, -F, 3000.0 + F, F), abs=1e-9)
    corners = np.array(band.exterior.coords)
    assert not ((corners[:, 0] > 5.0) & (corners[:, 0] < 2995.0)).any()


def test_what_is_no_straight_stretch_is_none() -> None:
    line = np.stack([np.linspace(0.0, 600.0, 301), np.zeros(301)], axis=1)
    bowed, back, still = line.copy(), line.copy(), np.zeros((5, 2))
    bowed[150, 1] = 4.5
    back[150:160, 0] -= 30.0
    first = np.array([0, 301, 602, 903])
    stretches = np.concatenate([line, bowed, back, still])
    assert are_even(stretches, first, np.zeros((4, 3))).tolist() == [True, False, False, False]


def test_what_is_no_stretch_along_its_arc_is_none() -> None:
    angle = np.linspace(0.0, 1.0, 301)
    arc = 2000.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    off_it, back = arc.copy(), arc.copy()
    off_it[150] *= 1.00225
    back[150:160] = back[140:150]
    first, bend = np.array([0, 301, 602]), np.tile([0.0, 0.0, 2000.0], (3, 1))
    stretches = np.concatenate([arc, off_it, back])
    assert are_even(stretches, first, bend).tolist() == [True, False, False]
    assert not are_even(stretches, first, bend * [1.0, 1.0, -1.0]).any(), "it runs the other way"


@pytest.mark.deeper
def test_what_is_swept_up_to_a_place_is_the_union_of_the_discs_so_far() -> None:
    """Also where that part of the way lies farther off its own chord than the whole does off its chord."""
    along = np.linspace(0.0, 3000.0, 1001)
    across = np.select([along < 120.0, along < 400.0, along < 1500.0, along < 3000.0], [0.0, 2.0, -1.9, 2.0])
    place = np.stack([along, across], axis=1)
    first, row = np.zeros(1, dtype=np.int64), np.zeros(1001, dtype=np.int64)
    assert are_even(place, first, STRAIGHT).all()
    assert not are_even(place[:502], first, STRAIGHT).any()
    way, chord = WireWay(place, along, along, row), place[None, [0, -1]]
    swept = Swept(way, np.array([0, 1001]), np.array([True]), STRAIGHT, chord, np.zeros(1), F, shapely.Polygon(), ())
    for at in (0, 1, 20, 34, 100, 501, 700, 1000):
        discs = discs_of(place[: at + 1])
        region = swept.up_to(0, at)
        assert shapely.hausdorff_distance(region.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM, at
    for since, at in ((300, 310), (300, 400), (300, 1000)):
        discs = discs_of(place[since : at + 1])
        region = swept.up_to(0, at, since)
        assert shapely.hausdorff_distance(region.exterior, discs.exterior, densify=0.2) <= OFF_UM + NOTCH_UM, at


def square() -> Pen:
    pen = Pen(0, 0)
    for x, y in ((4000, 0), (4000, 4000), (0, 4000), (0, 0)):
        pen.to(x, y)
    return pen


def circle() -> Pen:
    pen = Pen(2000, 0)
    return pen.arc(0, 0, 2.0 * np.pi)


@pytest.mark.parametrize(("pen", "fewer"), [(square(), 3), (circle(), 1)], ids=["square", "circle"])
def test_both_ways_of_sweeping_give_one_kerf(pen: Pen, fewer: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a fourth of the stretches; with a third of the corners, where no steps across the way are left to show."""
    path = pen.path()
    by_bands = kerf_along(path)
    monkeypatch.setattr("sim.cut.kerf.swept.are_even", lambda place, first, bend: np.zeros(len(first), dtype=np.bool_))
    by_stars = kerf_along(path)
    assert by_bands.swept[0].is_band.any()
    assert not by_stars.swept[0].is_band.any()
    apart = shapely.hausdorff_distance(by_bands.region_um.boundary, by_stars.region_um.boundary, densify=0.1)
    assert apart <= 2.0 * OFF_UM
    assert len(by_bands.swept[0].is_band) < len(by_stars.swept[0].is_band) / 4
    assert shapely.get_num_coordinates(by_bands.region_um) < shapely.get_num_coordinates(by_stars.region_um) / fewer
