"""What was not looked at is told, and never counts as clean."""

from places import SCENARIOS

from parser.program import parse_program
from sim.check.engine import Checked, Demands, run_checks

OPEN = "B10000B0B10000GXL1 B0B10000B10000GYL2 B10000B0B9000GXL3 B0B10000B10000GYL4 DD"


def checked(text: str) -> Checked:
    return run_checks(parse_program(text), Demands())


def left_out(text: str) -> dict[str, str]:
    """Incomplete checks with the reason."""
    return {check.name: check.reason for check in checked(text).coverage.checks if check.state == "incomplete"}


def test_beyond_any_number_neither_blocks_nor_prints_are_compared() -> None:
    reasons = left_out("Length= 1.0 mm\nB1B0B99999999999GXL1;1.000,0.000\nDD")
    expected = ("check-blocks", "check-printed-ends", "check-header", "check-steps", "check-contours")
    assert {reasons[name] for name in expected} == {"reason-too-large"}
    assert "check-grammar" not in reasons


def test_senses_and_crossings_leave_open_contours_out() -> None:
    assert left_out(OPEN) == {"check-senses": "reason-open", "check-crossings": "reason-open"}


def test_no_arc_is_accused_beside_a_wrong_block() -> None:
    text = (SCENARIOS / "keyhole" / "program.3b").read_text("utf-8").replace("GX L1", "GX L3")
    assert [finding.code for finding in checked(text).findings] == ["3B217", "3B301"]
