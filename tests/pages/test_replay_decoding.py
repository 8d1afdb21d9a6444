"""How blocks are decoded, in the replay's page: the course's example as it runs, in both languages, and none of 3B."""

import functools
from typing import TYPE_CHECKING

import page_checks
import pytest
from browser import OpenPage
from replayed import recording_of
from runs import plain_scenario

from parser.dialect.reader import Choices
from parser.program import parse_program
from sim.base.progress import silent
from sim.run.recording import recorded
from sim.show.replay.document import replay_document, replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

COURSE = "G92 X0.72 Y0.48\nN06 G90 G41 D11 G01 X2.00 Y3.00 F200 ;\nN07 X2.50\nN08 G40 X3.00\nM02\n"
CHOICES = Choices(dialect="classroom", registers=(("D11", 100.0),))


@functools.cache
def page_of_course() -> str:
    with recorded(parse_program(COURSE, "course.iso", choices=CHOICES), plain_scenario(), silent) as recording:
        return replay_page(recording)


def opened(open_page: OpenPage, **how: object) -> "Page":
    shown = open_page(page_of_course(), 1000, 700, **how).page
    shown.evaluate("drycut.player.ready")
    shown.click("#tab-decoding")
    return shown


def shown_at(page: "Page", row: int) -> str:
    page.evaluate("(row) => drycut.player.seekBlock(row)", row)
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    text: str = page.locator("#decoding").inner_text()
    return text


def test_the_words_of_the_running_block_are_shown_with_their_fields(open_page: OpenPage) -> None:
    page = opened(open_page)
    text = shown_at(page, 0)

    assert page.locator("#decoding tr").count() == 9
    assert page.locator("#decoding tr").nth(3).inner_text().split() == ["④", "D11", "D", "11"]
    assert "G0=0x42 (01000010)" in text
    assert "P′ (G41, left) (1.9108, 3.0453)" in text


def test_the_next_block_takes_the_place_of_the_last(open_page: OpenPage) -> None:
    page = opened(open_page)
    shown_at(page, 0)

    assert "N07 X2.50" in shown_at(page, 1)
    assert "N06" not in shown_at(page, 1)


def test_a_chinese_page_says_it_in_chinese(open_page: OpenPage) -> None:
    page = opened(open_page, lang="zh")

    assert page.locator("#tab-decoding").inner_text() == "译码"
    assert "刀补建立" in shown_at(page, 0)


@pytest.mark.deeper
def test_the_page_has_names_and_room_for_all_of_it(open_page: OpenPage) -> None:
    page = opened(open_page)
    shown_at(page, 0)

    assert page_checks.complaints(page) == []


def test_a_program_in_3b_has_nothing_to_be_decoded_word_by_word() -> None:
    assert replay_document(recording_of("B1000 B0 B1000 GX L1\nDD\n"))["decoding"] is None
