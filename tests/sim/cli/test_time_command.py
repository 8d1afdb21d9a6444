"""``drycut time`` as a user meets it: tables in both languages, JSON of its schema, rows for a spreadsheet, bad use."""

import csv
import json
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

SCHEMA = Draft202012Validator(json.loads((ROOT / "docs" / "time.schema.json").read_text(encoding="utf-8")))
SQUARE = "B60000B0B60000GXL1\nB0B60000B60000GYL2\nB60000B0B60000GXL3\nB0B60000B60000GYL4\nDD\n"
LOG = "program,length_mm,height_mm,passes,minutes\n,100,40,1,55\n,100,40,1,59\n,200,40,1,107\n,100,40,1,60.5\n"
LOG += ",50,40,1,28\n"


@pytest.fixture
def part(tmp_path: Path) -> Path:
    machine = (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")
    (tmp_path / "m.toml").write_text(machine.replace("area_rate_mm2_min = 105.0", "area_rate_mm2_min = 80.0"), "utf-8")
    (tmp_path / "cuts.csv").write_text(LOG)
    path = tmp_path / "part.3b"
    path.write_text(SQUARE)
    return path


def test_without_a_log_the_time_says_that_no_cut_is_known(part: Path) -> None:
    said = run_inside("time", part).stdout.decode()
    assert "1 h 31 min (± 40 %, no cut of this machine known)" in said
    said = run_inside("time", part, "--lang", "zh").stdout.decode()
    assert "1 小时 31 分（± 40 %，没有这台机床的切割记录）" in said


def test_json_has_the_worked_example(part: Path) -> None:
    folder = part.parent
    done = run_inside("time", part, "--log", folder / "cuts.csv", "--machine", folder / "m.toml", "--json")
    assert (done.returncode, done.stderr) == (0, b"")
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    assert found["from_cuts"] == 5
    assert found["minutes"]["middle"] == pytest.approx(136.1, abs=0.1)
    assert found["minutes"]["level"] == 0.9
    assert sum(term["minutes"] for term in found["terms"]) == pytest.approx(found["minutes"]["middle"], abs=1e-5)
    assert found["programs"][0]["minutes"] == found["minutes"]
    assert (found["log"]["cuts"], found["log"]["heights_mm"]) == (5, [40.0, 40.0])


def test_many_programs_are_written_as_rows_with_their_costs(part: Path) -> None:
    folder = part.parent
    (folder / "shop.toml").write_text('[rates]\ncurrency = "=1+1"\nper_hour = 35\nset_up = 10\n', "utf-8")
    (folder / "-2.3b").write_text(SQUARE)
    output = folder / "times.csv"
    options = ("--log", folder / "cuts.csv", "--shop", folder / "shop.toml", "-o", output, "--json")
    done = run_inside("time", part, folder / "-2.3b", *options)
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    rows = [*csv.DictReader(output.read_text("utf-8").splitlines())]
    assert [row["middle_min"] for row in rows] == [f"{each['minutes']['middle']:.2f}" for each in found["programs"]]
    assert all(row["currency"] == "'=1+1" for row in rows)  # no formula of a spreadsheet
    assert found["cost"]["total"] == round(sum(item["amount"] for item in found["cost"]["items"]), 2)
    assert rows[0]["cost"] == f"{found['programs'][0]['cost']['total']:.2f}"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_tables_fit_a_terminal_of_80_columns(part: Path, language: str) -> None:
    folder = part.parent
    (folder / "shop.toml").write_text('[time]\nbreaks_per_h = 0.2\n[rates]\ncurrency = "元"\nper_hour = 35\n', "utf-8")
    options = ("--log", folder / "cuts.csv", "--shop", folder / "shop.toml", "--thickness", "90mm", "--lang", language)
    done = run_inside("time", part, *options)
    assert done.returncode == 0
    assert b"90" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("part.3b", "--log", "none.csv"), "none.csv"),
        (("part.3b", "--log", "part.3b"), "no column minutes"),
        (("part.3b", "-o", "x.txt"), "written as .csv"),
        (("none.3b",), "none.3b"),
        ((), "Missing"),
    ],
)
def test_bad_use_is_refused(part: Path, arguments: tuple[str, ...], said: str) -> None:
    paths = [part.parent / each if each[0] != "-" else each for each in arguments]
    done = run_inside("time", *paths)
    assert done.returncode == 2
    assert said in done.stderr.decode()
    assert b"Traceback" not in done.stderr
