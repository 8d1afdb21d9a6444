"""A check holds the offsets of a program against the kerf of their pass, as a technology has it."""

from pathlib import Path

import pytest
from command import run_inside

from parser.findings.errors import SettingsError
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings
from sim.setup.technology import Cut, Technology

SQUARE = """%
N10 G60 G90 G92 X5.000 Y-3.000
N20 G38
N30 G41 D1
N40 G01 X5.000 Y0.000
N50 G01 X0.000 Y0.000
N60 G01 X0.000 Y10.000
N70 G01 X10.000 Y10.000
N80 G01 X10.000 Y0.000
N90 G01 X5.000 Y0.000
N100 G40
N110 G01 X5.000 Y-3.000
N120 M02
%
"""
ROW = Cut("Cr12", 180.0, 40.0, 1, 12.0, 2.0, 2.0, None, None, None, None, None, None, None, None)
KNOWS = Technology("test", "measured", "here", (ROW, ROW._replace(number=2, gap_um=8.0)))
TWO = KNOWS._replace(cuts=(*KNOWS.cuts, ROW._replace(height_mm=80.0), ROW._replace(material="Al")))


def codes(offset_um: float, **more: object) -> list[str]:
    settings = CheckSettings(dialect="robofil", registers=(("D1", offset_um),), **{"technology": KNOWS, **more})  # type: ignore[arg-type]
    return [finding.code for finding in check_file(Job("a.iso", SQUARE.encode(), settings)).findings]


@pytest.mark.parametrize("offset_um", [100.0, 102.0, 104.0])
def test_an_offset_within_the_interval_of_its_pass_is_silent(offset_um: float) -> None:
    """Half of 180 µm and 12 ± 2."""
    assert codes(offset_um) == []


@pytest.mark.parametrize("offset_um", [99.9, 104.1, 150.0])
def test_an_offset_beside_it_is_told_at_its_pass(offset_um: float) -> None:
    assert codes(offset_um) == ["3B607"]
    assert codes(offset_um, technology=None) == []


def test_of_several_heights_and_materials_one_is_named() -> None:
    for more, why in (({}, "several"), ({"material": "Cr12"}, "several heights"), ({"material": "Fe"}, "knows")):
        with pytest.raises(SettingsError, match=why):
            _ = CheckSettings(technology=TWO, **more).demands  # type: ignore[arg-type]
    kerfs = CheckSettings(technology=TWO, material="cr12", thickness_mm=40.0).demands.kerfs
    assert kerfs is not None
    assert [kerfs.reach(number).um for number in (1, 2, 3)] == [102.0, 98.0, 98.0]


def test_a_gap_beside_a_technology_and_a_material_without_one_are_refused() -> None:
    for settings in (CheckSettings(technology=KNOWS, spark_gap_um=10.0), CheckSettings(material="Cr12")):
        with pytest.raises(SettingsError, match="technology"):
            _ = settings.demands


def test_options_and_a_settings_file_name_it(tmp_path: Path) -> None:
    (tmp_path / "a.iso").write_text(SQUARE)
    (tmp_path / "t.toml").write_text(
        '[technology]\nname = "Cr12"\n[[cut]]\nmaterial = "Cr12"\nwire_mm = 0.18\nheight_mm = 40\ngap_um = 12\n'
    )
    read = ("--dialect", "robofil", "--offset", "D1=0.13mm")
    named = run_inside("check", tmp_path / "a.iso", *read, "--technology", tmp_path / "t.toml")
    (tmp_path / "drycut.toml").write_text('technology = "t.toml"\nmaterial = "Cr12"\nthickness_mm = 40\n')
    found = run_inside("check", tmp_path / "a.iso", *read, cwd=tmp_path)
    for done in (named, found):
        assert (done.returncode, done.stdout.decode().count("3B607")) == (0, 1)
    refused = run_inside("check", tmp_path / "a.iso", *read, "--gap", "10um", cwd=tmp_path)
    assert (refused.returncode, b"--gap" in refused.stderr) == (2, True)
