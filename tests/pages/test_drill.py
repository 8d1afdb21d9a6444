"""The pages of fault drills in a browser: tasks, answers, points, the keyboard, paper; both languages, dark, phone."""

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import OpenPage
from drill_pages import answers, drills_of_part, tasks
from page_checks import complaints
from report_pages import PART

from parser.program import parse_program
from sim.check.settings import CheckSettings
from sim.show.drill_page import answers_page, drill_page
from sim.show.texts import bilingual
from sim.teach.drills import LEVELS, DrillRequest, drills_of
from sim.teach.kinds import GROUPS

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page


KEYS = (*(f"drill.group-{group}" for group in GROUPS), *(f"drill.level-name-{level}" for level in LEVELS))
"""Of the texts of kinds of fault and of levels."""


def task(page: "Page") -> "Locator":
    """The task that shows."""
    return page.locator("form.drill:not(.aside-now)")


def answer(page: "Page", at: int, *, line: bool = True, group: bool = True) -> None:
    """Answer the task of an index, rightly or not."""
    drill = drills_of_part()[at]
    wrong_line = next(n for n in range(1, 9) if n not in drill.lines)
    wrong_group = "order" if drill.group != "order" else "twice"
    form = task(page)
    form.locator(f'.listing input[value="{drill.lines[0] if line else wrong_line}"]').check()
    form.locator(f'.what input[value="{drill.group if group else wrong_group}"]').check()
    form.get_by_role("button").click()


@pytest.mark.deeper
@pytest.mark.parametrize(("lang", "dark"), [("en", True), ("zh", False)])
@pytest.mark.parametrize("html", [tasks, answers])
def test_the_pages_offer_anyone_what_pages_must(open_page: OpenPage, html: "type", lang: str, dark: bool) -> None:
    shown = open_page(html(), lang=lang, dark=dark).page
    assert complaints(shown) == []
    if shown.locator("#start").count():
        shown.click("#start button")
        answer(shown, 0, line=False)
        assert complaints(shown) == []


def test_answers_are_weighed_and_shown_and_the_score_can_be_taken_along(open_page: OpenPage, tmp_path: Path) -> None:
    shown = open_page(tasks()).page
    assert task(shown).count() == 0
    shown.fill("#who", "=Li Lei")
    shown.click("#start button")
    told = []
    for at, (line, group) in enumerate([(True, True), (True, False), (False, True), (False, False)]):
        assert shown.locator("h2:visible").first.inner_text().startswith(f"Drill {at + 1} of 4")
        assert task(shown).locator(".answer").is_hidden()
        answer(shown, at, line=line, group=group)
        told.append(task(shown).locator(".said").inner_text())
        assert task(shown).locator("label.wrong").count() == 2 - line - group
        task(shown).get_by_role("button").click()
    assert told == [
        "Right: line and fault.",
        "The line is right, the fault is another one.",
        "The fault is right, the line is another one.",
        "Not right.",
    ]
    assert shown.inner_text("#end .score") == "4 of 8 points"
    head, *rows = saved(shown, tmp_path)
    assert head[0] == "name"
    assert [row[-1] for row in rows] == ["2", "1", "1", "0"]
    assert rows[0][:3] == ["'=Li Lei", "5", "1"]
    assert [row[6] == row[7] for row in rows] == [True, False, True, False]
    named = dict(map(bilingual, KEYS))
    shown.click("[data-language-switch]")
    in_chinese = saved(shown, tmp_path)
    assert in_chinese[0][:2] == ["姓名", "套"]
    assert [[row[at] for at in (3, 6, 7)] for row in in_chinese[1:]] == [
        [named[row[at]] for at in (3, 6, 7)] for row in rows
    ]


def saved(shown: "Page", folder: Path) -> list[list[str]]:
    """Rows of the score that the page offers."""
    with shown.expect_download() as waiting:
        shown.click("#save")
    waiting.value.save_as(folder / "score.csv")
    return list(csv.reader((folder / "score.csv").read_text("utf-8-sig").splitlines()))


def test_a_task_is_answered_by_the_keyboard_alone(open_page: OpenPage) -> None:
    shown = open_page(tasks()).page
    shown.locator("#who").focus()
    shown.keyboard.press("Enter")
    for key in ("Tab", "Space", "ArrowDown", "Tab", "Space", "ArrowDown"):
        shown.keyboard.press(key)
    assert task(shown).locator(".listing input:checked").get_attribute("value") == "2"
    assert task(shown).locator(".what input:checked").count() == 1
    assert task(shown).locator(".answer").is_hidden()
    shown.keyboard.press("Enter")
    assert task(shown).locator(".answer").is_visible()
    shown.keyboard.press("Enter")
    assert shown.locator("h2:visible").first.inner_text().startswith("Drill 2 of 4")


def test_nothing_is_weighed_before_both_are_chosen(open_page: OpenPage) -> None:
    shown = open_page(tasks()).page
    shown.click("#start button")
    task(shown).locator(".listing input").first.check()
    task(shown).get_by_role("button").click()
    assert task(shown).locator(".answer").is_hidden()


def test_the_fault_is_not_marked_before_it_is_asked(open_page: OpenPage) -> None:
    shown = open_page(tasks()).page
    shown.click("#start button")
    line = task(shown).locator("label.at").first
    other = task(shown).locator(".listing label:not(.at)").first
    ground = "node => getComputedStyle(node).backgroundColor + getComputedStyle(node).boxShadow"
    assert line.evaluate(ground) == other.evaluate(ground)
    assert task(shown).locator(".red").is_hidden()
    answer(shown, 0)
    assert line.evaluate(ground) != other.evaluate(ground)


def test_on_paper_stand_all_tasks_and_no_answer(open_page: OpenPage) -> None:
    shown = open_page(tasks()).page
    shown.click("#start button")
    answer(shown, 0)
    shown.emulate_media(media="print")
    assert shown.locator("form.drill:visible").count() == 4
    assert shown.locator(".answer:visible").count() == 0
    assert shown.locator("path.fault:visible").count() == 0
    shown.emulate_media(media="screen")


def test_nothing_of_a_program_is_obeyed_by_the_page(open_page: OpenPage) -> None:
    text = PART.replace("//lead-in", "//</code><script>document.title='no'</script>\u202e\x1b[31m")
    sound = parse_program(text, "<img src=x>.3b")
    drills = drills_of(sound, CheckSettings(), DrillRequest(1, 2))
    for html in (drill_page(sound, drills, 1, ["drill-01.3b", "drill-02.3b"]), answers_page(sound, drills, 1)):
        assert "\u202e" not in html
        assert "\x1b" not in html
        assert open_page(html).page.title().startswith(("Find the fault: <img", "Answers: <img"))


def test_a_change_of_language_keeps_what_was_chosen(open_page: OpenPage) -> None:
    shown = open_page(tasks()).page
    shown.click("#start button")
    answer(shown, 0)
    shown.click(".language")
    assert task(shown).locator(".said").inner_text() == "正确：行和错误都对。"
    assert shown.inner_text("h1") == "找错练习：a <b> part.3b"


def test_the_sheet_of_answers_shows_each_fault_and_what_stood_there(open_page: OpenPage) -> None:
    shown = open_page(answers()).page
    assert shown.locator("section.answered").count() == 4
    for at, drill in enumerate(drills_of_part()):
        section = shown.locator("section.answered").nth(at)
        listed = section.locator("code").all_inner_texts()
        assert listed == [*drill.stands, *drill.was]
