"""Lag and reach of a wire from an inside corner: held to a wire that is dragged by hand and a kerf of shapely's."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import shapely
from depth import cases
from runs import run_text

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from sim.measure.fit.corner import CornerFit, corner_edge, fit_corner
from sim.setup.wire import DEFAULT_WIRE

LONG_UM = 1500.0


@cache
def dragged(turn_deg: float, lag_um: float) -> Floats:
    """The way (m, 2) of a wire that is pulled straight to within its lag of the guides, in steps of 0.1 µm."""
    turn = math.radians(turn_deg)
    before = np.array([math.cos(turn), math.sin(turn)])
    wire, ways = -2.0 * LONG_UM * before, []
    for way, start in ((before, -2.0 * LONG_UM * before), (np.array([1.0, 0.0]), np.zeros(2))):
        for at in np.arange(0.0, 2.0 * LONG_UM, 0.1):
            guide = start + at * way
            gap = guide - wire
            away = math.hypot(*gap)
            if away > lag_um:
                wire = guide - gap / away * lag_um
            ways.append(wire)
    return np.array(ways[::2])


def measured(turn_deg: float, reach_um: float, lag_um: float, number: int = 60) -> Floats:
    """Places (n, 2) on the border of the kerf, on its outer side: on one face, round the corner, and on the other."""
    path = dragged(turn_deg, lag_um)
    by = np.diff(path, axis=0)
    moves = np.hypot(*by.T) > 1e-9
    middle, heading = (0.5 * (path[1:] + path[:-1]))[moves], np.unwrap(np.arctan2(*by[moves].T[::-1]))
    # Where the wire turns at once the border is a fan about its place.
    number_of = np.maximum(np.ceil(np.abs(np.diff(heading, append=heading[-1])) / 0.01), 1.0).astype(int)
    share = np.concatenate([np.arange(each) / each for each in number_of])
    own = np.repeat(np.arange(len(heading)), number_of)
    following = np.minimum(own + 1, len(heading) - 1)
    middle = middle[own] + share[:, None] * (middle[following] - middle[own])
    heading = heading[own] + share * (heading[following] - heading[own])
    edge = middle + reach_um * np.column_stack([-np.sin(heading), np.cos(heading)])
    # Around the sharpest place they lie closer.
    corner = np.argmin(np.hypot(*middle.T))
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(edge, axis=0).T))])
    near = np.linspace(-1.0, 1.0, number)
    wanted = along[corner] + np.sign(near) * np.abs(near) ** 1.5 * LONG_UM
    places = np.column_stack([np.interp(wanted, along, column) for column in edge.T])
    kerf = shapely.LineString(path)
    assert shapely.distance(kerf, shapely.points(places)) == pytest.approx(reach_um, abs=0.02)
    return places


def laid(places: Floats, rng: np.random.Generator, noise_um: float) -> Floats:
    """Turned, shifted, mirrored and run back by chance, with noise."""
    angle = rng.uniform(0.0, 2.0 * math.pi)
    turned = places @ np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    turned = turned * [1.0, rng.choice([-1.0, 1.0])] + rng.uniform(-5e4, 5e4, 2)
    found: Floats = (turned[::-1] if rng.random() < 0.5 else turned) + rng.normal(0.0, noise_um, places.shape)
    return found


def value(fit: CornerFit, name: str) -> tuple[float, float, float]:
    found = next(each for each in fit.parameters if each.name == name)
    assert found.value is not None
    assert found.least is not None
    assert found.most is not None
    return found.value, found.least, found.most


@pytest.mark.parametrize("turn_deg", [45.0, 90.0])
@pytest.mark.parametrize("lag_um", [15.0, 40.0])
def test_lag_and_reach_come_back_whichever_way_the_corner_lies(turn_deg: float, lag_um: float) -> None:
    places = measured(turn_deg, 100.0, lag_um)
    for seed in range(3):
        fit = fit_corner(laid(places, np.random.default_rng(seed), 0.0))
        assert fit.residual_um < 0.05
        assert value(fit, "lag")[0] == pytest.approx(lag_um, abs=0.5)
        assert value(fit, "reach")[0] == pytest.approx(100.0, abs=0.5)


def test_the_interval_holds_the_lag_as_often_as_it_says() -> None:
    """Corners of 90° measured to 0.5 µm: 95 % of the intervals hold the lag, less what chance leaves of so many."""
    places, inside, seeds = measured(90.0, 100.0, 30.0, 40), 0, cases(30, 60)
    for seed in seeds:
        _, least, most = value(fit_corner(laid(places, np.random.default_rng(seed), 0.5)), "lag")
        inside += least <= 30.0 <= most
    assert inside / len(seeds) >= 0.86


def test_a_straight_wire_leaves_the_fillet_of_its_reach() -> None:
    angle = np.linspace(0.0, 0.5 * math.pi, 30)
    fillet = 100.0 * np.column_stack([-np.cos(angle), np.sin(angle)])
    faces = np.column_stack([np.full(20, -100.0), np.linspace(-1000.0, -10.0, 20)])
    places = np.concatenate([faces, fillet, -faces[::-1, ::-1]])
    lag, least, _ = value(fit_corner(laid(places, np.random.default_rng(1), 0.3)), "lag")
    assert least == 0.0
    assert lag < 6.0


@pytest.mark.parametrize("lag_um", [20.0, 45.0])
def test_the_lag_of_a_run_is_found_in_the_corner_that_it_cut(lag_um: float) -> None:
    """A hole of 4 mm from its middle, by a wire of 0.18 mm with a gap of 10 µm: the table adds a µm of its own."""
    text = "B2000B0B2000GXL1 B0B2000B2000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 B4000B0B4000GXL1 B0B2000B2000GYL2 "
    run = run_text(text + "B2000B0B2000GXL3 DD", wire=replace(DEFAULT_WIRE, lag=lag_um), kerf=True)
    assert run.remains is not None
    border = run.remains.kerf.region_um.exterior
    corner = border.project(shapely.Point(2100.0, 2100.0))
    near = np.linspace(-1.0, 1.0, 60)
    along = (corner + np.sign(near) * np.abs(near) ** 1.5 * 1000.0) % border.length
    fit = fit_corner(shapely.get_coordinates(shapely.line_interpolate_point(border, along)))
    lag, least, most = value(fit, "lag")
    assert lag == pytest.approx(lag_um, abs=2.0)
    assert most - least < 4.0
    assert value(fit, "reach")[0] == pytest.approx(100.0, abs=2.0)


def test_the_edge_settles_on_both_faces() -> None:
    edge = corner_edge(math.radians(90.0), 100.0, 20.0)
    assert edge[-1, 1] == 0.0
    assert edge[-2, 1] == pytest.approx(0.0, abs=0.01)
    assert edge[1, 0] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("number", [5, 19])
def test_too_few_places_are_refused(number: int) -> None:
    with pytest.raises(SettingsError, match="too few"):
        fit_corner(measured(90.0, 100.0, 20.0)[:number])


def test_places_along_one_face_are_no_corner() -> None:
    with pytest.raises(SettingsError, match="in order along"):
        fit_corner(np.column_stack([np.linspace(0.0, 1e3, 40), np.zeros(40)]))
