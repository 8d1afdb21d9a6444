"""Clamps, workpiece and arm as files give them: every key known, every outline a simple polygon."""

from pathlib import Path

import pytest
from places import MACHINES

from parser.findings.errors import SettingsError
from parser.toolpath import Point
from sim.setup.machine.machine import load_machine
from sim.setup.obstacles import Clamp
from sim.setup.scenario import load_scenario


def scenario_of(tmp_path: Path, text: str) -> Path:
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    return tmp_path


def test_clamps_and_work_are_read_in_either_sense(tmp_path: Path) -> None:
    text = """
        [[clamps]]
        outline_mm = [[0, 0], [0, 10], [20.5, 10]]
        [[clamps]]
        name = "vice"
        outline_mm = [[0, 0], [20, 10], [0, 10]]
        [work]
        thickness_mm = 30.0
        outline_mm = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    """
    scenario = load_scenario(scenario_of(tmp_path, text))
    assert scenario.clamps == (
        Clamp("clamp 1", (Point(20500, 10000), Point(0, 10000), Point(0, 0))),
        Clamp("vice", (Point(0, 0), Point(20000, 10000), Point(0, 10000))),
    )
    assert scenario.work_um == (Point(-1000, -1000), Point(1000, -1000), Point(1000, 1000), Point(-1000, 1000))
    assert scenario.thickness_mm == 30.0


@pytest.mark.parametrize(
    ("value", "complaint"),
    [
        ("3", r"outline_mm is a list of points \[x, y\]; found 3"),
        ("[[0, 0], [1, 0], [1]]", "is a list of points"),
        ("[[0, 0], [1, 0]]", "the number of points is 2; it must lie between 3 and 100"),
        (str([[x, x * x] for x in range(101)]), "the number of points is 101"),
        ("[[0, 0], [1, 0], [nan, 1]]", "point 3: x is nan"),
        ("[[0, 0], [1, 0], [0, 1e6]]", "point 3: y is 1000000; it must lie between"),
        ("[[0, 0], ['a', 0], [0, 1]]", "point 2: x is a number; found 'a'"),
        ("[[0, 0], [1, 0], [0, true]]", "point 3: y is a number; found True"),
        ("[[0, 0], [1, 0], [1, 1], [0, 0]]", "the last point repeats the first"),
        ("[[0, 0], [1, 0], [1, 0], [1, 1]]", "point 3 lies on the side that begins at point 1"),
        ("[[0, 0], [1, 0], [2, 0]]", "lies on the side"),
        (
            "[[0, 0], [10, 0], [5, 0.0005]]",
            "point 3 lies on the side that begins at point 1, or nearer to it than 1 µm",
        ),
        ("[[0, 0], [10, 0], [5, 0], [5, 5]]", "point 3 lies on the side"),
        ("[[0, 0], [1, 1], [1, 0], [0, 1]]", "the sides that begin at points 1 and 3 cross"),
    ],
)
def test_bad_outlines_are_refused(tmp_path: Path, value: str, complaint: str) -> None:
    for section, where in (("[[clamps]]", r"\[\[clamps\]\] 1"), ("[work]", r"\[work\]")):
        folder = scenario_of(tmp_path, f"{section}\noutline_mm = {value}")
        with pytest.raises(SettingsError, match=rf"scenario\.toml: {where}: (outline_mm)?.*{complaint}"):
            load_scenario(folder)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("clamps = 3", r"clamps are tables, \[\[clamps\]\]; found 3"),
        ("clamps = [3]", "clamps are tables"),
        ("[[clamps]]", r"\[\[clamps\]\] 1: outline_mm is missing"),
        ("[[clamps]]\nname = 3\noutline_mm = [[0, 0], [1, 0], [0, 1]]", "name is a text"),
        ("[[clamps]]\noutlin_mm = 3", "did you mean outline_mm"),
        ("[work]\noutlin_mm = 3", r"\[work\]: unknown key 'outlin_mm'; did you mean outline_mm"),
    ],
)
def test_bad_clamps_are_refused(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        load_scenario(scenario_of(tmp_path, text))


def test_the_arm_is_read_from_the_machine(tmp_path: Path) -> None:
    shipped = (MACHINES / "dk7740.toml").read_text("utf-8")
    assert load_machine("dk7740").arm_um is None
    (tmp_path / "m.toml").write_text(shipped + "\n[arm]\noutline_mm = [[-1, -1], [1, -1], [0, 2]]\n", "utf-8")
    machine = load_machine("m.toml", folder=tmp_path)
    assert machine.arm_um == (Point(-1000, -1000), Point(1000, -1000), Point(0, 2000))
    for bad, complaint in (("", r"\[arm\]: outline_mm is missing"), ("outline = 3", "did you mean outline_mm")):
        (tmp_path / "m.toml").write_text(f"{shipped}\n[arm]\n{bad}\n", "utf-8")
        with pytest.raises(SettingsError, match=complaint):
            load_machine("m.toml", folder=tmp_path)
