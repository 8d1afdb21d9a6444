"""The replay's page in a browser: played, stepped, scrubbed, asked, in both languages, with mouse, keys and fingers."""

import csv
import functools
import io
import re
from itertools import combinations, pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import page_checks
import pytest
from browser import OpenPage
from golden_pictures import assert_golden_screen
from long_replays import long_page
from replayed import canvas, drawn, exports, recording_of
from runs import plain_scenario, scenario_recording

from parser.findings.catalogue import Bilingual
from parser.program import parse_program
from sim.base.progress import silent
from sim.run.recording import recorded
from sim.setup.quiz import Question, WrittenQuestion
from sim.show.replay.document import replay_page

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

EVIL = "</script><script>window.owned = 1</script><img src=x onerror='window.owned = 1'>"
PART = """\
N1: B0 B600 B600 GY L4 //<script>window.owned = 1</script>
N2: B1000 B0 B1000 GX L1
N3: B0 B400 B400 GY L2
N4: B1000 B0 B2000 GY NR1
N5: B0 B400 B400 GY L4
N6: B1000 B0 B1000 GX L4
N7: B0 B600 B600 GY L2
N8: DD
"""
"""A half round of 2 mm, cut from inside; block 6 bears the label of the next quadrant, which is a finding."""
STEPS = 8001  # with the stray one of block 6
WHY = Bilingual("because", "因为")
QUIZ = (
    Question(2, "quadrant", "test"),
    Question(
        4,
        WrittenQuestion(Bilingual("Ready?", "好了吗？"), (Bilingual("Yes", "好了"), Bilingual("No", "没有")), 0, WHY),
        "test",
    ),
)
ZIGZAG = "B100000B97000B100000GXL1 B97000B100000B100000GYL2 B100000B97000B100000GXL3 B97000B100000B100000GYL4"


@functools.cache
def part_page(title: str = "A half round") -> str:
    scenario = plain_scenario(title=title, quiz=QUIZ)
    with recorded(parse_program(PART, "half <b>round</b>.3b"), scenario, silent) as recording:
        return replay_page(recording)


def opened(open_page: OpenPage, page: str | None = None, width: int = 1000, height: int = 700, **how: object) -> "Page":
    """A page that has read its document and drawn it."""
    shown = open_page(part_page() if page is None else page, width, height, **how).page
    shown.evaluate("drycut.player.ready")
    drawn(shown)
    return shown


def until(page: "Page", condition: str) -> None:
    """Wait for something; what Playwright has for that evaluates texts, which the page forbids."""
    page.evaluate(f"async () => {{ while (!({condition})) await new Promise(requestAnimationFrame); }}")


def state(page: "Page") -> dict:
    found: dict = page.evaluate("drycut.player.state()")
    return found


def out(page: "Page", name: str) -> str:
    drawn(page)
    return page.locator(f'[data-out="{name}"]').inner_text()


def do(page: "Page", script: str) -> None:
    page.evaluate(f"() => {{ {script} }}")
    drawn(page)


def colour(page: "Page", x_um: float, y_um: float) -> list[int]:
    """Colour that a place has on the table."""
    px, py = page.evaluate(f"[drycut.player.view.toX({x_um}), drycut.player.view.toY({y_um})]")
    levels: list[int] = canvas(page)[round(py), round(px)].tolist()
    return levels


def named(page: "Page", name: str) -> list[int]:
    """A colour of the style sheet."""
    text = page.evaluate(f"getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()")
    return [int(text[at : at + 2], 16) for at in (1, 3, 5)]


def near(one: list[int], other: list[int], levels: int = 12) -> bool:
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= levels


