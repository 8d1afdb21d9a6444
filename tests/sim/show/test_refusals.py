"""Why no program is made, and why entities are left out: every reason that the code gives has its text."""

import re

import pytest
from places import ROOT

from parser.toolpath import Point
from sim.cam.model import Refusal
from sim.show.refusals import places_said, why_refused
from sim.show.words.words import texts

SOURCES = "\n".join(
    path.read_text("utf-8")
    for folder in ("sim/cam", "parser/drawing")
    for path in sorted((ROOT / folder).rglob("*.py"))
)
REFUSED = sorted(set(re.findall(r"\bRefusal\(\s*\"([\w-]+)\"", SOURCES)))
LEFT_OUT = sorted(set(re.findall(r"\bLeftOut\([^\"]*?\"([\w-]+)\"", SOURCES)))


@pytest.mark.parametrize("why", REFUSED)
def test_every_refusal_has_its_text(why: str) -> None:
    assert f"refused-{why}" in texts("program")


@pytest.mark.parametrize("why", LEFT_OUT)
def test_every_reason_to_leave_out_has_its_text(why: str) -> None:
    assert f"left-out-{why}" in texts("program")


def test_a_refusal_tells_its_first_places() -> None:
    places = tuple(Point(1000.0 * at, -500.0) for at in range(7))
    said = why_refused(Refusal("no-contour", places))
    assert said.en == (
        "no contour of the drawing is closed, at (0, -0.5), (1, -0.5), (2, -0.5), (3, -0.5), (4, -0.5) mm "
        "and 2 more places"
    )
    assert places_said([(0.0, -0.0)]).zh == "(0, 0) mm"
