"""The panel in a browser: it cuts as a run does, to the tick; keys drive it; a sitting makes the same cut."""

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from axe import needs_axe, violations
from browser import OpenPage
from page_checks import complaints
from runs import plain_scenario, scenario_run

from controller.stepping.counters import counters_after
from parser.program import parse_program
from sim.process.cut import Started
from sim.process.ticks import state as ticks
from sim.process.ticks.tick import run_ticks
from sim.run.running import dry_run
from sim.run.sparks import panel_cut
from sim.setup.scenario import Scenario, without_sparks
from sim.setup.spark import Event, Law, Spark
from sim.show.html.environment import joined
from sim.show.panel_page.page import panel_entry, panel_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

ASSETS = Path(__file__).parents[2] / "sim" / "show" / "panel_page" / "assets"
HEAD = '<!doctype html><html lang="en"><title>x</title><meta charset="utf-8">'
BARE = HEAD + "<script>const machine = {0}, counters = {1};</script>"
ARCS = "B300B0B300GXL1 B400B0B800GYNR1 B100B250B250GYL2 B0B200B800GXSR2 B150B40B150GXL3 DD"
WHOLE = [ticks.TICKS, ticks.AT, ticks.FARTHEST, ticks.ALL_SPARKS, ticks.SHORTS, ticks.BREAKS, ticks.LOGGED]
NEAR = [ticks.FRONT_UM, ticks.RESET_UM_S, ticks.REMOVED_UM3, ticks.RETREATED_UM, ticks.AREA_UM2]


def cut_of(text: str, spark: Spark, *events: Event) -> tuple[Scenario, Started]:
    scenario = plain_scenario(spark=spark, events=events)
    return scenario, panel_cut(dry_run(parse_program(text), without_sparks(scenario)), scenario)


@cache
def chip_page() -> str:
    run = scenario_run("sparks-chip")
    return panel_page(run.scenario, panel_cut(run, run.scenario))


def bare(open_page: OpenPage) -> "Page":
    html = BARE.replace("{0}", joined(ASSETS / "machine.js")).replace("{1}", joined(ASSETS / "counters.js"))
    return open_page(html).page


def entry_of(started: Started) -> Any:
    return json.loads(json.dumps(panel_entry(started), allow_nan=False))


@pytest.mark.parametrize("law", ["voltage", "window", "duty"])
def test_the_panel_cuts_as_a_run_does(open_page: OpenPage, law: Law) -> None:
    """A minute and a half of cutting with a short, a pause and a turned knob: counts equal, sums to 1e-9 of them."""
    spark = Spark(law=law, least_um_s=5.0 if law == "duty" else None, seed=11, most_mm2_min=400.0)
    events = (
        Event("short", 2, share=0.3, for_s=9.0, clear_um=40.0),
        Event("pause", 1, share=0.5, for_s=4.0),
        Event("set", at_s=9.0, set_value=0.35 if law == "voltage" else 0.6),
        Event("sparks-off", at_s=20.0, for_s=0.2),
    )
    _, started = cut_of(ARCS, spark, *events)
    started = started._replace(job=started.job._replace(bounds=started.job.bounds._replace(is_manned=1.0)))
    page = bare(open_page)
    page.evaluate(
        "panel => { window.cut = machine.newCut(panel); window.count = counters.newCounters(panel); }",
        entry_of(started),
    )
    for _ in range(30):
        came_to = run_ticks(started.job, started.state, 3000)
        found = page.evaluate("() => { window.cut.advance(3000); return [window.cut.status, ...window.cut.state]; }")
        state = np.array(found[1:])
        assert found[0] == came_to
        assert state[WHOLE].tolist() == started.state[WHOLE].tolist()
        assert state[NEAR] == pytest.approx(started.state[NEAR], rel=1e-9, abs=1e-9)
    walls = page.evaluate("() => Array.from(window.cut.job.records.lit_s)")
    assert walls == pytest.approx(started.job.records.lit_s.tolist(), abs=1e-9)
    assert started.state[ticks.AT] > 500


def test_counters_of_the_panel_are_those_of_the_control(open_page: OpenPage) -> None:
    """X, Y, F and J left at any step, forward and back, across arcs."""
    _, started = cut_of(ARCS, Spark())
    page = bare(open_page)
    page.evaluate("panel => { window.count = counters.newCounters(panel); }", entry_of(started))
    random, work = np.random.default_rng(5), started.work
    asked = [(int(row), int(random.integers(work.steps.count[row] + 1))) for row in random.integers(0, 5, 300)]
    found = page.evaluate("asked => asked.map(([row, made]) => window.count.at(row, made))", asked)
    for (row, made), shown in zip(asked, found, strict=True):
        wanted = counters_after(work.steps, work.words, row, made)._asdict()
        assert shown == {name: wanted[name] for name in ("x_um", "y_um", "deviation", "count_left_um")}


