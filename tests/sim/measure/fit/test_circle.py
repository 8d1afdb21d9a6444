"""What a measured circle tells of machines whose truth is known: their circles are made here, axis by axis."""

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from depth import cases

from parser.findings.errors import SettingsError
from sim.measure.fit.circle import CircleFit, fit_circle, steps_um
from sim.measure.fit.rows import read_circle

TOLD = {"squareness": 1e6, "scale_difference": 1e6, "lag_difference": 1.0, "reversal_x": 1.0, "reversal_y": 1.0}


class Truth(NamedTuple):
    """A machine: out of square rad, scales apart, µm that Y lags behind X, lost motion µm."""

    squareness: float = 0.0
    scale_difference: float = 0.0
    lag_difference: float = 0.0
    reversal_x: float = 0.0
    reversal_y: float = 0.0


class Circle(NamedTuple):
    """How it is measured: radius µm, places a turn, noise µm, directions, and what no model of a machine has."""

    radius_um: float = 50_000.0
    places: int = 720
    noise_um: float = 1.0
    senses: tuple[int, ...] = (1, -1)
    lobe_um: float = 0.0
    drift_um: float = 0.0
    missing_rad: float = math.radians(3.0)
    outliers: float = 0.01


def machine(chance: np.random.Generator) -> Truth:
    return Truth(
        40e-6 * chance.normal(), 30e-6 * chance.normal(), 2.0 * chance.normal(), *chance.uniform(0.0, 15.0, 2).tolist()
    )


def measured(truth: Truth, circle: Circle, chance: np.random.Generator) -> np.ndarray:
    """Places (n, 2) µm about a centre that is not the origin, to 0.1 µm, some of them far off, an arc missing."""
    radius, turns = circle.radius_um, []
    for sense in circle.senses:
        angle = 0.3 + sense * np.linspace(0.0, 2.0 * np.pi, circle.places, endpoint=False)
        x, y = np.cos(angle), np.sin(angle)
        # Each axis where it stands: its scale, its lag along its own speed, its lost motion against it.
        speed_x, speed_y = -sense * y, sense * x
        lag = 0.5 * truth.lag_difference
        scale_x, scale_y = 1.0 + 0.5 * truth.scale_difference, 1.0 - 0.5 * truth.scale_difference
        along_x = radius * x * scale_x + lag * speed_x - 0.5 * truth.reversal_x * np.sign(speed_x)
        along_y = radius * y * scale_y - lag * speed_y - 0.5 * truth.reversal_y * np.sign(speed_y)
        along_x = along_x - truth.squareness * radius * y
        off = circle.lobe_um * np.cos(6.0 * angle) + circle.noise_um * chance.normal(size=len(angle))
        off += np.where(chance.random(len(angle)) < circle.outliers, chance.choice([-30.0, 30.0], len(angle)), 0.0)
        place = np.column_stack([along_x + off * x, along_y + off * y])
        missing = np.abs(np.mod(angle - 1.1 + np.pi, 2.0 * np.pi) - np.pi) < 0.5 * circle.missing_rad
        turns.append(place[~missing])
    place = np.concatenate(turns)
    drift = np.outer(np.linspace(0.0, circle.drift_um, len(place)), [1.0, 0.0])
    return np.round((place + drift + [1234.0, -567.0]) / 0.1) * 0.1


def parameter(fit: CircleFit, name: str):
    return next(each for each in fit.parameters if each.name == name)


def test_intervals_hold_the_truth_in_19_of_20_and_clean_circles_are_not_doubted() -> None:
    chance = np.random.default_rng(11)
    many, doubted = len(cases(60, 500)), 0
    held = dict.fromkeys(TOLD, 0)
    for _ in range(many):
        truth = machine(chance)
        circle = Circle(float(chance.choice([20e3, 50e3, 100e3])), noise_um=chance.uniform(0.5, 3.0))
        fit = fit_circle(measured(truth, circle, chance))
        doubted += bool(fit.lack)
        for name, scale in TOLD.items():
            found = parameter(fit, name)
            held[name] += found.least <= scale * getattr(truth, name) <= found.most
    slack = 2.6 * math.sqrt(0.95 * 0.05 / many)
    assert all(share / many == pytest.approx(0.95, abs=0.02 + slack) for share in held.values()), held
    assert doubted / many <= 0.01 + 2.6 * math.sqrt(0.01 / many)


@pytest.mark.parametrize("circle", [Circle(lobe_um=3.0, noise_um=3.0), Circle(drift_um=2.0, noise_um=2.0)])
def test_lobes_and_drift_are_told(circle: Circle) -> None:
    chance = np.random.default_rng(12)
    many = len(cases(20, 200))
    told = sum(bool(fit_circle(measured(machine(chance), circle, chance)).lack) for _ in range(many))
    assert told / many >= 0.95


