"""The picture of a plan: parts, waste, passes, leads and thread points in their order, in both themes and languages."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from golden_pictures import assert_golden
from numpy.typing import NDArray

from parser.toolpath import Point
from sim.make.cam.model import CutPlan
from sim.make.cam.planned import PlanRequest, planned
from sim.setup.machine.machine import load_machine
from sim.setup.making import Making
from sim.setup.picks import pick_of
from sim.setup.scenario import Scenario
from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import DARK, LIGHT, Paint
from sim.show.pictures.plan import draw_plan, plan_bounds_um

SCENARIO = Scenario("part", Path("part.3b"), load_machine("dk7740"))
PASSES_UM = 180.0, 120.0, 100.0
STARTS_UM = Point(4500.0, 4300.0), Point(9300.0, 4200.0), Point(6000.0, -2000.0)
"""Asked for, so that the golden pictures hold on to nothing that the maker chooses by itself."""


def plate(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (12, 0), (12, 8), (0, 8)], close=True)
    space.add_circle((4, 4), 2.0)
    space.add_circle((9, 4), 1.5)


@pytest.fixture(name="plan", scope="module")
def plan_of_plate(tmp_path_factory: pytest.TempPathFactory) -> CutPlan:
    path = drawn(tmp_path_factory.mktemp("plate"), plate)
    return planned(PlanRequest(path, Making(passes_um=PASSES_UM, starts_um=STARTS_UM), SCENARIO))


@pytest.fixture(name="dots", scope="module")
def dots_of_plan(plan: CutPlan) -> NDArray[np.uint8]:
    """The colours (n, 3) of a picture of the plan."""
    return np.asarray(draw_plan(pixels(1200), plan).image()).reshape(-1, 3)


def test_plan_in_english_on_white(plan: CutPlan) -> None:
    assert_golden(draw_plan(pixels(800), plan).image(), "plan.png")


def test_plan_in_chinese_on_black(plan: CutPlan) -> None:
    assert_golden(draw_plan(pixels(800, DARK, "zh"), plan).image(), "plan-dark-zh.png")


def test_all_of_it_lies_in_the_bounds(plan: CutPlan) -> None:
    low, high = plan_bounds_um(plan)
    places = np.array([cut.thread.place_um for cut in plan.cuts])
    assert (low <= places).all()
    assert (high >= places).all()
    assert (low <= -PASSES_UM[0] + 1e-6).all()
    assert (high >= np.array([12e3, 8e3]) + PASSES_UM[0] - 1e-6).all()


@pytest.mark.parametrize("paint", [Paint.PART, Paint.SLUG, Paint.KERF, Paint.TRIM_1, Paint.TRIM_2, Paint.START])
def test_every_pass_and_area_shows_its_colour(dots: NDArray[np.uint8], paint: Paint) -> None:
    assert (dots == LIGHT[paint]).all(axis=1).sum() > 300


def test_the_turns_of_the_figures_stand_in_the_svg(plan: CutPlan) -> None:
    text = draw_plan(drawing(1200), plan).document("plan", 1200)
    assert all(f">{turn}</text>" in text for turn in (1, 2, 3))
    assert "thread point, with its turn" in text
    assert "tab, cut off" not in text


def test_many_figures_have_marks_without_numbers(plan: CutPlan) -> None:
    many = plan._replace(cuts=plan.cuts * 30)
    assert ">90</text>" not in draw_plan(drawing(1200), many).document("plan", 1200)


def test_another_wire_has_another_pass(tmp_path: Path) -> None:
    wide = replace(SCENARIO, wire=replace(SCENARIO.wire, diameter_um=280.0))
    one = planned(PlanRequest(drawn(tmp_path, plate), Making(), wide))
    assert "offset 0.150 mm" in draw_plan(drawing(1200), one).document("plan", 1200)


def test_what_is_not_cut_is_dashed_in_the_colour_of_what_it_is(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        plate(space)
        space.add_lwpolyline([(20, 0), (30, 0), (30, 8), (20, 8), (20, 0.2)])

    path = drawn(tmp_path, draw)
    for making, there, said in (
        (Making(), Paint.WARNING, "not cut: to be checked"),
        (Making(picks=(pick_of("0,0..13,9", ""),)), Paint.GREY, "not picked"),
    ):
        one = planned(PlanRequest(path, making, SCENARIO))
        text = draw_plan(drawing(1200), one).document("plan", 1200)
        assert said in text
        assert plan_bounds_um(one)[1, 0] >= 30_000.0
        assert (np.asarray(draw_plan(pixels(1200), one).image()) == LIGHT[there]).all(axis=-1).sum() > 300


def test_a_plan_of_two_drawings_shows_all_of_the_upper_contours(tmp_path: Path) -> None:
    def lower(space: Modelspace) -> None:
        space.add_circle((4, 4), 3.0)

    def upper(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (8, 0), (8, 8), (0, 8)], close=True)

    (tmp_path / "top").mkdir()
    making = Making(upper=drawn(tmp_path / "top", upper))
    both = planned(PlanRequest(drawn(tmp_path, lower), making, SCENARIO))
    low, high = plan_bounds_um(both)
    assert (low <= 0.0).all()
    assert (high >= 8000.0).all()
    shown = [
        (np.asarray(draw_plan(pixels(800), each).image()) == LIGHT[Paint.TOP]).all(axis=2).any()
        for each in (both, both._replace(facings=()))
    ]
    assert shown == [True, False]
