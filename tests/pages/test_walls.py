"""The walls of a leaning wire in the report: turned by keys and pointer, cut at a height, the wire at a place."""

from functools import cache

from axe import needs_axe, violations
from browser import OpenPage
from page_checks import complaints
from runs import scenario_run

from sim.run.report.document import build_report
from sim.show.html.walls import walls_entry
from sim.show.report_page.page import report_page


@cache
def page_of(name: str) -> str:
    run = scenario_run(name)
    return report_page(run, build_report(run), [])


def slide(page: object, selector: str, value: float) -> None:
    page.eval_on_selector(  # type: ignore[attr-defined]
        selector, "(e, v) => { e.value = String(v * e.max); e.dispatchEvent(new Event('input')); }", value
    )


def test_walls_are_places_of_both_faces_one_beside_the_other() -> None:
    walls = walls_entry(scenario_run("taper-round-on-square").tilted)
    assert walls is not None
    assert len(walls["bottom"]) == len(walls["top"]) == len(walls["cuts"]) == len(walls["block"])
    assert max(x for x, _ in walls["bottom"]) == 10.0
    assert all(abs((x * x + y * y) ** 0.5 - 8.0) < 1e-3 for x, y in walls["top"][1:-1])
    assert (walls["lower_guide_mm"], walls["upper_guide_mm"], walls["work_mm"]) == (-60.0, 140.0, 40.0)


def test_a_slider_cuts_the_walls_at_a_height(open_page: OpenPage) -> None:
    page = open_page(page_of("taper-round-on-square")).page
    slide(page, "#walls-height", 0.0)
    assert page.inner_text("#walls-told").startswith("z 0.00 mm · 20.000 × 20.000 mm")
    slide(page, "#walls-height", 0.5)
    assert page.inner_text("#walls-told").startswith("z 20.00 mm · 18.000 × 18.000 mm")
    slide(page, "#walls-along", 1.0)
    assert "#10" in page.inner_text("#walls-told")
    assert page.inner_text("#walls-told").endswith("U 0.000 V 0.000")


def test_keys_and_pointer_turn_the_walls(open_page: OpenPage) -> None:
    page = open_page(page_of("taper-round-on-square")).page
    look = "() => document.querySelector('#walls').toDataURL()"
    page.locator("#walls").scroll_into_view_if_needed()
    first = page.evaluate(look)
    page.locator("#walls").press("ArrowRight")
    turned = page.evaluate(look)
    assert turned != first
    page.locator("#walls").press("Home")
    assert page.evaluate(look) == first
    box = page.locator("#walls").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 160, box["y"] + 120)
    page.mouse.up()
    assert page.evaluate(look) not in {first, turned}


def test_an_upright_cut_has_no_walls() -> None:
    html = page_of("drops-early")
    assert 'id="walls"' not in html
    assert 'href="#taper"' not in html


def test_the_page_of_a_lean_lacks_nothing(open_page: OpenPage) -> None:
    assert complaints(open_page(page_of("taper-die"), lang="zh").page) == []


@needs_axe
def test_axe_finds_nothing_in_the_page_of_a_lean(open_page: OpenPage) -> None:
    assert violations(open_page(page_of("taper-die"), lang="zh").page) == []
