"""Findings of what the drives lose: by axis and stretch of blocks, no more than a page of them, nothing left out."""

import math
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from parser.controller_words import Axis
from parser.findings.catalogue import texts
from parser.program import Program, parse_program
from sim.setup.machine.motor import Motor
from sim.table.losses import MOST_FINDINGS, Loss, loss_findings

STEPPER = Motor("stepper", 0.002, 6.0, math.inf, ((0.0, 2000.0),))
SERVO = Motor("servo", 0.001, 6.0, 100.0, ((0.0, 2000.0),))
BLOCKS = 100


def program(blocks: int = BLOCKS, a_line: int = 1) -> Program:
    """A program with so many blocks, and so many of them on each line."""
    lines = ("B10B0B10GXL1" * min(a_line, blocks - first) for first in range(0, blocks, a_line))
    return parse_program("\n".join([*lines, "DD"]))


PROGRAM = program()


def slip(row: int, axis: Axis = Axis.X, amount_um: float = 6.0) -> Loss:
    return Loss("lost-steps", axis, row, t_s=float(row), amount_um=amount_um, x_um=10.0 * row, y_um=-2500.0)


def found(*losses: Loss, motor: Motor = STEPPER) -> list[tuple[str, object, int, object, object]]:
    findings = loss_findings(PROGRAM, losses, motor)
    return [(f.code, f.values["axis"], f.block, f.values["last"], f.values["lost"]) for f in findings]


def test_a_run_without_losses_has_no_findings() -> None:
    assert loss_findings(PROGRAM, (), STEPPER) == []


def test_a_slip_is_found_at_its_block_with_axis_time_and_place() -> None:
    (finding,) = loss_findings(PROGRAM, (slip(41, Axis.Y, -12.0),), STEPPER)
    assert (finding.code, finding.block, finding.line, finding.column) == ("3B402", 42, 42, 1)
    assert finding.values == {
        "axis": "Y",
        "t_s": 41.0,
        "x_mm": 0.41,
        "y_mm": -2.5,
        "lost": 12.0,
        "last": 42,
        "chance": "",
    }
    assert texts(finding).found == (
        "the Y motor slips at 0.410, -2.500 mm, 0:00:41.00 into the run, and loses 12.00 µm up to block 42"
    )


def test_blocks_that_slip_one_after_the_other_are_one_finding() -> None:
    assert found(slip(3), slip(4, amount_um=12.0), slip(5), slip(8), slip(9)) == [
        ("3B402", "X", 4, 6, 24.0),
        ("3B402", "X", 9, 10, 12.0),
    ]


def test_slips_to_and_fro_do_not_hide_each_other() -> None:
    assert found(slip(3), slip(4, amount_um=-6.0)) == [("3B402", "X", 4, 5, 12.0)]


def test_axes_are_told_apart() -> None:
    assert found(slip(3), slip(4, Axis.Y), slip(5)) == [
        ("3B402", "X", 4, 4, 6.0),
        ("3B402", "Y", 5, 5, 6.0),
        ("3B402", "X", 6, 6, 6.0),
    ]


def test_past_the_most_the_last_finding_holds_the_rest() -> None:
    slips = [slip(row) for row in range(0, BLOCKS, 2)]
    assert found(*slips) == [
        *(("3B402", "X", row + 1, row + 1, 6.0) for row in range(0, 2 * (MOST_FINDINGS - 1), 2)),
        ("3B402", "X", 2 * MOST_FINDINGS - 1, BLOCKS - 1, 6.0 * (len(slips) - MOST_FINDINGS + 1)),
    ]


def test_a_trip_is_found_with_following_error_and_limit() -> None:
    trip = Loss("trip", Axis.Y, 6, t_s=3.5, amount_um=-100.25, x_um=70.0, y_um=0.0)
    (finding,) = loss_findings(PROGRAM, (trip,), SERVO)
    assert (finding.code, finding.block) == ("3B403", 7)
    assert finding.values == {"axis": "Y", "t_s": 3.5, "x_mm": 0.07, "y_mm": 0.0, "lag": 100.25, "limit": 100.0}
    assert texts(finding).message == (
        "the Y servo is 100.25 µm behind its command at 0.070, 0.000 mm, 0:00:03.50 into the run; expected a following "
        "error of 100.00 µm at most; the servo trips, the machine stops there, and nothing of the rest is cut"
    )


def test_findings_stand_in_file_order() -> None:
    losses = (slip(90, Axis.X), slip(20, Axis.Y), slip(21, Axis.X), slip(22, Axis.Y))
    findings = loss_findings(program(a_line=10), losses, STEPPER)
    assert [(f.block, f.line) for f in findings] == [(21, 3), (22, 3), (23, 3), (91, 10)]
    assert [f.column for f in findings] == [1, 13, 25, 1]


@pytest.mark.parametrize("axis", list(Axis))
@given(st.lists(st.integers(0, BLOCKS - 1), unique=True))
def test_every_loss_is_in_just_one_finding(axis: Axis, rows: list[int]) -> None:
    losses = tuple(slip(row, axis, 6.0 * (1 + row % 5)) for row in rows)
    findings = loss_findings(PROGRAM, losses, STEPPER)
    assert len(findings) <= MOST_FINDINGS
    assert bool(findings) == bool(losses)
    covered = Counter(row for f in findings for row in range(f.block - 1, int(f.values["last"])))
    assert all(covered[row] == 1 for row in rows)
    assert set(covered.values()) <= {1}
    if len(findings) < MOST_FINDINGS:
        assert set(covered) == set(rows)
    for f in findings:
        inside = [6.0 * (1 + row % 5) for row in rows if f.block - 1 <= row < int(f.values["last"])]
        assert f.values["lost"] == pytest.approx(sum(inside), abs=1e-9)
