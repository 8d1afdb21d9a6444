"""The browser of the tests: it is found or asked for, and what is wrong with a page is seen."""

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import browser
import chromium
import page_checks
import pytest
from browser import Browsers, OpenPage, Pages
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

GOOD = "<!doctype html><html lang='en'><meta charset='utf-8'><title>page</title><p>零件 text</p>"


@pytest.mark.alike(3)
@pytest.mark.parametrize(
    ("bad", "problem"),
    [
        ("<script>console.error('oh')</script>", "console error: oh"),
        ("<script>console.warn('oh')</script>", "console warning: oh"),
        ("<script>throw new Error('oh')</script>", "script: oh"),
        ("<script>Promise.reject(new Error('oh'))</script>", "script: oh"),
        ("<script>alert('oh')</script>", "dialog: oh"),
        ("<script>open('about:blank')</script>", "window: about:blank"),
        ("<img src='http://127.0.0.1:9/x.png'>", "request: http://127.0.0.1:9/x.png"),
        ("<script>fetch('https://127.0.0.1:9/x').catch(() => 0)</script>", "request: https://127.0.0.1:9/x"),
        ("<link rel='stylesheet' href='beside.css'>", "beside.css"),
    ],
)
def test_what_is_wrong_with_a_page_fails_its_test(browsers: Browsers, tmp_path: Path, bad: str, problem: str) -> None:
    pages = Pages(browsers.of, tmp_path)
    pages.open(GOOD + bad)
    with pytest.raises(pytest.fail.Exception, match=re.escape(problem)):
        pages.close()


@pytest.mark.deeper
def test_a_page_that_hangs_fails_its_test_and_holds_up_no_other(
    browsers: Browsers, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(browser, "WAIT_MS", 1000)
    pages = Pages(browsers.of, tmp_path)
    pages.open(GOOD + "<script>addEventListener('message', () => { for (;;) {} })</script>").page.evaluate(
        "postMessage('hang', '*')"
    )
    with pytest.raises(Exception, match="Timeout 1000ms"):
        pages.close()
    other = Pages(browsers.of, tmp_path)
    other.open(GOOD)
    other.close()


def test_a_sound_page_is_open_in_its_language_colours_and_size(open_page: OpenPage) -> None:
    here = "[navigator.language, matchMedia('(prefers-color-scheme: dark)').matches, innerWidth, navigator.onLine]"
    assert open_page(GOOD).page.evaluate(here) == ["en-US", False, 1280, False]
    assert open_page(GOOD, 390, 844, lang="zh", dark=True).page.evaluate(here) == ["zh-CN", True, 390, False]
    assert open_page(GOOD, reduced_motion="reduce").problems() == []


def test_nothing_is_left_of_a_page_before(browsers: Browsers, tmp_path: Path) -> None:
    file = tmp_path / "page.html"
    file.write_text(GOOD, "utf-8")
    found = []
    for lang, width in (("en", 900), ("en", 390), ("zh", 900)):
        pages = Pages(browsers.of, tmp_path)
        page = pages.open(file, width, lang=lang).page
        found.append(page.evaluate("[localStorage.length, sessionStorage.length, history.length, innerWidth]"))
        assert page.evaluate("(async () => (await indexedDB.databases()).length)()") == 0
        page.evaluate("localStorage.a = sessionStorage.b = 1; history.pushState(1, ''); indexedDB.open('kept')")
        pages.close()
    assert found == [[0, 0, first[2], width] for first, width in zip(found, (900, 390, 900), strict=True)]
    assert len({history for _, _, history, _ in found}) == 1


def test_a_page_that_was_closed_complains_to_no_later_test(browsers: Browsers, tmp_path: Path) -> None:
    pages = Pages(browsers.of, tmp_path)
    before = pages.open(GOOD)
    pages.close()
    other = Pages(browsers.of, tmp_path)
    other.open(GOOD + "<script>console.error('oh')</script>")
    with pytest.raises(pytest.fail.Exception, match="oh"):
        other.close()
    assert before.found == []


def test_a_page_is_opened_from_its_own_file(open_page: OpenPage, tmp_path: Path) -> None:
    path = tmp_path / "零件 #1.html"
    path.write_text(GOOD, "utf-8")
    assert open_page(path).page.evaluate("decodeURI(location.href)") == f"file://{path}".replace("#", "%23")


def test_the_shipped_font_draws_every_text_where_it_is_asked_for(open_page: OpenPage) -> None:
    width = """() => {
        const pen = document.createElement("canvas").getContext("2d");
        return ["serif", "sans-serif", "monospace", "Arial"].map(name => {
            pen.font = `100px ${name}`;
            return pen.measureText("零件 mi").width;
        });
    }"""
    shipped, machine = (open_page(GOOD, shipped_font=alone).page.evaluate(width) for alone in (True, False))
    assert shipped == [pytest.approx(2 * 100 + 22.4 + 92.6 + 27.5, abs=1.0)] * 4
    assert machine != shipped


@pytest.mark.parametrize(("ci", "outcome"), [("", "1 skipped"), ("true", "1 failed")])
def test_without_a_browser_tests_are_skipped_but_never_in_ci(tmp_path: Path, ci: str, outcome: str) -> None:
    (tmp_path / "test_page.py").write_text("def test_page(open_page):\n    open_page('<p>')\n")
    (tmp_path / "conftest.py").write_text("import chromium\nfrom browser import *\nchromium.NAMES = ()\n")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", "--rootdir", tmp_path, tmp_path],
        env={**os.environ, "CI": ci, "PYTHONPATH": f"{ROOT / 'tests' / 'tools'}:{ROOT}"},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert outcome in done.stdout
    assert "apt-get install chromium" in done.stdout
    assert done.returncode == bool(ci)


@pytest.mark.parametrize(("root", "installable", "ci"), [(True, True, "1"), (True, False, "1"), (False, True, "")])
def test_the_step_installs_what_it_can_and_says_how_to_otherwise(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], root: bool, installable: bool, ci: str
) -> None:
    there: list[str] = []
    monkeypatch.setenv("CI", ci)
    monkeypatch.setattr(chromium, "executable", lambda: next(iter(there), None))
    monkeypatch.setattr(chromium, "may_install", lambda: root)
    assert chromium.make_ready(lambda: there.extend(["/usr/bin/chromium"] * installable)) == bool(ci and not there)
    told = capsys.readouterr().err
    assert ("installing chromium" in told) == root
    assert (chromium.HOW_TO in told) == (not there)
    assert ("They are skipped" in told) == (not there and not ci)


