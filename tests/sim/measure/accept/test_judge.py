"""A measured piece: sizes by closed forms and known truths, the rule of ISO 14253-1, and what explains deviations."""

import math
from pathlib import Path

import numpy as np
import pytest
from depth import cases

from parser.findings.errors import SettingsError
from sim.make.piece import piece_limits_text
from sim.measure.accept.features import circle_size, width_size
from sim.measure.accept.judge import Judgement, Places, judged, read_piece, verdict_of
from sim.setup.limits import FeatureLimits, Limits, load_limits

WIDTH = '[[feature]]\nname = "a"\nkind = "width"\nnominal_mm = 1\n'
BETWEEN = "lower_um = -1\nupper_um = 1\n"


def faces(
    size_um: float, across_deg: float, noise_um: float, chance: np.random.Generator, places: int = 6
) -> np.ndarray:
    """Places (n, 2) on two faces somewhere in the plane."""
    angle = math.radians(across_deg)
    across, along = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    side = np.repeat([-0.5, 0.5], places) * size_um + noise_um * chance.normal(size=2 * places)
    return np.outer(side, across) + np.outer(np.tile(np.linspace(-3e3, 3e3, places), 2), along) + [4e4, -7e4]


def disc(radius_um: float, noise_um: float, chance: np.random.Generator, places: int = 16) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, places, endpoint=False)
    radius = radius_um + noise_um * chance.normal(size=places)
    return np.column_stack([radius * np.cos(angle) - 2e4, radius * np.sin(angle) + 5e4])


def test_sizes_are_exact_without_noise() -> None:
    chance = np.random.default_rng(1)
    assert circle_size(disc(10_003.0, 0.0, chance)).size_um == pytest.approx(20_006.0, abs=1e-6)
    for across in (0.0, 45.0, 90.0, 200.0):
        found = width_size(faces(9_994.0, across, 0.0, chance), math.radians(across + 1.0))  # a piece set down askew
        assert found is not None
        assert found.size_um == pytest.approx(9_994.0, abs=1e-6)
        assert found.form_um == pytest.approx(0.0, abs=1e-6)


def test_intervals_of_the_fit_hold_the_true_size() -> None:
    chance = np.random.default_rng(2)
    many, held = len(cases(400, 4000)), {"circle": 0, "width": 0}
    limits = Limits(
        0.0, (FeatureLimits("circle", "circle", 20.0, -9.0, 9.0), FeatureLimits("width", "width", 10.0, -9.0, 9.0))
    )
    for _ in range(many):
        piece = {"circle": disc(1e4, 1.0, chance), "width": faces(1e4, 0.0, 1.0, chance)}
        places = {name: type_of(place) for name, place in piece.items()}
        for each in judged(places, limits).judged:
            held[each.feature.name] += abs(each.deviation_um) <= each.uncertainty_um
    slack = 2.6 * math.sqrt(0.95 * 0.05 / many)
    assert all(share / many == pytest.approx(0.95, abs=0.02 + slack) for share in held.values()), held


def type_of(place: np.ndarray):

    return Places(place, np.full(len(place), math.nan))


@pytest.mark.parametrize(
    ("off", "by", "wanted"),
    [
        (0.0, 1.0, "pass"),
        (8.9, 1.0, "pass"),
        (9.1, 1.0, "to-check"),
        (10.9, 1.0, "to-check"),
        (11.1, 1.0, "fail"),
        (-5.9, 1.0, "fail"),
        (-4.5, 1.0, "to-check"),
        (0.0, 11.0, "to-check"),  # it was measured too badly for these limits
    ],
)
def test_a_size_near_its_limit_is_to_be_checked(off: float, by: float, wanted: str) -> None:
    assert verdict_of(off, by, -4.8, 10.0) == wanted


