"""The page of drycut open in a real browser: a program comes in, is seen, edited, mended and saved."""

import json
import math
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from axe import needs_axe, violations
from browser import Browsers
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from open_tab import places_of, planned, tab
from opened_page import OpenedPage, Recorder, opened_page
from page_checks import complaints
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

WRONG = "B9900B0B39600GXNR1\nDD\n"
KEYHOLE = ROOT / "scenarios" / "keyhole" / "program.3b"
PUNCH = """B0B900B900GYL4
B10100B0B10100GXL1
B0B10200B10200GYL4
B20200B0B20200GXL3
B0B10200B10200GYL2
B10100B0B10100GXL1
B0B900B900GYL2
DD
"""
MARKUP = '<img src=x onerror="document.title=1"><script>document.title=2</script>'


# A server has no more of a page than its last run: tests of pages share it.
@pytest.fixture(name="served", scope="module")
def served_wrong(tmp_path_factory: pytest.TempPathFactory) -> Iterator[OpenedPage]:
    file = tmp_path_factory.mktemp("open") / "part.3b"
    file.write_bytes(WRONG.replace("\n", "\r\n").encode())
    with opened_page(file) as served:
        yield served


@pytest.fixture(name="keyhole", scope="module")
def served_keyhole() -> Iterator[OpenedPage]:
    with opened_page(KEYHOLE) as served:
        yield served


@pytest.fixture(name="empty", scope="module")
def served_nothing() -> Iterator[OpenedPage]:
    with opened_page() as served:
        yield served


@pytest.mark.deeper
def test_a_program_shows_at_once(browsers: Browsers, keyhole: OpenedPage) -> None:
    with tab(browsers, keyhole.address) as shown:
        shown.waits_for("pass")
        assert shown.page.title() == "program.3b · drycut"
        assert "174.800 × 99.799 mm" in shown.page.inner_text("#size")
        assert shown.page.locator("#figures tr").all_inner_texts() == ["1\tN1 – N6\t0.000, 0.000\t502.929\tclosed"]
        assert shown.page.inner_text("#lines div:first-child") == "1"
        drawn = shown.page.evaluate(
            "() => new Set(document.querySelector('#picture').getContext('2d').getImageData(0, 0, 800, 400).data).size"
        )
        assert drawn > 3


@pytest.mark.deeper
def test_a_file_leads_the_browser_to_the_page(browsers: Browsers, tmp_path: Path) -> None:
    recorder = Recorder(tmp_path)
    with opened_page(KEYHOLE, browser=recorder.program) as served, tab(browsers, served.address) as shown:
        shown.page.goto(recorder.heard())
        shown.page.wait_for_url(served.address)
        shown.waits_for("pass")
        shown.asked.remove(recorder.heard())


@pytest.mark.deeper
@needs_axe
@pytest.mark.parametrize("lang", ["en", "zh"])
def test_axe_has_nothing_against_the_page(browsers: Browsers, keyhole: OpenedPage, lang: str) -> None:
    with tab(browsers, keyhole.address, lang=lang) as shown:
        shown.waits_for("pass")
        assert violations(shown.page) == []


