"""The spark gap of a measured piece: exact without noise, within its interval with it, refused where nothing tells."""

from pathlib import Path

import numpy as np
import pytest

from parser.findings.errors import SettingsError
from sim.measure.accept.gap import Cutting, measured_gap, technology_of
from sim.measure.accept.judge import Judged, Judgement
from sim.setup.limits import FeatureLimits
from sim.setup.technology import GAP_WITHIN_UM, Choice, load_technology, passes_at, technology_sections
from sim.setup.toml.keys import toml_text

SIZES_MM = {
    "octagon-0": 20.0,
    "octagon-90": 20.0,
    "square-0": 10.0,
    "disc": 20.0,
    "slot-1": 1.0,
    "slot-2": 2.0,
    "slot-5": 5.0,
}
CUT = Cutting(offset_um=105.0, wire_um=180.0)


def piece(gap_um: float, scale: float = 0.0, noise_um: float = 0.0, seed: int = 0, of: str = "") -> Judgement:
    """Sizes by their own arithmetic: outer ones lose the kerf's reach on both sides, and slots gain it."""
    rng = np.random.default_rng(seed)
    found = []
    for name, nominal in SIZES_MM.items():
        inside = name.startswith("slot")
        if of and not name.startswith(of):
            continue
        edge_um = CUT.offset_um - (CUT.wire_um / 2.0 + gap_um)
        size = (1000.0 * nominal + (-2.0 if inside else 2.0) * edge_um) * (1.0 + scale) + rng.normal(0.0, noise_um)
        off = size - 1000.0 * nominal
        limits = FeatureLimits(name, "width", nominal, -10.0, 10.0, inside=inside)
        found.append(Judged(limits, None, "size", size, 1000.0 * nominal, off, 1.0, -10.0, 10.0, "pass"))
    return Judgement(tuple(found), (), (), ())


@pytest.mark.parametrize("gap_um", [-5.0, 8.0, 12.0, 43.0])
@pytest.mark.parametrize("scale", [0.0, 30e-6])
def test_the_gap_is_exact_whatever_the_scale(gap_um: float, scale: float) -> None:
    found = measured_gap(piece(gap_um, scale), CUT, 0.0)
    assert found.gap_um == pytest.approx(gap_um, abs=0.01)
    assert found.sizes == len(SIZES_MM)


def test_the_interval_holds_the_gap_as_often_as_it_says() -> None:
    """95 % of 1,000 pieces measured with noise alone; the instrument's own uncertainty comes on top."""
    rng = np.random.default_rng(5)
    inside = 0
    for seed in range(1000):
        gap, noise = float(rng.uniform(5.0, 50.0)), float(rng.uniform(0.2, 3.0))
        found = measured_gap(piece(gap, float(rng.normal(0.0, 20e-6)), noise, seed), CUT, 0.0)
        inside += abs(found.gap_um - gap) <= found.by_um
    assert 0.93 <= inside / 1000.0 <= 0.97


def test_an_instrument_that_is_off_widens_the_interval() -> None:
    sure, unsure = (measured_gap(piece(12.0, noise_um=0.5, seed=3), CUT, of) for of in (0.0, 4.0))
    assert unsure.gap_um == sure.gap_um
    assert unsure.by_um == pytest.approx(np.hypot(sure.by_um, 2.0))


@pytest.mark.parametrize("of", ["octagon", "slot-1", "disc"])
def test_a_piece_that_cannot_tell_the_gap_from_the_scale_is_refused(of: str) -> None:
    with pytest.raises(SettingsError, match="slots or holes"):
        measured_gap(piece(12.0, of=of), CUT, 0.0)


def test_the_technology_file_holds_the_gap_with_its_interval_and_source(tmp_path: Path) -> None:
    found = measured_gap(piece(12.0, noise_um=0.5, seed=1), CUT, 1.0)
    choice = Choice("Cr12", 180.0, 40.0)
    path = tmp_path / "cr12.toml"
    path.write_text(toml_text(technology_sections(technology_of(found, choice, 2, "piece.csv"))), "utf-8")
    (of_pass,) = passes_at(load_technology(path), choice)
    assert of_pass.number == 2
    assert of_pass.gap_um.value == pytest.approx(found.gap_um, abs=0.01)
    assert of_pass.gap_um.most - of_pass.gap_um.value == pytest.approx(
        np.hypot(found.by_um, GAP_WITHIN_UM["measured"]), abs=0.01
    )
    assert (of_pass.gap_um.grade, of_pass.gap_um.source) == ("measured", "piece.csv")
