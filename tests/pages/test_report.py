"""report.html in a real browser: what it shows, how it sorts, what it prints, and that nothing runs but its own."""

import csv
import io
import re
from typing import TYPE_CHECKING

import pytest
from browser import OpenPage
from golden_pictures import assert_golden_screen
from page_checks import complaints
from places import ROOT
from report_pages import HOSTILE, HOSTILE_TITLE, PART, Made, hostile, made, staircase

from sim.show.html.environment import joined
from sim.show.report_page.tables import reached

if TYPE_CHECKING:
    from playwright.sync_api import Page

CSV = joined(ROOT / "sim" / "show" / "report_page" / "assets" / "csv.js")
BLOCKS = '[data-table="blocks"]'
MM_PX = 96.0 / 25.4


@pytest.fixture(scope="module")
def part() -> Made:
    return made(PART, kerf=True, title="A square and a circle")


@pytest.fixture(scope="module")
def bad() -> Made:
    return hostile()


@pytest.fixture(scope="module")
def many() -> Made:
    return made(staircase(5000), may_stay_open=True)


def shown(open_page: OpenPage, html: str, **how: object) -> "Page":
    """A page that shows all of its tables."""
    page = open_page(html, **how).page
    page.evaluate("drycut.tables.ready")
    return page


def cells(page: "Page", head: str, table: str = BLOCKS) -> list[str]:
    """Texts of a column."""
    heads = page.locator(f"{table} thead th").evaluate_all(
        "all => all.map(th => th.querySelector('[lang=en]').textContent)"
    )
    return page.locator(f"{table} tbody tr > :nth-child({heads.index(head) + 1})").all_inner_texts()


def head(page: "Page", name: str) -> "Page":
    return page.locator(f"{BLOCKS} thead button", has_text=re.compile(f"^{name}"))


def numbers(texts: list[str]) -> list[float]:
    return [float(text.replace(",", "")) for text in texts if text != "–"]


