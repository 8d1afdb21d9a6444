"""``drycut accept`` as a user meets it: its piece can be made, its document keeps to its schema, bad use is refused."""

import json
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

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
    assert len(found["figures"]) == 7
    assert run_inside("accept", "--piece", tmp_path / "piece").returncode == 2  # it stands there


def test_bad_use_is_refused(tmp_path: Path) -> None:
    arguments = measured(tmp_path, 10.0)
    (tmp_path / "o.csv").write_text("feature,x_mm,y_mm\nflat,1,\n")
    for given, said in (
        (("accept",), "FILE.csv"),
        (arguments[:2], "--limits"),
        (("accept", str(tmp_path / "o.csv"), *arguments[2:]), "o.csv:2: y_mm"),
        (("accept", str(tmp_path / "l.toml"), *arguments[2:]), "no column feature"),
    ):
        done = run_inside(*given)
        assert done.returncode == 2
        assert said in done.stderr.decode()