def test_it_plays_stops_and_ends_at_the_end(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.get_by_role("button", name=re.compile("Play")).click()
    until(page, "drycut.player.state().t > 0.2")
    page.keyboard.press("Space")
    stopped = state(page)
    drawn(page)
    assert not stopped["playing"]
    assert state(page)["t"] == stopped["t"]
    do(page, "drycut.player.setSpeed(10000); drycut.player.play()")
    until(page, "!drycut.player.state().playing")
    end = state(page)
    assert (end["step"], end["block"]) == (STEPS, 6)
    assert out(page, "left") == "0 GY"
    assert out(page, "remaining") == "00:00.00"


@pytest.mark.deeper
def test_time_goes_by_at_the_speed_that_is_set(open_page: OpenPage) -> None:
    page = opened(open_page)
    for speed in (0.01, 2.0):
        took, went = page.evaluate(
            """async (speed) => {
                drycut.player.seek(10);
                drycut.player.setSpeed(speed);
                const frame = () => new Promise(requestAnimationFrame);
                drycut.player.play();
                await frame();
                const first = await frame();
                const since = drycut.player.state().t;
                let [took, last] = [0, first];
                while (last < first + 300) {
                    const now = await frame();
                    took += Math.min(now - last, 250) / 1000;  // longer frames are cut off
                    last = now;
                }
                return [took, drycut.player.state().t - since];
            }""",
            speed,
        )
        assert went == pytest.approx(speed * took, rel=0.1, abs=speed * 0.02)


def test_steps_and_blocks_go_on_and_back_one_by_one(open_page: OpenPage) -> None:
    page = opened(open_page)
    do(page, "drycut.player.seekBlock(3)")
    assert (state(page)["step"], out(page, "left")) == (2000, "2,000 GY")
    assert out(page, "f") == "F = 0 ≥ 0 → −X"
    page.keyboard.press("ArrowRight")
    assert (state(page)["step"], out(page, "x"), out(page, "left")) == (2001, "0.999", "2,000 GY")
    assert out(page, "f") == "F = −1,999 < 0 → +Y"
    assert "999² + 0² − 1,000,000" in out(page, "formula")
    page.keyboard.press("ArrowRight")
    assert (out(page, "y"), out(page, "left")) == ("−0.199", "1,999 GY")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowUp")
    assert (state(page)["step"], state(page)["block"]) == (2000, 3)
    page.keyboard.press("ArrowUp")
    assert (state(page)["step"], state(page)["block"]) == (1600, 2)
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowDown")
    assert state(page)["block"] == 4
    drawn(page)  # what is read out is written with the next frame
    assert page.locator("#live").inner_text() == "Block N5 (5 of 7) · line"


def test_scrubbing_leads_to_the_time_under_the_pointer(open_page: OpenPage) -> None:
    page = opened(open_page)
    bar = page.locator("#bar").bounding_box()
    assert bar
    duration = page.evaluate("drycut.player.duration")
    page.mouse.move(bar["x"] + bar["width"] / 4, bar["y"] + 10)
    page.mouse.down()
    assert state(page)["t"] == pytest.approx(duration / 4, rel=0.01)
    page.mouse.move(bar["x"] + bar["width"] * 3 / 4, bar["y"] + 60)
    page.mouse.up()
    assert state(page)["t"] == pytest.approx(duration * 3 / 4, rel=0.01)
    assert float(page.locator("#bar").get_attribute("aria-valuenow") or 0) == pytest.approx(duration * 3 / 4, rel=0.01)


def test_a_click_on_a_block_leads_there_and_marks_it(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.get_by_text("B1000 B0 B2000 GY NR1").click()
    assert (state(page)["block"], out(page, "block")) == (3, "N4 · 4 / 7")
    running = page.locator('#program [aria-selected="true"]')
    assert running.count() == 1
    assert "N4:" in running.inner_text()


def test_hovering_a_block_tells_its_geometry_and_outlines_it(open_page: OpenPage) -> None:
    page = opened(open_page)
    before = canvas(page)
    page.get_by_text("B1000 B0 B2000 GY NR1").hover()
    said = page.locator("#tip").inner_text().replace("\n", " ")
    for part in ("arc, counter-clockwise", "centre X 0.000, Y −0.200 mm", "radius 1.000 mm", "sweep 180.000°", "Z NR1"):
        assert part in said
    assert (np.abs(canvas(page) - before).max(axis=2) > 60).sum() > 500
    page.mouse.move(200, 300)
    assert not page.locator("#tip").is_visible()
    assert np.array_equal(canvas(page), before)


def test_findings_stand_in_the_time_line_and_lead_to_their_block(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.get_by_role("tab", name="Findings (1)").click()
    assert "block N6, line 6" in page.locator("#findings").inner_text()
    page.locator("#finding-marks button").click()
    assert state(page)["block"] == 5
    do(page, "drycut.player.seek(0)")
    page.locator("#findings button").click()
    assert state(page)["block"] == 5


def test_a_finding_of_a_block_that_never_moves_leads_to_that_block(open_page: OpenPage) -> None:
    page = opened(open_page, replay_page(recording_of("B900B0B900GXL1 B0B0B0GXL1 B0B500B500GYL2 DD")))
    page.locator("#finding-marks button").click()
    assert out(page, "block") == "2 / 3"


@functools.cache
def many_findings() -> str:
    with recorded(parse_program("B99B7B7GYL1 B99B7B7GYL3 " * 200 + "DD"), plain_scenario(), silent) as recording:
        return replay_page(recording)


@pytest.mark.deeper
def test_marks_of_many_findings_lie_apart_and_name_each_kind_once(open_page: OpenPage) -> None:
    page = opened(open_page, many_findings())
    marks = page.locator("#finding-marks button")
    lefts = marks.evaluate_all("all => all.map(mark => mark.getBoundingClientRect().left)")
    assert len(lefts) > 20
    assert all(right - left >= 18 for left, right in pairwise(lefts))
    name = marks.nth(3).get_attribute("aria-label") or ""
    assert name.count("3B204") == 1
    assert re.search(r" ×\d+$", name)


@pytest.mark.deeper
def test_numbers_of_blocks_that_have_no_room_are_not_measured(open_page: OpenPage) -> None:
    page = opened(open_page, many_findings())
    measured = page.evaluate("""() => {
        const measure = CanvasRenderingContext2D.prototype.measureText;
        let count = 0;
        CanvasRenderingContext2D.prototype.measureText = function (text) { count++; return measure.call(this, text); };
        drycut.player.setLoop("from", 1);
        CanvasRenderingContext2D.prototype.measureText = measure;
        return count;
    }""")
    assert measured < 10  # of 400 blocks on a bar of 600 px the sizes of the groups that they are shown in


def test_the_number_of_a_block_of_very_many_is_not_cut_off(open_page: OpenPage) -> None:
    page = opened(open_page)
    do(
        page,
        f"const {{ readoutsIn }} = {exports('readouts')};"
        """
        const doc = JSON.parse(document.getElementById("document").textContent);
        doc.blocks.kind = Array(100000).fill("line");
        const outs = readoutsIn(document.body, doc, { decision: () => null });
        outs.show({ ...drycut.player.state(), block: 45456, deviation: { um: 0 } });
        """,
    )
    cell = page.locator("dd", has=page.locator('[data-out="block"]'))
    assert cell.inner_text() == "45,457"
    assert cell.evaluate("cell => cell.scrollWidth <= cell.clientWidth")


def test_the_language_changes_and_is_kept(open_page: OpenPage) -> None:
    page = opened(open_page)
    assert page.get_by_role("button", name="Block on").is_visible()
    page.get_by_role("button", name="中文").click()
    assert page.locator("html").get_attribute("lang") == "zh-CN"
    assert page.get_by_role("button", name="下一段").is_visible()
    assert page.get_by_role("tab", name="问题").is_visible()
    assert not page.get_by_text("J left").is_visible()
    page.reload()
    assert page.locator("html").get_attribute("lang") == "zh-CN"


def test_the_page_speaks_the_language_of_the_browser(open_page: OpenPage) -> None:
    assert opened(open_page, lang="zh").locator("html").get_attribute("lang") == "zh-CN"


KEYS = {
    "Space": "playing", "ArrowRight": "step", "ArrowLeft": "step", "ArrowDown": "block", "ArrowUp": "step",
    "PageDown": "step", "PageUp": "step", "End": "t", "Home": "t", "]": "speed", "[": "speed", "a": "loop", "b": "loop",
    "l": "loop", "+": "scale", "-": "scale", "9": "scale", "z": "scale", "Shift+ArrowLeft": "center",
    "Shift+ArrowRight": "center", "Shift+ArrowUp": "center", "Shift+ArrowDown": "center", "f": "follow", "m": "times",
    "?": "help", "g": "lang", "q": "quiz",
}  # fmt: skip
SEEN = """() => ({
    ...drycut.player.state(), scale: drycut.player.view.scale, center: drycut.player.view.center,
    follow: document.querySelector('[data-do="follow"]').getAttribute("aria-pressed"),
    times: document.getElementById("magnify").value, help: document.getElementById("help").open,
    lang: document.documentElement.lang, quiz: document.getElementById("quiz-on").getAttribute("aria-pressed"),
})"""


def test_every_key_does_what_it_says(open_page: OpenPage) -> None:
    page = opened(open_page)
    for key, what in KEYS.items():
        do(page, "drycut.player.pause(); drycut.player.seekStep(4100); document.getElementById('help').close()")
        before = page.evaluate(SEEN)
        page.keyboard.press(key)
        drawn(page)
        after = page.evaluate(SEEN)
        assert after[what] != before[what], key
    page.keyboard.press("0")


def test_the_list_of_keys_has_the_keyboard_for_itself(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.keyboard.press("?")
    for key in ("ArrowRight", "l", "?", "q"):
        page.keyboard.press(key)
    drawn(page)
    assert (state(page)["step"], state(page)["loop"]["isOn"], state(page)["playing"]) == (0, False, False)
    page.keyboard.press("Escape")
    assert not page.locator("#help").is_visible()
    page.keyboard.press("?")
    page.keyboard.press("Space")  # on its button
    assert not page.locator("#help").is_visible()


@pytest.mark.deeper
def test_a_loop_that_is_shorter_than_a_frame_is_seen_in_all_its_parts(open_page: OpenPage) -> None:
    page = opened(open_page)
    times = page.evaluate("""async () => {
        drycut.player.setLoop("from", 20);
        drycut.player.setLoop("to", 30.7);
        drycut.player.seek(20);
        drycut.player.setSpeed(10000);
        drycut.player.play();
        const times = [];
        for (let frame = 0; frame < 40; frame++) {
            await new Promise(requestAnimationFrame);
            times.push(drycut.player.state().t);
        }
        return times;
    }""")
    assert all(20 <= t <= 30.7 for t in times)  # no part of the 167 s of an even frame, which would show few places
    assert len({round(t, 3) for t in times}) > 5


@pytest.mark.deeper
def test_the_loop_goes_round(open_page: OpenPage) -> None:
    page = opened(open_page)
    do(page, "drycut.player.seek(20); drycut.player.setSpeed(100)")
    page.keyboard.press("a")
    do(page, "drycut.player.seek(30)")
    page.keyboard.press("b")
    do(page, "drycut.player.seek(22); drycut.player.play()")
    times = page.evaluate("""async () => {
        const times = [];
        for (let frame = 0; frame < 40; frame++) {
            await new Promise(requestAnimationFrame);
            times.push(drycut.player.state().t);
        }
        return times;
    }""")
    assert all(20 <= t <= 30 for t in times)
    assert any(later < earlier for earlier, later in pairwise(times))


def test_wheel_drag_and_two_fingers_move_the_view(open_page: OpenPage) -> None:
    page = opened(open_page)
    box = page.locator("#table").bounding_box()
    assert box
    x, y = 160, 300
    place = f"drycut.player.view.placeOf({x - box['x']}, {y - box['y']})"
    before, scale = page.evaluate(f"[{place}, drycut.player.view.scale]")
    page.mouse.move(x, y)
    page.mouse.wheel(0, -400)
    until(page, f"drycut.player.view.scale > {1.5 * scale}")
    assert page.evaluate(place) == pytest.approx(before, abs=1e-6)
    page.mouse.down()
    page.mouse.move(x + 40, y + 30, steps=3)
    page.mouse.up()
    moved = f"drycut.player.view.placeOf({x + 40 - box['x']}, {y + 30 - box['y']})"
    assert page.evaluate(moved) == pytest.approx(before, abs=1e-6)
    wide = page.evaluate("""() => {
        const table = document.getElementById("table");
        table.setPointerCapture = () => {};
        const box = table.getBoundingClientRect();
        const touch = (name, pointerId, x, y) => table.dispatchEvent(new PointerEvent(name, {
            pointerId, pointerType: "touch", clientX: box.x + x, clientY: box.y + y, bubbles: true }));
        const before = drycut.player.view.scale;
        touch("pointerdown", 1, 200, 300);
        touch("pointerdown", 2, 300, 300);
        touch("pointermove", 1, 150, 300);
        touch("pointermove", 2, 350, 300);
        touch("pointerup", 1, 150, 300);
        touch("pointerup", 2, 350, 300);
        return drycut.player.view.scale / before;
    }""")
    assert wide == pytest.approx(2.0)


@pytest.mark.deeper
def test_a_turned_phone_shows_the_whole_path_unless_the_view_was_moved(open_page: OpenPage) -> None:
    def scale(width: int, height: int) -> float:
        page.set_viewport_size({"width": width, "height": height})
        drawn(page)
        drawn(page)
        found: float = page.evaluate("drycut.player.view.scale")
        return found

    page = opened(open_page, width=390, height=844)
    upright = scale(390, 844)
    turned = scale(844, 390)
    assert turned < upright  # the path is no wider than the table is high now
    assert scale(390, 844) == pytest.approx(upright)
    page.get_by_role("button", name="Zoom in").click()
    assert scale(844, 390) == pytest.approx(1.5 * upright)


def test_controls_answer_to_a_tap(open_page: OpenPage) -> None:
    page = opened(open_page, width=390, height=844, has_touch=True)
    page.get_by_role("button", name="Block on").tap()
    assert state(page)["block"] == 1
    page.get_by_text("B0 B400 B400 GY L4").tap()
    assert state(page)["block"] == 4


def test_the_kerf_opens_behind_the_wire_and_closes_when_it_goes_back(open_page: OpenPage) -> None:
    page = opened(open_page)
    kerf = named(page, "kerf")
    beside = (500.0, -540.0)  # 60 µm off block 2, in its kerf of 200 µm
    assert not near(colour(page, *beside), kerf)
    do(page, "drycut.player.seekBlock(3)")
    assert near(colour(page, *beside), kerf)
    assert not near(colour(page, 500.0, -480.0), kerf)  # 120 µm off it
    do(page, "drycut.player.seekBlock(0)")
    assert not near(colour(page, *beside), kerf)


@pytest.mark.deeper
def test_a_kerf_drawn_bit_by_bit_is_the_kerf_drawn_at_once(open_page: OpenPage) -> None:
    page = opened(open_page)
    do(page, "for (let t = 0; t < 100; t += 0.7) drycut.player.seek(t)")
    page.evaluate("""async () => {
        for (let t = 0; t < 120; t += 1.7) {
            drycut.player.seek(t);
            await new Promise(requestAnimationFrame);
        }
        drycut.player.seek(120);
    }""")
    grown = canvas(page)
    do(page, "const v = drycut.player.view; v.zoomAt(0, 0, 2); drycut.player.seek(0)")
    do(page, "const v = drycut.player.view; v.zoomAt(0, 0, 0.5); drycut.player.seek(120)")
    different = np.abs(canvas(page) - grown).max(axis=2) > 90
    assert different.mean() < 2e-4  # edges that are smoothed twice are a little darker


@pytest.mark.deeper
@pytest.mark.parametrize(("motion", "speed"), [("no-preference", 1000), ("no-preference", 10000), ("reduce", 1000)])
def test_a_piece_that_is_free_drops_and_leaves_a_hole(open_page: OpenPage, motion: str, speed: int) -> None:
    page = opened(open_page, reduced_motion=motion)
    gone, middle = named(page, "gone"), (-500.0, 300.0)
    do(page, "drycut.player.seekBlock(5)")
    assert near(colour(page, *middle), named(page, "table"))
    do(page, f"drycut.player.setSpeed({speed})")  # the fastest is at the end before it has dropped
    seen = page.evaluate(
        """async ([px, py]) => {
            const copy = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
            const pen = copy.getContext("2d", { willReadFrequently: true });
            const seen = [];
            drycut.player.play();
            for (let since = performance.now(); performance.now() < since + 1500; ) {
                await new Promise(requestAnimationFrame);
                pen.drawImage(document.getElementById("table"), -Math.round(px), -Math.round(py));
                seen.push([...pen.getImageData(0, 0, 1, 1).data.slice(0, 3)]);
            }
            return seen;
        }""",
        page.evaluate(f"[drycut.player.view.toX({middle[0]}), drycut.player.view.toY({middle[1]})]"),
    )
    assert near(seen[-1], gone)
    between = [levels for levels in seen if not near(levels, named(page, "table"), 4) and not near(levels, gone, 4)]
    assert bool(between) == (motion == "no-preference")


@pytest.mark.deeper
def test_single_steps_show_their_decisions_and_no_text_covers_another(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.evaluate("""() => {
        window.texts = [];
        const write = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            if (/^F = |×[0-9]/.test(text)) texts.push([text, x, y - 10, x + this.measureText(text).width, y + 2]);
            return write.call(this, text, x, y);
        };
    }""")
    page.keyboard.press("m")
    for step in (2004, 2600, 3300, 4020):  # steep, 45° and flat stretches of the arc
        do(page, f"drycut.player.seekStep({step})")
        page.keyboard.press("z")
        do(page, f"texts.length = 0; drycut.player.seekStep({step})")
        texts = page.evaluate("texts")
        shown = [text for text, *_ in texts]
        assert len(texts) >= 7
        assert shown[0] == out(page, "f")
        assert shown[-1].endswith("µm ×1")
        for (_, *one), (_, *other) in combinations(texts, 2):
            assert one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]


def test_lines_of_many_points_are_thinned_by_no_more_than_is_said(open_page: OpenPage) -> None:
    page = opened(open_page)
    page.evaluate(f"() => {{ window.detail = {exports('detail')}; }}")
    off = page.evaluate("""() => {
        const n = 3000, x = new Float64Array(n), y = new Float64Array(n);
        let seed = 1, toward = 0;
        const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
        for (let at = 1; at < n; at++) {
            if (random() < 0.02) toward += random() < 0.3 ? Math.PI : random() * 6;  // it also comes back on itself
            toward += (random() - 0.5) * 0.02;
            x[at] = x[at - 1] + 5 * Math.cos(toward);
            y[at] = y[at - 1] + 5 * Math.sin(toward);
        }
        const line = detail.detailOf(x, y, new Uint8Array(n));
        const everywhere = { left: -1e9, right: 1e9, bottom: -1e9, top: 1e9 };
        return [0.3, 0.03, 0.003].map((scale) => {
            const kept = [];
            line.visit(scale, 0, n - 1, everywhere, (points, at, past) => kept.push(...points.slice(at, past)));
            let worst = 0;
            for (let at = 0; at + 1 < kept.length; at++) {
                const [a, b] = [kept[at], kept[at + 1]];
                for (let between = a + 1; between < b; between++) {
                    const [ux, uy] = [x[b] - x[a], y[b] - y[a]], [px, py] = [x[between] - x[a], y[between] - y[a]];
                    const share = Math.min(1, Math.max(0, (ux * px + uy * py) / (ux * ux + uy * uy || 1)));
                    worst = Math.max(worst, Math.hypot(px - share * ux, py - share * uy));
                }
            }
            return [worst * scale, kept.length, kept[kept.length - 1]];
        });
    }""")
    counts = [count for _, count, _ in off]
    assert all(worst <= 0.6 and last == 2999 for worst, _, last in off)  # px; 0.3 a level, and those below it
    assert counts[0] > counts[1] > counts[2]
    assert counts[2] < 1000


def test_the_quiz_asks_weighs_and_counts(open_page: OpenPage) -> None:
    page = opened(open_page)
    panel = begun(page)
    panel.locator(".answer").first.wait_for()
    stopped = state(page)
    assert (stopped["block"], stopped["step"], stopped["playing"]) == (1, 600, False)
    assert out(page, "f") == "–"  # no help from the read-outs
    answers = panel.locator(".answer").all_inner_texts()
    right = next(at for at, text in enumerate(answers, 1) if text.endswith("L1"))
    page.keyboard.press(str(right))
    assert "Right." in panel.inner_text()
    page.keyboard.press("Enter")
    page.get_by_text("Ready?").wait_for()
    panel.get_by_role("button", name="No").click()
    assert "No; the right answer is marked. because" in panel.inner_text()
    panel.get_by_role("button", name="Continue").click()
    page.get_by_text("1 of 2 answers were right.").wait_for()
    assert state(page)["step"] == STEPS
    page.get_by_role("button", name="中文").click()
    assert "共答 2 题，答对 1 题" in panel.inner_text()


def begun(page: "Page", who: str = "", number: str = "") -> "Locator":
    """The panel of a quiz that has begun, as fast as it can."""
    page.get_by_role("button", name="Quiz").click()
    panel = page.locator("#quiz")
    panel.get_by_label("Name").fill(who)
    panel.get_by_label("Set").fill(number)
    do(page, "drycut.player.setSpeed(10000)")
    panel.get_by_role("button", name="Continue").click()
    return panel


@pytest.mark.deeper
def test_no_answer_is_given_by_space_and_nothing_tells_the_right_one(open_page: OpenPage) -> None:
    page = opened(open_page)
    panel = begun(page)
    panel.locator(".answer").first.wait_for()
    page.keyboard.press("Space")
    page.keyboard.press("Enter")
    assert panel.locator("#quiz-said").inner_text() == ""
    assert not state(page)["playing"]
    line = page.locator("#program .line", has_text="N2:")
    assert line.inner_text().endswith("N2: B1000 B0 B1000 ▒▒ ▒▒")  # G and the quadrant
    line.hover()
    assert not page.locator("#tip").is_visible()
    assert (out(page, "left"), out(page, "f"), out(page, "formula")) == ("–", "–", "")
    assert not page.locator("#finding-marks").is_visible()
    page.keyboard.press("1")
    assert line.inner_text().endswith("N2: B1000 B0 B1000 GX L1")
    page.keyboard.press("Escape")
    assert not panel.is_visible()
    assert page.locator("#quiz-on").get_attribute("aria-pressed") == "false"


@functools.cache
def unasked_page() -> str:
    with recorded(parse_program(PART, "part.3b"), plain_scenario(), silent) as recording:
        return replay_page(recording)


NEXT = """before => !document.querySelector('#quiz').hidden
    && document.querySelector('#quiz-count').textContent !== before"""


def asked_of(page: "Page", panel: "Locator") -> list[str]:
    """What is asked from here to the end, each answered by the first answer."""
    questions = []
    while panel.locator("#quiz-count").inner_text() != "Quiz finished":
        questions.append(panel.locator("#quiz-ask").inner_text())
        page.keyboard.press("1")
        page.keyboard.press("Enter")
        page.wait_for_function(NEXT, arg=f"Question {len(questions)} of 10")
    return questions


@pytest.mark.deeper
def test_a_number_gives_a_class_the_same_questions_and_a_score_to_take_along(open_page: OpenPage) -> None:
    page = opened(open_page, unasked_page())
    panel = begun(page, who="=1+1", number="17")
    panel.locator(".answer").first.wait_for()
    questions = asked_of(page, panel)
    assert len(questions) == 10
    with page.expect_download() as saving:
        panel.get_by_role("button", name="Save the score").click()
    text = Path(saving.value.path()).read_bytes().decode("utf-8-sig")
    head, *lines = csv.reader(io.StringIO(text))
    assert head == ["name", "set", "question no.", "block", "question", "answer", "right answer", "right"]
    assert [line[4] for line in lines] == questions
    assert {(line[0], line[1]) for line in lines} == {("'=1+1", "17")}
    assert all((line[5] == line[6]) == (line[7] == "1") for line in lines)
    right = sum(line[7] == "1" for line in lines)
    assert f"{right} of 10 answers were right." in panel.inner_text()
    page.keyboard.press("Escape")
    assert asked_again(page, "17") == questions[0]
    assert not panel.is_visible()


def asked_again(page: "Page", number: str) -> str:
    """The first question of a set."""
    panel = begun(page, number=number)
    panel.locator(".answer").first.wait_for()
    first = panel.locator("#quiz-ask").inner_text()
    page.keyboard.press("Escape")
    return first


def test_a_link_names_the_set(open_page: OpenPage) -> None:
    page = opened(open_page, unasked_page())
    page.evaluate("window.location.hash = 'quiz=42'")
    page.keyboard.press("q")
    assert page.locator("#quiz").get_by_label("Set").input_value() == "42"


def test_a_program_without_steps_has_a_quiz_that_says_so(open_page: OpenPage) -> None:
    text = re.sub(r'"quiz":\{.*?\},"tape"', '"quiz":{"own":[],"pool":[],"sets":[]},"tape"', unasked_page())
    page = opened(open_page, text)
    page.get_by_role("button", name="Quiz").click()
    assert "There is nothing to ask" in page.locator("#quiz").inner_text()
    page.get_by_role("button", name="Continue").click()
    assert not page.locator("#quiz").is_visible()


def test_nothing_of_a_program_or_a_scenario_becomes_a_part_of_the_page(open_page: OpenPage) -> None:
    page = opened(open_page, part_page(EVIL))
    assert page.evaluate("window.owned") is None
    assert page.locator("h1").inner_text() == EVIL
    assert EVIL in page.title()
    assert "<script>window.owned = 1</script>" in page.locator("#program").inner_text()
    assert "half <b>round</b>.3b" in page.locator(".about").inner_text()
    assert EVIL not in part_page(EVIL)


def test_after_a_trip_the_replay_ends_there_and_says_so(open_page: OpenPage) -> None:
    page = opened(open_page, replay_page(scenario_recording("servo-trip")))
    assert page.get_by_text("A drive tripped: the replay ends there.").is_visible()
    do(page, "drycut.player.seek(1e9)")
    assert state(page)["block"] == 4
    assert out(page, "remaining") == "00:00.00"


@pytest.mark.alike(1)
@pytest.mark.parametrize(("lang", "dark"), [("en", False), ("zh", True)])
def test_anyone_can_use_it(open_page: OpenPage, lang: str, dark: bool) -> None:
    page = opened(open_page, lang=lang, dark=dark)
    page.get_by_role("tab").last.click()
    assert page_checks.complaints(page) == []


def test_a_phone_shows_table_controls_and_text_one_below_the_other(open_page: OpenPage) -> None:
    page = opened(open_page, width=390, height=844)
    tops = [page.locator(part).bounding_box() for part in ("#stage", "#transport", ".readouts", "#program")]
    assert all(one and other and one["y"] + one["height"] <= other["y"] for one, other in pairwise(tops))
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


@functools.cache
def million_steps() -> str:
    return long_page(f"{ZIGZAG} {ZIGZAG} DD")


@pytest.mark.deeper
def test_a_million_steps_load_soon_and_play_smoothly(open_page: OpenPage) -> None:
    text = million_steps()
    assert len(text.encode()) < 5e6
    page = opened(open_page, text)
    loaded_s = page.evaluate("performance.now() / 1000")  # since the page began to load
    assert page.evaluate("drycut.player.seekStep(1e9), drycut.player.state().step") > 1_000_000
    empty, played, script = page.evaluate("""async () => {
        const frame = () => new Promise(requestAnimationFrame);
        const spans = async (count) => {
            const found = [];
            let last = await frame();
            for (let at = 0; at < count; at++) {
                const now = await frame();
                found.push(now - last);
                last = now;
            }
            return found;
        };
        const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1];
        const pen = document.createElement("canvas").getContext("2d");
        pen.fillRect(0, 0, 1, 1);
        const empty = middle(await spans(40));
        const ask = window.requestAnimationFrame;
        const spent = [];
        window.requestAnimationFrame = (call) => ask((now) => {
            const since = performance.now();
            call(now);
            spent.push(performance.now() - since);
        });
        drycut.player.seek(5000);
        drycut.player.setSpeed(1000);
        drycut.player.play();
        const played = middle(await spans(60));
        window.requestAnimationFrame = ask;
        return [empty, played, middle(spent)];
    }""")
    print(f"loaded in {loaded_s:.2f} s; frames of {played:.1f} ms, empty {empty:.1f} ms, script {script:.1f} ms")
    assert loaded_s < 5.0
    assert script < 16.0  # half of all frames; measured 2 ms
    assert played < 3 * empty + 1


@pytest.mark.deeper
def test_many_blocks_keep_few_lines_in_the_page(open_page: OpenPage) -> None:
    page = opened(open_page, million_steps())
    page.locator("#program").evaluate("box => box.scrollTop = 0")
    assert page.locator("#program .line").count() < 60


LOOKS = {
    "replay-whole": (1000, 700, "en", False, "drycut.player.seek(120)"),
    "replay-steps": (1000, 700, "zh", True, "drycut.player.seekStep(2600)"),
    "replay-phone": (390, 844, "zh", False, "drycut.player.seek(60)"),
}


@pytest.mark.alike(1)
@pytest.mark.parametrize("name", LOOKS)
def test_it_looks_as_it_did(open_page: OpenPage, name: str) -> None:
    width, height, lang, dark, script = LOOKS[name]
    page = opened(open_page, width=width, height=height, lang=lang, dark=dark, shipped_font=True)
    do(page, script)
    if name == "replay-steps":
        page.keyboard.press("z")
    drawn(page)
    assert_golden_screen(page, f"{name}.png")


@pytest.mark.deeper
def test_paper_has_the_picture_sharp_and_light_with_its_place_and_time(open_page: OpenPage) -> None:
    page = opened(open_page, dark=True)
    do(page, "drycut.player.seekBlock(3)")
    drawn(page)
    screen = canvas(page).shape
    pdf = page.pdf(prefer_css_page_size=True)
    assert re.findall(rb"/Type\s*/Page\b", pdf) == [b"/Type /Page"]
    drawn(page)
    assert canvas(page).shape == screen
    page.emulate_media(media="print")
    drawn(page)
    printed = canvas(page)
    width = page.locator("#table").evaluate("table => table.clientWidth")
    assert printed.shape[1] == 4 * width
    assert printed[4, 4].min() > 200
    assert page.locator(".clock").is_visible()
    assert page.locator("[data-out=x]").is_visible()
    for control in ("header nav", ".tools", "#bar", "#program", '[data-do="toggle"]'):
        assert not page.locator(control).first.is_visible(), control