def test_what_others_wrote_shows_as_text(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    assert page.evaluate("window.hacked") is None
    assert page.locator("img, main b").count() == 0
    assert page.locator("h1").inner_text() == HOSTILE_TITLE
    sources = page.locator(".source .row:first-child").all_inner_texts()
    shown = "\n".join(sources)
    for line in HOSTILE.splitlines()[1:4]:
        assert line in shown
    assert "<script>window.hacked=5</script>" in page.locator(".groups").inner_text()


@pytest.mark.alike(1)
@pytest.mark.parametrize(("lang", "dark"), [("en", False), ("zh", True)])
def test_nobody_has_to_complain_of_the_page(open_page: OpenPage, bad: Made, lang: str, dark: bool) -> None:
    assert complaints(open_page(bad.html, lang=lang, dark=dark).page) == []


def test_the_switch_changes_the_language_of_every_text(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    assert page.locator(".verdict .word").inner_text() == "Fail"
    assert cells(page, "kind")[0] == "line"
    picture = page.locator("#picture-cut svg[aria-label]:visible")
    english = picture.get_attribute("aria-label")
    page.locator("[data-language-switch]").click()
    assert page.locator(".verdict .word").inner_text() == "不通过"
    assert cells(page, "kind")[0] == "直线"
    assert picture.get_attribute("aria-label") != english
    assert page.locator("a.replay").get_attribute("href") == "replay.html#lang=zh-CN"
    left = page.evaluate("""() => [...document.querySelectorAll('h2, h3, thead button, dt')]
        .map(el => el.innerText.trim()).filter(text => text && !/[\\u4e00-\\u9fff]/.test(text))""")
    assert set(left) <= {"95 %\nµm"}, "words that stand in English alone"


def test_cells_show_the_figures_of_the_report(open_page: OpenPage, part: Made) -> None:
    page = open_page(part.html).page
    for column, entry, unit_um, decimals in (
        ("J", "count_um", 1.0, 0),
        ("to X", "exact.end_um.0", 1000.0, 3),
        ("radius", "exact.radius_um", 1000.0, 3),
        ("length", "exact.length_um", 1000.0, 3),
        ("deviation, table", "table.max_deviation_um", 1.0, 2),
    ):
        values = [reached(block, entry) for block in part.report["blocks"]]
        shown = cells(page, column)
        assert {len(text.partition(".")[2]) for text in shown if text != "–"} == {decimals}, column
        half = 0.5001 * 10.0**-decimals
        expected = ["–" if value is None else pytest.approx(value / unit_um, abs=half) for value in values]
        assert ["–" if text == "–" else float(text.replace(",", "")) for text in shown] == expected, column


def test_a_head_sorts_up_then_down_and_says_so(open_page: OpenPage, part: Made) -> None:
    page = open_page(part.html).page
    before = numbers(cells(page, "length"))
    assert before != sorted(before)
    head(page, "length").click()
    assert numbers(cells(page, "length")) == sorted(before)
    assert page.locator(f"{BLOCKS} [aria-sort=ascending]").inner_text().startswith("length")
    page.keyboard.press("Enter")
    assert numbers(cells(page, "length")) == sorted(before, reverse=True)
    assert page.locator(f"{BLOCKS} [aria-sort=descending]").count() == 1
    head(page, "kind").focus()
    page.keyboard.press("Space")
    assert cells(page, "kind") == sorted(cells(page, "kind"))
    assert page.locator(f"{BLOCKS} [aria-sort=descending]").count() == 0


@pytest.mark.alike(1)
@pytest.mark.parametrize("clicks", [1, 2])
def test_rows_without_a_value_stand_last_either_way(open_page: OpenPage, part: Made, clicks: int) -> None:
    page = open_page(part.html).page
    for _ in range(clicks):
        head(page, "radius").click()
    assert cells(page, "radius") == ["0.500"] + ["–"] * 10


@pytest.mark.deeper
def test_the_worst_of_many_blocks_is_two_clicks_away(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html)
    assert page.locator(f"{BLOCKS} tbody tr").count() == 200
    assert page.locator(f"{BLOCKS} .count").inner_text() == "rows 1–200 of 5,000"
    button = head(page, "deviation, table")
    took_ms = button.evaluate("""button => {
        const before = performance.now();
        button.click(); button.click();
        document.body.getBoundingClientRect();
        return performance.now() - before;
    }""")
    worst = max(many.report["blocks"], key=lambda block: block["table"]["max_deviation_um"])
    assert cells(page, "deviation, table")[0] == f"{worst['table']['max_deviation_um']:.2f}"
    assert took_ms < 1500.0, "sorting 5,000 blocks twice"


@pytest.mark.deeper
def test_pages_of_a_long_table_are_turned(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html)
    turn = {
        name: page.locator(f"{BLOCKS} .turning button", has_text=name) for name in ("First", "Back", "Next", "Last")
    }
    turn["Next"].click()
    assert cells(page, "block")[:2] == ["201", "202"]
    turn["Last"].click()
    assert cells(page, "block")[-1] == "5,000"
    assert turn["Next"].is_disabled()
    turn["Back"].click()
    assert page.locator(f"{BLOCKS} .count").inner_text() == "rows 4,601–4,800 of 5,000"
    turn["First"].click()
    assert turn["Back"].is_disabled()
    assert cells(page, "block")[0] == "1"


@pytest.mark.deeper
def test_a_long_table_is_searched_by_block_and_by_text(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html)
    field, told = page.locator(f"{BLOCKS} input[type=search]"), page.locator(f"{BLOCKS} .told")
    assert told.inner_text() == ""
    field.fill("4,321")
    assert cells(page, "block") == ["4,321"]
    assert told.inner_text() == "1 of 5,000 rows"
    field.fill("4321 ")
    assert cells(page, "block") == ["4,321"]
    wanted = "b9b0b9gxl1"
    having = [block["block"] for block in many.report["blocks"] if wanted in block["text"].lower()]
    assert 200 < len(having) < 5000
    field.fill(wanted)
    assert numbers(cells(page, "block")) == having[:200]
    assert page.locator(f"{BLOCKS} .count").inner_text() == f"rows 1–200 of {len(having)}"
    head(page, "block").click()
    head(page, "block").click()
    assert [int(text.replace(",", "")) for text in cells(page, "block")] == having[:-201:-1], (
        "sorted, it is searched still"
    )
    field.fill("no such text")
    assert cells(page, "block") == []
    assert told.inner_text() == "0 of 5,000 rows"
    field.fill("")
    assert page.locator(f"{BLOCKS} .count").inner_text() == "rows 1–200 of 5,000"


@pytest.mark.deeper
def test_all_rows_of_a_long_table_are_saved_as_csv(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html)
    page.locator(f"{BLOCKS} input[type=search]").fill("17")  # what is searched does not matter
    with page.expect_download() as download:
        page.locator(f"{BLOCKS} .tools button").click()
    assert download.value.suggested_filename == "blocks.csv"
    heads, *rows = list(csv.reader(download.value.path().read_text("utf-8-sig").splitlines()))
    blocks = many.report["blocks"]
    assert {len(row) for row in rows} == {len(heads)}
    for name, entry, per in (
        ("block", "block", 1),
        ("to X mm", "exact.end_um.0", 1000),
        ("length mm", "exact.length_um", 1000),
    ):
        saved = [float(row[heads.index(name)]) for row in rows]
        assert saved == pytest.approx([reached(block, entry) / per for block in blocks], rel=1e-11), name
    assert [row[heads.index("text")] for row in rows] == [block["text"] for block in blocks]


def test_no_text_of_a_program_becomes_a_formula_or_a_row_of_a_spreadsheet(open_page: OpenPage) -> None:
    texts = ["=1+1", "+1", "-1", "@x", "\t=1", 'a "b", c', "two\nlines", None, "B5GXL1"]
    page = open_page(f"<!doctype html><html lang=en><title>csv</title><script>const csv = {CSV};</script>").page
    columns = [
        {"head": {"en": "text, said", "zh": ""}, "values": texts, "kind": "code", "unit": "", "per": 1, "digits": 0}
    ]
    text = page.evaluate("([columns, rows]) => csv.csvOf(columns, rows)", [columns, list(range(len(texts)))])
    read = [row[0] if row else "" for row in csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""))]
    assert read == ["text, said", "'=1+1", "'+1", "'-1", "'@x", "'\t=1", 'a "b", c', "two\nlines", "", "B5GXL1"]


