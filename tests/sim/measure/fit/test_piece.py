"""A test piece tells edge, scales, squareness and lost motion: against a model of its own, by intervals and by runs."""

import math
from pathlib import Path

import numpy as np
import pytest
from cut_pieces import cut_and_measured
from depth import cases

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from sim.base.progress import silent
from sim.make.piece import piece_limits
from sim.measure.accept.judge import Places
from sim.measure.fit.piece import PieceFit, fit_piece
from sim.run.ballbar.fitted import fitted_machine
from sim.setup.limits import Limits
from sim.setup.machine.machine import load_machine

LIMITS = piece_limits(uncertainty_um=0.0)
PARAMETERS = ("edge", "mean_scale", "scale_difference", "squareness", "reversal_x", "reversal_y")


def cut(nominal: Floats, normal: Floats, way: Floats, truth: dict[str, float], inside: bool) -> Floats:
    """Where places (n, 2) of an edge come to lie that is cut along a way (n, 2): place by place, by the machine's law.

    An axis that moves stands half of its lost motion back; one that stands came from the middle of the piece.
    """
    scale = 1e-6 * truth["mean_scale"] + 0.5e-6 * truth["scale_difference"] * np.array([1.0, -1.0])
    placed = nominal + (-1.0 if inside else 1.0) * truth["edge"] * normal
    moves = np.where(np.abs(way) > 1e-9, np.sign(way), np.sign(placed - placed.mean(axis=0)))
    placed = placed - 0.5 * moves * np.array([truth["reversal_x"], truth["reversal_y"]])
    placed = placed * (1.0 + scale)
    return placed - np.column_stack([1e-6 * truth["squareness"] * placed[:, 1], np.zeros(len(placed))])


def measured(truth: dict[str, float], noise_um: float, seed: int, names: str = "") -> dict[str, Places]:
    """A piece cut counter-clockwise round outer contours, clockwise round inner ones, and measured with noise."""
    rng, piece = np.random.default_rng(seed), {}
    for feature in LIMITS.features:
        if not feature.name.startswith(names):
            continue
        size, sense = 1000.0 * feature.nominal_mm, -1.0 if feature.inside else 1.0
        if feature.kind == "circle":
            angle = np.linspace(0.1, 2.0 * np.pi, 40, endpoint=False)
            normal = np.column_stack([np.cos(angle), np.sin(angle)])
            nominal = 0.5 * size * normal
        else:
            across = math.radians(feature.across_deg)
            normal = np.repeat([[math.cos(across), math.sin(across)]], 24, axis=0)
            normal[12:] *= -1.0
            along = np.column_stack([-normal[:, 1], normal[:, 0]])
            nominal = 0.5 * size * normal + np.tile(np.linspace(-400.0, 400.0, 12), 2)[:, None] * along
        way = sense * np.column_stack([-normal[:, 1], normal[:, 0]])
        place = cut(nominal, normal, np.where(np.abs(way) > 1e-9, way, 0.0), truth, feature.inside)
        place = place + rng.normal(0.0, noise_um, place.shape) + rng.uniform(-5e4, 5e4, 2)
        piece[feature.name] = Places(place, np.full(len(place), np.nan))
    return piece


def random_truth(rng: np.random.Generator) -> dict[str, float]:
    reversals = rng.uniform(0.0, 12.0, 2)
    return {
        "edge": float(rng.uniform(-8.0, 8.0)),
        "mean_scale": float(rng.normal(0.0, 40.0)),
        "scale_difference": float(rng.normal(0.0, 40.0)),
        "squareness": float(rng.normal(0.0, 80.0)),
        "reversal_x": float(reversals[0]),
        "reversal_y": float(reversals[1]),
    }


def of(fit: PieceFit, name: str) -> tuple[float, float, float]:
    parameter = next(each for each in fit.parameters if each.name == name)
    assert parameter.value is not None
    assert parameter.least is not None
    assert parameter.most is not None
    return parameter.value, parameter.least, parameter.most


def test_without_noise_all_is_as_it_was_but_what_45_degrees_cannot_tell() -> None:
    truth = random_truth(np.random.default_rng(4)) | {"reversal_y": 5.0, "reversal_x": 5.0}
    found = fit_piece(measured(truth, 0.0, 1), LIMITS)
    assert not found.lack
    for name in PARAMETERS:
        assert of(found, name)[0] == pytest.approx(truth[name], abs=0.1), name  # µm, ppm, µrad
    assert set(found.left_out) == {"rhomb-120", "rhomb-hole-120"}


def test_intervals_hold_the_truth_as_often_as_they_say() -> None:
    """95 % of pieces: 93 to 97 of 100; squareness at least as often, since its interval has what it cannot know."""
    pieces = len(cases(500, 2000))
    inside = dict.fromkeys(PARAMETERS, 0)
    lacking = 0
    for seed in range(pieces):
        rng = np.random.default_rng(seed)
        truth, noise_um = random_truth(rng), float(rng.uniform(0.3, 2.0))
        found = fit_piece(measured(truth, noise_um, seed), LIMITS)
        lacking += bool(found.lack)
        for name in PARAMETERS:
            _, least, most = of(found, name)
            inside[name] += least <= truth[name] <= most
    shares = {name: number / pieces for name, number in inside.items()}
    assert all(0.93 <= share <= (1.0 if name == "squareness" else 0.97) for name, share in shares.items()), shares
    assert lacking <= 0.01 * pieces


def test_a_size_that_no_cause_explains_is_told() -> None:
    piece = measured(random_truth(np.random.default_rng(2)), 0.5, 3)
    far = piece["square-0"].place_um
    piece["square-0"] = Places(far + 4.0 * (far[:, :1] > far[:, :1].mean()) * [1.0, 0.0], piece["square-0"].z_mm)
    assert fit_piece(piece, LIMITS).lack == "sizes"


