"""Dialects of a shop's own at the command line: in files, in settings, and tested on samples."""

import html
import json
from pathlib import Path

import jsonschema
import pytest
from checking import drycut
from places import ROOT

OWN = 'extends = "fanuc"\n[g]\n145 = "switch"\n'
PROGRAM = "O0001\nG92 X0 Y0\nG90 G01 X5000 Y0\n{}\nX5000 Y5000\nX0 Y5000\nX0 Y0\nM02\n"


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    (tmp_path / ".git").mkdir()
    (tmp_path / "samples").mkdir()
    for name, words in (("a.nc", "G145"), ("b.nc", "G146 G145")):
        (tmp_path / "samples" / name).write_text(PROGRAM.format(words), "ascii")
    (tmp_path / "makino.toml").write_text(OWN, "ascii")
    return tmp_path


def test_samples_tell_what_a_dialect_does_not_read(shop: Path) -> None:
    code, out, _ = drycut("dialect", "test", "samples", "--dialect", "makino.toml", cwd=shop)
    assert code == 1
    assert [line.replace("\\", "/") for line in out.splitlines()] == [
        "samples/b.nc:4:1: ISO203: unknown G or M word: G146",
        "G146: 1 ×, in files: 1",
        "2 files: 1 read whole; dialect: makino",
    ]
    (shop / "makino.toml").write_text(OWN + '146 = "switch"\n', "ascii")
    assert drycut("dialect", "test", "samples", "--dialect", "makino.toml", cwd=shop)[0] == 0
    assert "G145" in drycut("dialect", "test", "samples", "--dialect", "fanuc", cwd=shop)[1]
    one = drycut("dialect", "test", "samples/a.nc", "--dialect", "makino.toml", cwd=shop)[1]
    assert one == "1 file: 1 read whole; dialect: makino\n"


IN_SETTINGS = f"[dialects.makino]\n{OWN.replace('[g]', '[dialects.makino.g]')}"
CHECKED = jsonschema.Draft202012Validator(json.loads((ROOT / "docs" / "check.schema.json").read_text("utf-8")))


@pytest.mark.parametrize(
    "settings",
    [IN_SETTINGS, '[dialects]\nmakino = "makino.toml"\n'],
)
def test_settings_define_dialects_and_choose_one(shop: Path, settings: str) -> None:
    (shop / "drycut.toml").write_text(f'dialect = "makino"\n{settings}', "ascii")
    code, out, _ = drycut("check", "samples", "--format", "json", cwd=shop)
    found = json.loads(out)
    CHECKED.validate(found)
    assert [file["dialect"] for file in found["files"]] == ["makino", "makino"]
    assert (code, list(found["totals"]["codes"])) == (1, ["ISO203"])
    (shop / "drycut.toml").write_text(settings, "ascii")
    assert drycut("check", "samples/a.nc", "--dialect", "makino", cwd=shop)[0] == 0
    code, _, err = drycut("check", "samples/a.nc", "--dialect", "ona", cwd=shop)
    assert (code, "makino, fast-wire" in err) == (2, True)


def test_what_is_wrong_in_the_settings_is_named_with_line_and_column(shop: Path) -> None:
    (shop / "drycut.toml").write_text('[dialects.makino.g]\n145 = "swich"\n', "ascii")
    code, _, err = drycut("check", "samples", cwd=shop)
    assert (code, "drycut.toml:2:1: g.145 is one of" in err) == (2, True)
    (shop / "drycut.toml").unlink()
    (shop / "pyproject.toml").write_text('[tool.drycut.dialects.makino.g]\n145 = "swich"\n', "ascii")
    assert "pyproject.toml:2:1: g.145 is one of" in drycut("check", "samples", cwd=shop)[2]
    (shop / "pyproject.toml").write_text("[tool.drycut.dialects]\nmakino = 3\n", "ascii")
    assert "pyproject.toml:2:1: the dialect makino" in drycut("check", "samples", cwd=shop)[2]


@pytest.mark.parametrize("command", ["run", "decode", "draw"])
def test_commands_that_read_programs_read_with_a_file(shop: Path, command: str, tmp_path: Path) -> None:
    more = ["-o", "out.png"] if command == "draw" else []
    code, _, err = drycut(command, "samples/a.nc", "--dialect", "makino.toml", *more, cwd=shop)
    assert (code, err.count("error")) == (0, 0)
    (shop / "makino.toml").write_text("extends = 1\n", "ascii")
    code, _, err = drycut(command, "samples/a.nc", "--dialect", "makino.toml", *more, cwd=shop)
    assert (code, "makino.toml:1:1: extends" in err) == (2, True)


def test_a_scenario_names_the_file_of_its_dialect_and_its_report_has_it(shop: Path) -> None:
    folder = shop / "part"
    folder.mkdir()
    (folder / "program.nc").write_text(PROGRAM.format("G145"), "ascii")
    (folder / "scenario.toml").write_text('program = "program.nc"\ndialect = "makino.toml"\n', "ascii")
    (folder / "makino.toml").write_text(OWN, "ascii")
    first = drycut("run", "part", "-o", "out", cwd=shop)
    page = html.unescape((shop / "out" / "report.html").read_text("utf-8"))
    assert 'dialect = "makino.toml"' in page
    assert '[g]\n"145" = "switch"' in page
    assert json.loads((shop / "out" / "report.json").read_text("utf-8"))["program"]["dialect"] == "makino"
    assert first[0] in (0, 1)
    (folder / "scenario.toml").write_text('program = "program.nc"\ndialect = "ona.toml"\n', "ascii")
    assert drycut("run", "part", cwd=shop)[0] == 2


def test_no_program_is_written_in_a_dialect_of_ones_own(shop: Path) -> None:
    code, _, err = drycut("convert", "samples/a.nc", "-o", "x.iso", "--dialect", "makino.toml", cwd=shop)
    assert (code, "is not one of fast-wire" in err) == (2, True)
