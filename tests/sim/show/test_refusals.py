"""Why no program is made, and why entities are left out: every reason that the code gives has its text."""

import ast
from typing import get_args

import pytest
from places import ROOT

from parser.drawing.loops.chain import WhyFlat
from parser.toolpath import Point
from sim.make.cam.model import UNCUT, Refusal
from sim.show.refusals import places_said, why_refused
from sim.show.texts.texts import texts

TREES = [
    ast.parse(path.read_text("utf-8"))
    for folder in ("sim/make/cam", "parser/drawing")
    for path in sorted((ROOT / folder).rglob("*.py"))
]


def named_in_calls_of(*functions: str) -> set[str]:
    """Words that are given to functions as they stand, or one or the other of two."""
    calls = [node for tree in TREES for node in ast.walk(tree) if isinstance(node, ast.Call)]
    given = [arg for call in calls if getattr(call.func, "id", "") in functions for arg in call.args]
    either = [one for arg in given for one in ((arg.body, arg.orelse) if isinstance(arg, ast.IfExp) else (arg,))]
    return {one.value for one in either if isinstance(one, ast.Constant) and isinstance(one.value, str)}


REFUSED = sorted(named_in_calls_of("Refusal", "refused"))
OF_FIGURES = {"falls-apart", "narrow-neck", "narrow-slot", "no-room", "too-near", "too-small"}
LEFT_OUT = sorted(named_in_calls_of("LeftOut", "_left_out", "_Uncertain") | set(get_args(WhyFlat)) | set(UNCUT))


@pytest.mark.parametrize("why", REFUSED)
def test_every_refusal_has_its_text(why: str) -> None:
    assert f"refused-{why}" in texts("program")


@pytest.mark.parametrize("why", LEFT_OUT)
def test_every_reason_to_leave_out_has_its_text(why: str) -> None:
    assert f"left-out-{why}" in texts("program")


def test_what_keeps_a_figure_from_being_cut_is_to_be_checked() -> None:
    assert set(UNCUT) >= OF_FIGURES
    assert set(REFUSED) >= OF_FIGURES - {"narrow-neck", "narrow-slot"}  # which of the two is chosen by a condition


def test_a_refusal_tells_its_first_places() -> None:
    places = tuple(Point(1000.0 * at, -500.0) for at in range(7))
    said = why_refused(Refusal("no-contour", places))
    assert said.en == (
        "no contour of the drawing is closed, at (0, -0.5), (1, -0.5), (2, -0.5), (3, -0.5), (4, -0.5) mm "
        "and 2 more places"
    )
    assert places_said([(0.0, -0.0)]).zh == "(0, 0) mm"
