"""The course of a run: its deviation at any moment against the measure, and what happens in it and when."""

import math
from dataclasses import replace

import numpy as np
import pytest
from runs import plain_scenario, scenario_recording

from parser.findings.findings import Finding
from parser.program import parse_program
from parser.toolpath import Stop
from sim.base.progress import silent
from sim.cut.pieces.pieces import Piece
from sim.measure.deviation import across_um
from sim.run.course import Course, course_of
from sim.run.recording import recorded
from sim.table.losses import Loss

PART = """
B300 B0 B300 GX L1
B0 B300 B300 GY L2
B600 B0 B600 GX L3
B0 B600 B600 GY L4
B600 B0 B600 GX L1
B0 B300 B300 GY L2
D
B1200 B0 B1200 GX L1
DD
"""
"""A square that a slug comes free of, a pause, and a jump whose contour does not close."""


def course_of_scenario(name: str) -> Course:
    return course_of(scenario_recording(name))


def course_of_text(text: str) -> Course:
    with recorded(parse_program(text), plain_scenario(), silent) as recording:
        return course_of(recording)


@pytest.mark.alike(2)
@pytest.mark.parametrize("name", ["wire-lag-corner", "wire-lag-arc", "backlash", "friction", "servo-trip"])
def test_the_deviation_at_every_sample_is_that_of_the_measure(name: str) -> None:
    course = course_of_scenario(name)
    run, trace = course.run, course.trace
    expected = np.abs(across_um(run.toolpath, trace, trace.wire_um, run.plan.at(trace.t_s).along_um))
    found = np.array([course.at(t).deviation_um for t in trace.t_s.tolist()])
    assert np.abs(found - expected).max() < 1e-9  # µm
    assert found.max() == pytest.approx(run.deviations.wire.max_um, abs=1e-9)


def test_between_samples_no_moment_deviates_more_than_the_worse_of_the_two() -> None:
    course = course_of_scenario("wire-lag-corner")
    samples = np.abs(course.across.off_um)
    t_s = course.trace.t_s
    for share in (0.1, 0.5, 0.9):
        times = t_s[:-1] + share * np.diff(t_s)
        found = np.array([course.at(t).deviation_um for t in times.tolist()])
        assert (found <= np.maximum(samples[:-1], samples[1:]) + 1e-9).all()


def test_events_come_with_their_rows_and_times() -> None:
    course = course_of_text(PART)
    (piece,), (pause, end) = course.pieces, course.stops
    border_s = course.border_s
    assert (piece.what.kind, piece.row) == ("slug", 5)
    assert border_s[5] < piece.t_s <= border_s[6]
    assert (pause.what.kind, pause.row, pause.t_s) == ("pause", 6, border_s[6])
    assert (end.what.kind, end.row, end.t_s) == ("end", 7, border_s[7])
    assert border_s[-1] == pytest.approx(course.run.plan.duration_s, abs=1e-9)
    for finding in course.findings:
        assert finding.row == finding.what.block - 1
        assert finding.t_s == border_s[finding.row]
    assert [one.t_s for one in course.happenings] == sorted(one.t_s for one in course.happenings)
    assert {type(one.what) for one in course.happenings} >= {Piece, Stop}


def test_a_finding_about_no_block_has_no_time_and_does_not_happen() -> None:
    course = course_of_text(PART)
    about_all = Finding("3B602", {"what": "no-edge"})
    with recorded(parse_program(PART), plain_scenario(), silent) as recording:
        run = replace(recording.run, findings=(about_all, *recording.run.findings))
        with_it = course_of(recording._replace(run=run))
    first = with_it.findings[0]
    assert (first.what, first.row) == (about_all, -1)
    assert math.isnan(first.t_s)
    assert [one.t_s for one in with_it.happenings] == [one.t_s for one in course.happenings]


def test_a_trip_ends_what_happens() -> None:
    course = course_of_scenario("servo-trip")
    trip = course.run.ended
    assert trip is not None
    assert (course.losses[-1].what.kind, course.losses[-1].t_s, course.losses[-1].row) == ("trip", trip.t_s, trip.row)
    assert any(isinstance(one.what, Loss) for one in course.happenings)
    end = course.stops[-1]
    assert end.what.kind == "end"
    assert end.t_s > course.duration_s
    assert end not in course.happenings
    assert course.happenings[-1].t_s <= course.duration_s == trip.t_s
