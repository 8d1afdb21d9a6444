"""Drills of operation in a browser: the page judges as the loops do, and anyone can do them."""

import json
from functools import cache
from pathlib import Path
from random import Random

import pytest
from axe import needs_axe, violations
from browser import OpenPage
from page_checks import complaints
from runs import scenario_run

from parser.findings.catalogue import Bilingual
from sim.process.cut import Started
from sim.run.sparks import panel_cut
from sim.show.html.environment import joined
from sim.show.operation_page.page import operation_answers_page, operation_entry, operation_page
from sim.teach.operation.incidents import ACTIONS, KINDS, REMEDIES, OperationDrill, operation_drills, outcome

ASSETS = Path(__file__).parents[2] / "sim" / "show" / "operation_page" / "assets"
HEAD = '<!doctype html><html lang="en"><title>x</title><meta charset="utf-8">'
TITLE = Bilingual("opening", "型孔")


@cache
def made() -> tuple[Started, tuple[OperationDrill, ...]]:
    run = scenario_run("sparks-chip")
    cut = panel_cut(run, run.scenario)
    return cut, operation_drills(cut, 3, len(KINDS))


def test_the_page_judges_as_the_loops_do(open_page: OpenPage) -> None:
    """Of each drill its remedy, nothing, and orders by chance."""
    cut, drills = made()
    page = open_page(f"{HEAD}<script>const task = {joined(ASSETS / 'task.js')};</script>").page
    page.evaluate("data => { window.data = data; }", json.loads(json.dumps(operation_entry(cut, drills, 3))))
    chance = Random(4)
    for at, drill in enumerate(drills):
        orders = [(), REMEDIES[drill.kind], *(tuple(chance.sample(ACTIONS, chance.randint(1, 3))) for _ in range(4))]
        for order in orders:
            numbers = [ACTIONS.index(action) for action in order]
            found = page.evaluate(
                "([at, actions]) => task.outcomeOf(window.data, window.data.drills[at], actions)", [at, numbers]
            )
            assert found == outcome(cut, drill, order), (drill.kind, order)


def test_a_drill_is_done_and_scored(open_page: OpenPage) -> None:
    cut, drills = made()
    page = open_page(operation_page(TITLE, cut, drills, 3), lang="zh").page
    page.click("#start button")
    for drill in drills:
        form = page.locator("form.drill:not(.aside-now)")
        form.locator(f".kinds input[value={drill.kind}]").check()
        for action in REMEDIES[drill.kind]:
            form.locator(f"[data-action='{ACTIONS.index(action)}']").click()
        form.locator(".try").click()
        assert "切割继续正常" in form.locator(".said").inner_text()
        form.locator(".next").click()
    assert page.inner_text(".score") == "14 / 14 分"
    with page.expect_download() as saved:
        page.click("#save")
    lines = Path(saved.value.path()).read_text("utf-8-sig").splitlines()
    assert len(lines) == 8


def test_a_wrong_order_may_be_mended_once_for_half_a_point(open_page: OpenPage) -> None:
    cut, drills = made()
    water = next(drill for drill in drills if drill.kind == "water")
    page = open_page(operation_page(TITLE, cut, [water], 3)).page
    page.click("#start button")
    form = page.locator("form.drill")
    form.locator(".try").click()
    assert "Say what happened" in form.locator(".said").inner_text()
    form.locator(".kinds input[value=water]").check()
    for action in ("thread-here", "pump-on"):
        form.locator(f"[data-action='{ACTIONS.index(action)}']").click()
    form.locator(".try").click()
    assert "try once more" in form.locator(".said").inner_text()
    for _ in range(2):
        form.locator(".undo").click()
    for action in ("pump-on", "thread-here"):
        form.locator(f"[data-action='{ACTIONS.index(action)}']").click()
    form.locator(".try").click()
    form.locator(".next").click()
    assert page.inner_text(".score") == "1.5 of 2 points"


@needs_axe
@pytest.mark.parametrize(("lang", "dark", "width"), [("zh", False, 1280), ("en", True, 390)])
def test_the_pages_break_no_rule(open_page: OpenPage, lang: str, dark: bool, width: int) -> None:
    cut, drills = made()
    page = open_page(operation_page(TITLE, cut, drills, 3), lang=lang, dark=dark, width=width).page
    page.click("#start button")
    assert violations(page) == []
    assert complaints(page) == []
    sheet = open_page(operation_answers_page(TITLE, cut, drills, 3), lang=lang, dark=dark, width=width).page
    assert violations(sheet) == []
    assert complaints(sheet) == []