def test_keys_pressed_again_at_their_ticks_make_the_same_cut(open_page: OpenPage) -> None:
    _, started = cut_of(ARCS, Spark(seed=3))
    page = bare(open_page)
    page.evaluate("panel => { window.panel = panel; }", entry_of(started))
    first, again = page.evaluate(
        """() => {
            const keys = [["set", 0.3], ["chip", 0], ["off", 60], ["hold", 1], ["hold", 0], ["tear", 0], ["thread", 1],
                ["mode", 2], ["pump", 0], ["pump", 1], ["hand", -0.3], ["hand", 0], ["fail", 0], ["restart", 0],
                ["mode", 5]];
            const cut = machine.newCut(window.panel);
            for (const [name, value] of keys) {
                cut.advance(713);
                cut.press(name, value);
            }
            cut.advance(5000);
            const other = machine.newCut(window.panel, cut.presses);
            for (let round = 0; round < 1e4 && (other.state[0] < cut.state[0] || other.ahead.length); round += 1) {
                other.advance(Math.max(Math.min(97, cut.state[0] - other.state[0]), 1));
            }
            return [cut, other].map(({ state, presses }) => [Array.from(state), presses]);
        }"""
    )
    assert first == again
    assert len(first[1]) == 15


def test_a_class_drives_it_by_keyboard(open_page: OpenPage) -> None:
    page = open_page(chip_page(), lang="zh").page
    value = page.locator("#set-value")
    page.keyboard.press("ArrowUp")
    page.wait_for_function("() => document.querySelector('#set-value').textContent === '0.41'")
    page.keyboard.press("b")
    page.wait_for_selector("#alarm:not([hidden])")
    assert "断丝" in page.inner_text("#alarm")
    page.keyboard.press("t")
    page.wait_for_function("() => document.querySelector('#alarm').hidden")
    page.keyboard.press("f")
    page.wait_for_selector("#alarm:not([hidden])")
    page.keyboard.press("e")
    page.wait_for_function("() => document.querySelector('#alarm').hidden")
    page.keyboard.press("h")
    page.wait_for_function("() => document.querySelector('#key-hold').getAttribute('aria-pressed') === 'true'")
    page.keyboard.press("h")
    page.keyboard.press("c")
    page.wait_for_function(
        f"() => window.drycutPanel.cut().state[{ticks.SHORTS}] > 0"
        " || document.querySelector('#lamp-chip').dataset.lit === '1'"
    )
    assert value.inner_text() == "0.41"
    assert [name for _, name, _ in page.evaluate("window.drycutPanel.cut().presses")] == [
        *("set", "tear", "thread", "fail", "restart", "hold", "hold", "chip")
    ]


def test_a_cut_comes_to_its_end_and_a_sitting_is_saved_and_played(open_page: OpenPage, tmp_path: Path) -> None:
    scenario, started = cut_of("B200B0B200GXL1 B0B150B150GYL2 DD", Spark(seed=2))
    page = open_page(panel_page(replace(scenario, title="short"), started)).page
    page.keyboard.press("ArrowDown")
    for _ in range(6):
        page.keyboard.press("+")
    page.wait_for_function("() => document.querySelector('#alarm').textContent.includes('Done in')")
    state = page.evaluate("Array.from(window.drycutPanel.cut().state)")
    with page.expect_download() as saved:
        page.locator("#save").click()
    file = tmp_path / "sitting.json"
    saved.value.save_as(file)
    page.evaluate("() => { window.before = window.drycutPanel.cut(); }")
    page.set_input_files("#load", file)
    page.wait_for_function("() => window.drycutPanel.cut() !== window.before && window.drycutPanel.cut().isThrough()")
    assert page.evaluate("Array.from(window.drycutPanel.cut().state)") == state
    file.write_text(json.dumps({"schema": "drycut.sitting/1", "cut": "other", "presses": []}), "utf-8")
    page.set_input_files("#load", file)
    page.wait_for_selector("#unread:not([hidden])")


def test_what_a_program_says_stands_escaped_in_the_panel() -> None:
    scenario, started = cut_of("B200B0B200GXL1 DD", Spark())
    named = replace(scenario, title="</script><img src=x onerror=alert(1)>")
    html = panel_page(named, started)
    assert "<img" not in html
    assert html == panel_page(named, started)


@needs_axe
@pytest.mark.parametrize(("lang", "dark", "width"), [("zh", False, 1280), ("en", True, 390)])
def test_the_panel_breaks_no_rule(open_page: OpenPage, lang: str, dark: bool, width: int) -> None:
    page = open_page(chip_page(), lang=lang, dark=dark, width=width).page
    page.keyboard.press("b")
    page.wait_for_selector("#alarm:not([hidden])")
    assert violations(page) == []
    assert complaints(page) == []