def test_the_step_does_nothing_where_a_browser_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chromium, "executable", lambda: "/usr/bin/chromium")
    assert chromium.make_ready(pytest.fail) == 0


POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
SOUND = f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>page</title>
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<style>
body {{ color: #333; background: #fff }}
.over {{ position: relative }}
.over b {{ position: absolute; left: 5px; top: 5px; color: #fff }}
@media (prefers-color-scheme: dark) {{ body {{ color: #ddd; background: #111 }} a {{ color: #8cf }} }}
</style>
<h1>Title</h1><p id="a">A <a href="#a">link</a></p>
<button>Play</button><button aria-label="next block">▶</button><button disabled style="color: #ccc">Off</button>
<label>Speed <input type="range"></label><label for="b">Name</label><input id="b" value="x">
<label><input type="radio" name="n" checked>one</label><label><input type="radio" name="n">two</label>
<canvas aria-label="the cut" tabindex="0"></canvas><img alt="" src="data:,"><img alt="a cut" src="data:,">
<div role="listbox" aria-label="blocks"><div role="option" tabindex="0">1</div><div role="option" tabindex="-1">2</div>
</div><div role="tablist"><button role="tab">Text</button><button role="tab" tabindex="-1">Findings</button></div>
<details><summary>More</summary><button>Hidden</button></details>
<svg role="img" aria-label="picture" width="200" height="50"><rect width="200" height="50" fill="#000"/>
<text x="9" y="30" fill="#fff">white on black</text></svg>
<div class="over"><canvas aria-hidden="true" width="90" height="40" id="c"></canvas><b>over</b></div>
<div style="width: 200px; overflow: auto" tabindex="0" role="region" aria-label="wide"><div style="width: 900px">wide
</div></div>
<p style="position: absolute; width: 1px; height: 1px; overflow: hidden; color: #fff">for screen readers</p>
<script>const pen = document.getElementById("c").getContext("2d"); pen.fillRect(0, 0, 90, 40)</script>
<div style="height: 3000px"></div>"""


@pytest.mark.alike(1)
@pytest.mark.parametrize("dark", [False, True])
def test_a_sound_page_gives_no_complaint(open_page: OpenPage, dark: bool) -> None:
    page = open_page(SOUND, 900, 700, dark=dark).page
    assert page_checks.complaints(page) == []
    assert page.viewport_size == {"width": 900, "height": 700}
    assert page.evaluate("scrollY") == 0


@pytest.fixture(scope="module")
def blank(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    """One page for one text after another: to open one takes 20 times as long."""
    pages = Pages(browsers.of, tmp_path_factory.mktemp("blank"))
    yield pages.open(GOOD).page
    pages.close()


@pytest.mark.alike(8)
@pytest.mark.parametrize(
    ("check", "bad", "complaint"),
    [
        (page_checks.unnamed, "<button></button>", "no name: <button>"),
        (page_checks.unnamed, "<button><span style='display: none'>hidden</span></button>", "no name: <button>"),
        (page_checks.unnamed, "<input type='range'>", 'no name: <input type="range">'),
        (page_checks.unnamed, "<canvas></canvas>", "no name: <canvas>"),
        (page_checks.unnamed, "<img src='data:,' width=9 height=9>", "no name: <img"),
        (page_checks.unnamed, "<select><option>one</select>", "no name: <select>"),
        (page_checks.unnamed, "<a href='#'><svg></svg></a>", 'no name: <a href="#">'),
        (page_checks.unnamed, "<dialog open><p>ask</p></dialog>", "no name: <dialog"),
        (page_checks.doubled_ids, "<p id='x'></p><p id='x'></p>", "id twice: x"),
        (page_checks.unreached, "<button tabindex='-1'>x</button>", "no tab stop: <button"),
        (page_checks.unreached, "<div role='tablist'><button tabindex='-1'>x</button></div>", "no tab stop: <button"),
        (page_checks.unreached, "<div role='button'>x</div>", "no tab stop: <div"),
        (page_checks.unreached, "<button style='outline: none'>x</button>", "focus does not show: <button"),
        (page_checks.unreached, "<button onfocus='this.blur()'>x</button>", "no tab stop: <button"),
        (page_checks.too_wide, "<div style='width: 400px'>wide</div>", "sticks out at 390 px: <div"),
        (page_checks.faint, "<p style='color: #777'>grey</p>", "contrast 4.48 of 4.5: 'grey'"),
        (page_checks.faint, "<p style='color: #767676'>grey</p>", None),
        (page_checks.faint, "<p style='color: #979797; font-size: 24px'>grey</p>", "contrast 2.9"),
        (page_checks.faint, "<p style='color: #949494; font-size: 24px'>grey</p>", None),
        (page_checks.faint, "<b style='color: #949494; font-size: 19px'>grey</b>", None),
        (page_checks.faint, "<p style='color: #949494; font-size: 19px'>grey</p>", "of 4.5: 'grey'"),
        (page_checks.faint, "<p style='color: #0008'>half</p>", "contrast 4.48"),
        (page_checks.faint, "<p style='color: #000; opacity: 0.5'>half</p>", "contrast 3.9"),
        (
            page_checks.faint,
            "<div style='background: #000'><p style='background: #0000; color: #333'>on</p></div>",
            "'on'",
        ),
        (page_checks.faint, "<svg><rect width='99' height='99'/><text y='20'>on black</text></svg>", "'on black'"),
        (page_checks.faint, "<input style='color: #eee' value='told'>", "'told'"),
        (page_checks.faint, "<button style='color: #999'>Play</button>", "'Play'"),
        (page_checks.faint, "<div style='height: 3000px'></div><p style='color: #eee'>far</p>", "'far'"),
        (page_checks.faint, "<p style='background: linear-gradient(#000, #222); color: #000'>on</p>", "'on'"),
    ],
)
def test_each_check_sees_what_it_is_for(
    blank: "Page", check: Callable[["Page"], list[str]], bad: str, complaint: str | None
) -> None:
    blank.set_content(GOOD + bad)
    found = check(blank)
    assert len(found) >= 1 if complaint else found == []
    assert complaint is None or complaint in found[-1]


def test_a_document_says_what_it_is_and_in_what_language(open_page: OpenPage) -> None:
    found = page_checks.untitled(open_page("<!doctype html><title> </title><p>text</p>").page)
    assert found == ["the document has no language", "the document has no title"]
