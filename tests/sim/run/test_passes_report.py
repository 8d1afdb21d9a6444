"""What the report and the course of a run tell of passes, against the generator of the program."""

import pytest
from rough_and_trim import REACH_UM
from trimmed import trimmed, trimmed_run, untrimmed_run

from sim.run.course import course_of
from sim.run.report import build_report


def test_each_pass_is_told_with_its_blocks_offset_direction_and_tab() -> None:
    entries = build_report(trimmed_run().run)["passes"]
    expected = trimmed().passes
    assert [(one["contour"], one["number"]) for one in entries] == [(1, 1), (1, 2), (1, 3), (1, 4)]
    assert [one["blocks"] for one in entries] == [[true.first + 1, true.last + 1] for true in expected]
    assert [one["offset_um"] for one in entries] == pytest.approx([true.offset_um for true in expected], abs=1.0)
    assert [one["direction"] for one in entries] == ["back" if true.is_back else "forward" for true in expected]
    assert [one["cuts_tab"] for one in entries] == [true.is_tab for true in expected]


def test_length_time_and_deviation_of_a_pass_are_those_of_its_blocks() -> None:
    report = build_report(trimmed_run().run)
    for one in report["passes"]:
        rows = slice(one["blocks"][0] - 1, one["blocks"][1])
        blocks = report["blocks"][rows]
        assert one["length_um"] == pytest.approx(sum(block["exact"]["length_um"] for block in blocks), abs=1e-4)
        assert one["time_s"] == pytest.approx(sum(report["time_s"]["by_block"][rows]), abs=1e-4)
        assert one["deviation"]["max_um"] == max(block["table"]["max_deviation_um"] for block in blocks)
    worst = max(report["passes"], key=lambda one: one["deviation"]["max_um"])["deviation"]
    where = report["deviation"]["wire"]["where"]
    assert worst == {"max_um": report["deviation"]["wire"]["max_um"], "where_um": [where["x_um"], where["y_um"]]}


def test_rough_cuts_take_the_kerf_and_trims_what_the_pass_before_left() -> None:
    rough, trim, tab, tab_trim = (one["stock_um"] for one in build_report(trimmed_run().run)["passes"])
    assert rough == {"least": 2.0 * REACH_UM, "most": 2.0 * REACH_UM, "mean": 2.0 * REACH_UM}
    # The table lies up to 2.5 µm beside each of the two paths.
    assert trim["mean"] == pytest.approx(20.0, abs=1.0)
    assert 15.0 < trim["least"] <= trim["mean"] <= trim["most"] < 27.0
    assert tab["most"] == 2.0 * REACH_UM
    assert tab_trim["least"] < tab_trim["mean"] < tab_trim["most"] < 25.0  # at its ends the trim was there before


def test_a_contour_that_is_cut_once_is_one_pass() -> None:
    (entry,) = build_report(untrimmed_run().run)["passes"]
    assert (entry["contour"], entry["number"], entry["blocks"]) == (1, 1, [1, 4])
    assert (entry["offset_um"], entry["direction"], entry["cuts_tab"]) == (REACH_UM, "forward", False)
    assert entry["stock_um"]["mean"] == 2.0 * REACH_UM


def test_a_moment_names_the_pass_that_runs_and_none_on_leads() -> None:
    course = course_of(trimmed_run())
    for row in range(len(course.run.toolpath)):
        moment = course.at((course.border_s[row] + course.border_s[row + 1]) / 2.0)
        expected = [one.number for one in trimmed().passes if one.first <= row <= one.last]
        assert ([moment.running.pass_.number] if moment.running else []) == expected
        assert moment.running is None or moment.running.among == 4


def test_where_every_edge_is_cut_once_no_pass_is_spoken_of() -> None:
    course = course_of(untrimmed_run())
    assert not course.run.has_trims
    assert course.passes == ()
    assert course.at(course.duration_s / 2.0).running is None
