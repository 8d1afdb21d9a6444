"""Technology files: what they say comes back, between heights and beyond them no surer than it is known."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from runs import plain_scenario

from parser.findings.errors import SettingsError
from sim.setup.key_tables import technology_schema
from sim.setup.scenario import load_scenario, with_values
from sim.setup.technology import (
    GAP_WITHIN_UM,
    LAG_WITHIN,
    RATE_WITHIN,
    Choice,
    Cut,
    Technology,
    load_technology,
    passes_at,
    technology_sections,
)
from sim.setup.toml.keys import toml_text

IN_FULL = """
[technology]
name = "Cr12, molybdenum 0.18"
name_zh = "Cr12，钼丝 0.18"
grade = "measured"
source = "logs of machine 3"

[[cut]]
material = "Cr12"
wire_mm = 0.18
height_mm = 40
gap_um = 12
gap_within_um = 1.5
area_rate_mm2_min = 80
rate_within = 0.1
lag_um = 25
lag_within_um = 4
offset_mm = 0.13
ra_um = 2.5

[[cut]]
material = "Cr12"
wire_mm = 0.18
height_mm = 40
pass = 2
gap_um = 8
feed_mm_min = 4
grade = "maker"
source = "table 7"
"""
OF_CR12 = Choice("cr12", 180.0, 40.0)
ROW = Cut("Cr12", 180.0, 40.0, 1, 12.0, None, 2.0, None, None, 25.0, None, None, None, None, None)


def written(folder: Path, text: str) -> Path:
    path = folder / "technology.toml"
    path.write_text(text, "utf-8")
    return path


def of_heights(**heights: tuple[float, float, float]) -> Technology:
    """Cuts of one pass at heights, each with gap, feed and lag."""
    cuts = tuple(
        ROW._replace(height_mm=float(name[1:]), gap_um=gap, feed_mm_min=feed, lag_um=lag)
        for name, (gap, feed, lag) in heights.items()
    )
    return Technology("test", "measured", "here", cuts)


def test_at_a_height_that_is_known_the_figures_are_those_of_the_file(tmp_path: Path) -> None:
    technology = load_technology(written(tmp_path, IN_FULL))
    first, second = passes_at(technology, OF_CR12)
    assert first.gap_um == (12.0, 10.5, 13.5, "measured", "logs of machine 3")
    assert first.feed_mm_min is not None
    assert first.feed_mm_min[:3] == pytest.approx((80.0 / 40.0, 2.0 / 1.1, 2.0 * 1.1))
    assert first.lag_um == (25.0, 21.0, 29.0, "measured", "logs of machine 3")
    assert first.offset_um is not None
    assert first.offset_um.value == pytest.approx(130.0)
    assert second.number == 2
    assert second.gap_um == (8.0, 8.0 - GAP_WITHIN_UM["maker"], 8.0 + GAP_WITHIN_UM["maker"], "maker", "table 7")
    assert second.lag_um is None
    assert second.roughness_um is None


def test_a_file_that_is_written_says_the_same(tmp_path: Path) -> None:
    technology = load_technology(written(tmp_path, IN_FULL))
    text = toml_text(technology_sections(technology))
    assert load_technology(written(tmp_path, text)) == technology
    validator = Draft202012Validator(technology_schema())
    for each in (text, IN_FULL):
        assert not [*validator.iter_errors(tomllib.loads(each))]


@pytest.mark.parametrize("seed", range(20))
def test_between_two_heights_figures_rise_or_fall_as_these_do_and_never_farther(seed: int) -> None:
    """Straight in the logarithms: of a power law of the height it is that law."""
    rng = np.random.default_rng(seed)
    low, high = np.sort(rng.uniform(5.0, 200.0, 2))
    powers, at_one = rng.uniform(-2.0, 2.0, 3), rng.uniform(1.0, 30.0, 3)
    rows = {f"h{height!r}": tuple((at_one * height**powers).tolist()) for height in (float(low), float(high))}
    height = float(rng.uniform(low, high))
    (found,) = passes_at(of_heights(**rows), OF_CR12._replace(height_mm=height))
    figures = (found.gap_um, found.feed_mm_min, found.lag_um)
    law = at_one * height**powers
    assert [figure.value for figure in figures if figure is not None] == pytest.approx(law.tolist(), rel=1e-9)


def test_the_interval_opens_between_heights_and_far_more_beyond_them() -> None:
    """What the sheets measured: ± 15 % at most between heights of 1 to 3, 46 % at half the least one."""
    technology = of_heights(h20=(10.0, 4.0, 10.0), h60=(14.0, 2.0, 30.0))
    wide = {}
    for height in (20.0, math.sqrt(20.0 * 60.0), 60.0, 10.0, 120.0):
        (found,) = passes_at(technology, OF_CR12._replace(height_mm=height))
        assert found.feed_mm_min is not None
        wide[height] = found.feed_mm_min.most / found.feed_mm_min.value - 1.0
    middle = math.sqrt(20.0 * 60.0)
    assert [wide[20.0], wide[60.0]] == pytest.approx([RATE_WITHIN["measured"]] * 2)
    assert wide[middle] == pytest.approx(math.hypot(RATE_WITHIN["measured"], 0.15))
    assert [wide[10.0], wide[120.0]] == pytest.approx([math.hypot(RATE_WITHIN["measured"], 0.46)] * 2)
    (beyond,) = passes_at(technology, OF_CR12._replace(height_mm=120.0))
    assert beyond.gap_um.value == pytest.approx(14.0)
    assert beyond.gap_um.most - 14.0 == pytest.approx(math.hypot(GAP_WITHIN_UM["measured"], 0.09 * 14.0))
    assert beyond.lag_um is not None
    assert beyond.lag_um.most - 30.0 == pytest.approx(math.hypot(30.0 * LAG_WITHIN["measured"], 30.0))


def test_beyond_the_heights_the_area_rate_stays_and_no_lag_is_below_none() -> None:
    """80 mm²/min at 40 mm are 2 mm/min; through 80 mm they are 1."""
    rows = of_heights(h40=(12.0, 2.0, 20.0))
    at_80, at_20 = (passes_at(rows, OF_CR12._replace(height_mm=height))[0] for height in (80.0, 20.0))
    feeds = [of_pass.feed_mm_min.value for of_pass in (at_80, at_20) if of_pass.feed_mm_min is not None]
    assert feeds == pytest.approx([1.0, 4.0])
    assert at_80.lag_um is not None
    assert (at_80.lag_um.value, at_80.lag_um.least) == (20.0, 0.0)


def test_beside_a_row_of_a_table_with_a_hump_the_feed_lies_within_its_interval() -> None:
    """Area rate over height of a maker's table as the trade reports it: 52, 87, 58 mm²/min at 12.7, 38, 152 mm."""
    heights, rates = (12.7, 38.0, 152.0), (52.0, 87.0, 58.0)
    rows = {f"h{height}": (45.0, rate / height, 10.0) for height, rate in zip(heights, rates, strict=True)}
    for height, rate in zip(heights, rates, strict=True):
        (found,) = passes_at(of_heights(**rows), OF_CR12._replace(height_mm=height * 1.05))
        assert found.feed_mm_min is not None
        feed = rate / (height * 1.05)
        assert found.feed_mm_min.least < feed < found.feed_mm_min.most


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (('material = "Cr12"', 'material = ""'), "material"),
        (("gap_um = 12\n", ""), "gap_um"),
        (("gap_um = 12\n", "gap_um = -200\n"), "gap_um"),
        (("area_rate_mm2_min = 80", "area_rate_mm2_min = 80\nfeed_mm_min = 2"), "feed_mm_min"),
        (("pass = 2", "pass = 1"), "same material"),
        (("[[cut]]", "[[cuts]]"), "cuts"),
        (('grade = "maker"', 'grade = "guessed"'), "grade"),
        (("pass = 2", "pass = 2.5"), "pass"),
    ],
)
def test_what_is_wrong_in_a_file_is_named_with_its_place(tmp_path: Path, change: tuple[str, str], why: str) -> None:
    with pytest.raises(SettingsError, match=why):
        load_technology(written(tmp_path, IN_FULL.replace(*change)))


