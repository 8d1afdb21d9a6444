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


FOUR = "B100B0B100B0GXL1\n"
THREE = "B100B0B100GXL1\n"


@pytest.mark.parametrize(
    ("text", "block"),
    [
        (FOUR * 3 + THREE, 4),
        (THREE * 3 + FOUR, 4),
        (THREE + FOUR, 2),  # as many of both: those of 4B are the rare ones in the trade
        (FOUR * 2 + THREE + FOUR, 3),
    ],
)
def test_of_two_dialects_the_rarer_one_is_named_at_its_first_block(text: str, block: int) -> None:
    found = [finding for finding in parse_program(f"{text}DD").findings if finding.code == "3B109"]
    assert [finding.block for finding in found] == [block]
    assert (found[0].values["three"], found[0].values["four"]) == (text.count(THREE), text.count(FOUR))


@pytest.mark.parametrize(
    ("behind", "blocks", "column"),
    [
        (THREE, 1, 1),
        (f"  {THREE}", 1, 3),
        ("B9O0B0B9GXL1\n" + THREE, 2, 2),
        (THREE + "B9O0B0B9GXL1\n", 2, 1),
        ("B9O0B0B9GXL1\nB8O0B0B9GXL1\n", 2, 2),
    ],
)
def test_blocks_behind_the_end_are_counted_and_the_first_is_pointed_at(behind: str, blocks: int, column: int) -> None:
    (lost,) = (finding for finding in parse_program(f"{THREE}DD\n{behind}").findings if finding.code == "3B103")
    assert (lost.line, lost.column, lost.values["blocks"]) == (3, column, blocks)