@pytest.mark.deeper
def test_a_browser_that_cannot_unpack_a_table_says_so(open_page: OpenPage, many: Made) -> None:
    watched = open_page(
        many.html.replace("<head>", "<head><script>delete window.DecompressionStream;</script>", 1), lang="zh"
    )
    assert "report.json" in watched.page.locator(f"{BLOCKS} .unread").inner_text()
    assert watched.page.locator('[data-table="deviation"] tbody tr').count() == 4, "short tables show"
    assert [problem for problem in watched.problems() if "DecompressionStream" not in problem] == []
    watched.found.clear()


def test_a_code_opens_its_explanation(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    code = page.locator(".findings .head a").first
    explained = page.locator(f"#code-{code.inner_text()}")
    assert explained.get_attribute("open") is None
    code.click()
    page.locator(f"#code-{code.inner_text()}[open]").wait_for()  # the event of the new hash comes after the click
    assert "How to mend it" in explained.inner_text()
    assert "如何改正" not in explained.inner_text()


def test_a_code_of_a_block_leads_to_its_finding(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    link = page.locator(f"{BLOCKS} .codes a").first
    link.click()
    assert page.locator(":target .head a").inner_text() == link.inner_text()
    assert page.locator(":target").evaluate("el => el.getBoundingClientRect().top") > page.locator(".bar").evaluate(
        "el => el.getBoundingClientRect().bottom"
    ), "not hidden below the bar"


def test_carets_stand_below_what_they_mean(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    apart = page.evaluate("""() => {
        const left = (row, text) => {
            const walk = document.createTreeWalker(row, NodeFilter.SHOW_TEXT);
            for (let node = walk.nextNode(); node; node = walk.nextNode()) {
                const at = node.data.indexOf(text);
                const range = document.createRange();
                if (at < 0) continue;
                range.setStart(node, at);
                range.setEnd(node, at + 1);
                return range.getBoundingClientRect().left;
            }
        };
        const all = [...document.querySelectorAll('.findings li')];
        const source = all.find(li => li.querySelector('.head a').innerText === '3B217');
        const [line, carets] = source.querySelectorAll('.row');
        return left(line, '490 GYL4') - left(carets, '^');
    }""")
    assert abs(apart) < 1.0, "px"


def test_a_phone_scrolls_wide_tables_in_their_own_box_alone(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html, 390, 844, lang="zh").page
    assert page.evaluate("document.scrollingElement.scrollWidth") == 390
    assert page.locator(f"{BLOCKS} .box").evaluate("box => box.scrollWidth > box.clientWidth")


def test_pictures_take_the_colours_of_the_desk_and_are_light_on_paper(open_page: OpenPage, part: Made) -> None:
    page = open_page(part.html, dark=True).page
    ground = "getComputedStyle(document.querySelector('.picture div[lang=en] .f-page')).fill"
    body = "getComputedStyle(document.body).backgroundColor"
    assert page.evaluate(ground) == "rgb(22, 24, 28)"
    page.emulate_media(media="print")
    assert page.evaluate(ground) == "rgb(255, 255, 255)"
    assert page.evaluate(body) == "rgb(255, 255, 255)"


def sheets(pdf: bytes) -> list[tuple[int, int]]:
    """Sizes of the sheets of a PDF, mm."""
    boxes = re.findall(rb"/MediaBox\s*\[\s*0\s+0\s+([\d.]+)\s+([\d.]+)\s*\]", pdf)
    return [(round(float(w) / 72 * 25.4), round(float(h) / 72 * 25.4)) for w, h in boxes]


@pytest.mark.deeper
def test_lines_that_the_languages_share_are_drawn_in_both(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html, lang="zh")
    used = page.evaluate("""() => [...document.querySelectorAll('.picture [lang=zh-CN] use')].map(use => {
        const { width, height } = use.getBBox();
        return [document.querySelectorAll(use.getAttribute('href')).length, width + height];
    })""")
    assert len(used) >= 2
    assert all(times == 1 and size > 100 for times, size in used)


def test_it_prints_on_a_few_sheets_of_a4(open_page: OpenPage, many: Made) -> None:
    page = shown(open_page, many.html)
    printed = sheets(page.pdf(prefer_css_page_size=True))
    assert {(210, 297), (297, 210)} == set(printed)
    assert len(printed) < 20, "of 5,000 blocks the rows that are seen"
    page.emulate_media(media="print")
    assert page.locator(f"{BLOCKS} .rest").is_visible()
    assert "report.json" in page.locator(f"{BLOCKS} .rest").inner_text()


def grid(holes: int) -> str:
    """A program of so many squares round start holes in a row, each five blocks with the jump before it."""
    square = ["B300B0B300GXL1", "B0B300B300GYL2", "B300B0B300GXL3", "B0B300B300GYL4"]
    return "\n".join(
        [*square, *(line for _ in range(holes - 1) for line in ("D", "B900B0B900GXL1", "D", *square)), "DD"]
    )


@pytest.mark.alike(1)
@pytest.mark.parametrize("holes", [1, 12, 40])
def test_the_job_sheet_is_one_sheet_with_all_that_stands_on_it(open_page: OpenPage, holes: int) -> None:
    page = open_page(made(grid(holes), kerf=True).html, int((210 - 24) * MM_PX), 1000).page
    assert sheets(page.pdf(prefer_css_page_size=True)).count((210, 297)) == 1
    page.emulate_media(media="print")
    sheet = page.locator(".sheet")
    assert sheet.evaluate("sheet => sheet.scrollHeight <= sheet.clientHeight")
    bottom = sheet.locator(".signed").evaluate("line => line.getBoundingClientRect().bottom")
    assert bottom <= sheet.evaluate("sheet => sheet.getBoundingClientRect().bottom")
    assert sheet.locator(".threads tbody tr").count() == min(holes, 12)
    assert sheet.locator(".picture").evaluate("box => box.clientHeight") > 60 * MM_PX
    assert page.locator('[data-table="threads"] tbody tr').count() == (holes if holes > 12 else 0)


@pytest.mark.deeper
@pytest.mark.parametrize("lang", ["en", "zh"])
def test_a_long_title_and_many_findings_leave_the_sheet_whole(open_page: OpenPage, lang: str) -> None:
    wrong = grid(14).replace("B300B0B300GXL3", "B300B0B290GXL3")
    long = "A title as shops write them, with a customer, an order number and a drawing " * 3
    part = made(wrong, kerf=True, title=long, may_stay_open=True)
    page = open_page(part.html, int((210 - 24) * MM_PX), 1000, lang=lang).page
    page.emulate_media(media="print")
    sheet = page.locator(".sheet")
    assert sheet.locator(".threads tbody tr").count() == 12
    assert sheet.locator(".short li").count() == 4
    assert sheet.evaluate("sheet => sheet.scrollHeight <= sheet.clientHeight"), "the line to sign is cut off"
    assert sheet.locator(".verdict").evaluate("box => box.clientHeight") < 30 * MM_PX, "a letter a line"


@pytest.mark.deeper
def test_a_program_of_24_blocks_takes_two_sheets(open_page: OpenPage) -> None:
    part = made(grid(5), kerf=True)
    assert part.report["summary"]["blocks"] == 24
    assert sheets(open_page(part.html).page.pdf(prefer_css_page_size=True)) == [(210, 297), (297, 210)]


@pytest.mark.deeper
def test_all_rows_go_on_paper_beneath_heads_that_can_be_repeated(open_page: OpenPage) -> None:
    page = open_page(made(staircase(700), may_stay_open=True).html).page
    rows = page.locator(f"{BLOCKS} tbody tr")
    assert rows.count() == 200
    page.evaluate("""() => {
        window.addEventListener('afterprint', () => { window.printed = window.atPrint; });
        window.addEventListener('beforeprint', () => {
            window.atPrint = document.querySelectorAll('[data-table="blocks"] tbody tr').length;
        });
    }""")
    assert len(sheets(page.pdf(prefer_css_page_size=True))) < 25
    assert page.evaluate("window.printed") == 700
    assert rows.count() == 200
    page.emulate_media(media="print")
    heads = page.locator(f"{BLOCKS} thead button")
    assert set(heads.evaluate_all("all => all.map(one => getComputedStyle(one).display)")) == {"contents"}


@pytest.mark.deeper
def test_a_tick_puts_all_of_the_page_on_paper(open_page: OpenPage, bad: Made) -> None:
    page = open_page(bad.html).page
    page.emulate_media(media="print")
    assert not page.locator("#settings").is_visible()
    page.emulate_media(media="screen")
    assert not page.locator("#picture-histogram").is_visible(), "behind the accuracy"
    page.locator("#print-everything").check()
    page.evaluate("""() => window.addEventListener('beforeprint', () => {
        window.folded = document.querySelectorAll('details:not([open])').length;
    })""")
    page.pdf(prefer_css_page_size=True)
    assert page.evaluate("window.folded") == 0
    assert page.locator("details[open]").count() == 0
    page.emulate_media(media="print")
    assert page.locator("#settings").is_visible()


@pytest.mark.parametrize(
    ("sheet_mm", "where"), [(210 - 24, ".sheet *:not(svg *):visible"), (297 - 20, ".behind *:not(svg *):visible")]
)
def test_nothing_is_cut_off_at_the_edge_of_the_paper(
    open_page: OpenPage, bad: Made, sheet_mm: float, where: str
) -> None:
    page = open_page(bad.html, int(sheet_mm * MM_PX), 1000).page
    page.emulate_media(media="print")
    right = page.locator(where).evaluate_all(
        "all => Math.max(...all.map(el => el.getBoundingClientRect().left + el.scrollWidth))"
    )
    assert right <= sheet_mm * MM_PX + 0.5


def test_the_page_looks_as_it_should_in_english(open_page: OpenPage, part: Made) -> None:
    assert_golden_screen(open_page(part.html, 1280, 720, shipped_font=True).page, "report-en.png")


def test_the_page_looks_as_it_should_in_chinese_and_dark(open_page: OpenPage, bad: Made) -> None:
    assert_golden_screen(open_page(bad.html, 390, 844, lang="zh", dark=True, shipped_font=True).page, "report-zh.png")


@pytest.mark.deeper
@pytest.mark.parametrize(("lang", "says"), [("en", "too old for the tables"), ("zh", "浏览器版本太旧")])
def test_a_browser_too_old_for_the_tables_is_told_so(open_page: OpenPage, part: Made, lang: str, says: str) -> None:
    assert not open_page(part.html, lang=lang).page.locator("#too-old").is_visible()
    old = part.html.replace("<head>", "<head><script>delete window.DecompressionStream;</script>", 1)
    watched = open_page(old, lang=lang)
    assert says in watched.page.locator("#too-old").inner_text()
    watched.found.clear()


def test_a_picture_is_large_enough_to_be_read_on_a_phone(open_page: OpenPage, part: Made) -> None:
    page = open_page(part.html, 390, 844).page
    box = page.locator("#picture-cut > div:visible")
    assert box.evaluate("box => box.scrollWidth") == 700
    assert page.evaluate("document.scrollingElement.scrollWidth") == 390
    least = box.locator("svg").first.evaluate(
        "svg => Math.min(...[...svg.querySelectorAll('text')].map(text => text.getBoundingClientRect().height))"
    )
    assert least > 8.0, "px"
