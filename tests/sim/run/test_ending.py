"""A run that stops early: where, when and why, and that all its figures are of what ran."""

import io
import json
import math
from pathlib import Path

import numpy as np
import pytest
from runs import codes, machine, run_text, scenario_run

from controller.card.log import CardLog
from parser.controller_words import Axis
from parser.program import parse_program
from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.part import DrawingTarget
from sim.show.terminal.run import summary_rows

HOLE = "B100B0B100GXL1 B0B100B100GYL2 B100B0B100GXL3 B0B100B100GYL4"
EDGE = "B500B0B500GXL1 B0B200B200GYL2 B500B0B500GXL3 B0B200B200GYL4"
PROGRAM = f"{HOLE} D B300B0B300GXL1 D {EDGE} DD"
SMALL = {"travel_x_mm": 1.0, "travel_y_mm": 1.0}


def at_the_end(**changes: object) -> DryRun:
    """A hole, a jump, and a rectangle whose first side leaves a travel of 1 mm after 100 µm."""
    return run_text(PROGRAM, machine=machine(**SMALL), start_mm=(0.6, 0.5), **changes)


def test_a_run_ends_with_the_last_step_on_the_travel() -> None:
    run = at_the_end()
    assert codes(run) == ["3B401"]
    assert run.ended is not None
    assert (run.ended.cause, run.ended.axis, run.ended.row) == ("travel", Axis.X, 5)
    assert (run.ended.x_um, run.ended.y_um) == (400.0, 0.0)
    assert run.ran_um == pytest.approx(400.0 + 300.0 + 100.0)
    # 500 µm of cut at 43.75 µm/s, 300 µm of jump at 500 µm/s, two starts and stops of each at 100 mm/s².
    assert run.ran_s == pytest.approx(500 / 43.75 + 300 / 500 + 1.5 * 43.75 / 1e5 + 500 / 1e5, abs=1e-6)
    assert run.stepped.count.tolist() == [100, 100, 100, 100, 300, 100, 0, 0, 0]
    assert run.trace.t_s[-1] == run.ran_s
    assert run.trace.commanded_um[-1].tolist() == [400.0, 0.0]
    assert run.trace.table_um[:, 0].max() == pytest.approx(400.0, abs=2.5)  # within its play, and the last step
    assert run.losses == ()


def test_all_totals_are_of_what_ran() -> None:
    run = at_the_end()
    report = build_report(run)
    assert report["ended"] == {"cause": "travel", "axis": "X", "block": 6, "t_s": report["time_s"]["total"]} | {
        "x_um": 400.0,
        "y_um": 0.0,
    }
    assert report["time_s"]["total"] == pytest.approx(run.ran_s, abs=1e-6)
    assert sum(report["time_s"]["by_block"]) == pytest.approx(run.ran_s, abs=1e-5)
    assert report["time_s"]["by_block"][6:] == [0.0, 0.0, 0.0]
    assert (report["summary"]["length_um"], report["summary"]["steps"]) == (800.0, 800)
    assert [(one["first_block"], one["last_block"]) for one in report["contours"]] == [(1, 4)]
    rows = dict(summary_rows(run))
    assert rows["path length"] == "0.800 mm"
    assert rows["stopped"].startswith("in block 6 after 12.0 s: the X travel ends here")


def test_after_a_trip_table_and_picture_give_one_total() -> None:
    run = scenario_run("servo-trip")
    report = build_report(run)
    assert run.ended is not None
    assert report["ended"]["cause"] == "trip"
    assert report["time_s"]["total"] == pytest.approx(run.ended.t_s, abs=1e-6)
    assert [(one["first_block"], one["last_block"]) for one in report["contours"]] == [(1, 4)]
    assert report["summary"]["length_um"] == pytest.approx(float(run.plan.at(run.ended.t_s).along_um), abs=1e-6)
    assert report["summary"]["steps"] == len(run.stepped) <= report["summary"]["length_um"] + 1.0
    assert [one["steps"] for one in (block["stepped"] for block in report["blocks"])][5:] == [0] * 4
    assert report["findings"][0]["code"] == "3B403"


