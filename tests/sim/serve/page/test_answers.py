"""What the page is told of a program at once."""

import pytest
from places import ROOT
from runs import run_text

from sim.base.units import clock
from sim.serve.page.answers import answer


@pytest.mark.parametrize("scenario", ["keyhole", "arm-hit"])
def test_the_time_is_that_of_a_run_but_for_accelerations(scenario: str) -> None:
    text = (ROOT / "scenarios" / scenario / "program.3b").read_text("utf-8")
    ran_s = run_text(text).ran_s
    time, _, by = answer("part.3b", None, text)["size"]["time"]["en"].partition(", ")
    assert by == "by the feeds of dk7740 in 40 mm"
    assert time in {clock(ran_s * share) for share in (1.0, 0.998, 0.999, 1.001, 1.002)}
