"""``drycut fit`` as a user meets it: a machine is found again from its own circle; JSON of its schema; bad use."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

from sim.measure.fit.corner import corner_edge
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
    half = {
        each["name"]: 0.5 * (each["most"] - each["least"]) for each in found["parameters"] if each["most"] is not None
    }
    margins = dict(fitted.measured)
    told_by = {
        "backlash_x_um": "reversal_x_um",
        "backlash_y_um": "reversal_y_um",
        "squareness_urad": "squareness_urad",
    }
    assert margins == {key: pytest.approx(half[name], abs=0.001) for key, name in told_by.items()}
    assert circularity_um(mine) == pytest.approx(circularity_um(machine), abs=0.3)
    assert re.search(r"^# reversal_x: \d", mine.read_text("utf-8"), re.MULTILINE)


def test_a_corner_tells_the_lag_of_the_wire(tmp_path: Path) -> None:
    """The edge as cut by a wire that lags by 30 µm, a place every 8 µm: the numbers of docs/fit.md."""
    edge = corner_edge(np.pi / 2.0, 100.0, 30.0)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(edge, axis=0).T))])
    middle = along[1] + 60.0
    wanted = np.linspace(middle - 800.0, middle + 800.0, 200)
    places = np.column_stack([np.interp(wanted, along, column) for column in edge.T])
    rows = [f"{x / 1000.0:.7f},{y / 1000.0:.7f}" for x, y in places]
    (tmp_path / "corner.csv").write_text("\n".join(["x_mm,y_mm", *rows]))
    done = run_inside("fit", tmp_path / "corner.csv", "--corner", "--json")
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    told = {each["name"]: each["value"] for each in found["parameters"]}
    assert told == {"lag_um": pytest.approx(30.0, abs=0.1), "reach_um": pytest.approx(100.0, abs=0.1)}
    assert "滞后" in run_inside("fit", tmp_path / "corner.csv", "--corner", "--lang", "zh").stdout.decode()
    refused = run_inside("fit", tmp_path / "corner.csv", "--corner", "--feed", "10mm/min")
    assert (refused.returncode, b"--feed" in refused.stderr) == (2, True)


def test_a_piece_tells_and_makes_a_machine_file(tmp_path: Path) -> None:
    """Sizes without noise of a machine that loses 8 and 6 µm and cuts 1 µm outside of each contour, by arithmetic."""
    rows = ["feature,x_mm,y_mm"]
    sizes = {f"octagon-{at}": (20.0, at) for at in (0, 45, 90, 135)}
    sizes |= {"square-0": (10.0, 0), "square-90": (10.0, 90), "plate-0": (60.0, 0), "plate-90": (14.0, 90)}
    sizes |= {"slot-1": (1.0, 0), "slot-2": (2.0, 0), "slot-5": (5.0, 0)}
    for name, (size, across) in sizes.items():
        lost = {0: 0.008, 90: 0.006}.get(across, 0.0)
        half = 0.5 * (size + (-0.002 if name.startswith("slot") else 0.002) - lost)
        normal = np.array([np.cos(np.radians(across)), np.sin(np.radians(across))])
        for by in np.linspace(-0.4, 0.4, 5):
            for sign in (-1.0, 1.0):
                x, y = sign * half * normal + by * np.array([-normal[1], normal[0]])
                rows.append(f"{name},{x:.6f},{y:.6f}")
    (tmp_path / "piece.csv").write_text("\n".join(rows))
    mine = tmp_path / "mine.toml"
    done = run_inside("fit", tmp_path / "piece.csv", "--machine", "dk7740", "--feed", "60mm/min", "-o", mine, "--json")
    found = json.loads(done.stdout)
    SCHEMA.validate(found)
    values = {each["name"]: each["value"] for each in found["parameters"]}
    wanted = {"edge_um": 1.0, "reversal_x_um": 8.0, "reversal_y_um": 6.0, "mean_scale_ppm": 0.0}
    assert {name: values[name] for name in wanted} == pytest.approx(wanted, abs=0.05)
    assert "reversal_x" in mine.read_text("utf-8")
    assert load_machine(str(mine)).table.backlash_um[0] > load_machine("dk7740").table.backlash_um[0]
    assert "试件" in run_inside("fit", tmp_path / "piece.csv", "--lang", "zh").stdout.decode()
    (tmp_path / "circle.csv").write_text("x_mm,y_mm\n1,2\n")
    for options in (("--limits", mine), ("--back", tmp_path / "circle.csv")):
        file = "piece.csv" if options[0] == "--back" else "circle.csv"
        refused = run_inside("fit", tmp_path / file, *options)
        assert (refused.returncode, options[0].encode() in refused.stderr) == (2, True)


@pytest.mark.parametrize("suffix", [".png", ".svg"])
def test_a_picture_is_drawn_beside_the_table(machine: Path, suffix: str) -> None:
    trace, picture = machine.parent / "trace.csv", machine.parent / f"fit{suffix}"
    run_inside("ballbar", *TEST, "--machine", machine, "--trace", trace)
    done = run_inside("fit", trace, "--picture", picture, "--lang", "zh")
    assert (done.returncode, picture.exists(), picture.name in done.stdout.decode()) == (0, True, True)
    assert suffix == ".png" or "模型" in picture.read_text("utf-8")
    for bad in (trace, machine.parent / "x.gif"):
        refused = run_inside("fit", trace, "--picture", bad)
        assert (refused.returncode, b"--picture" in refused.stderr) == (2, True)


def test_without_a_machine_both_circles_are_taken_for_one_of_the_usual_machine(machine: Path) -> None:
    trace, mine = machine.parent / "trace.csv", machine.parent / "mine.toml"
    run_inside("ballbar", *TEST, "--machine", machine, "--trace", trace)
    done = run_inside("fit", trace, "--feed", "30mm/min", "-o", mine)
    assert done.returncode == 0
    assert "taken for a DK7740" in " ".join(done.stdout.decode().split())
    assert load_machine(str(mine)).table.backlash_um == pytest.approx((7.0, 0.5), abs=0.1)


def test_lost_motion_that_no_machine_file_makes_is_told(machine: Path) -> None:
    trace, mine = machine.parent / "trace.csv", machine.parent / "mine.toml"
    angle = np.linspace(0.0, 2.0 * np.pi, 720)
    way = np.column_stack([np.cos(angle), np.sin(angle)])
    # Lost motion of −5 µm on both axes, by the formula of docs/fit.md: an axis runs ahead where it turns round.
    out = -0.0025 * (np.sign(way[:, 1]) * way[:, 0] - np.sign(way[:, 0]) * way[:, 1])
    turns = [(3.0 + out)[:, None] * way, ((3.0 - out)[:, None] * way)[::-1]]
    trace.write_text("x_mm,y_mm\n" + "".join(f"{x:.5f},{y:.5f}\n" for x, y in np.concatenate(turns)))
    done = run_inside("fit", trace, "--machine", "dk7740", "--feed", "30mm/min", "-o", mine)
    assert done.returncode == 0
    off = re.search(
        r"at a reversal the machine file loses up to (\S+) µm more or less", " ".join(done.stdout.decode().split())
    )
    assert off is not None
    assert "backlash_x_um" not in dict(load_machine(str(mine)).measured), "what is off was not measured so"
    assert f"# lost motion still differs by {off[1]} µm from what was measured" in mine.read_text("utf-8")


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