def test_errors_are_those_of_the_least_squares_of_so_many_places() -> None:
    """σ 1 µm, R 50 mm, 2 × 1,440 places: ± 1.96 × 0.105 µm of lost motion, 1.05 µrad, 2 × 0.53 ppm (closed forms)."""
    chance = np.random.default_rng(13)
    circle = Circle(places=1440, missing_rad=0.0, outliers=0.0)
    fit = fit_circle(measured(Truth(40e-6, 30e-6, 2.0, 10.0, 6.0), circle, chance))
    reach = {name: 0.5 * (parameter(fit, name).most - parameter(fit, name).least) / 1.96 for name in TOLD}
    assert reach["reversal_x"] == pytest.approx(0.105, rel=0.12)
    assert reach["squareness"] == pytest.approx(1.05, rel=0.1)
    assert reach["scale_difference"] == pytest.approx(2.0 * 0.53, rel=0.1)
    assert fit.residual_um == pytest.approx(1.0, rel=0.05)


def test_one_direction_tells_no_squareness_and_no_number_stands_for_it() -> None:
    chance = np.random.default_rng(14)
    fit = fit_circle(measured(Truth(40e-6, 0.0, 2.0, 10.0, 6.0), Circle(senses=(1,)), chance), 1000.0)
    untold = {each.name: each.why for each in fit.parameters if not each.is_determined}
    assert untold == {
        "squareness": "one-direction",
        "lag_difference": "one-direction",
        "delay_difference": "one-direction",
        "backlash_x": "with-friction",
        "backlash_y": "with-friction",
        "mean_scale": "with-radius",
    }
    assert all((each.value, each.least, each.most) == (None, None, None) for each in fit.parameters if each.why)
    assert fit.value("reversal_x") == pytest.approx(10.0, abs=0.6)


def test_a_feed_makes_a_time_of_the_lag() -> None:
    chance = np.random.default_rng(15)
    fit = fit_circle(measured(Truth(lag_difference=2.0), Circle(noise_um=0.2), chance), 5000.0)
    assert fit.value("delay_difference") == pytest.approx(2.0 / 5000.0 * 1e3, abs=0.02)


def test_what_is_no_circle_is_refused() -> None:
    chance = np.random.default_rng(16)
    turn = measured(Truth(), Circle(senses=(1,), outliers=0.0), chance)
    for places, code in (
        (turn[:10], "circle-too-few"),
        (turn[: len(turn) // 2], "circle-not-round"),
        (turn * [1.0, 0.5], "circle-not-round"),
        (turn[chance.permutation(len(turn))], "circle-no-order"),
    ):
        with pytest.raises(SettingsError) as raised:
            fit_circle(places)
        assert raised.value.message.code == code


def test_steps_of_a_point_by_point_controller_look_like_lost_motion() -> None:
    angle = np.concatenate([np.linspace(0.0, 2.0 * np.pi, 3000), np.linspace(2.0 * np.pi, 0.0, 3000)])
    angle = np.mod(angle + np.pi, 2.0 * np.pi) - np.pi
    sense = np.repeat([1.0, -1.0], 3000)
    radius = 20_000.0 + steps_um(angle, sense, 20_000.0)
    fit = fit_circle(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))
    assert fit.value("reversal_x") == pytest.approx(-1.0, abs=0.5)
    corrected = fit_circle(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), by_points=True)
    assert corrected.value("reversal_x") == pytest.approx(0.0, abs=0.05)
    assert parameter(corrected, "reversal_x").most - parameter(corrected, "reversal_x").least >= 1.0


def test_both_directions_come_of_further_columns_or_of_a_further_file(tmp_path: Path) -> None:
    there, back = (np.array([[of, 1.0], [of + 1.0, 2.5]]) for of in (1.0, 7.0))
    (tmp_path / "a.csv").write_text("x_mm;y_mm;x_back_mm;y_back_mm\n1;1,0;7;1\n2;2,5;8;2,5\n")
    (tmp_path / "b.csv").write_text("X_MM,Y_MM\n1,1\n2,2.5\n")
    (tmp_path / "c.csv").write_text("turn,x_um,y_um\ncw,7000,1000\ncw,8000,2500\n")
    wanted = 1000.0 * np.concatenate([there, back])
    assert np.array_equal(read_circle(tmp_path / "a.csv"), wanted)
    assert np.array_equal(read_circle(tmp_path / "b.csv", tmp_path / "c.csv"), wanted)
    (tmp_path / "d.csv").write_text("feature,x_mm,y_mm,z_mm\nhole,1,1,0\n")
    (tmp_path / "e.csv").write_text("x_mm,y_mm\n1,1\n2,\n")
    for name, code in (("d.csv", "fit-of-features"), ("e.csv", "row-field")):
        with pytest.raises(SettingsError) as raised:
            read_circle(tmp_path / name)
        assert raised.value.message.code == code
