"""The replay of a program of 100,000 blocks: it stays small in memory, and smooth while its view moves."""

import functools
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pytest
from browser import Browsers, Pages
from long_replays import long_page, rippled_spiral
from replayed import canvas

if TYPE_CHECKING:
    from playwright.sync_api import CDPSession, Page

BLOCKS = 100_000

pytestmark = pytest.mark.deeper

COUNTED = """() => {
    window.points = 0;
    for (const name of ["lineTo", "arc"]) {
        const own = CanvasRenderingContext2D.prototype[name];
        CanvasRenderingContext2D.prototype[name] = function (...values) { points++; return own.apply(this, values); };
    }
}"""
"""Counts the points that are drawn."""
ZOOMED = """async (frames) => {
    const table = document.getElementById("table");
    const { left, top } = table.getBoundingClientRect();
    const drawn = [];
    const later = window.setTimeout;
    window.setTimeout = () => 1;
    for (let at = 1; at <= frames; at++) {
        if (at === frames) window.setTimeout = later;
        points = 0;
        table.dispatchEvent(new WheelEvent("wheel", { clientX: left + 400, clientY: top + 200, deltaY: -20 }));
        await new Promise(requestAnimationFrame);
        drawn.push(points);
    }
    return drawn;
}"""
"""Points drawn in each frame of a zoom; where frames take long, the view does not rest between two of them."""
REST = "() => new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 400))"


@functools.cache
def page_of_many() -> str:
    return long_page(rippled_spiral(BLOCKS))


@pytest.fixture(scope="module")
def page(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    """One page for all tests, for it is long."""
    pages = Pages(browsers.of, tmp_path_factory.mktemp("many"))
    shown = pages.open(page_of_many(), 1000, 700).page
    shown.evaluate("drycut.player.ready")
    shown.evaluate(COUNTED)
    yield shown
    pages.close()


@pytest.fixture
def tools(page: "Page") -> Iterator["CDPSession"]:
    session = page.context.new_cdp_session(page)
    yield session
    session.detach()


def cpu_s(tools: "CDPSession") -> float:
    """CPU time of the page so far: what else the machine has to do does not count."""
    metrics = {one["name"]: one["value"] for one in tools.send("Performance.getMetrics")["metrics"]}
    return float(metrics["ProcessTime"])


def test_the_file_is_a_few_megabytes() -> None:
    assert len(page_of_many().encode()) < 6e6  # measured 4.6 MB; 18 MB with its columns unpacked


def test_it_takes_little_memory(page: "Page", tools: "CDPSession") -> None:
    tools.send("HeapProfiler.collectGarbage")
    used = tools.send("Runtime.getHeapUsage")
    assert used["usedSize"] + used["backingStorageSize"] < 110e6  # bytes; measured 91, 166 with every step unpacked


def test_while_it_is_zoomed_the_last_drawing_is_shown(page: "Page", tools: "CDPSession") -> None:
    tools.send("Performance.enable")
    page.keyboard.press("0")
    page.evaluate("() => { points = 0; drycut.player.seek(drycut.player.duration); }")
    page.evaluate(REST)
    whole = page.evaluate("points")
    assert whole > 2000
    before = cpu_s(tools)
    drawn = page.evaluate(ZOOMED, 30)
    assert sum(drawn) < whole  # 30 frames together, of which each would draw as much
    assert np.median(drawn) < 100
    took_s = (cpu_s(tools) - before) / len(drawn)
    print(f"{1000 * took_s:.0f} ms of CPU a frame")
    assert took_s < 0.04


def test_a_view_that_rests_is_drawn_as_if_it_had_not_moved(page: "Page") -> None:
    page.evaluate("drycut.player.seek(drycut.player.duration * 0.6)")
    page.keyboard.press("0")
    page.evaluate(REST)
    page.evaluate(ZOOMED, 25)
    moving = canvas(page)
    page.evaluate(REST)
    rested = canvas(page)
    page.emulate_media(color_scheme="dark")
    page.evaluate(REST)
    assert np.abs(canvas(page) - rested).max() > 100  # all is drawn anew
    page.emulate_media(color_scheme="light")
    page.evaluate(REST)
    assert np.array_equal(canvas(page), rested)
    assert np.abs(moving - rested).max() > 0  # it did not draw everything in each frame


def test_the_time_line_groups_what_it_cannot_tell_apart(page: "Page") -> None:
    bar = page.locator("#bar")
    box = bar.bounding_box()
    assert box is not None
    first, past = 0, 0
    sizes = []
    for x in range(1, int(box["width"]), 4):
        page.mouse.move(box["x"] + x, box["y"] + 10)
        found = re.match(r"Blocks (\d+) to (\d+), ([\d,]+) in all", bar.get_attribute("title") or "")
        assert found, "every block is in a group"
        if int(found[1]) == past + 1:
            first, past = int(found[1]), int(found[2])
            sizes.append(int(found[3].replace(",", "")))
            assert sizes[-1] == past - first + 1
    assert past == BLOCKS
    assert sum(sizes) == BLOCKS
    assert len(sizes) < 20


def test_a_click_on_a_group_leads_to_its_first_block_and_two_show_it_larger(page: "Page") -> None:
    bar, whole = page.locator("#bar"), page.locator("#whole-run")
    box = bar.bounding_box()
    assert box is not None

    def group() -> tuple[int, int]:
        found = re.match(r"Blocks? ([\d,]+)(?: to (\d+),)?", bar.get_attribute("title") or "")
        assert found
        first, last = (int((number or found[1]).replace(",", "")) for number in found.groups())
        return first, last

    assert whole.is_hidden()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 10)
    first, last = group()
    page.mouse.down()
    page.mouse.up()
    assert page.evaluate("drycut.player.state().block") == first - 1
    page.mouse.dblclick(box["x"] + 0.4 * box["width"], box["y"] + 10)
    page.mouse.move(box["x"] + 1, box["y"] + 10)
    assert group()[0] == first
    page.mouse.move(box["x"] + box["width"] - 4, box["y"] + 10)
    assert group()[1] == last
    page.evaluate("drycut.player.seekBlock(0)")
    page.evaluate(REST)
    page.mouse.move(box["x"] + 1, box["y"] + 10)
    assert group()[0] == 1, "the time line goes with the time"
    whole.click()
    assert whole.is_hidden()
    page.mouse.move(box["x"] + box["width"] - 4, box["y"] + 10)
    assert group()[1] == BLOCKS