@pytest.mark.parametrize(
    ("names", "name", "why"),
    [
        (("octagon-0", "octagon-90", "square", "plate", "rhomb-90"), "edge", "piece-alike"),
        (("octagon-0", "octagon-90", "square", "plate", "slot", "disc", "rhomb-hole-90"), "squareness", "no-oblique"),
        (("octagon-0", "square-0", "plate-0", "slot", "disc"), "reversal_y", "no-faces"),
    ],
)
def test_what_a_part_of_a_piece_does_not_tell_gets_no_number(names: tuple[str, ...], name: str, why: str) -> None:
    whole = measured(random_truth(np.random.default_rng(2)), 0.5, 3)
    part = {each: place for each, place in whole.items() if each.startswith(names)}
    parameter = next(each for each in fit_piece(part, LIMITS).parameters if each.name == name)
    assert (parameter.value, parameter.why) == (None, why)


def test_a_face_on_which_a_cut_begins_has_a_step_and_is_left_out() -> None:
    truth = random_truth(np.random.default_rng(2)) | {"reversal_x": 9.0}
    piece = measured(truth, 0.3, 3)
    place = piece["octagon-0"].place_um.copy()
    middle = place.mean(axis=0)
    began = (place[:, 0] < middle[0]) & (place[:, 1] < middle[1])  # what is cut first comes from outside
    place[began, 0] -= 9.0
    piece["octagon-0"] = Places(place, piece["octagon-0"].z_mm)
    found = fit_piece(piece, LIMITS)
    assert (found.stepped, found.lack) == (("octagon-0",), "")
    assert of(found, "reversal_x")[1] <= 9.0 <= of(found, "reversal_x")[2]


def test_an_inside_corner_beside_the_sizes_tells_of_the_wire() -> None:
    """A fillet alone: no lag, and a reach that is the radius of it."""
    turn, reach_um = math.radians(30.0), 100.0
    angle = np.linspace(0.0, turn, 40)
    arc = reach_um * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    before = np.column_stack([np.linspace(-600.0, -1.0, 40), np.zeros(40)])
    behind = arc[-1] + np.linspace(1.0, 600.0, 40)[:, None] * [math.cos(turn), math.sin(turn)]
    rows = np.concatenate([before, arc, behind]) + np.random.default_rng(1).normal(0.0, 0.05, (120, 2))
    piece = measured(random_truth(np.random.default_rng(2)), 0.3, 3)
    piece["corner-150"] = Places(rows, np.full(len(rows), np.nan))
    found = fit_piece(piece, LIMITS)
    assert not found.left_out or "corner-150" not in found.left_out
    lag = next(each for each in found.parameters if each.name == "lag")
    reach = next(each for each in found.parameters if each.name == "reach")
    assert lag.is_determined or lag.why == "corner-alike"
    if reach.least is not None and reach.most is not None:
        assert reach.least - 1.0 <= reach_um <= reach.most + 1.0
    without = fit_piece(measured(random_truth(np.random.default_rng(2)), 0.3, 3), LIMITS)
    assert next(each.why for each in without.parameters if each.name == "lag") == "no-corner"


def test_a_piece_that_the_table_cut_tells_the_machine_that_cut_it(tmp_path: Path) -> None:
    machine = load_machine("dk7740")
    geometry = machine.table.geometry._replace(squareness_urad=120.0, scale_ppm=(150.0, 60.0))
    table = machine.table._replace(backlash_um=(9.0, 6.0), geometry=geometry)
    found = fit_piece(cut_and_measured(tmp_path, machine._replace(table=table)), piece_limits())
    truth = {"edge": 0.0, "mean_scale": 105.0, "scale_difference": 90.0, "squareness": 120.0}
    truth |= {"reversal_x": 9.8, "reversal_y": 6.1}  # as `drycut ballbar` has it on 10 mm
    assert not found.lack
    for name, value in truth.items():
        _, least, most = of(found, name)
        assert least <= value <= most, name


def test_too_few_sizes_are_refused() -> None:
    with pytest.raises(SettingsError, match="4 features"):
        fit_piece(measured(random_truth(np.random.default_rng(2)), 0.5, 3, "octagon"), LIMITS)


def test_a_probe_that_may_be_larger_moves_the_edge_alone() -> None:
    piece = measured(random_truth(np.random.default_rng(5)), 0.05, 6)
    known, unknown = fit_piece(piece, LIMITS), fit_piece(piece, Limits(2.0, LIMITS.features))
    assert of(unknown, "edge")[2] - of(unknown, "edge")[0] > 1.0
    assert of(known, "edge")[2] - of(known, "edge")[0] < 0.2


def test_a_machine_file_of_a_piece_loses_as_much_motion(tmp_path: Path) -> None:
    truth = random_truth(np.random.default_rng(8)) | {"reversal_x": 8.0, "reversal_y": 6.0}
    found = fit_piece(measured(truth, 0.05, 9), LIMITS)
    made = fitted_machine(load_machine("dk7740"), found, 5000.0, silent)
    assert made.off_um < 0.06
    assert set(made.keys) >= {"backlash_x_um", "backlash_y_um", "scale_x_ppm", "scale_y_ppm", "squareness_urad"}
    x, y = made.machine.table.geometry.scale_ppm
    assert 0.5 * (x + y) == pytest.approx(truth["mean_scale"], abs=8.0)  # ppm: 0.5 µm of 60 mm
    assert x - y == pytest.approx(truth["scale_difference"], abs=8.0)
    assert {"scale_x_ppm", "scale_y_ppm"} <= {key for key, _ in made.machine.measured}
