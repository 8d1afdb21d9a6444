"""The page of a shop in a browser: search, filter, sort and turn; both languages, dark, phone, paper."""

import pytest
from browser import OpenPage
from index_pages import SQUARE, entry, shop_page
from page_checks import complaints

from sim.jobs.index import Row, build_index
from sim.show.index_page import BesideTheIndex, index_page
from sim.show.texts.phrases import same


@pytest.mark.alike(1)
@pytest.mark.parametrize(("lang", "dark"), [("en", True), ("zh", False)])
def test_the_page_offers_anyone_what_pages_must(open_page: OpenPage, lang: str, dark: bool) -> None:
    shown = open_page(shop_page(8), lang=lang, dark=dark).page
    assert complaints(shown) == []


def test_search_and_choices_leave_what_fits_and_heads_sort_it(open_page: OpenPage) -> None:
    shown = open_page(shop_page(3000)).page
    rows = shown.locator("tbody tr")
    assert rows.count() == 200
    assert shown.inner_text("#shown") == "3,000 of 3,000 programs"
    shown.fill("#search", "PART-29 no")
    assert shown.inner_text("#shown") == "25 of 3,000 programs"
    shown.fill("#search", "")
    shown.select_option("#verdict", "fail")
    assert shown.inner_text("#shown") == "750 of 3,000 programs"
    shown.click("th.findings button")
    assert rows.first.locator(".codes").inner_text() == "3B301 ×2999 3B405"
    shown.click("th.time button")
    shown.click("th.time button")
    assert shown.get_attribute("th.time", "aria-sort") == "ascending"
    assert rows.first.locator(".time").inner_text() == "0:01:02"
    shown.select_option("#verdict", "")
    shown.select_option("#code", "3B405")
    shown.get_by_role("button", name="Last", exact=True).click()
    assert shown.inner_text(".count") == "rows 601–750 of 750"


def test_what_failed_stands_first_with_how_far_it_is_off_the_drawing(open_page: OpenPage) -> None:
    shown = open_page(shop_page(8)).page
    words = shown.locator("tbody .word").all_inner_texts()
    assert words == ["fail"] * 2 + ["cannot be run"] * 2 + ["pass"] * 4
    assert shown.locator("tbody td.worst").first.inner_text().split("\n") == ["87.25 µm", "from the drawing"]
    assert shown.locator("tbody td.worst").last.inner_text() == "5.50 µm"
    head = shown.locator("thead tr").bounding_box()
    assert head is not None
    assert head["height"] < 70.0, "one line, and the unit below"


@pytest.mark.parametrize("lang", ["en", "zh"])
def test_no_word_of_the_head_is_broken_where_a_long_message_takes_room(open_page: OpenPage, lang: str) -> None:
    refused = entry(3)
    refused = refused._replace(
        row=refused.row._replace(message=same("文件里没有程序段；控制器读不进去，或读入后没有动作" * 4))
    )
    entries = [entry(0), entry(2), refused]
    additions = [BesideTheIndex(each.row.picture, each.row.message) for each in entries]
    shown = open_page(index_page(build_index(entries), additions), lang=lang, shipped_font=True).page
    lines = shown.evaluate(
        """() => [...document.querySelectorAll("thead th span")].filter((span) => !span.children.length)
          .map((span) => [...span.getClientRects()].length).filter(Boolean)"""
    )
    assert lines == [1] * len(lines)
    assert len(lines) > 5


def test_links_lead_to_the_files_of_each_program(open_page: OpenPage) -> None:
    shown = open_page(shop_page(8)).page
    assert shown.locator("a.file").first.get_attribute("href") == "00/part%20%232%25.3b/report.html"
    assert shown.locator("tr.refused a").count() == 0


def test_the_replay_stands_below_the_name_also_where_a_program_has_no_title(open_page: OpenPage) -> None:
    alone = entry(0)._replace(row=Row("pass", same("part-0000.3b"), time_s=60.0, max_um=0.5, picture=SQUARE))
    shown = open_page(index_page(build_index([alone]), [BesideTheIndex(SQUARE, alone.row.message)])).page
    assert shown.locator("tbody .title").count() == 0
    name, replay = (shown.locator(f"tbody a.{each}").bounding_box() for each in ("file", "replay"))
    assert name is not None
    assert replay is not None
    assert replay["y"] >= name["y"] + name["height"]


def test_a_title_is_shown_in_the_language_of_the_page_and_found_in_both(open_page: OpenPage) -> None:
    shown = open_page(shop_page(4)).page
    assert shown.locator("tbody tr").count() == 4
    shown.fill("#search", "零件")
    assert sorted(shown.locator("tbody .title").all_inner_texts()) == ["Part 0", "Part 1", "Part 2"]
    shown.click(".language")
    assert sorted(shown.locator("tbody .title").all_inner_texts()) == ["零件 0", "零件 1", "零件 2"]


def test_a_change_of_language_keeps_what_was_asked(open_page: OpenPage) -> None:
    shown = open_page(shop_page(8)).page
    shown.select_option("#verdict", "refused")
    shown.click(".language")
    assert shown.input_value("#verdict") == "refused"
    assert shown.locator("tbody .message").first.inner_text() == "第 3 个文件没有程序段"
    shown.fill("#search", "没有程序段 7")
    assert shown.locator("tbody tr").count() == 1
    shown.fill("#search", "nothing like this")
    assert shown.inner_text(".none") == "没有符合条件的程序。"


def test_a_shop_without_programs_says_so(open_page: OpenPage) -> None:
    assert open_page(shop_page(0)).page.inner_text(".none") == "There is no program."


def test_on_paper_stand_rows_and_no_controls(open_page: OpenPage) -> None:
    shown = open_page(shop_page(30)).page
    shown.emulate_media(media="print")
    assert shown.locator("tbody tr:visible").count() == 30
    assert shown.locator("form:visible, .language:visible").count() == 0
