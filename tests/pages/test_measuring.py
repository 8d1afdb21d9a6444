"""Measuring on the page of drycut open, held against closed forms; and links to a moment of the replay."""

import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import Browsers, OpenPage
from open_tab import Tab, tab
from opened_page import OpenedPage, opened_page
from replayed import recording_of

from sim.show.replay.document import replay_page

# A line from (0, 0) to (10, 0), an arc of 5 mm about (10, 5) up to (10, 10), a line back to (0, 10), and one down.
SLOT = "N10: B10000B0B10000GXL1\nN20: B0B5000B10000GXNR4\nN30: B10000B0B10000GXL3\nN40: B0B10000B10000GYL4\nDD\n"


@pytest.fixture(name="served", scope="module")
def served_slot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[OpenedPage]:
    file = tmp_path_factory.mktemp("slot") / "slot.3b"
    file.write_text(SLOT, "utf-8")
    with opened_page(file) as served:
        yield served


class Ruler:
    """The picture of a page on which is measured, by places in mm."""

    def __init__(self, shown: Tab) -> None:
        self.page = shown.page
        shown.page.wait_for_selector("#figures td")
        box = shown.page.locator("#picture").bounding_box()
        assert box is not None
        self.box = box
        # The path of 15 mm by 10 mm is fitted into the canvas, 7 % free on each side, less 40 px at the head and 34 px
        # at the foot.
        self.scale = min(box["width"] / 15.0, (box["height"] - 74.0) / 10.0) * (1.0 - 2.0 * 0.07)

    def at(self, x: float, y: float) -> dict[str, float]:
        middle_x = self.box["x"] + self.box["width"] / 2.0
        middle_y = self.box["y"] + 40.0 + (self.box["height"] - 74.0) / 2.0
        return {"x": middle_x + (x - 7.5) * self.scale, "y": middle_y - (y - 5.0) * self.scale}

    def click(self, x: float, y: float) -> None:
        self.page.mouse.click(**self.at(x, y))

    def told(self) -> tuple[str, dict[str, str]]:
        names, values = (self.page.locator(f"#measured {tag}").all_inner_texts() for tag in ("dt", "dd"))
        return self.page.inner_text("#measured p"), dict(zip(names, values, strict=True))


def test_an_arc_says_its_radius_and_centre(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as shown:
        ruler = Ruler(shown)
        shown.page.keyboard.press("m")
        ruler.click(10.0 + 5.0 * math.cos(0.5) + 0.02, 5.0 + 5.0 * math.sin(0.5))
        kind, found = ruler.told()
        assert kind == "on the path"
        assert (found["radius"], found["diameter"], found["sweep"]) == ("5.000 mm", "10.000 mm", "180.000°")
        assert (found["centre X"], found["centre Y"]) == ("10.000 mm", "5.000 mm")


def test_two_ends_of_a_half_circle(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as shown:
        ruler = Ruler(shown)
        shown.page.click("#measure")
        ruler.click(10.1, 0.05)
        ruler.click(10.05, 9.95)
        kind, found = ruler.told()
        assert kind == "end → end"
        assert (found["distance"], found["ΔX"], found["ΔY"], found["angle"]) == (
            *("10.000 mm", "0.000 mm", "10.000 mm"),
            "90.000°",
        )
        assert float(found["along the path"].removesuffix(" mm")) == pytest.approx(5.0 * math.pi, abs=5e-4)
        shown.page.keyboard.press("Escape")
        assert shown.page.locator("#measured").is_hidden()


def test_a_tangent_and_a_perpendicular_are_taken_hold_of(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as shown:
        ruler = Ruler(shown)
        shown.page.click("#measure")
        ruler.click(14.5, 9.5)
        far = math.hypot(4.5, 4.5)
        angle = math.atan2(4.5, 4.5) - math.acos(5.0 / far)
        ruler.click(10.0 + 5.0 * math.cos(angle) + 0.05, 5.0 + 5.0 * math.sin(angle) - 0.03)
        kind, found = ruler.told()
        assert kind == "free → tangent"
        # A free place is as exact as a pixel, here about 0.03 mm.
        assert float(found["distance"].removesuffix(" mm")) == pytest.approx(math.sqrt(far**2 - 25.0), abs=0.06)
        ruler.click(3.0, 10.0)  # a third place begins anew
        ruler.click(3.1, 0.05)
        kind, found = ruler.told()
        assert kind == "on the path → perpendicular"
        assert (found["distance"], found["across"]) == ("10.000 mm", "10.000 mm")


@pytest.mark.deeper
def test_a_centre_is_taken_hold_of(browsers: Browsers, served: OpenedPage) -> None:
    with tab(browsers, served.address) as shown:
        ruler = Ruler(shown)
        shown.page.click("#measure")
        ruler.click(0.0, 0.0)
        ruler.click(10.05, 5.05)
        kind, found = ruler.told()
        assert kind == "end → centre"
        assert float(found["distance"].removesuffix(" mm")) == pytest.approx(math.hypot(10.0, 5.0), abs=5e-4)
        assert "along the path" not in found


@pytest.mark.deeper
def test_a_link_leads_to_a_moment_or_a_block_of_the_replay(open_page: OpenPage) -> None:
    page = open_page(replay_page(recording_of(SLOT))).page
    page.wait_for_selector("#loading", state="hidden")
    state = "drycut.player.state()"
    for hash_, truth in (
        ("t=1.5", f"{state}.t === 1.5"),
        ("block=N30", f"{state}.block === 2"),
        ("block=4", f"{state}.block === 3"),
        ("t=1e9", f"{state}.t === drycut.player.duration"),
    ):
        page.evaluate("hash => { window.location.hash = hash; }", hash_)
        page.wait_for_function(f"() => {truth}")
    for nonsense in ("t=abc", "block=N99", "block=%E0%A4%A", "t=", "=&=&", "block=" + "9" * 5000):
        page.evaluate("hash => { window.location.hash = hash; }", nonsense)
    page.evaluate("drycut.player.seek(2.25)")
    page.click('[data-do="link"]')
    page.wait_for_function("() => window.location.hash === '#t=2.250'")
    # The page says so once the browser has taken the link, or has refused it: some time after the address has it.
    page.wait_for_function("() => document.querySelector('#live').innerText.includes('link to this moment')")


@pytest.mark.deeper
def test_the_block_of_the_caret_leads_into_the_replay(browsers: Browsers, tmp_path: Path) -> None:
    (tmp_path / "slot.3b").write_text(SLOT, "utf-8")
    with opened_page(tmp_path / "slot.3b") as served, tab(browsers, served.address) as shown:
        shown.page.wait_for_selector("#figures td")
        shown.page.click("#start")
        shown.page.wait_for_selector("#looks button")
        shown.page.evaluate("document.querySelector('#text').setSelectionRange(30, 30)")
        shown.page.click("#text", position={"x": 60, "y": 30})
        link = shown.page.locator("#moment")
        assert link.inner_text() == "Replay from block N20"
        assert link.get_attribute("href") == "run/1/replay.html#block=N20"
        shown.page.keyboard.type(" ")
        shown.page.wait_for_selector("#moment", state="hidden")
