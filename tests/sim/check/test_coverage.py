"""What was not looked at is told, and never counts as clean."""

import pytest
from places import SCENARIOS

from parser.program import parse_program
from sim.check.path_checks import (
    PARSER_CHECKS,
    PATH_CHECKS,
    Checked,
    Demands,
    run_checks,
)
from sim.setup.machine.machine import load_machine

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


HOLE = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3"
DAMAGED = f"B9O0B0B900GXL1 B9900B0B9900GXL3 D B20000B0B20000GXL1 D {HOLE} DD"
ENDLESS = f"B0B5B5GXL2 {HOLE} D B20000B0B20000GXL1 D {HOLE} DD"
TABLE = load_machine("dk7740").table
ALL_ASKED = Demands(TABLE, (200_000.0, 250_000.0), offset_um=100.0)


@pytest.mark.parametrize(
    ("text", "demands", "states"),  # by their first letters: complete, incomplete, not asked
    [
        (f"{HOLE} DD", Demands(), "CCCNNCCCCCNN"),
        (f"{HOLE} DD", Demands(offset_um=100.0), "CCCNNCCCCCCN"),
        (f"{HOLE} DD", Demands(TABLE, (200_000.0, 250_000.0)), "CCCNNCCCCCNC"),
        (f"{HOLE} DD", Demands(TABLE), "CCCNNCCCCCNN"),  # nobody knows where it starts
        (f"{HOLE};0.000,0.000\nDD", ALL_ASKED, "CCCCNCCCCCCC"),
        (f"Length= 82.004\n{HOLE} DD", ALL_ASKED, "CCCNCCCCCCCC"),
        (DAMAGED, ALL_ASKED, "CIINNCIIIIII"),
        (ENDLESS, ALL_ASKED, "CCCNNIIIIIII"),
        (OPEN, ALL_ASKED, "CCCNNCCIICCC"),
        (f"{HOLE.replace('39600', '999999999')} DD", ALL_ASKED, "CCCNNIIIIIII"),  # too many steps
        (f"{HOLE.replace('39600', '9999999999')} DD", ALL_ASKED, "CCINNIIIIIII"),  # too large a number
    ],
)
def test_every_check_says_how_far_it_came(text: str, demands: Demands, states: str) -> None:
    coverage = run_checks(parse_program(text), demands).coverage
    assert [check.name for check in coverage.checks] == [*PARSER_CHECKS, *PATH_CHECKS]
    assert "".join(check.state[0].upper() for check in coverage.checks) == states


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        (f"{HOLE} DD", (3, 3, 3, 3)),
        (DAMAGED, (6, 5, 5, 5)),  # found: the damaged one too
        (ENDLESS, (8, 8, 7, 7)),  # decoded: but for the one that never ends
        (f"{HOLE} DD {HOLE}", (6, 6, 3, 3)),
    ],
)
def test_blocks_are_counted_as_found_read_decoded_and_stepped(text: str, counts: tuple[int, int, int, int]) -> None:
    coverage = checked(text).coverage
    assert (coverage.found, coverage.read, coverage.decoded, coverage.stepped) == counts


def test_a_contour_beside_a_damaged_block_is_not_judged_and_the_others_are() -> None:
    broken_hole = HOLE.replace("GXL3", "GXL1")
    assert [c.first for c in checked(f"{DAMAGED}").judged] == [3]
    assert "3B301" not in {f.code for f in checked(f"{broken_hole} B9O0B0B900GXL1 DD").findings}
    assert "3B301" in {
        f.code for f in checked(f"{broken_hole} D B20000B0B20000GXL1 D {HOLE} B9O0B0B900GXL1 DD").findings
    }


@pytest.mark.parametrize(("more", "is_too_many"), [("", False), ("B1B0B1GXL3", True)])
def test_three_hundred_million_steps_are_taken_and_not_one_more(more: str, *, is_too_many: bool) -> None:
    out, back = "B150000000B0B150000000GXL1", "B150000000B0B150000000GXL3"
    found = [finding for finding in checked(f"{out} {back} {more} DD").findings if finding.code == "3B206"]
    assert [(f.block, f.values["what"], f.values["limit"]) for f in found] == (
        [(1, "too-many-steps", 300_000_000)] if is_too_many else []
    )
