"""Offset, kerf and drawing as scenarios and the command line ask for them."""

from pathlib import Path

import pytest

from controller.offset.sections import Side
from parser.findings.errors import SettingsError
from sim.cli.overrides import Overrides, overridden
from sim.setup.part import DrawingTarget, Offset
from sim.setup.scenario import load_scenario

NONE = Overrides(
    machine=None,
    thickness=None,
    wire_diameter=None,
    gap=None,
    wire_lag=None,
    interpolator=None,
    offset=None,
    side=None,
    kerf=False,
    drawing=None,
    layer=None,
    tolerance=None,
    no_fit=False,
    sharp_corners=None,
)


def scenario_of(tmp_path: Path, text: str) -> Path:
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    return tmp_path


def test_nothing_is_asked_by_default(tmp_path: Path) -> None:
    scenario = load_scenario(scenario_of(tmp_path, ""))
    assert (scenario.offset, scenario.kerf, scenario.drawing) == (None, False, None)
    assert scenario.density_g_cm3 == 7.85


def test_all_that_can_be_asked_is_read(tmp_path: Path) -> None:
    text = """
        kerf = true
        [work]
        density_g_cm3 = 8.4
        [offset]
        by_mm = 0.1
        side = "left"
        [drawing]
        file = "part.dxf"
        layer = "CUT"
        tolerance_um = 3
        gap_um = 2.5
        fit = false
    """
    scenario = load_scenario(scenario_of(tmp_path, text))
    assert scenario.kerf
    assert scenario.density_g_cm3 == 8.4
    assert scenario.offset == Offset(100.0, Side.LEFT)
    assert scenario.drawing == DrawingTarget(tmp_path / "part.dxf", "CUT", 3.0, 2.5, fit=False)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("kerf = 1", "kerf is true or false; found 1"),
        ("[offset]\nby_mm = 0.1", r"\[offset\]: side is a text and must be given"),
        ("[offset]\nside = 'left'", r"\[offset\]: by_mm is missing"),
        ("[offset]\nby_mm = 0.1\nside = 'links'", r"\[offset\]: side is left or right; found 'links'"),
        ("[offset]\nby_mm = 0\nside = 'left'", r"\[offset\]: by_mm is 0; it must lie between 0.0001 and 10"),
        ("[offset]\nby_um = 0.1\nside = 'left'", "unknown key 'by_um'; did you mean by_mm"),
        ("offset = 3", r"offset is a table, \[offset\]"),
        ("[drawing]\nlayer = 'CUT'", r"\[drawing\]: file is a text and must be given"),
        ("[drawing]\nfile = 'a.dxf'\ntolerance_um = 0", "tolerance_um is 0; it must lie between 0.001"),
        ("[drawing]\nfile = 'a.dxf'\nfit = 'no'", r"\[drawing\]: fit is true or false; found 'no'"),
        ("[drawing]\nfile = 'a.dxf'\nlayer = ''", "layer is a text"),
        ("[work]\ndensity_g_cm3 = 0", r"\[work\]: density_g_cm3 is 0"),
    ],
)
def test_what_cannot_be_asked_is_refused(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        load_scenario(scenario_of(tmp_path, text))


def test_options_take_the_place_of_the_scenarios_values(tmp_path: Path) -> None:
    folder = scenario_of(tmp_path, "[offset]\nby_mm = 0.1\nside = 'left'\n[drawing]\nfile = 'a.dxf'\nlayer = 'CUT'")
    scenario = overridden(folder, NONE)
    assert (scenario.offset, scenario.kerf, scenario.drawing) == (
        Offset(100.0, Side.LEFT),
        False,
        DrawingTarget(tmp_path / "a.dxf", "CUT"),
    )
    other = NONE._replace(side="right", kerf=True, drawing=Path("b.dxf"), tolerance=2.0, no_fit=True)
    scenario = overridden(folder, other)
    assert scenario.offset == Offset(100.0, Side.RIGHT)
    assert scenario.kerf
    assert scenario.drawing == DrawingTarget(Path("b.dxf"), "CUT", 2.0, fit=False)
    assert overridden(folder, NONE._replace(offset=50.0)).offset == Offset(50.0, Side.LEFT)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (NONE._replace(offset=100.0), "--offset needs --side left or --side right"),
        (NONE._replace(side="left"), "--side needs --offset"),
        (NONE._replace(side="left", offset=0.0), "--offset in mm is 0"),
        (NONE._replace(layer="CUT"), "--layer needs --drawing"),
        (NONE._replace(tolerance=5.0), "--tolerance needs --drawing"),
        (NONE._replace(no_fit=True), "--no-fit needs --drawing"),
        (NONE._replace(drawing=Path("a.dxf"), tolerance=0.0), "--tolerance in µm is 0"),
    ],
)
def test_half_an_option_is_refused(tmp_path: Path, options: Overrides, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        overridden(scenario_of(tmp_path, ""), options)
