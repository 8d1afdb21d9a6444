"""``[program]`` and ``[[layer]]``: what is asked of a program is read, written again, and refused where it is odd."""

from pathlib import Path

import pytest

from parser.findings.errors import SettingsError
from parser.toolpath import Point
from sim.setup.making import LayerWish, Making, Writing
from sim.setup.scenario import load_scenario, scenario_sections
from sim.setup.toml.keys import toml_text

ALL = """title = "Made"
[drawing]
file = "part.dxf"
layer = "CUT"
tolerance_um = 7.0
gap_um = 20.0
[program]
file = "part.iso"
tolerance_um = 1.5
passes_mm = [0.18, 0.12, 0.1]
returning = "one-way"
side = "outside"
direction = "cw"
order = [3, 1, 2]
starts_mm = [[-5.0, 10.0], [4.0, 4.5]]
thread_layer = "HOLES"
lead = "arc"
lead_mm = 1.5
overcut_mm = 0.3
tab_mm = 3.0
corners = "round"
crlf = true
encoding = "gbk"
compensation = "kept"
decimals = 4
[[layer]]
name = "pins"
side = "inside"
rank = -1
passes_mm = [0.12]
"""
LEAST = '[drawing]\nfile = "part.dxf"\n[program]\n'


def scenario_of(folder: Path, text: str) -> Path:
    (folder / "scenario.toml").write_text(text, "utf-8")
    return folder


def test_all_that_is_asked_is_read(tmp_path: Path) -> None:
    read = load_scenario(scenario_of(tmp_path, ALL)).to_make
    assert read is not None
    assert (read.file, read.language) == (Path("part.iso"), "iso")
    assert read.writing == Writing(crlf=True, encoding="gbk", compensation="kept", decimals=4)
    assert read.making == Making(
        tolerance_um=1.5,
        part_tolerance_um=7.0,
        layer="CUT",
        gap_um=20.0,
        passes_um=(180.0, 120.0, 100.0),
        returning="one-way",
        side="outside",
        direction="cw",
        order=(3, 1, 2),
        starts_um=(Point(-5000.0, 10000.0), Point(4000.0, 4500.0)),
        thread_layer="HOLES",
        lead="arc",
        lead_um=1500.0,
        overcut_um=300.0,
        tab_um=3000.0,
        corners="round",
        layers=(LayerWish("pins", "inside", -1, (120.0,)),),
    )


@pytest.mark.parametrize("text", [ALL, LEAST, f'{LEAST}form = "aligned"\nend_code = "E"\npause_code = "A"\n'])
def test_what_was_read_is_written_so_that_it_is_read_alike(tmp_path: Path, text: str) -> None:
    read = load_scenario(scenario_of(tmp_path, text))
    written = toml_text(scenario_sections(read)).replace('"machine.toml"', '"dk7740"')
    again = load_scenario(scenario_of(tmp_path, written))
    assert again == read
    assert toml_text(scenario_sections(again)) == toml_text(scenario_sections(read))


def test_the_program_is_that_of_the_section(tmp_path: Path) -> None:
    assert load_scenario(scenario_of(tmp_path, LEAST)).program == tmp_path / "program.3b"
    assert load_scenario(scenario_of(tmp_path, f'{LEAST}file = "a.nc"\n')).program == tmp_path / "a.nc"
    assert load_scenario(scenario_of(tmp_path, 'program = "b.3b"\n')).to_make is None


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[program]\n", r"\[program\] needs \[drawing\]"),
        ('[[layer]]\nname = "A"\n', r"\[\[layer\]\] needs \[program\]"),
        (f'{LEAST}file = "part.txt"\n', "the suffix says no language"),
        (f"{LEAST}tolerance_um = 0.01\n", "tolerance_um is 0.01; it must lie between 0.1 and 1000"),
        (f"{LEAST}passes_mm = [0.1, 0.2]\n", "no larger than that of the pass before it"),
        (f"{LEAST}passes_mm = [0.1, 0.0]\n", "the only one"),
        (f"{LEAST}passes_mm = [0.1, 5e-24]\n", "must lie between 0.0001 and 10"),
        (f"{LEAST}passes_mm = 0.1\n", "passes_mm is a list"),
        (f"{LEAST}passes_mm = [{', '.join(['0.1'] * 21)}]\n", "the number of passes is 21"),
        (f"{LEAST}order = [1.5]\n", "order: entry 1 is a whole number; found 1.5"),
        (f"{LEAST}starts_mm = [[1.0]]\n", r"starts_mm: entry 1 is \[x, y\]"),
        (f'{LEAST}side = "left"\n', "side is one of nesting, inside, outside"),
        (f'{LEAST}compensation = "kept"\n', "compensation is for 4B and ISO, not 3b"),
        (f'{LEAST}file = "a.iso"\nform = "aligned"\n', "form is for 3B and 4B, not iso"),
        (f"{LEAST}passes = [0.1]\n", "did you mean passes_mm"),
        (f'{LEAST}[[layer]]\nname = "A"\nrank = 0.5\n', "rank is a whole number"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_key(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(SettingsError, match=told):
        load_scenario(scenario_of(tmp_path, text))
