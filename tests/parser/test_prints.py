"""Printed ends: the block or the print that is wrong is named once, with the caret under the print."""

import pytest

from parser.program import parse_program

SQUARE = "B0B10000B10000GYL2{}\nB10000B0B10000GXL1{}\nB0B10000B10000GYL4{}\nB10000B0B10000GXL3{}\nDD"
ENDS = (";0.000,10.000", ";10.000,10.000", ";10.000,0.000", ";0.000,0.000")


def places(text: str) -> list[tuple[str, int, int, int]]:
    return [(f.code, f.line, f.column, f.block) for f in parse_program(text).findings]


def test_sound_prints_are_silent() -> None:
    assert places(SQUARE.format(*ENDS)) == []
    assert places(SQUARE.format(ENDS[0], "", "", ENDS[3])) == []


def test_a_print_that_is_wrong_alone_is_named_once() -> None:
    assert places(SQUARE.format(ENDS[0], ";10.000,10.030", *ENDS[2:])) == [("3B207", 2, 20, 2)]


def test_a_wrong_block_is_named_once_though_all_later_prints_are_off() -> None:
    wrong = SQUARE.format(*ENDS).replace("B10000GXL1", "B10400GXL1").replace("B10000B0B10400", "B10400B0B10400")
    assert places(wrong) == [("3B207", 2, 20, 2)]


@pytest.mark.parametrize(
    ("print_mm", "codes"),
    [("10.001", []), ("10.002", ["3B213"]), ("9.998", ["3B213"]), ("10.004", ["3B213"]), ("10.005", ["3B207"])],
)
def test_two_micrometres_are_a_warning_and_five_an_error(print_mm: str, codes: list[str]) -> None:
    assert [place[0] for place in places(SQUARE.format(f";0.000,{print_mm}", "", "", ""))] == codes


def test_an_end_printed_some_micrometres_off_does_not_hide_an_error_behind_it() -> None:
    ends = (";0.000,10.003", ";10.400,10.003", ";10.400,0.003", ";0.400,0.003")
    assert [place[:2] for place in places(SQUARE.format(*ends))] == [("3B213", 1), ("3B207", 2)]


@pytest.mark.parametrize(
    ("ends", "advice"),
    [
        ((ENDS[0], ";10.000,10.030", *ENDS[2:]), "correct-print"),
        ((ENDS[0], ";10.030,10.000", ";10.030,0.000", ENDS[3]), "restore-block"),
        ((*ENDS[:3], ";0.030,0.000"), "compare-print"),
    ],
)
def test_a_printed_end_is_told_from_a_block_by_the_ends_behind_it(ends: tuple[str, ...], advice: str) -> None:
    assert parse_program(SQUARE.format(*ends)).findings[0].values["advice"] == advice


def test_a_drift_is_named_where_it_comes_to_two_micrometres() -> None:
    lines = [f"B0B10000B10000GYL2;0.000,{10 * n + 0.001 * n:.3f}" for n in range(1, 11)]
    found = places("\n".join([*lines, "DD"]))
    assert [place[1] for place in found] == [2, 4, 6, 8, 10]
    assert [place[0] for place in found if place[1] <= 6] == ["3B213", "3B213", "3B207"]


def test_prints_of_two_decimals_may_lie_half_a_digit_off() -> None:
    assert places("B0B10004B10004GYL2;0.00,10.00\nDD") == []
    assert places("B0B10020B10020GYL2;0.00,10.00\nDD") == [("3B207", 1, 20, 1)]


def test_a_length_belongs_to_the_figure_behind_its_start_point() -> None:
    hole = "B5000B0B5000GXL1\nB5000B0B20000GYNR1\nB5000B0B5000GXL3\nD\n"
    text = "".join(f"Start Point = {20 * n}.0 , 0.0 ; Length = 41.42\n{hole}" for n in range(4))
    assert places(f"{text}DD") == []
    assert [place[:2] for place in places(f"{text}DD".replace("41.42", "43.42", 1))] == [("3B108", 1)]


def leading_to(*ends_um: tuple[int, int]) -> list[str]:
    """Blocks without marks: lines from the origin to each end after the other, counted on the longer side."""
    blocks, at = [], (0, 0)
    for end in ends_um:
        dx, dy = end[0] - at[0], end[1] - at[1]
        quadrant = {(True, True): 1, (False, True): 2, (False, False): 3, (True, False): 4}[dx > 0, dy > 0]
        axis = "X" if abs(dx) > abs(dy) else "Y"
        blocks.append(f"B{abs(dx)}B{abs(dy)}B{max(abs(dx), abs(dy))}G{axis}L{quadrant}")
        at = end
    return blocks


@pytest.mark.parametrize(("off_um", "codes"), [(14, []), (15, ["3B207"])])
def test_an_end_is_wrong_from_three_halves_of_its_last_digit(off_um: int, codes: list[str]) -> None:
    (block,) = leading_to((0, 10000 + off_um))
    assert [place[0] for place in places(f"{block};0.00,10.00\nDD")] == codes


@pytest.mark.parametrize(("off_um", "codes"), [(5, ["3B207"]), (6, ["3B207", "3B207"])])
def test_ends_rounded_the_other_way_behind_a_wrong_block_are_sound(off_um: int, codes: list[str]) -> None:
    # Rounded to 10 µm, ends lie 5 µm off at most on either axis, and 14.1 µm at most from one another.
    first, second = leading_to((5, 10405), (10000 - off_um, 10400 - off_um))
    assert [place[0] for place in places(f"{first};0.00,10.00\n{second};10.00,10.00\nDD")] == codes


@pytest.mark.parametrize(
    ("length_mm", "side_um", "codes"),
    [
        ("40.0040", 10000, []),  # four blocks
        ("39.9960", 10000, []),
        ("40.0041", 10000, ["3B108"]),
        ("39.9959", 10000, ["3B108"]),
        ("40.01", 10001, []),  # and 5 µm for half of the last digit
        ("40.01", 10000, ["3B108"]),
    ],
)
def test_a_printed_length_may_be_off_by_1_um_a_block_and_half_its_last_digit(
    length_mm: str, side_um: int, codes: list[str]
) -> None:
    square = SQUARE.format("", "", "", "").replace("10000", str(side_um))
    assert [place[0] for place in places(f"Length= {length_mm} mm\n{square}")] == codes
