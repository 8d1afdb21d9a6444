"""Marks and places between the blocks: what two micrometres decide, as ends are printed to one."""

import pytest

from parser.program import parse_program

HOLE = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\n"


def codes(text: str) -> list[str]:
    return [finding.code for finding in parse_program(text).findings]


@pytest.mark.parametrize(
    ("off_mm", "found"), [("0.000", []), ("0.002", []), ("0.003", ["3B309"]), ("0.019", ["3B309"])]
)
def test_a_start_point_may_be_printed_2_um_from_where_the_wire_stands(off_mm: str, found: list[str]) -> None:
    for place in (f"{off_mm} , 0.000", f"0.000 , -{off_mm}"):
        assert codes(f"{HOLE}Start Point = {place}\n{HOLE}DD") == found
        assert codes(f"{HOLE}D\nStart Point = {place}\n{HOLE}DD") == []


@pytest.mark.parametrize(("farther_um", "found"), [(0, ["3B308"]), (1, ["3B308"]), (3, []), (19, [])])
def test_a_figure_cut_again_within_2_um_has_lost_a_jump_and_farther_out_is_a_trim(
    farther_um: int, found: list[str]
) -> None:
    radius = 9900 + farther_um
    trim = HOLE.replace("39600", str(4 * radius)).replace("9900", str(radius))
    assert codes(f"{HOLE}D\n{trim}DD") == found
