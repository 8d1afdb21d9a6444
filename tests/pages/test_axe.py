"""No page breaks a rule of axe-core, in either language, light or dark, as it stands and with what it can open."""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

import pytest
from axe import needs_axe, violations
from browser import OpenPage
from drill_pages import answers, tasks
from index_pages import shop_page
from report_pages import PART, made
from runs import scenario_recording

from sim.show.replay.document import replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

LOOKS = [("en", False), ("zh", True)]


@cache
def report() -> str:
    return made(PART, kerf=True, title="A square and a circle").html


@cache
def replay() -> str:
    return replay_page(scenario_recording("lost-steps"))


@cache
def shop() -> str:
    return shop_page(8)


def as_it_stands(page: "Page") -> None:
    pass


def with_its_quiz(page: "Page") -> None:
    page.evaluate("drycut.player.ready")
    page.keyboard.press("q")


def with_a_drill(page: "Page") -> None:
    page.click("#start button")
    form = page.locator("form.drill").first
    form.locator(".listing input").first.check()
    form.locator(".what input").first.check()
    form.get_by_role("button").click()


def with_its_keys(page: "Page") -> None:
    page.evaluate("drycut.player.ready")
    page.keyboard.press("?")


@pytest.mark.alike(2)
@needs_axe
@pytest.mark.parametrize(("lang", "dark"), LOOKS)
@pytest.mark.parametrize(
    ("html", "opened"),
    [
        (report, as_it_stands),
        (replay, as_it_stands),
        (replay, with_its_quiz),
        (replay, with_its_keys),
        (shop, as_it_stands),
        (answers, as_it_stands),
        (tasks, with_a_drill),
    ],
)
def test_axe_has_nothing_against_a_page(
    open_page: OpenPage, html: Callable[[], str], opened: Callable[["Page"], None], lang: str, dark: bool
) -> None:
    page = open_page(html(), lang=lang, dark=dark).page
    opened(page)
    page.wait_for_timeout(100)
    assert violations(page) == []
