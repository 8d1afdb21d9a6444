"""The replay of an ISO program in a browser: the lines of a subprogram run again, and are marked again."""

import functools
from typing import TYPE_CHECKING

import pytest
from browser import OpenPage
from iso_at_home import ROUNDS
from replayed import recording_of

from sim.show.replay.document import replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

SECOND, THIRD = 5, 8
"""Rows of the arc of the second hole, in the first and in the second call."""


@functools.cache
def rounds_page() -> str:
    return replay_page(recording_of(ROUNDS))


def opened(open_page: OpenPage) -> "Page":
    page = open_page(rounds_page(), 1000, 700).page
    page.evaluate("drycut.player.ready")
    return page


def running(page: "Page") -> str:
    line = page.locator('#program [aria-selected="true"]')
    assert line.count() == 1
    return line.inner_text().split("\n")[-1]


def at(page: "Page", row: int) -> str:
    """The line that is marked while a row runs."""
    page.evaluate(f"drycut.player.seekBlock({row})")
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return running(page)


@pytest.mark.deeper
def test_the_line_of_a_subprogram_is_marked_in_every_call(open_page: OpenPage) -> None:
    page = opened(open_page)
    assert "N120 G03" in at(page, 1)
    assert "N220 G03" in at(page, SECOND)
    assert "N230 G01" in at(page, SECOND + 1)
    assert "N220 G03" in at(page, THIRD)
    assert page.locator("#program .now").inner_text().startswith("N220")


@pytest.mark.deeper
def test_a_click_on_it_leads_to_its_first_call(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.get_by_text("N220 G03 X35000 Y0 I-5000 J0").click()
    assert page.evaluate("drycut.player.state().block") == SECOND
    page.locator("#program .now").filter(has_text="N220").hover()  # marked in the next frame
    assert page.locator("#tip").inner_text().startswith("Block N220 (6 of 10) · arc, counter-clockwise")


@pytest.mark.deeper
def test_words_of_3b_are_not_shown_as_those_of_a_block(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.get_by_text("N220 G03 X35000 Y0 I-5000 J0").hover()
    names = page.locator("#tip dt").all_inner_texts()
    assert names[-1] == "steps counted"
    assert not {"count J", "axis G", "Z"} & set(names)
    assert page.locator("#tip dd").last.inner_text() == "20,000 along Y"
    assert page.locator('.readouts dt:has-text("Count left")').count() == 1
    assert page.locator('[data-out="left"]').inner_text() == "5,000 X"
