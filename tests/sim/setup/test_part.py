"""Offset, kerf and drawing as scenarios and the command line ask for them."""

from pathlib import Path

import pytest

from controller.offset.shifted import Side
from parser.findings.errors import SettingsError
from sim.cli.options import Lengths
from sim.cli.scenario_options import Overrides, overridden
from sim.setup.part import DrawingTarget, Offset, OffsetPass
from sim.setup.scenario import MACHINE_FILE, load_scenario, scenario_sections
from sim.setup.toml.keys import toml_text

LED = "[offset]\nside = 'left'\n[[pass]]\nby_mm = 0.18\n"
"""The first pass of some."""
NONE = Overrides()


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
    assert scenario.offset == Offset((OffsetPass(100.0),), Side.LEFT)
    assert scenario.drawing == DrawingTarget(tmp_path / "part.dxf", "CUT", 3.0, 2.5, fit=False)


def test_passes_are_read_and_written_as_they_were_asked(tmp_path: Path) -> None:
    text = (
        LED
        + """
        [[pass]]
        by_mm = 0.12
        direction = "back"
        feed_mm_min = 6
        [[pass]]
        by_mm = 0.1
        area_rate_mm2_min = 60
    """
    )
    scenario = load_scenario(scenario_of(tmp_path, text))
    assert scenario.offset == Offset(
        (OffsetPass(180.0), OffsetPass(120.0, "back", feed_um_s=100.0), OffsetPass(100.0, area_rate_mm2_min=60.0)),
        Side.LEFT,
    )
    assert scenario.offset.back == (False, True, True)
    assert scenario.offset.by_um == 100.0
    written = {part.section.header: dict(part.values) for part in scenario_sections(scenario)}
    assert written["[offset]"] == {"side": "left"}
    again = toml_text(scenario_sections(scenario)).replace(MACHINE_FILE, "dk7740")
    assert load_scenario(scenario_of(tmp_path, again)).offset == scenario.offset
    one = load_scenario(scenario_of(tmp_path, "[offset]\nside = 'left'\n[[pass]]\nby_mm = 0.1"))
    assert one.offset == Offset((OffsetPass(100.0),), Side.LEFT)
    assert one.pass_tables == ()


def test_lengths_of_passes_are_read_from_the_command_line() -> None:
    assert Lengths().convert("0.18mm, 120um,0.1mm", None, None) == (180.0, 120.0, 100.0)
    for text in ("0.1mm,", ",0.1mm", ",", "0.1mm,,0.2mm"):
        with pytest.raises(SettingsError, match="lacks a length beside a comma"):
            Lengths().convert(text, None, None)
    for text in ("0.1,0.2", "", "0.1mm;0.2mm"):
        with pytest.raises(SettingsError, match="is no length"):
            Lengths().convert(text, None, None)


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
        ("[[pass]]\nby_mm = 0.1", r"\[\[pass\]\] needs \[offset\] with side"),
        ("pass = []\n[offset]\nside = 'left'", r"the number of \[\[pass\]\] is 0; it must lie between 1 and 20"),
        ("[offset]\nside = 'left'\n" + "[[pass]]\nby_mm = 0.1\n" * 21, r"the number of \[\[pass\]\] is 21"),
        ("[offset]\nside = 'left'\n[pass]\nby_mm = 0.1", r"pass are tables, \[\[pass\]\]"),
        (
            "[offset]\nside = 'left'\nby_mm = 0.1\n[[pass]]\nby_mm = 0.1",
            r"\[offset\]: by_mm is left out where there are",
        ),
        ("[offset]\nside = 'left'\n[[pass]]\nfeed_mm_min = 3", r"\[\[pass\]\] 1: by_mm is missing"),
        (LED + "direction = 'back'", r"\[\[pass\]\] 1: direction is that of the program in the first pass"),
        (LED + "[[pass]]\nby_mm = 0.1\ndirection = 'there'", r"\[\[pass\]\] 2: direction is one of same, back"),
        (LED + "feed_mm_min = 3\narea_rate_mm2_min = 60", r"feed_mm_min and area_rate_mm2_min are two ways to say one"),
        (LED + "feed_mm_min = 0", "feed_mm_min is 0; it must lie between 0.001"),
        (LED + "side = 'left'", r"\[\[pass\]\] 1: unknown key 'side'"),
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
        Offset((OffsetPass(100.0),), Side.LEFT),
        False,
        DrawingTarget(tmp_path / "a.dxf", "CUT"),
    )
    other = NONE._replace(
        side="right", settings={"kerf": True}, drawing=Path("b.dxf"), comparison={"tolerance_um": 2.0, "fit": False}
    )
    scenario = overridden(folder, other)
    assert scenario.offset == Offset((OffsetPass(100.0),), Side.RIGHT)
    assert scenario.kerf
    assert scenario.drawing == DrawingTarget(Path("b.dxf"), "CUT", 2.0, fit=False)
    assert overridden(folder, NONE._replace(offset=((50.0,),))).offset == Offset((OffsetPass(50.0),), Side.LEFT)
    folder = scenario_of(tmp_path, LED + "feed_mm_min = 3\n[[pass]]\nby_mm = 0.1\ndirection = 'back'")
    passes = (OffsetPass(180.0, feed_um_s=50.0), OffsetPass(100.0, "back"))
    assert overridden(folder, NONE._replace(side="right")).offset == Offset(passes, Side.RIGHT)
    plain = (OffsetPass(150.0), OffsetPass(120.0), OffsetPass(100.0))
    assert overridden(folder, NONE._replace(offset=((150.0, 120.0, 100.0),))).offset == Offset(plain, Side.LEFT)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (NONE._replace(offset=((100.0,),)), "--offset needs --side left or --side right"),
        (NONE._replace(side="left"), "--side needs --offset"),
        (NONE._replace(side="left", offset=((0.0,),)), "--offset in mm is 0"),
        (NONE._replace(side="left", offset=((180.0, 20_000.0),)), "--offset in mm is 20"),
        (
            NONE._replace(side="left", offset=((100.0,) * 21,)),
            "--offset: the number of passes is 21; it must lie between 1",
        ),
        (NONE._replace(comparison={"layer": "CUT"}), "--layer needs --drawing"),
        (NONE._replace(comparison={"tolerance_um": 5.0}), "--tolerance needs --drawing"),
        (NONE._replace(comparison={"fit": False}), "--no-fit needs --drawing"),
        (NONE._replace(drawing=Path("a.dxf"), comparison={"tolerance_um": 0.0}), "--tolerance in µm is 0"),
    ],
)
def test_half_an_option_is_refused(tmp_path: Path, options: Overrides, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        overridden(scenario_of(tmp_path, ""), options)
