"""The workbench in a real browser: one screen with picture, time line, findings and one verdict, at every size."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from axe import needs_axe, violations
from browser import Browsers
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from golden_pictures import assert_golden_screen
from open_tab import Tab, Window, tab, tab_in
from opened_page import OpenedPage, opened_page
from page_checks import complaints
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

SQUARE = "B3000B0B3000GXL1\nB0B2000B2000GYL2\nB3000B0B3000GXL3\nB0B2000B2000GYL4\nDD\n"
KEYHOLE = ROOT / "scenarios" / "keyhole" / "program.3b"
SIZES = ((1280, 800), (1920, 1080))


@pytest.fixture(name="square", scope="module")
def served_square(tmp_path_factory: pytest.TempPathFactory) -> Iterator[OpenedPage]:
    file = tmp_path_factory.mktemp("bench") / "square.3b"
    file.write_text(SQUARE, "utf-8")
    with opened_page(file) as served:
        yield served


@pytest.fixture(name="empty", scope="module")
def served_nothing() -> Iterator[OpenedPage]:
    with opened_page() as served:
        yield served


def box_of(page: "Page", selector: str) -> dict[str, float]:
    box = page.locator(selector).bounding_box()
    assert box is not None
    return dict(box)


def reading(shown: Tab, name: str) -> str:
    return shown.page.inner_text(f"#reading-{name}")


def reads(shown: Tab, name: str, text: str) -> None:
    """Wait for the frame in which a reading begins with a text."""
    shown.page.wait_for_function(
        "([name, text]) => document.querySelector(`#reading-${name}`).textContent.startsWith(text)", arg=[name, text]
    )


@pytest.mark.deeper
@pytest.mark.parametrize(("width", "height"), SIZES)
def test_the_picture_is_the_room_and_the_verdict_is_read_from_afar(
    browsers: Browsers, square: OpenedPage, width: int, height: int
) -> None:
    with tab(browsers, square.address, width, "zh") as shown:
        shown.page.set_viewport_size({"width": width, "height": height})
        shown.waits_for("pass")
        assert box_of(shown.page, "#picture")["height"] >= height * 2 / 3
        verdict = shown.page.locator("#counts")
        assert verdict.inner_text() == "通过"
        assert float(verdict.evaluate("shown => parseFloat(getComputedStyle(shown).fontSize)")) >= 40.0
        for part in ("#counts", "#start", "#bar", "#found", "#readings"):
            box = box_of(shown.page, part)
            assert box["y"] + box["height"] <= height, part
        assert shown.page.evaluate("document.documentElement.scrollHeight") <= height
        assert complaints(shown.page) == []


def test_a_path_plays_at_the_feeds_without_a_run(browsers: Browsers, square: OpenedPage) -> None:
    with tab(browsers, square.address) as shown:
        shown.waits_for("pass")
        # 10 mm by the feeds of the default machine in 40 mm: 105 mm² a minute, so 2.625 mm.
        assert reading(shown, "remaining") == "03:48.57"
        assert reading(shown, "cut") == "0.000 / 10.000 mm · 0 %"
        shown.page.click("[data-do=blockOn]")
        shown.page.click("[data-do=blockOn]")
        reads(shown, "cut", "5.000 / 10.000 mm · 50 %")
        reads(shown, "remaining", "01:54.28")
        shown.page.click("#bar", position={"x": box_of(shown.page, "#bar")["width"] * 0.75, "y": 10})
        reads(shown, "cut", "7.5")
        done = float(reading(shown, "cut").split()[0])
        shown.page.click("[data-do=toggle]")
        shown.page.wait_for_function(
            "before => parseFloat(document.querySelector('#reading-cut').textContent) > before", arg=done
        )
        shown.page.click("[data-do=toggle]")


def test_code_and_picture_follow_each_other(browsers: Browsers, square: OpenedPage) -> None:
    line = "() => new DOMMatrix(getComputedStyle(document.querySelector('#running-line')).transform).f / 20 + 1"
    with tab(browsers, square.address) as shown:
        shown.waits_for("pass")
        assert shown.page.locator("#running-line").is_hidden()
        shown.page.click("[data-do=blockOn]")
        shown.page.wait_for_function(f"() => ({line})() === 2")
        shown.page.click("#text", position={"x": 60, "y": 70})
        shown.page.wait_for_function(f"() => ({line})() === 4")
        reads(shown, "cut", "8.000 /")
        box = box_of(shown.page, "#picture")
        shown.page.mouse.move(box["x"] + 30, box["y"] + 30)
        assert re.fullmatch(r"X -?\d+\.\d{3}  Y -?\d+\.\d{3}", reading(shown, "cursor"))
        shown.page.mouse.move(*edge_of(shown.page))
        assert shown.page.inner_text("#hover") == "Block 3 (3 of 4) · line · 3.000 mm"


def edge_of(page: "Page") -> tuple[float, float]:
    """A place on the upper edge of the square of 3 mm by 2 mm, which is fitted into the picture."""
    box = box_of(page, "#picture")
    room = box["height"] - 74.0
    scale = min(box["width"] / 3.0, room / 2.0) * (1.0 - 2.0 * 0.07)
    return box["x"] + box["width"] / 2.0 + scale * 0.7, box["y"] + 40.0 + room / 2.0 - scale


@pytest.mark.deeper
def test_a_run_takes_the_place_of_the_path_and_its_verdict_is_the_one(browsers: Browsers, tmp_path: Path) -> None:
    dxf = drawn(tmp_path, lambda space: space.add_circle((0.0, 0.0), 3.0))
    with opened_page() as served, tab(browsers, served.address) as shown:
        shown.page.set_input_files("#pick", dxf)
        shown.page.wait_for_selector("#drawing:not([hidden])")
        shown.page.fill("#text", "B3000B0B3000GXL1\nB3000B0B12000GYNR1\nB3000B0B3000GXL3\nDD\n")
        shown.waits_for("pass")
        shown.page.click("#start")
        shown.waits_for("fail")
        assert shown.page.inner_text("#counts") == "fail"
        codes = shown.codes()
        assert codes
        assert shown.page.inner_text("#found-count") == f"({len(codes)})"
        assert shown.page.locator("#tab-findings").get_attribute("aria-selected") == "true"
        assert shown.page.locator("#lines .error").count() > 0
        shown.page.wait_for_selector("[data-of-run]:visible")
        assert shown.page.locator("#finding-marks .mark").count() > 0
        shown.page.click("[data-do=toEnd]")
        reads(shown, "cut", "24.850 / 24.850 mm · 100 %")
        shown.page.fill("#text", SQUARE)
        shown.waits_for("pass")
        shown.page.wait_for_selector("[data-of-feeds]:visible")


def test_all_certain_mends_are_made_at_one_click_and_can_be_undone(browsers: Browsers, empty: OpenedPage) -> None:
    wrong = "B9900B0B9900GXL1\nB9900B0B39600GXNR1\nB9900B0B39600GXNR1\nDD\n"
    with tab(browsers, empty.address) as shown:
        shown.page.fill("#text", wrong)
        shown.waits_for("fail")
        assert shown.page.inner_text("#mend-all") == "Mend all 2"
        shown.page.click("#mend-all")
        shown.page.wait_for_function("() => !document.querySelector('#text').value.includes('39600GX')")
        assert shown.text() == wrong.replace("39600GX", "39600GY")
        shown.waits_for("pass")
        assert shown.page.locator("#mend-all").is_hidden()
        shown.page.keyboard.press("Control+z")
        shown.page.wait_for_function("() => document.querySelector('#text').value.includes('39600GX')")


@pytest.mark.deeper
@pytest.mark.parametrize(
    ("lang", "said"), [("en", "J counts the steps on one axis only"), ("zh", "J 只数一个轴的步数")]
)
def test_each_finding_has_the_page_of_its_code_in_place(
    browsers: Browsers, empty: OpenedPage, lang: str, said: str
) -> None:
    with tab(browsers, empty.address, lang=lang) as shown:
        shown.page.fill("#text", "B9900B0B39600GXNR1\nDD\n")
        shown.waits_for("fail")
        shown.page.wait_for_selector("#bar")  # it comes a moment later, and would take the focus away
        page = shown.page.locator("#found details")
        assert page.locator("p").first.is_hidden()
        page.locator("summary").click()
        assert page.locator("p").first.inner_text().startswith(said)
        assert "--fix" in page.locator("code").all_inner_texts()
        assert complaints(shown.page) == []


def test_an_empty_page_invites_and_nothing_is_red(browsers: Browsers, empty: OpenedPage) -> None:
    with tab(browsers, empty.address, lang="zh") as shown:
        assert shown.page.locator("#begin").is_visible()
        assert shown.page.inner_text("#counts") == "–"
        assert shown.page.get_attribute("#counts", "class") == ""
        assert shown.page.locator("#found li").count() == 0
        assert shown.page.inner_text("#status") == ""
        for name, verdict in (("sound", "pass"), ("broken", "fail")):
            shown.page.click(f"[data-start={name}]")
            shown.waits_for(verdict)
            assert shown.page.locator("#begin").is_hidden()
            shown.page.fill("#text", "")
            shown.page.locator("#begin").wait_for()
            assert shown.page.get_attribute("#counts", "class") == ""
        shown.page.click("[data-start=drawing]")
        shown.page.wait_for_selector("#drawing:not([hidden])")
        assert shown.page.locator("#begin").is_hidden()
        assert shown.page.locator("#tab-drawing").get_attribute("aria-selected") == "true"


def test_wire_and_gap_give_the_offset_and_the_machine_counts_for_the_check(
    browsers: Browsers, square: OpenedPage
) -> None:
    with tab(browsers, square.address) as shown:
        shown.waits_for("pass")
        shown.page.click("#tab-run")
        assert shown.page.inner_text("#reach") == "0.180 / 2 + 0.010 = 0.100 mm"
        shown.page.fill("input[name=wire_mm]", "0，2")
        shown.page.fill("input[name=gap_mm]", "0.015")
        assert shown.page.inner_text("#reach") == "0.200 / 2 + 0.015 = 0.115 mm"
        assert reading(shown, "kerf-half") == "0.115 mm"
        shown.page.fill("input[name=gap_mm]", "-0.05")
        shown.page.fill("input[name=wire_mm]", "0.1")
        assert shown.page.inner_text("#reach") == "0.100 / 2 − 0.050 = 0.000 mm"
        assert shown.page.inner_text("#wrong") == "wire and gap leave no kerf"
        assert shown.page.is_disabled("#start")
        shown.page.fill("input[name=gap_mm]", "")
        shown.page.fill("input[name=wire_mm]", "9")
        assert shown.page.inner_text("#wrong") == "wire diameter mm: 9 is no number from 0.01 to 1"
        names = [name for name in shown.page.locator("[name=machine] option").all_inner_texts() if "*" not in name]
        before = reading(shown, "machine")
        shown.page.select_option("[name=machine]", names[-1])
        shown.page.wait_for_function(
            "was => document.querySelector('#reading-machine').textContent !== was", arg=before
        )


@pytest.mark.deeper
def test_the_picture_refits_when_the_path_leaves_it_unless_it_was_moved(browsers: Browsers, square: OpenedPage) -> None:
    bar = "() => document.querySelector('#hover').textContent"
    large = SQUARE.replace("3000", "9000")
    with tab(browsers, square.address) as shown:
        shown.waits_for("pass")
        at = edge_of(shown.page)
        shown.page.fill("#text", large)
        shown.page.wait_for_function("() => document.querySelector('#size').textContent.includes('9.000')")
        shown.page.mouse.move(*at)
        assert shown.page.evaluate(bar) == "", "what was the edge lies elsewhere"
        shown.page.mouse.wheel(0, -400)
        shown.page.fill("#text", large.replace("9000", "30000"))
        shown.page.wait_for_function("() => document.querySelector('#size').textContent.includes('30.000')")
        first = shown.page.evaluate("() => document.querySelector('#picture').toDataURL()")
        shown.page.click("#fit")
        shown.page.wait_for_function("was => document.querySelector('#picture').toDataURL() !== was", arg=first)


@pytest.mark.alike(1)
@needs_axe
@pytest.mark.parametrize(("width", "lang"), [(1280, "en"), (390, "zh")])
def test_axe_has_nothing_against_any_tab(browsers: Browsers, square: OpenedPage, width: int, lang: str) -> None:
    with tab(browsers, square.address, width, lang) as shown:
        shown.waits_for("pass")
        for name in ("findings", "drawing", "run", "versions", "files"):
            shown.page.click(f"#tab-{name}")
            assert violations(shown.page) == [], name


@pytest.mark.deeper
def test_the_keyboard_alone_plays_and_changes_tabs(browsers: Browsers, square: OpenedPage) -> None:
    with tab(browsers, square.address) as shown:
        shown.waits_for("pass")
        shown.page.focus("#picture")
        shown.page.keyboard.press("ArrowDown")
        reads(shown, "cut", "3.000 /")
        shown.page.keyboard.press("End")
        reads(shown, "cut", "10.000 / 10.000 mm · 100 %")
        shown.page.focus("#tab-findings")
        shown.page.keyboard.press("ArrowRight")
        assert shown.page.locator("#panel-drawing").is_visible()


def test_the_workbench_in_chinese_is_the_golden_one(browsers: Browsers) -> None:
    with opened_page(KEYHOLE) as served, tab_in(browsers, served.address, Window(lang="zh", is_golden=True)) as shown:
        shown.waits_for("pass")
        shown.page.focus("#picture")
        shown.page.keyboard.press("ArrowDown")
        reads(shown, "cut", "24.900 /")
        assert_golden_screen(shown.page, "workbench-zh.png")


def test_the_plan_of_a_drawing_in_chinese_is_the_golden_one(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    with tab_in(browsers, empty.address, Window(lang="zh", scheme="dark", is_golden=True)) as shown:
        shown.page.set_input_files("#pick", drawn(tmp_path, plate))
        shown.page.locator("#drawing-told li").wait_for()
        shown.page.locator("#drawing-told li", has_text="227.642 mm").wait_for()
        shown.page.fill("#order", "2")
        with shown.page.expect_response("**/plan"):
            shown.page.fill("#passes", "0.12 0.1")
        shown.page.locator("#drawing-told li", has_text="454.874 mm").wait_for()
        shown.page.evaluate("() => new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn)))")
        assert_golden_screen(shown.page, "workbench-plan-dark-zh.png")


@pytest.mark.alike(4)
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("lang", ["en", "zh"])
@pytest.mark.parametrize(("width", "height"), [*SIZES, (390, 844)])
def test_the_way_of_a_user_by_the_keyboard_alone(  # noqa: PLR0917 - a window's sides and moods
    browsers: Browsers, tmp_path: Path, width: int, height: int, lang: str, scheme: str
) -> None:
    """Opened, seen, played, mended, run, its verdict read without scrolling, saved."""
    wrong = "B900B0B900GXL1\nB900B0B3600GXNR1\nB900B0B3600GXNR1\nDD\n"
    file = tmp_path / "part.3b"
    file.write_text(wrong)
    with opened_page() as served, tab_in(browsers, served.address, Window(width, height, lang, scheme)) as shown:
        page = shown.page

        def press(selector: str) -> None:
            page.focus(selector)
            page.keyboard.press("Enter")

        blank = page.evaluate("() => document.querySelector('#picture').toDataURL()")
        with page.expect_file_chooser() as chooser:
            press("#open")
        chooser.value.set_files(file)
        shown.waits_for("fail")
        assert page.evaluate("() => document.querySelector('#picture').toDataURL()") != blank
        assert shown.codes()
        press("[data-do=toggle]")
        page.wait_for_function("() => !document.querySelector('#reading-cut').textContent.startsWith('0.000')")
        press("#mend-all")
        shown.waits_for("pass")
        assert shown.text() == wrong.replace("3600GX", "3600GY")
        press("#start")
        page.wait_for_selector("[data-of-run]:visible")
        shown.waits_for("pass")
        at = box_of(page, "#counts")
        assert page.evaluate("() => window.scrollY") == 0
        assert at["y"] >= 0.0
        assert at["y"] + at["height"] <= height
        with page.expect_download() as saved:
            press("#save")
        assert Path(saved.value.path()).read_text() == shown.text()
        assert complaints(page) == []


@needs_axe
def test_axe_has_nothing_against_a_plan(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    with tab(browsers, empty.address) as shown:
        shown.page.set_input_files("#pick", drawn(tmp_path, plate))
        shown.page.locator("#drawing-told li", has_text="Plan").wait_for()
        assert violations(shown.page) == []


def plate(space: Modelspace) -> None:
    """A plate with a slot and two holes."""
    space.add_lwpolyline([(0, 0), (40, 0), (40, 20), (0, 20)], close=True)
    space.add_lwpolyline([(12, 6), (28, 6), (28, 14), (12, 14)], close=True)
    for x in (6, 34):
        space.add_circle((x, 10), 3)
