"""Where the wire is threaded, and how far its path goes from there, against places along each curve."""

import math

import numpy as np
import pytest
from places import ROOT
from runs import scenario_run

from parser.program import parse_program
from parser.toolpath import Toolpath
from sim.jobs.shop import program_read, source_of
from sim.measure.threadings import threadings
from sim.run.prepare import as_run
from sim.run.report import build_report
from sim.setup.scenario import load_scenario

PLACES = 2000  # along each curve
TWO_HOLES = """\
B0B500B500GYL4
B500B0B2000GYNR1
B0B500B500GYL2
D
B3000B1000B3000GXL1
D
B200B0B200GXL3
DD
"""


def places(toolpath, row: int) -> np.ndarray:
    """Places (n, 2) along a curve, from its centre and its sweep."""
    start, end = toolpath.start_um[row], toolpath.end_um[row]
    if not toolpath.is_arc[row]:  # no place on a line lies further off than its ends
        return np.array([start, (start + end) / 2.0, end])
    center = toolpath.center_um[row]
    radius, sweep = math.hypot(*(start - center)), float(toolpath.sweep_rad[row])
    angles = math.atan2(*(start - center)[::-1]) + sweep * np.linspace(0.0, 1.0, PLACES + 1)
    return center + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def plain(toolpath) -> list[tuple[int, int, tuple[float, ...]]]:
    """First and last row of each stretch without a jump, and its reach to the left, right, down and up."""
    found: list[tuple[int, int, tuple[float, ...]]] = []
    rows: list[int] = []
    for row in range(len(toolpath) + 1):
        if row < len(toolpath) and not toolpath.is_jump[row]:
            rows.append(row)
        elif rows:
            off = np.concatenate([places(toolpath, one) for one in rows]) - toolpath.start_um[rows[0]]
            (left, down), (right, up) = -off.min(axis=0), off.max(axis=0)
            found.append((rows[0], rows[-1], (left, right, down, up)))
            rows = []
    return found


def path_of(name: str) -> Toolpath:
    """The path that a scenario runs, without its run."""
    scenario = load_scenario(ROOT / "scenarios" / name)
    return as_run(program_read(scenario, source_of(scenario)), scenario.offset).toolpath


@pytest.mark.parametrize(
    "name",
    [
        "keyhole",
        "die",
        "plate",
        "rough-and-trim",
        "iso-die",
        "out-of-travel",
        pytest.param("logo", marks=pytest.mark.deeper),
    ],
)
def test_reach_is_that_of_places_along_the_path(name: str) -> None:
    toolpath = path_of(name)
    found = threadings(toolpath, np.arange(len(toolpath) + 1.0))
    known = plain(toolpath)
    assert [(one.first, one.last) for one in found] == [(first, last) for first, last, _ in known]
    radius_um = float(np.nanmax(toolpath.radius_um, initial=0.0))
    sagitta_um = radius_um * (1.0 - math.cos(math.pi / PLACES))
    for one, (first, last, reach) in zip(found, known, strict=True):
        assert (one.left_um, one.right_um, one.down_um, one.up_um) == pytest.approx(reach, abs=sagitta_um + 1e-6)
        assert one.at_um == tuple(toolpath.start_um[first])
        assert one.out_um == tuple(toolpath.end_um[last])
        assert (one.at_s, one.out_s) == (first, last + 1.0)


def test_two_holes_worked_out_by_hand() -> None:
    toolpath = parse_program(TWO_HOLES).toolpath
    first, second = threadings(toolpath, np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0]))
    # The lead goes down by 500; the circle about a place 500 to the left of its end comes back to it.
    assert (first.left_um, first.right_um, first.down_um, first.up_um) == (1000.0, 0.0, 1000.0, 0.0)
    assert (first.at_s, first.out_s) == (0.0, 3.0)
    assert second.at_um == (3000.0, 1000.0)
    assert (second.left_um, second.right_um, second.down_um, second.up_um) == (200.0, 0.0, 0.0, 0.0)
    assert (second.at_s, second.out_s) == (4.0, 5.0)


def test_what_the_run_did_not_come_to_has_no_time() -> None:
    run = scenario_run("servo-trip")
    assert run.ended is not None
    (*_, last) = build_report(run)["thread_points"]
    assert last["out_s"] is None
