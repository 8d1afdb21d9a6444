"""A replay of a wire that leans shows U and V at each step, and its walls in space; one of an upright wire neither."""

import math
import re
from functools import cache

import numpy as np
import pytest
from axe import needs_axe, violations
from browser import OpenPage
from page_checks import complaints
from playwright.sync_api import Page
from runs import scenario_recording

from sim.show.replay.document import replay_page
from sim.show.replay.lean import lean_entry


@cache
def page_of(name: str) -> str:
    return replay_page(scenario_recording(name))


def told_uv(page: Page) -> tuple[float, float]:
    """U and V as they stand on the page, mm."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    found = re.fullmatch(r"U (.+) V (.+) mm", page.inner_text("#lean-uv").replace("\N{MINUS SIGN}", "-"))
    assert found is not None
    return float(found[1]), float(found[2])


def test_u_and_v_are_those_of_the_step_on_lines_against_arcs(open_page: OpenPage) -> None:
    """Round on square: at share s of a half side the top is at that share of an arc of 45°; guides are 200 mm apart."""
    page = open_page(page_of("taper-round-on-square"), lang="en").page
    page.evaluate("drycut.player.ready")
    for step in (1, 137, 2500, 5000, 9999):
        page.evaluate(f"drycut.player.seekBlock(4); drycut.player.stepBy({step})")
        angle = math.radians(135.0 + 45.0 * step / 10_000.0)
        u, v = 8.0 * math.cos(angle) + 10.0, 8.0 * math.sin(angle) - (10.0 - 1e-3 * step)
        # The program gives ends of arcs in whole µm: up to 1 µm, times 200 mm of guides over 40 mm of work.
        assert told_uv(page) == pytest.approx((5.0 * u, 5.0 * v), abs=5e-3)


def test_u_and_v_are_those_of_the_step_along_a_draft(open_page: OpenPage) -> None:
    """A punch of 3°: along its right side the wire leans straight out by 200 mm tan 3°, wherever a step is."""
    page = open_page(page_of("taper-cone"), lang="zh").page
    page.evaluate("drycut.player.ready")
    for step in (10, 7001, 19_990):
        page.evaluate(f"drycut.player.seekBlock(2); drycut.player.stepBy({step})")
        assert told_uv(page) == pytest.approx((200.0 * math.tan(math.radians(3.0)), 0.0), abs=2e-3)


def test_the_table_shows_both_contours_in_their_colours(open_page: OpenPage) -> None:
    """Round on square: on the circle of 8 mm at 22.5°, and on the side of the square beside the path's own line."""
    page = open_page(page_of("taper-round-on-square"), lang="en").page
    page.evaluate("drycut.player.ready")
    page.evaluate("drycut.player.seekStep(0)")
    told_uv(page)
    found = page.evaluate(
        """() => {
            const table = document.getElementById("table");
            const ratio = table.width / table.clientWidth;
            const pen = table.getContext("2d");
            const { view } = drycut.player;
            const seen = ([x, y]) => {
                const [px, py] = [view.toX(x) * ratio, view.toY(y) * ratio].map(Math.round);
                const bytes = [...pen.getImageData(px - 2, py - 2, 5, 5).data];
                return bytes.map((byte) => byte.toString(16).padStart(2, "0"));
            };
            const shade = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
            return { on: seen([8000 * Math.cos(Math.PI / 8), 8000 * Math.sin(Math.PI / 8)]), top: shade("--top") };
        }"""
    )
    pixels = ["#" + "".join(found["on"][at : at + 3]) for at in range(0, len(found["on"]), 4)]
    assert found["top"] in pixels
    assert page.locator(".legend .top, .legend .bottom").count() == 2


def test_walls_turn_by_keys_and_the_replay_stays_where_it_is(open_page: OpenPage) -> None:
    page = open_page(page_of("taper-cone"), lang="en").page
    page.evaluate("drycut.player.ready")
    page.evaluate("drycut.player.seekBlock(3)")
    picture = "document.querySelector('#walls').toDataURL()"
    told_uv(page)  # by then the walls are drawn
    before, step = page.evaluate(picture), page.evaluate("drycut.player.state().step")
    page.press("#walls", "ArrowRight")
    turned = page.evaluate(picture)
    assert turned != before
    assert page.evaluate("drycut.player.state().step") == step
    page.press("#walls", "Home")
    assert page.evaluate(picture) == before


def test_rows_of_both_contours_hang_together() -> None:
    for name in ("taper-cone", "taper-die", "taper-round-on-square", "taper-two-files"):
        run = scenario_recording(name).run
        entry = lean_entry(run)
        assert entry is not None
        assert run.tilted is not None
        for of in (run.tilted.path.ruled.lower, run.tilted.path.ruled.upper):
            np.testing.assert_allclose(of.start_um[1:], of.end_um[:-1], atol=1e-6)
        assert set(entry["block"]) == set(range(len(run.toolpath)))


def test_a_replay_of_an_upright_wire_has_none_of_it() -> None:
    html = page_of("keyhole")
    assert 'id="leaning"' not in html
    assert 'id="lean"' not in html


@needs_axe
@pytest.mark.parametrize(("lang", "dark"), [("zh", False), ("en", True)])
def test_it_breaks_no_rule(open_page: OpenPage, lang: str, dark: bool) -> None:
    page = open_page(page_of("taper-die"), lang=lang, dark=dark).page
    page.evaluate("drycut.player.ready")
    assert violations(page) == []
    assert complaints(page) == []