def piece(folder: Path, outer_um: float, inner_um: float, bow_um: float = 0.0, x_more_um: float = 0.0) -> Judgement:
    """The standard piece, all outer sizes off by so much and all inner ones, a bow between its heights."""
    chance = np.random.default_rng(3)
    rows = ["feature;x_mm;y_mm;z_mm"]
    sizes = [(f"octagon-{at}", 20e3, at, outer_um) for at in (0, 45, 90, 135)]
    sizes += [(f"square-{at}", 10e3, at, outer_um) for at in (0, 90)]
    sizes += [("plate-0", 60e3, 0, outer_um), ("plate-90", 14e3, 90, outer_um)]
    sizes += [(f"rhomb-{at}", 6e3, at, outer_um) for at in (90, 120)]
    sizes += [(f"slot-{at}", 1e3 * at, 0, inner_um) for at in (1, 2, 5)]
    sizes += [(f"rhomb-hole-{at}", 5e3, at, inner_um) for at in (90, 120)]
    for name, size, across, off in sizes:
        for z in (0, 20, 40):
            more = off + bow_um * (z == 20) + x_more_um * (across == 0)
            for x, y in faces(size + more, across, 0.2, chance) / 1e3:
                rows.append(f"{name};{x:.5f};{y:.5f};{z}".replace(".", ","))
    rows += [f"disc;{x:.5f};{y:.5f};0".replace(".", ",") for x, y in disc(1e4 + 0.5 * outer_um, 0.2, chance) / 1e3]
    (folder / "m.csv").write_text("\n".join(rows))
    (folder / "limits.toml").write_text(piece_limits_text())
    return judged(read_piece(folder / "m.csv"), load_limits(folder / "limits.toml"))


def test_an_offset_too_large_explains_outer_and_inner_sizes(tmp_path: Path) -> None:
    found = piece(tmp_path, 6.0, -6.0)
    assert found.verdict == "pass"
    assert len(found.judged) == 15 * 3 + 2
    (cause,) = found.causes
    assert cause.name == "offset"
    assert cause.value_um == pytest.approx(3.0, abs=0.1)
    assert piece(tmp_path, 14.0, -14.0).verdict == "fail"
    assert piece(tmp_path, 10.2, -3.0).verdict == "to-check"


def test_a_bow_and_an_axis_are_told(tmp_path: Path) -> None:
    names = {cause.name: cause.value_um for cause in piece(tmp_path, 0.0, 0.0, bow_um=5.0).causes}
    assert names["barrel"] == pytest.approx(5.0 * 6.0 / 9.0 - 5.0 * 3.0 / 9.0, abs=0.3)  # slots have it inside
    names = {cause.name: cause.value_um for cause in piece(tmp_path, 0.0, 0.0, x_more_um=6.0).causes}
    assert "x-less-y" in names
    assert not piece(tmp_path, 0.2, -0.2).causes


def test_what_is_missing_makes_a_piece_incomplete(tmp_path: Path) -> None:
    piece(tmp_path, 0.0, 0.0)
    text = (tmp_path / "m.csv").read_text().splitlines()
    rows = [row for row in text if not row.startswith("disc")] + ["else;1;2;3", "corner-150;1;2;3"]
    (tmp_path / "m.csv").write_text("\n".join(rows))
    found = judged(read_piece(tmp_path / "m.csv"), load_limits(tmp_path / "limits.toml"))
    assert (found.verdict, found.missing, found.without_limits) == ("incomplete", ("disc",), ("else",))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("uncertainty_um = 1\n", "limits-without-feature"),
        (
            'uncertainty_um = 1\n[[feature]]\nname = "a"\nkind = "width"\nnominal_mm = 1\nlower_um = 2\nupper_um = 1\n',
            "limits-crossed",
        ),
        ("x = 1\n", "unknown-key"),
    ],
)
def test_odd_limits_are_refused(tmp_path: Path, text: str, code: str) -> None:
    (tmp_path / "l.toml").write_text(text)
    with pytest.raises(SettingsError, match=r"l\.toml") as raised:
        load_limits(tmp_path / "l.toml")
    assert raised.value.message.code == code
