"""The form of the page as a scenario: what it takes, and what it refuses."""

import math
from pathlib import Path

import pytest

from parser.findings.errors import SettingsError
from sim.serve.page.form import offsets_um, scenario_of
from sim.serve.page.runs import KEYS
from sim.setup.making import OR_NONE_MM
from sim.setup.part import OFFSET_MM, SIDES
from sim.setup.taper import TaperSettings

EMPTY = dict.fromkeys((*KEYS, "drawing_file"), "")


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ({"machine": "/etc/passwd.toml"}, "machine '/etc/passwd.toml' is not shipped"),
        ({"machine": "../x.toml"}, "is not shipped"),
        ({"thickness_mm": "-4"}, "thickness"),
        ({"thickness_mm": "nan"}, "thickness"),
        ({"wire_mm": "much"}, "the wire in mm is a number, not 'much'"),
        ({"wire_mm": "1e9"}, "the wire in mm is 1000000000; it must lie between 0.01 and 1"),
        ({"offset_mm": "inf"}, "the offset in mm is inf; it must lie between 0.0001 and 10"),
        ({"offset_mm": "-5"}, "the offset in mm is -5; it must lie between 0.0001 and 10"),
        ({"offset_mm": "0.00001"}, "the offset in mm is 0.00001; it must lie between 0.0001 and 10"),
        ({"offset_mm": "0.2, 0"}, "the offset in mm is 0; it must lie between 0.0001 and 10"),
        ({"taper_deg": "61"}, "the taper in ° is 61; it must lie between 0 and 60"),
        ({"taper_deg": "steep"}, "the taper in ° is a number, not 'steep'"),
        ({"taper_deg": "3", "plane_mm": "-1"}, "the program plane in mm is -1; it must lie between 0 and 2000"),
        ({"offset_mm": "0.1 " * 21}, "the number of passes is 21; it must lie between 1 and 20"),
    ],
)
def test_what_no_other_door_takes_is_refused(values: dict[str, str], why: str) -> None:
    with pytest.raises(SettingsError) as caught:
        scenario_of({**EMPTY, **values}, Path("part.3b"))
    assert why in str(caught.value)


def test_empty_values_are_the_usual_ones() -> None:
    scenario = scenario_of(EMPTY, Path("part.3b"))
    assert (scenario.thickness_mm, scenario.offset, scenario.drawing) == (40.0, None, None)
    assert scenario.machine_by_default
    assert scenario_of({**EMPTY, "offset_mm": " 0 "}, Path("part.3b")).offset is None
    assert scenario.taper is None


def test_the_wire_leans_as_the_page_says() -> None:
    values = {**EMPTY, "taper_deg": "3", "taper_side": "left", "taper_corner": "cone", "plane_mm": "10"}
    taper = scenario_of(values, Path("part.3b")).taper
    assert taper == TaperSettings(pytest.approx(math.radians(3.0)), SIDES["left"], "cone", 10_000.0)
    of_program = scenario_of({**EMPTY, "taper_side": "right", "plane_mm": "5"}, Path("part.iso")).taper
    assert of_program == TaperSettings(program_plane_um=5000.0)  # the program says its own angles


def test_each_number_is_the_offset_of_a_pass() -> None:
    offset = scenario_of({**EMPTY, "offset_mm": "0.18, 0.1", "side": "right"}, Path("part.3b")).offset
    assert offset is not None
    assert [one.by_um for one in offset.passes] == pytest.approx([180.0, 100.0])
    assert offset.side.name == "RIGHT"
    assert offsets_um({**EMPTY, "offset_mm": "\N{FULLWIDTH DIGIT ZERO}.2\N{FULLWIDTH COMMA}0.1"}, OFFSET_MM) == (
        200.0,
        100.0,
    )
    assert offsets_um({**EMPTY, "offset_mm": "0"}, OR_NONE_MM) == (0.0,)
