"""The pages in Chromium 86 of 2020, the oldest browser that they promise, and in one that cannot inflate the replay."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import Browsers
from drill_pages import drills_of_part, tasks
from old_browser import missing, old_page
from opened_page import opened_page
from replayed import recording_of
from report_pages import PART, made
from runs import scenario_run
from sittings import page as lesson

from sim.run.sparks import panel_cut
from sim.show.panel_page.page import panel_page
from sim.show.replay.document import replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

LABELLED = "N10: B0 B600 B600 GY L4\nN20: B1000 B0 B1000 GX L1\nN30: B500 B0 B2000 GY NR1\nDD\n"
CANNOT = "<script>delete window.DecompressionStream</script>"


@pytest.fixture(name="page", scope="module")
def page_of_2020(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    if missing():
        pytest.skip(missing())
    with old_page(browsers, tmp_path_factory.mktemp("old")) as page:
        assert "Chrome/86." in page.evaluate("navigator.userAgent")
        yield page


def opened(page: "Page", html: str, folder: Path) -> None:
    (folder / "page.html").write_text(html, "utf-8")
    page.goto((folder / "page.html").as_uri())


# What playwright itself looks for in a page it asks in words that this browser does not know.
def text(page: "Page", selector: str) -> str:
    """Text of an element as it shows; empty where it does not."""
    told: str = page.evaluate(
        "selector => { const box = document.querySelector(selector); return box.offsetHeight ? box.innerText : ''; }",
        selector,
    )
    return told


def waits_for(page: "Page", truth: str) -> None:
    page.wait_for_function(f"() => {truth}")


@pytest.mark.deeper
def test_the_replay_plays(page: "Page", tmp_path: Path) -> None:
    opened(page, replay_page(recording_of(LABELLED)), tmp_path)
    waits_for(page, "document.querySelector('#loading').hidden")
    assert text(page, '[data-out="block"]') == "N10 · 1 / 3"
    page.keyboard.press("End")
    waits_for(page, "document.querySelector('[data-out=block]').textContent === 'N30 · 3 / 3'")
    assert text(page, "#too-old") == ""
    assert page.evaluate("document.querySelectorAll('#program .line').length") == 4


def test_the_arrows_of_the_speed_go_1_2_5(page: "Page", tmp_path: Path) -> None:
    opened(page, replay_page(recording_of(LABELLED)), tmp_path)
    waits_for(page, "document.querySelector('#loading').hidden")
    page.evaluate("drycut.player.setSpeed(1); document.querySelector('#speed').focus()")
    shown = []
    for key in ("ArrowUp", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowDown", "ArrowLeft"):
        page.keyboard.press(key)
        shown.append(text(page, "#speed-shown"))
    assert shown == ["2×", "5×", "10×", "20×", "10×", "5×"]


@pytest.mark.parametrize(("lang", "says"), [("en", "too old"), ("zh-CN", "版本太旧")])
def test_a_browser_that_cannot_play_says_so_and_lists_the_program(
    page: "Page", tmp_path: Path, lang: str, says: str
) -> None:
    language = f"<script>Object.defineProperty(navigator, 'languages', {{ value: ['{lang}'] }})</script>"
    opened(page, replay_page(recording_of(LABELLED)).replace("<body>", f"<body>{CANNOT}{language}"), tmp_path)
    assert says in text(page, "#too-old")
    assert text(page, "#loading") == ""
    assert text(page, "#program").splitlines()[:3] == LABELLED.splitlines()[:3]


def test_the_report_fills_its_tables(page: "Page", tmp_path: Path) -> None:
    opened(page, made(PART, kerf=True).html, tmp_path)
    assert page.evaluate("document.querySelectorAll('[data-table=blocks] tbody tr').length") > 3


def test_a_fault_drill_is_answered(page: "Page", tmp_path: Path) -> None:
    opened(page, tasks(), tmp_path)
    drill = drills_of_part()[0]
    page.evaluate("document.querySelector('#start button').click()")
    page.evaluate(f"document.querySelector('.drill .listing input[value=\"{drill.lines[0]}\"]').click()")
    page.evaluate(f"document.querySelector('.drill .what input[value={drill.group}]').click()")
    page.evaluate("document.querySelector('.drill button').click()")
    assert text(page, ".drill .said") == "Right: line and fault."
    assert text(page, "#too-old") == ""


def test_a_lesson_is_begun_and_a_block_is_marked(page: "Page", tmp_path: Path) -> None:
    opened(page, lesson("1-first-blocks"), tmp_path)
    page.evaluate("document.querySelector('#name').value = '王小明'; document.querySelector('#class').value = '1'")
    page.evaluate("document.querySelector('#start button').click()")
    page.evaluate("document.querySelector('.step:not(.aside-now) input').value = 'B1B0B1GXL1'")
    page.evaluate("document.querySelector('.step:not(.aside-now) .check').click()")
    assert text(page, "#who") == "王小明 · 1"
    assert page.evaluate("document.querySelectorAll('.step:not(.aside-now) .words li').length") == 5
    assert text(page, "#too-old") == ""


def test_a_panel_cuts(page: "Page", tmp_path: Path) -> None:
    run = scenario_run("sparks-chip")
    opened(page, panel_page(run.scenario, panel_cut(run, run.scenario)), tmp_path)
    waits_for(page, "Number(document.querySelector('#out-j').textContent) < 1800")
    page.evaluate("document.querySelector('#key-tear').click()")
    waits_for(page, "!document.querySelector('#alarm').hidden")
    assert text(page, "#too-old") == ""


@pytest.mark.deeper
def test_a_program_opens(page: "Page", tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(LABELLED, "utf-8")
    with opened_page(tmp_path / "part.3b") as served:
        page.goto(served.address)
        waits_for(page, "document.querySelector('#figures td')")
        assert text(page, "#figures td:nth-child(2)") == "N10 – N30"
        page.goto("about:blank")
