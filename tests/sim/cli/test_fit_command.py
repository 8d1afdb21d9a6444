"""``drycut fit`` as a user meets it: a machine is found again from its own circle; JSON of its schema; bad use."""

import json
import re
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

from sim.setup.machine.machine import load_machine

SCHEMA = Draft202012Validator(json.loads((ROOT / "docs" / "fit.schema.json").read_text(encoding="utf-8")))
TEST = ("--radius", "3mm", "--feed", "30mm/min")


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A machine with more backlash than the shipped one."""
    text = (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")
    text = text.replace("backlash_x_um = 2.0", "backlash_x_um = 7.0").replace(
        "backlash_y_um = 2.0", "backlash_y_um = 0.5"
    )
    path = tmp_path / "true.toml"
    path.write_text(text, "utf-8")
    return path


def circularity_um(machine: Path) -> float:
    return float(json.loads(run_inside("ballbar", *TEST, "--machine", machine, "--json").stdout)["circularity_um"])


def test_a_fitted_machine_file_runs_the_circle_that_was_measured(machine: Path) -> None:
    trace, mine = machine.parent / "trace.csv", machine.parent / "mine.toml"
    run_inside("ballbar", *TEST, "--machine", machine, "--trace", trace)
    done = run_inside("fit", trace, "--machine", "dk7740", "--feed", "30mm/min", "-o", mine, "--json")
    assert done.returncode == 0
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    assert found["directions"] == ["ccw", "cw"]
    fitted = load_machine(str(mine))
    assert fitted.table.backlash_um == pytest.approx((7.0, 0.5), abs=0.1)
    assert not {"backlash_x_um", "backlash_y_um"} & set(fitted.assumed)
    assert circularity_um(mine) == pytest.approx(circularity_um(machine), abs=0.3)
    assert re.match(r"# reversal_x: \d", mine.read_text("utf-8"))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_what_is_not_told_has_no_number(machine: Path, language: str) -> None:
    trace = machine.parent / "trace.csv"
    run_inside("ballbar", *TEST, "--machine", machine, "--trace", trace)
    found = json.loads(run_inside("fit", trace, "--json", "--lang", language).stdout)
    SCHEMA.validate(found)
    untold = [each for each in found["parameters"] if not each["determined"]]
    assert {each["name"] for each in untold} == {
        "delay_difference_ms",
        "backlash_x_um",
        "backlash_y_um",
        "mean_scale_ppm",
    }
    assert all(each["value"] is None and each["why"] for each in untold)
    said = run_inside("fit", trace, "--lang", language).stdout.decode()
    assert "--machine" in said


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("a,b\n1,2\n", (), "no column x_mm"),
        ("x_mm,y_mm\n1,2\n", (), "the circle has 1 places"),
        ("x_mm,y_mm\n1,x\n", (), "c.csv:2: y_mm"),
        ("feature,x_mm,y_mm\na,1,2\n", (), "feature"),
        ("x_mm,y_mm\n1,2\n", ("-o", "x.txt"), ".toml"),
        ("x_mm,y_mm\n1,2\n", ("--feed", "3"), "speed"),
    ],
)
def test_bad_use_is_refused(tmp_path: Path, text: str, options: tuple[str, ...], said: str) -> None:
    (tmp_path / "c.csv").write_text(text)
    done = run_inside("fit", tmp_path / "c.csv", *options)
    assert done.returncode == 2
    assert said in done.stderr.decode()
    assert b"Traceback" not in done.stderr
