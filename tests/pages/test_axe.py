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
from sittings import marked_class

from sim.show.class_page import class_page, entry_page, pupil_page
from sim.show.class_page.page import RoomDoor
from sim.show.replay.document import replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

LOOKS_ANEW = "window.setInterval(look, EVERY_MS);\nlook();"
"""What a page that is served does: a page of a file has nobody to ask."""
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


def class_of_pupils() -> str:
    result = marked_class(12)
    return class_page(result, tuple(f"pupil-{number}.html" for number in range(12)))


def class_served() -> str:
    result = marked_class(12)
    door = RoomDoor(("http://127.0.0.1:8000/",), "012345")
    return class_page(result, tuple(f"pupil-{number}.html" for number in range(12)), door).replace(LOOKS_ANEW, "")


def pupil() -> str:
    return pupil_page(marked_class(12), 3)


def entry() -> str:
    return entry_page(marked_class(1).title, "wrong-code")


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
        (class_of_pupils, as_it_stands),
        (class_served, as_it_stands),
        (pupil, as_it_stands),
        (entry, as_it_stands),
    ],
)
def test_axe_has_nothing_against_a_page(
    open_page: OpenPage, html: Callable[[], str], opened: Callable[["Page"], None], lang: str, dark: bool
) -> None:
    page = open_page(html(), lang=lang, dark=dark).page
    opened(page)
    page.wait_for_timeout(100)
    assert violations(page) == []
