"""Grips of a planned figure in a real browser: dragged and clicked, they change what is asked of the plan."""

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from browser import Browsers
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from open_tab import Tab, places_of, planned, tab
from opened_page import OpenedPage, opened_page

if TYPE_CHECKING:
    from playwright.sync_api import Page

Place = tuple[float, float]
AHEAD, ASIDE = 40.0, 15.0
"""Px from where a cut starts to the grips."""


@pytest.fixture(name="empty", scope="module")
def served_nothing() -> Iterator[OpenedPage]:
    with opened_page() as served:
        yield served


class Plans:
    """What the page was last told of its plan."""

    def __init__(self, page: "Page") -> None:
        self.last: dict[str, Any] = {}
        self._page, self._taken = page, 0
        page.on("response", self._take)

    def _take(self, response: Any) -> None:
        if response.url.endswith("/plan"):
            self.last = json.loads(response.text())
            self._taken += 1

    def settles(self, read: Callable[[dict[str, Any]], Any]) -> Any:
        """A figure of the plan once the page has asked for none for half a second."""
        seen = -1
        while seen != self._taken:
            seen = self._taken
            self._page.wait_for_timeout(500)
        return read(self.last)

    def outline(self) -> dict[str, Any]:
        """The figure that is cut last: the outline of the plate."""
        figure: dict[str, Any] = self.last["figures"][-1]
        return figure


def heading_of(figure: dict[str, Any]) -> Place:
    """The wire runs beside the waste: counter-clockwise outside of a figure, it has the waste on its right."""
    x, y = figure["out"]
    return (-y, x) if figure["is_ccw"] != figure["is_inside"] else (y, -x)


def drags(page: "Page", begin: Place, end: Place) -> None:
    page.mouse.move(*begin)
    page.mouse.down()
    page.mouse.move(*((a + b) / 2.0 for a, b in zip(begin, end, strict=True)), steps=3)
    page.mouse.move(*end, steps=3)
    page.mouse.up()


def plate(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (40, 0), (40, 20), (0, 20)], close=True)
    space.add_circle((20, 10), 4.0)


def beside(at: Callable[[float, float], Place], figure: dict[str, Any], along: Place, px: float) -> Place:
    """A place on the page so many px from where a figure is cut from."""
    x, y = at(*(um / 1000.0 for um in figure["entry_um"]))
    return x + px * along[0], y - px * along[1]


def begun(shown: Tab, plans: Plans, tmp_path: Path) -> Callable[[float, float], Place]:
    """The plate is planned, and the pointer is at the thread point of its outline."""
    shown.page.set_input_files("#pick", drawn(tmp_path, plate))
    planned(shown.page, "2 figures")
    at = places_of(shown)
    shown.page.mouse.move(*at(*(um / 1000.0 for um in plans.outline()["thread_um"])))
    return at


def value(page: "Page", name: str) -> str:
    return page.input_value(f"#{name}")


def test_an_arrow_turns_the_cut_round_and_a_knob_takes_it_to_the_other_side(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    with tab(browsers, empty.address) as shown:
        page, plans = shown.page, Plans(shown.page)
        at = begun(shown, plans, tmp_path)
        for does in ("drag", "click"):
            figure, was = plans.outline(), plans.outline()["is_ccw"]
            arrow = beside(at, figure, heading_of(figure), AHEAD)
            with page.expect_response("**/plan"):
                if does == "drag":
                    drags(page, arrow, beside(at, figure, heading_of(figure), -AHEAD))
                else:
                    page.mouse.click(*arrow)
            assert plans.settles(lambda plan: plan["figures"][-1]["is_ccw"]) is not was
            assert value(page, "direction") == ("cw" if was else "ccw")
        figure = plans.outline()
        assert not figure["is_inside"]
        with page.expect_response("**/plan"):
            drags(page, beside(at, figure, figure["out"], ASIDE), beside(at, figure, figure["out"], -ASIDE))
        assert value(page, "wire-side") == "inside"
        assert value(page, "picks") == value(page, "starts") == "", "no click got through"


def test_a_tab_is_as_long_as_its_bar_is_dragged(browsers: Browsers, empty: OpenedPage, tmp_path: Path) -> None:
    with tab(browsers, empty.address) as shown:
        page, plans = shown.page, Plans(shown.page)
        at = begun(shown, plans, tmp_path)
        figure = plans.outline()
        x, y = heading_of(figure)
        behind = -x, -y
        assert figure["tab_um"] is None
        px_mm = abs(at(1, 0)[0] - at(0, 0)[0])
        drags(
            page,
            beside(at, figure, behind, AHEAD),
            beside(at, figure, behind, 3.0 * px_mm),
        )
        planned(page)
        assert float(value(page, "tab")) == pytest.approx(3.0, abs=0.15)
        begins = plans.settles(lambda plan: plan["figures"][-1]["tab_um"])
        away = math.dist(begins, plans.outline()["entry_um"]) / 1000.0
        assert away == pytest.approx(float(value(page, "tab")), abs=0.11), "and it begins there, the offset aside"
        drags(page, at(*(um / 1000.0 for um in begins)), beside(at, figure, behind, 2.0))
        assert value(page, "tab") == "", "none is shorter than its kerfs are wide"


def test_passes_are_added_by_clicks_and_dragged_once_they_are_seen_apart(
    browsers: Browsers, empty: OpenedPage, tmp_path: Path
) -> None:
    with tab(browsers, empty.address) as shown:
        page, plans = shown.page, Plans(shown.page)
        at = begun(shown, plans, tmp_path)
        page.select_option("#click-does", "passes")
        thread = at(*(um / 1000.0 for um in plans.outline()["thread_um"]))
        with page.expect_response("**/plan"):
            page.mouse.click(*thread)
        assert value(page, "passes") == "0.15 0.1"
        way = at(39.0, 20.15)  # on the upper edge of the outline
        page.mouse.move(*way)
        for _ in range(14):
            page.mouse.wheel(0, -240)
            page.wait_for_timeout(30)
        page.wait_for_timeout(300)
        near = places_of(shown)
        px_mm = abs(near(1, 0)[0] - near(0, 0)[0])
        assert px_mm > 100.0, "a tenth of a millimetre is seen"
        drags(page, near(38.9, 20.15), near(38.9, 20.25))
        rough, last = map(float, value(page, "passes").split())
        assert (rough, last) == (pytest.approx(0.25, abs=0.015), 0.1)
        highest_um = plans.settles(lambda plan: max(plan["path"]["place_y_um"]))
        assert highest_um == pytest.approx(20_000.0 + 1000.0 * rough, abs=2.0)
