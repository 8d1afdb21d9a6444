"""The drawings of the scenarios that are made of a drawing alone are those that their tool draws."""

import math

import pytest
from example_drawings import BORE, DRAWINGS, MODULE, TEETH, TOPS, drawing_text, involute_angle
from places import SCENARIOS

from parser.drawing.read import read_drawing


@pytest.mark.parametrize("name", DRAWINGS)
def test_the_scenario_holds_the_drawing(name: str) -> None:
    assert (SCENARIOS / name / "drawing.dxf").read_text("ascii") == drawing_text(DRAWINGS[name])
    tops = ["top.dxf"] if name in TOPS else []
    assert [file.name for file in sorted((SCENARIOS / name).iterdir())] == ["drawing.dxf", "scenario.toml", *tops]


@pytest.mark.parametrize("name", TOPS)
def test_the_scenario_holds_the_drawing_of_its_top(name: str) -> None:
    assert (SCENARIOS / name / "top.dxf").read_text("ascii") == drawing_text(TOPS[name])


def test_a_tooth_is_half_a_pitch_wide_at_the_pitch_circle() -> None:
    assert 2.0 * involute_angle(0.5 * MODULE * TEETH) == pytest.approx(math.pi / TEETH, abs=1e-12)


def test_the_gear_is_one_outline_and_its_bore() -> None:
    loops = read_drawing(SCENARIOS / "gear" / "drawing.dxf").loops
    assert [loop.closed for loop in loops] == [True, True]
    assert min(len(loop.row) for loop in loops) == 1
    assert BORE < 0.5 * MODULE * TEETH - 1.25 * MODULE