def test_a_mend_shows_what_it_changes_is_made_and_is_undone(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as shown:
        shown.waits_for("fail")
        assert shown.codes() == ["3B204"]
        assert shown.page.inner_text("#found .diff").split() == ["B9900B0B39600GXNR1", "B9900B0B39600GYNR1"]
        shown.page.click("#found .go")
        assert shown.selected() == "GX"
        shown.page.click("#found li > button:not(.go)")
        shown.waits_for("pass")
        assert shown.text() == WRONG.replace("GX", "GY")
        shown.page.keyboard.press("Control+z")
        shown.waits_for("fail")
        assert shown.text() == WRONG


def test_it_checks_while_one_types(browsers: Browsers, empty: OpenedPage) -> None:
    with tab(browsers, empty.address) as shown:
        shown.page.fill("#text", "B9900B0B39600GYNR1\nDD\n")
        shown.waits_for("pass")
        shown.page.press("#text", "Control+Home")
        shown.page.keyboard.type("B1B")
        shown.waits_for("fail")
        assert shown.page.locator("#lines .error").first.inner_text() == "1"


@pytest.mark.deeper
def test_what_is_typed_before_the_page_has_its_first_answer_stays(browsers: Browsers, empty: OpenedPage) -> None:
    with tab(browsers, empty.address) as shown:
        shown.page.route("**/first", lambda route: (shown.page.wait_for_timeout(500), route.continue_()))
        shown.page.goto(empty.address, wait_until="commit")
        shown.page.fill("#text", "B9900B0B39600GYNR1\nDD\n")
        shown.waits_for("pass")
        shown.page.wait_for_timeout(800)
        assert shown.text().startswith("B9900")


def test_files_are_dropped_and_saved_as_they_came(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    data = "B100B0B100GXL1 //孔\r\nB100B0B100GXL3\r\nDD\r\n".encode("gbk")
    (tmp_path / "孔.3b").write_bytes(data)
    with tab(browsers, empty.address) as shown:
        shown.page.set_input_files("#pick", str(tmp_path / "孔.3b"))
        shown.page.wait_for_function("() => document.title.startsWith('孔.3b')")
        with shown.page.expect_download() as coming:
            shown.page.click("#save")
        assert coming.value.suggested_filename == "孔.3b"
        assert Path(coming.value.path()).read_bytes() == data
        shown.drops("other.3b", WRONG)
        shown.page.wait_for_function("() => document.title.startsWith('other.3b')")
        shown.waits_for("fail")


def test_a_text_without_a_name_is_saved_under_that_of_its_language(browsers: Browsers, empty: OpenedPage) -> None:
    with tab(browsers, empty.address) as shown:
        shown.page.fill("#text", "G90 G21\nG92 X0 Y0\nG01 X1. Y0\nG01 X0 Y0\nM02\n")
        shown.waits_for("pass")
        with shown.page.expect_download() as coming:
            shown.page.click("#save")
        assert coming.value.suggested_filename == "program.iso"


def test_what_a_program_and_its_name_say_is_never_markup(browsers: Browsers, empty: OpenedPage) -> None:
    with tab(browsers, empty.address) as shown:
        shown.drops(f"{MARKUP}.3b", f"B1{MARKUP}\n{WRONG}")
        # The page that still holds nothing shows an error too (3B100), so the name says that this program is shown.
        shown.page.wait_for_function("() => document.title.startsWith('<img src=x')")
        shown.page.wait_for_selector("#found .error")
        assert shown.page.locator("main img, header img, main script").count() == 0
        assert MARKUP in shown.text()


def test_a_block_in_the_picture_is_its_line(browsers: Browsers, keyhole: OpenedPage) -> None:
    with tab(browsers, keyhole.address) as shown:
        shown.waits_for("pass")
        box = shown.page.locator("#picture").bounding_box()
        assert box is not None
        # N3 is the lower edge, from (0, -24.9) to (56.757, -24.9); the path lies from -24.9 to 149.9 across.
        shown.page.mouse.click(box["x"] + box["width"] * 0.33, box["y"] + box["height"] * 0.665)
        assert shown.selected().startswith("N3:") or "56757" in shown.selected()
        assert shown.page.inner_text("#lines .now") == "3"


@pytest.mark.deeper
def test_two_tabs_are_two_programs(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as one, tab(browsers, served.address) as other:
        one.waits_for("fail")
        other.page.fill("#text", WRONG.replace("GX", "GY"))
        other.waits_for("pass")
        assert one.codes() == ["3B204"]
        assert one.text() == WRONG


@pytest.mark.deeper
def test_a_large_program_is_shown_and_stays_in_hand(browsers: Browsers, tmp_path: Path) -> None:
    square = "B1000B0B1000GXL1\nB0B1000B1000GYL2\nB1000B0B1000GXL3\nB0B1000B1000GYL4\nD\nB1500B0B1500GXL1\nD\n"
    (tmp_path / "many.3b").write_text(f"{square * 4000}DD\n", "utf-8")
    with opened_page(tmp_path / "many.3b") as served, tab(browsers, served.address) as shown:
        shown.page.wait_for_function("() => document.querySelector('#counts').className !== ''")
        assert shown.page.locator("#lines div").count() < 80, "only what shows has its number"
        assert shown.page.locator("#figures tr").count() == 200
        shown.page.press("#text", "Control+End")
        shown.page.wait_for_function("() => Number(document.querySelector('#lines .now')?.textContent) > 27000")


@pytest.mark.deeper
def test_the_button_ends_it_and_an_ended_server_is_told(browsers: Browsers) -> None:
    with opened_page(KEYHOLE) as served, tab(browsers, served.address) as shown:
        shown.waits_for("pass")
        shown.page.click("#close")
        shown.page.wait_for_function("() => document.querySelector('#status').textContent.includes('has ended')")
        assert served.ended() == 0
        shown.page.fill("#text", "DD\n")
        shown.page.wait_for_function("() => document.querySelector('#status').textContent.includes('does not answer')")
        shown.found[:] = [text for text in shown.found if "ERR_CONNECTION_REFUSED" not in text]


@pytest.mark.alike(1)
@pytest.mark.parametrize(("widths", "lang"), [((390, 1280), "zh"), ((800, 390), "en")])
def test_nothing_runs_out_of_the_window(
    browsers: Browsers, served: OpenedPage, widths: tuple[int, ...], lang: str
) -> None:
    with tab(browsers, served.address, widths[0], lang) as shown:
        shown.waits_for("fail")
        for width in widths:
            shown.page.set_viewport_size({"width": width, "height": 800})
            assert shown.page.evaluate("() => document.documentElement.scrollWidth") <= width
        assert shown.page.locator("#found .go strong").inner_text() == (
            "计数方向选错" if lang == "zh" else "wrong count axis"
        )


def test_a_program_is_run_and_its_files_are_seen_and_saved(browsers: Browsers, keyhole: OpenedPage) -> None:
    with tab(browsers, keyhole.address) as shown:
        shown.waits_for("pass")
        shown.page.click("#tab-run")
        shown.page.fill("input[name=thickness_mm]", "20")
        shown.page.wait_for_function("() => document.querySelector('#size').textContent.includes('in 20 mm')")
        shown.page.click("#start")
        shown.page.wait_for_selector("#looks button")
        assert shown.page.inner_text("#stage") == "run on DK7740 class, stepper drives"
        assert shown.page.locator("#looks button").all_inner_texts() == ["Replay", "Report"]
        assert shown.page.locator("#thumbs button").all_inner_texts() == ["the path as it will be cut"]
        names = ["cut.png", "replay.html", "report.html", "report.json"]
        assert shown.page.locator("#files a").all_inner_texts() == names
        assert natural_width(shown.page, "#thumbs img") == 1600
        assert complaints(shown.page) == []
        with shown.page.expect_download() as coming:
            shown.page.click("#all")
        assert coming.value.suggested_filename == "program.3b.zip"
        with zipfile.ZipFile(coming.value.path()) as archive:
            assert archive.namelist() == names
            assert archive.testzip() is None
        before = shown.text()
        shown.page.fill("#text", WRONG)
        shown.page.wait_for_function("() => document.querySelector('#stage').textContent.includes('another one now')")
        shown.page.fill("#text", before)
        shown.page.wait_for_function("() => !document.querySelector('#stage').textContent.includes('another one now')")


@pytest.mark.deeper
def test_replay_and_film_are_seen_in_the_page_and_the_replay_may_ask_nobody(
    browsers: Browsers, served: OpenedPage
) -> None:
    with tab(browsers, served.address, lang="zh") as shown:
        shown.page.fill("#text", "B100B0B100GXL1\nB100B0B100GXL3\nDD\n")
        shown.waits_for("pass")
        shown.page.click("#start")
        shown.page.click("#looks button")
        shown.page.frame_locator("#viewer iframe").locator("canvas").first.wait_for()
        framed = shown.page.frames[-1]
        assert framed.evaluate("() => window.origin") == "null", "it is of no origin"
        asks = "() => fetch('../../first', {method: 'POST'}).then(() => 1, () => 0)"
        assert framed.evaluate(asks) == 0
        assert framed.evaluate("() => { try { return !!window.parent.document; } catch { return false; } }") is False
        with shown.page.context.expect_page() as coming:
            shown.page.click("#beside")
        coming.value.wait_for_load_state()
        assert coming.value.evaluate(asks) == 0
        coming.value.close()
        shown.page.click("#unview")
        shown.page.wait_for_selector("#viewer iframe", state="detached")
        shown.found[:] = [text for text in shown.found if "Content Security Policy" not in text]
        shown.page.fill("#seconds", "0.5")
        shown.page.click("#film")
        shown.page.click(".thumb:has(img[src*='film.webp'])")
        assert shown.page.inner_text("#viewing") == "动画"
        assert natural_width(shown.page, "#viewed img") == 960
        shown.page.click("#unview")
        shown.page.click("#drill")
        shown.page.get_by_role("button", name="找错练习", exact=True).click()
        framed = shown.page.frame_locator("#viewer iframe")
        framed.locator("form.aside-now").first.wait_for(state="attached")
        framed.locator("#start button").press("Enter")  # while the page still shifts, a click falls beside it
        assert framed.locator("h2:visible").first.inner_text().startswith("第 1 题"), "forms work in the frame"


def natural_width(page: "Page", selector: str) -> int:
    """Width of a picture as it came, px: 0 of one that the page was not let load."""
    page.wait_for_function("(at) => document.querySelector(at).complete", arg=selector)
    return page.eval_on_selector(selector, "(shown) => shown.naturalWidth")


@pytest.mark.deeper
def test_a_run_is_cancelled_and_another_one_begun(browsers: Browsers, tmp_path: Path) -> None:
    square = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\n"
    (tmp_path / "long.3b").write_text(f"{square * 40}DD\n", "utf-8")
    with opened_page(tmp_path / "long.3b") as served, tab(browsers, served.address) as shown:
        shown.page.click("#start")
        shown.page.wait_for_function("() => document.querySelector('#progress').value > 0")
        shown.page.click("#cancel")
        shown.page.wait_for_function("() => document.querySelector('#stage').textContent === 'cancelled'")
        assert shown.page.locator("#files a").count() == 0
        shown.page.fill("#text", f"{square}DD\n")
        shown.page.click("#tab-run")
        shown.page.fill("input[name=thickness_mm]", "a lot")
        assert shown.page.inner_text("#wrong") == "thickness mm: a lot is no number from 0.01 to 2000"
        assert shown.page.is_disabled("#start")
        shown.page.fill("input[name=thickness_mm]", "20")
        assert shown.page.locator("#wrong").is_hidden()
        assert shown.page.is_enabled("#start")


@pytest.mark.deeper
def test_a_run_waits_until_the_program_has_come(browsers: Browsers, keyhole: OpenedPage) -> None:
    with tab(browsers, keyhole.address) as shown:
        shown.page.route("**/first", lambda route: (shown.page.wait_for_timeout(500), route.continue_()))
        shown.page.reload()
        assert shown.page.input_value("#text") == ""
        shown.page.click("#start")
        assert shown.text() == KEYHOLE.read_text()
        shown.page.click("#cancel")


@pytest.mark.deeper
def test_a_folder_is_listed_and_its_programs_open_by_a_click(browsers: Browsers, tmp_path: Path) -> None:
    (tmp_path / f"{MARKUP.replace('/', '')}.3b").write_text(WRONG)
    (tmp_path / "b.3b").write_text("B1000B0B1000GXL1\nB1000B0B1000GXL3\nDD\n")
    with opened_page(tmp_path) as served, tab(browsers, served.address) as shown:
        rows = shown.page.locator("#programs tbody tr")
        shown.page.wait_for_selector("#programs tbody tr:nth-child(2)")
        assert rows.first.inner_text().split("\t")[-4:] == ["fail", "3B204", "19.800 × 19.800 mm", "62.204 mm"]
        assert shown.page.inner_text("#far") == "2 programs"
        assert shown.page.locator("#programs img").count() == 0
        assert complaints(shown.page) == []
        shown.page.select_option("#wanted", "pass")
        assert rows.count() == 1
        shown.page.select_option("#wanted", "")
        shown.page.fill("#search", "3b204")
        shown.page.click("#programs .go")
        shown.waits_for("fail")
        assert shown.text() == WRONG
        shown.page.click("#to-list")
        shown.page.fill("#search", "b.3b no such")
        assert rows.count() == 0
        shown.drops("d.3b", WRONG)
        shown.page.wait_for_function("() => document.title.startsWith('d.3b')")
        assert shown.page.locator("#list").is_hidden()
        shown.page.click("#to-list")
        (tmp_path / "c.3b").write_text(WRONG)
        shown.page.fill("#search", "c.3b")
        shown.page.click("#again")
        shown.page.click("#programs .go")
        shown.page.wait_for_function("() => document.title.startsWith('c.3b')")


@pytest.mark.deeper
def test_several_files_that_are_dropped_are_a_list(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    (tmp_path / "孔.3b").write_text(WRONG)
    (tmp_path / "b.txt").write_text("hello")
    with tab(browsers, empty.address, 390, "zh") as shown:
        shown.page.set_input_files("#pick", [str(tmp_path / "孔.3b"), str(tmp_path / "b.txt")])
        shown.page.wait_for_selector("#programs tbody tr:nth-child(2)")
        assert shown.page.locator("#programs .word").all_inner_texts() == ["不通过", "不是程序"]
        assert shown.page.evaluate("() => document.documentElement.scrollWidth") <= 390
        shown.page.click("#programs .go")
        shown.waits_for("fail")
        assert shown.page.title().startswith("孔.3b")
        assert shown.text() == WRONG


def shades(page: "Page") -> set[str]:
    """Which of the shades of a comparison are on the picture."""
    page.wait_for_function("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return set(
        page.evaluate(
            """() => {
              const canvas = document.querySelector('#picture');
              const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
              const seen = new Set();
              for (let at = 0; at < data.length; at += 4) seen.add(`${data[at]},${data[at + 1]},${data[at + 2]}`);
              const style = getComputedStyle(canvas);
              return ['--error', '--good'].filter((name) => {
                const hex = style.getPropertyValue(name).trim();
                return seen.has([1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)).join());
              });
            }"""
        )
    )


@pytest.mark.deeper
def test_an_earlier_version_is_seen_beside_the_present_one(browsers: Browsers, tmp_path: Path) -> None:
    square = "B3000B0B3000GXL1\nB0B2000B2000GYL2\nB3000B0B3000GXL3\nB0B2000B2000GYL4\nDD\n"
    wider = square.replace("3000", "4000")
    (tmp_path / "part.3b").write_text(square)
    with opened_page(tmp_path / "part.3b") as served, tab(browsers, served.address) as shown:
        shown.waits_for("pass")
        shown.page.fill("#text", wider)
        shown.page.click("#tab-versions")
        shown.page.select_option("#version", "opened")
        both = shown.page.locator("#both tr.other")
        both.first.wait_for()
        # Cells one by one: a row that is being replaced has no layout, and its text no tabs.
        rows = both.evaluate_all("all => all.map(row => [...row.children].map(cell => cell.textContent).join('\\t'))")
        assert rows == [
            "length of the cut\t10.000 mm\t12.000 mm",
            *[row for row in rows if row.startswith("cutting time")],
            "steps of 1 µm\t10,000\t12,000",
            "extent\t3.000 × 2.000 mm\t4.000 × 2.000 mm",
            "from … to\tX 0.000 … 3.000, Y 0.000 … 2.000 mm\tX 0.000 … 4.000, Y 0.000 … 2.000 mm",
        ]
        assert shown.page.locator("#changes del").all_inner_texts() == ["B3000B0B3000GXL1", "B3000B0B3000GXL3"]
        assert shown.page.locator("#changes ins").all_inner_texts() == ["B4000B0B4000GXL1", "B4000B0B4000GXL3"]
        assert shades(shown.page) == {"--error", "--good"}
        assert complaints(shown.page) == []
        shown.page.click("#changes li:nth-child(2) .go")
        assert shown.selected() == "B4000B0B4000GXL3"
        shown.page.click("#swap")
        shown.page.wait_for_function("() => document.querySelector('#both .other td')?.textContent === '12.000 mm'")
        assert shown.text() == square
        shown.page.fill("#text", wider)
        shown.page.wait_for_selector("#changes .good")
        assert shown.page.locator("#both tr.other").count() == 0
        assert "--error" not in shades(shown.page)
        shown.found[:] = [text for text in shown.found if "readback" not in text]  # of this test, twice


@pytest.mark.deeper
def test_a_second_program_is_compared_with_the_one_that_was_open(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address, lang="zh") as shown:
        shown.waits_for("fail")
        shown.drops("other.3b", WRONG.replace("GX", "GY"))
        shown.waits_for("pass")
        assert shown.page.inner_text("#beside-open") == "与 part.3b 比较"
        shown.page.click("#beside-open")
        shown.page.wait_for_selector("#changes del")
        verdict, findings, _ = shown.page.locator("#both tr.other").all_inner_texts()
        assert (verdict, findings) == ("结论\t不通过\t通过", "问题\t3B204\t–")
        assert shown.page.locator("#beside-open").is_hidden()


def test_the_plan_is_drawn_at_once_and_follows_each_change(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    def plate(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (40, 0), (40, 10), (0, 10)], close=True)
        for x in (8, 20, 32):
            space.add_circle((x, 5), 2.5)

    def lengths() -> float:
        return float(re.findall(r"([\d.]+) mm of way", page.inner_text("#drawing-told"))[0])

    with tab(browsers, empty.address) as shown:
        page = shown.page
        page.set_input_files("#pick", drawn(tmp_path, plate))
        planned(page, "4 figures")
        at, around = places_of(shown), 2.0 * (40.2 + 10.2)  # mm round the plate, a wire of 0.18 mm and its gap outside
        usual = lengths()
        assert usual == pytest.approx(around + 3.8 + 3 * 2.0 * math.pi * 2.4 + 3 * 2 * 2.4, abs=0.01)  # and leads
        page.select_option("#click-does", "order")
        for x in (32, 8):
            page.mouse.click(*at(x, 5))
        assert page.input_value("#order") == "3,1"
        page.mouse.click(*at(32, 2.6))  # on its way, as on its number
        assert page.input_value("#order") == "1"
        page.fill("#order", "4, 1")
        planned(page, "would have fallen with it")
        page.fill("#order", "3")
        planned(page)
        page.select_option("#click-does", "starts")
        with page.expect_response(lambda answer: '"starts":""' not in (answer.request.post_data or "")) as answered:
            page.mouse.click(*at(20, -5))
        path = answered.value.json()["path"]
        assert min(path["place_y_um"]) == pytest.approx(-5000.0, abs=200.0), "the wire is threaded there"
        page.mouse.move(*at(20, -5))
        page.mouse.down()
        seen = set()
        for y in (-4.5, -4.0, -3.5, -3.0):  # the plan is drawn while the mark is dragged
            with page.expect_response("**/plan") as answered:
                page.mouse.move(*at(20, y), steps=2)
            seen.add(round(min(answered.value.json()["path"]["place_y_um"]), -2))
        page.mouse.up()
        assert len(seen) > 1
        page.fill("#starts", "")
        page.select_option("#click-does", "entries")
        with page.expect_response(lambda answer: '"entries":""' not in (answer.request.post_data or "")) as answered:
            page.mouse.click(*at(40, 8))
        path = answered.value.json()["path"]
        edge = [y for x, y in zip(path["place_x_um"], path["place_y_um"], strict=True) if abs(x - 40_100.0) < 1.0]
        assert min(abs(y - 8000.0) for y in edge) < 200.0, "the cut starts there"
        page.fill("#entries", "")
        page.select_option("#wire-side", "outside")
        page.click("#make")
        shown.waits_for("fail")  # all outside: the holes are cut too large
        assert page.locator("#drawing-told li", has_text="Plan").count() == 0, "the program is drawn in its place"


def test_what_is_clicked_in_the_picture_is_cut_alone(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    def two(space: Modelspace) -> None:
        for x in (0, 20):
            space.add_lwpolyline([(x, 0), (x + 4, 0), (x + 4, 4), (x, 4)], close=True)

    with tab(browsers, empty.address) as shown:
        page = shown.page
        page.set_input_files("#pick", drawn(tmp_path, two))
        planned(page)
        at = places_of(shown)
        for x, picked in ((22, 1), (2, 2), (2, 1)):  # a second click on a mark takes it back
            page.mouse.click(*at(x, 2))
            assert len([each for each in page.input_value("#picks").split(";") if each]) == picked
        page.fill("#picks", "2F; 2,2;22, 2")
        page.mouse.click(*at(2, 2))  # a mark that was written goes as one that was clicked
        assert page.input_value("#picks") == "2F; 22, 2"
        page.fill("#picks", "22,2")
        page.click("#make")
        shown.waits_for("pass")
        assert "not picked" in page.inner_text("#drawing-told")
        page.click("#away")
        assert page.input_value("#picks") == ""


def test_a_click_sets_a_thread_point_where_it_is_to(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    def plate(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (20, 0), (20, 10), (0, 10)], close=True)
        space.add_lwpolyline([(4, 2), (16, 2), (16, 8), (4, 8)], close=True)

    with tab(browsers, empty.address) as shown:
        page = shown.page
        page.set_input_files("#pick", drawn(tmp_path, plate))
        planned(page)
        at = places_of(shown)
        page.select_option("#click-does", "starts")
        page.mouse.click(*at(7, 5))
        x, y = map(float, page.input_value("#starts").split(","))
        assert (x, y) == pytest.approx((7.0, 5.0), abs=0.2)
        assert page.input_value("#picks") == ""
        page.mouse.click(*at(7, 5))  # a second click on a mark takes it back
        assert page.input_value("#starts") == ""
        page.fill("#starts", "7,5; 10,-3")
        page.click("#make")
        shown.waits_for("pass")
        assert "Start Point = 7.00000 , 5.00000" in shown.text()
        assert "--start" not in page.inner_text("#drawing-told")


def test_a_mark_is_dragged_where_it_is_to_and_the_picture_stays(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    with tab(browsers, empty.address) as shown:
        page = shown.page
        page.set_input_files(
            "#pick",
            drawn(tmp_path, lambda space: space.add_lwpolyline([(0, 0), (20, 0), (20, 10), (0, 10)], close=True)),
        )
        planned(page)
        at = places_of(shown)
        page.fill("#starts", "2F; 7,5")
        page.fill("#picks", "layer:CUT; 3,3; 15,8")
        for field, place, to, marks in (
            ("#starts", (7, 5), (10, -3), "2F; "),
            ("#picks", (15, 8), (12, 6), "layer:CUT; 3,3; "),
        ):
            page.mouse.move(*at(*place))
            page.mouse.down()
            page.mouse.move(*at(11, 4), steps=3)
            page.mouse.move(*at(*to), steps=3)
            page.mouse.up()
            written = page.input_value(field)
            assert written.startswith(marks), "the others stay as they were written"
            x, y = map(float, written.removeprefix(marks).split(","))
            assert (x, y) == pytest.approx(to, abs=0.2)
        page.mouse.move(*at(18, 3))
        assert places_of(shown)(5, 5) == pytest.approx(at(5, 5), abs=1.0), "the picture was not moved"
        page.select_option("#click-does", "starts")
        page.mouse.click(*at(10, -3))  # a click takes it back, as before
        assert page.input_value("#starts") == "2F"


def test_beneath_a_program_a_click_picks_the_place_of_the_drawing(browsers: Browsers, tmp_path: Path) -> None:
    """The plate lies at (30, 40) mm in the drawing, and at (−10, −11) in the program."""

    def plate(space: Modelspace) -> None:
        space.add_lwpolyline([(30, 40), (50, 40), (50, 50), (30, 50)], close=True)

    punch = tmp_path / "punch.3b"
    punch.write_text(PUNCH, "ascii")
    with opened_page(punch) as served, tab(browsers, served.address) as shown:
        shown.waits_for("pass")
        shown.page.set_input_files("#pick", drawn(tmp_path, plate))
        shown.page.wait_for_selector("#drawing:not([hidden])")
        shown.page.wait_for_selector("#drawing-told:empty", state="attached")
        shown.page.mouse.click(*places_of(shown)(0, -6))
        x, y = shown.page.input_value("#picks").split(",")
        assert (float(x), float(y)) == pytest.approx((40.0, 45.0), abs=0.2)  # a px is some 0.03 mm


def test_a_drawing_is_dropped_made_a_program_and_run_against(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    dxf = drawn(tmp_path, lambda space: space.add_circle((30.0, 0.0), 1.0))
    with tab(browsers, empty.address) as shown:
        shown.page.set_input_files("#pick", dxf)
        shown.page.wait_for_selector("#drawing:not([hidden])")
        assert shown.page.inner_text("#drawing-name") == "part.dxf"
        shown.page.fill("#passes", "0.15 0.1")
        shown.page.click("#make")  # without a tab the part comes free with the first pass
        shown.waits_for("fail")
        assert shown.page.inner_text("#drawing-told li:first-child").startswith("not proved")
        assert "3 in “tab mm” holds it" in shown.page.inner_text("#drawing-told")
        shown.page.fill("#tab", "1")
        shown.page.click("#make")
        shown.waits_for("pass")
        assert shown.page.inner_text("#name") == "part.3b"
        assert shown.page.input_value("input[name=offset_mm]") == "", "no controller adds what is worked in"
        assert shown.page.inner_text("#drawing-told li:first-child") == "proved"
        shown.page.click("#start")
        shown.page.wait_for_selector("#stage.pass")
        run = json.loads(empty.ask("progress").body)["run"]
        report = json.loads(empty.ask(f"run/{run}/report.json", method="GET").body)
        assert report["drawing"]["max_um"] < 5.0
        shown.page.click("#tab-drawing")
        shown.page.click("#away")
        assert shown.page.locator("#drawing").is_hidden()


def test_what_was_opened_before_is_opened_by_one_click(browsers: Browsers, tmp_path: Path) -> None:
    file = tmp_path / "凸模.3b"
    file.write_text(PUNCH, "ascii")
    with opened_page(file, state=tmp_path / "state"):
        pass
    with opened_page(state=tmp_path / "state") as served, tab(browsers, served.address) as shown:
        button = shown.page.locator("#recent button")
        assert (button.inner_text(), button.get_attribute("title")) == ("凸模.3b", str(tmp_path))
        button.click()
        shown.waits_for("pass")
        assert shown.text() == PUNCH
        assert not shown.page.locator("#begin").is_visible()


def test_a_machine_file_that_is_dropped_is_chosen_and_checked_by(browsers: Browsers, tmp_path: Path) -> None:
    file = tmp_path / "long.3b"
    file.write_text("B150000B0B150000GXL1\nB0B90000B90000GYL2\nB150000B0B150000GXL3\nB0B90000B90000GYL4\nDD\n")
    machine = (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")
    narrow = re.sub(r"(?m)^travel_x_mm = \S+", "travel_x_mm = 100.0", machine)
    with opened_page(file) as served, tab(browsers, served.address) as shown:
        shown.waits_for("pass")
        shown.drops("narrow.toml", narrow)
        shown.waits_for("fail")
        assert shown.page.input_value("[name=machine]") == "own-0"
        assert "DK7740 class" in shown.page.inner_text("#reading-machine")
        shown.drops("wrong.toml", "nonsense")
        shown.page.locator("#status", has_text="wrong.toml").wait_for()
        assert shown.page.input_value("[name=machine]") == "own-0", "the other one stays"
        assert shown.text() == file.read_text(), "and the program"


def test_a_wire_that_leans_is_set_in_the_form(browsers: Browsers, empty: OpenedPage) -> None:
    square = "B0B2000B2000GYL2\nB4000B0B4000GXL1\nB0B4000B4000GYL2\nB4000B0B4000GXL3\nB0B4000B4000GYL4\nDD\n"
    with tab(browsers, empty.address) as shown:
        shown.page.fill("#text", square)
        shown.waits_for("pass")
        shown.page.click("#tab-run")
        shown.page.fill("input[name=taper_deg]", "61")
        assert "61" in shown.page.inner_text("#wrong")
        shown.page.fill("input[name=taper_deg]", "0.5")
        shown.page.select_option("select[name=taper_side]", "left")
        shown.page.fill("input[name=thickness_mm]", "10")
        shown.page.wait_for_function("() => document.querySelector('#size').textContent.includes('in 10 mm')")
        shown.page.click("#start")
        shown.page.wait_for_selector("#looks button")
        address = shown.page.get_attribute("#files a:text-is('report.json')", "href")
        report = shown.page.evaluate("(address) => fetch(address).then((answer) => answer.json())", address)
        assert report["taper"]["angle_deg"] == 0.5
        assert complaints(shown.page) == []
