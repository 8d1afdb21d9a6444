"""A replay of a cut under sparks shows its meters, its time and what happened; one without shows nothing of it."""

from functools import cache

import pytest
from axe import needs_axe, violations
from browser import OpenPage
from page_checks import complaints
from runs import scenario_recording

from sim.show.replay.document import replay_page
from sim.show.replay.sparks import spark_tape


@cache
def page_of(name: str) -> str:
    return replay_page(scenario_recording(name))


def test_the_tape_goes_by_the_steps_of_the_program() -> None:
    run = scenario_recording("sparks-chip").run
    tape = spark_tape(run)
    assert tape is not None
    assert tape["step"] == sorted(tape["step"])
    assert tape["step"][0] < 200
    assert tape["step"][-1] == pytest.approx(len(run.stepped), abs=200)
    assert len(tape["step"]) <= 2000
    assert [event["row"] for event in tape["events"]] == [2, 1]


def test_meters_time_and_events_are_of_the_moment(open_page: OpenPage) -> None:
    page = open_page(page_of("sparks-chip"), lang="zh").page
    page.evaluate("drycut.player.ready")
    page.evaluate("drycut.player.seekBlock(2)")
    page.wait_for_function("() => document.querySelector('#spark-events li') !== null")
    assert "短路" in page.inner_text("#spark-events")
    at_corner = page.inner_text("#spark-time")
    page.evaluate("drycut.player.seekBlock(5)")
    page.wait_for_function("() => document.querySelector('#spark-events li') === null")
    assert page.inner_text("#spark-time") > at_corner
    assert "rotate(" in str(page.get_attribute("#spark-volts .needle", "transform"))


def test_a_replay_without_sparks_has_none_of_it() -> None:
    html = page_of("lost-steps")
    assert "under-sparks" not in html
    assert "spark-tape" not in html


@needs_axe
@pytest.mark.parametrize(("lang", "dark"), [("zh", False), ("en", True)])
def test_it_breaks_no_rule(open_page: OpenPage, lang: str, dark: bool) -> None:
    page = open_page(page_of("sparks-chip"), lang=lang, dark=dark).page
    page.evaluate("drycut.player.ready")
    assert violations(page) == []
    assert complaints(page) == []