@pytest.mark.parametrize("interpolator", ["point-by-point", "card"])
@pytest.mark.parametrize(
    ("text", "start_mm", "place_um"),
    [
        ("B0B600B600GYL2 DD", (0.5, 0.5), (0.0, 500.0)),
        ("B300B400B400GYL3 B300B400B400GYL3 DD", (0.5, 0.5), (-375.0, -500.0)),
        ("B400B0B1600GYNR1 DD", (0.9, 0.8), (-200.0, 200.0)),  # R 400 about (0.5, 0.8): out at y = 1 mm
        ("B100B0B100GXL1 DD", (1.0, 0.5), (0.0, 0.0)),  # the first step leaves
    ],
)
def test_the_end_lies_where_the_path_leaves(
    text: str, start_mm: tuple[float, float], place_um: tuple[float, float], interpolator: str
) -> None:
    small = machine(**SMALL).stepping_by(interpolator)  # type: ignore[arg-type]
    run = run_text(text, machine=small, start_mm=start_mm, may_stay_open=True)
    assert run.ended is not None
    expected = (400.0 * math.cos(math.asin(0.5)) - 400.0, 200.0) if "NR" in text else place_um
    assert (run.ended.x_um, run.ended.y_um) == pytest.approx(expected, abs=2.0)  # µm: a step, and its slope
    assert np.hypot(*(run.trace.commanded_um[-1] - expected)) <= 3.0
    low, high = (np.array([0.0, 0.0]) - start_mm) * 1000.0, (np.array([1.0, 1.0]) - start_mm) * 1000.0
    assert (run.trace.commanded_um >= low - 0.5).all()
    assert (run.trace.commanded_um <= high + 0.5).all()
    assert build_report(run)["ended"]["cause"] == "travel"


def test_a_path_that_keeps_to_its_travel_runs_to_its_end() -> None:
    run = run_text("B500B0B500GXL1 DD", machine=machine(**SMALL), start_mm=(0.5, 0.5), may_stay_open=True)
    assert (run.ended, codes(run), run.trace.commanded_um[-1].tolist()) == (None, [], [500.0, 0.0])


def test_past_the_stop_it_goes_on() -> None:
    run = at_the_end(past_stop=True)
    assert run.ended is None
    assert run.trace.commanded_um[-1].tolist() == [300.0, 0.0]
    assert run.trace.table_um[:, 0].max() <= 400.0 + 1e-6
    assert "3B402" in codes(run)


def test_the_card_is_stopped_where_the_run_ends() -> None:
    scenario, stream = at_the_end().scenario, io.StringIO()
    log = CardLog(stream, scenario.machine.controller.card_settings)
    dry_run(parse_program(PROGRAM), scenario, log=log)
    assert "GT_EStpMtn() = 0" in stream.getvalue()
    pulses = json.loads(stream.getvalue().splitlines()[-1].removeprefix("end "))["pulses"]
    assert 800 <= pulses <= 850  # of 2100; the card brakes


def test_beyond_the_travel_nothing_else_is_held_against_the_drawing(tmp_path: Path) -> None:
    """The cut ends early: that it differs from its drawing as a whole comes of that alone."""
    corners = "".join(f"10\n{x}\n20\n{y}\n" for x, y in ((0.0, 0.0), (500.0, 0.0), (500.0, 1.0), (0.0, 1.0)))
    drawing = tmp_path / "part.dxf"
    drawing.write_text(
        f"0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n{corners}0\nENDSEC\n0\nEOF\n", "ascii"
    )
    text = "B500000B0B500000GXL1 B0B1000B1000GYL2 B500000B0B500000GXL3 B0B1000B1000GYL4 DD"
    table = machine(travel_x_mm=2.0)
    run = run_text(text, machine=table, start_mm=(1.0, 100.0), drawing=DrawingTarget(drawing))
    assert codes(run) == ["3B401"]
    remains = next(check for check in run.coverage.checks if check.name == "check-remains")
    assert (run.comparison, remains.state, remains.reason) == (None, "incomplete", "reason-ended")
