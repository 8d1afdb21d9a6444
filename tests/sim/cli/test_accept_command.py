"""``drycut accept`` as a user meets it: its piece can be made, its document keeps to its schema, bad use is refused."""

import json
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

from sim.setup.technology import Choice, load_technology, passes_at

SCHEMA = Draft202012Validator(json.loads((ROOT / "docs" / "accept.schema.json").read_text(encoding="utf-8")))
LIMITS = (
    'uncertainty_um = 1\n[[feature]]\nname = "flat"\nkind = "width"\nnominal_mm = 10\nlower_um = -5\nupper_um = 5\n'
)


def measured(folder: Path, size_mm: float) -> tuple[str, ...]:
    rows = [f"flat,{side * size_mm / 2},{y},0" for side in (-1, 1) for y in (-2, 0, 2)]
    (folder / "m.csv").write_text("\n".join(["feature,x_mm,y_mm,z_mm", *rows]))
    (folder / "l.toml").write_text(LIMITS)
    return ("accept", str(folder / "m.csv"), "--limits", str(folder / "l.toml"))


@pytest.mark.parametrize(
    ("size_mm", "verdict", "code"), [(10.001, "pass", 0), (10.0045, "to-check", 0), (9.99, "fail", 1)]
)
def test_the_exit_code_is_that_of_the_verdict(tmp_path: Path, size_mm: float, verdict: str, code: int) -> None:
    done = run_inside(*measured(tmp_path, size_mm), "--json")
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    assert (found["verdict"], done.returncode) == (verdict, code)
    assert found["features"][0]["deviation_um"] == pytest.approx(1e3 * (size_mm - 10.0), abs=1e-6)
    assert run_inside(*measured(tmp_path, size_mm), "--lang", "zh").returncode == code


def test_the_piece_is_made_by_program(tmp_path: Path) -> None:
    done = run_inside("accept", "--piece", tmp_path / "piece")
    assert done.returncode == 0
    done = run_inside("program", tmp_path / "piece" / "piece.dxf", "-o", tmp_path / "piece.3b", "--json")
    found = json.loads(done.stdout)
    assert found["proof"]["verdict"] == "pass"
    assert len(found["figures"]) == 9
    assert run_inside("accept", "--piece", tmp_path / "piece").returncode == 2  # it stands there


def test_a_measured_gap_goes_into_a_technology_file_that_a_run_takes(tmp_path: Path) -> None:
    """A flat of 10 mm, slots of 2 and 5, cut at 0.1 mm by a wire whose gap is 12 µm: 2 µm are missing on each side."""
    sizes = {"flat": 9.996, "slot2": 2.004, "slot5": 5.004}
    rows = [f"{name},{side * size / 2},{y},0" for name, size in sizes.items() for side in (-1, 1) for y in (-2, 0, 2)]
    (tmp_path / "m.csv").write_text("\n".join(["feature,x_mm,y_mm,z_mm", *rows]))
    limits = [LIMITS.replace("uncertainty_um = 1\n", ""), ""]
    for name, nominal in (("slot2", 2), ("slot5", 5)):
        limits[1] += limits[0].replace('"flat"', f'"{name}"').replace("= 10", f"= {nominal}") + "inside = true\n"
    (tmp_path / "l.toml").write_text("uncertainty_um = 1\n" + "".join(limits))
    judge = ("accept", str(tmp_path / "m.csv"), "--limits", str(tmp_path / "l.toml"), "--offset", "0.1mm")
    found = json.loads(run_inside(*judge, "--json").stdout)
    SCHEMA.validate(found)
    assert found["gap"]["value_um"] == pytest.approx(12.0, abs=0.01)
    output = tmp_path / "cr12.toml"
    written = (*judge, "--material", "Cr12", "--thickness", "40mm", "-o", str(output))
    for number in ("1", "2"):
        assert run_inside(*written, "--pass", number).returncode == 0
    assert [of_pass.number for of_pass in passes_at(load_technology(output), Choice("Cr12", 180.0, 40.0))] == [1, 2]
    before = output.read_bytes()
    again = run_inside(*written, "--pass", "2")
    assert (again.returncode, output.read_bytes()) == (2, before)
    assert "[[cut]] 3" in again.stderr.decode()
    (tmp_path / "part.3b").write_text("B1000B0B1000GXL1\nDD\n")
    ran = run_inside("run", tmp_path / "part.3b", "--technology", output, "-o", tmp_path / "out")
    assert ran.returncode == 0
    assert json.loads((tmp_path / "out" / "report.json").read_text("utf-8"))["wire"]["spark_gap_um"] == 12.0


def test_bad_use_is_refused(tmp_path: Path) -> None:
    arguments = measured(tmp_path, 10.0)
    (tmp_path / "o.csv").write_text("feature,x_mm,y_mm\nflat,1,\n")
    for given, said in (
        (("accept",), "FILE.csv"),
        (arguments[:2], "--limits"),
        (("accept", str(tmp_path / "o.csv"), *arguments[2:]), "o.csv:2: y_mm"),
        (("accept", str(tmp_path / "l.toml"), *arguments[2:]), "no column feature"),
        ((*arguments, "--offset", "0.1mm"), "slots or holes"),
        ((*arguments, "--wire-diameter", "0.2mm"), "--offset"),
    ):
        done = run_inside(*given)
        assert done.returncode == 2
        assert said in done.stderr.decode()