def test_a_material_or_a_wire_that_is_not_known_is_refused_with_what_is(tmp_path: Path) -> None:
    technology = load_technology(written(tmp_path, IN_FULL))
    scenario = replace(plain_scenario(), technology=technology)
    assert (scenario.cut_material, scenario.wire.spark_gap_um, scenario.wire_lag_um) == ("Cr12", 12.0, 25.0)
    assert [scenario.reach_um(number) for number in (1, 2, 3)] == [102.0, 98.0, 98.0]
    assert [scenario.lag_um(number) for number in (1, 2)] == [25.0, 25.0]
    with pytest.raises(SettingsError, match="Cr12"):
        replace(scenario, material="copper")
    with pytest.raises(SettingsError, match=r"0\.18"):
        replace(scenario, wire=replace(scenario.wire, diameter_um=250.0))
    with pytest.raises(SettingsError, match="needs a technology"):
        replace(plain_scenario(), material="Cr12")
    alike = technology._replace(cuts=(*technology.cuts, ROW._replace(material="CR12", height_mm=60.0)))
    assert alike.materials == ("Cr12",)
    several = technology._replace(cuts=(*technology.cuts, ROW._replace(material="copper")))
    with pytest.raises(SettingsError, match="Cr12, copper"):
        replace(plain_scenario(), technology=several)
    with pytest.raises(SettingsError, match="--gap"):
        with_values(scenario, {"spark_gap_mm": 15.0})


def test_a_scenario_names_a_technology_beside_it_and_gives_no_gap_of_its_own(tmp_path: Path) -> None:
    written(tmp_path, IN_FULL)
    (tmp_path / "program.3b").write_text("B1000B0B1000GXL1\nDD\n")
    file, text = tmp_path / "scenario.toml", 'technology = "technology.toml"\n[work]\nmaterial = "Cr12"\n'
    file.write_text(text)
    scenario = load_scenario(tmp_path)
    assert scenario.technology is not None
    assert scenario.reach_um(2) == 98.0
    file.write_text(text + "[wire]\nspark_gap_mm = 0.01\n")
    with pytest.raises(SettingsError, match="spark_gap_mm"):
        load_scenario(tmp_path)
