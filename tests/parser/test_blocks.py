"""Single blocks: the rules of the trade as plain loops over many words, and each tolerance at its border."""

import itertools
import math

import pytest
from plain import SIGNS, PlainBlock

from parser.findings.findings import Finding
from parser.program import parse_program
from parser.threeb.block_checks import counts_fit, ruled_label
from parser.threeb.decode import decoded_words

LABEL_OF_WAY = {
    "L": {(1, 0): 1, (0, 1): 2, (-1, 0): 3, (0, -1): 4},
    "NR": {(1, 0): 1, (0, 1): 2, (-1, 0): 3, (0, -1): 4},
    "SR": {(0, 1): 1, (-1, 0): 2, (0, -1): 3, (1, 0): 4},
}
"""docs/3b.md §1, axis labels: where a line goes, or from where an arc starts."""


def text_of(*blocks: PlainBlock | str) -> str:
    return "\n".join([*(block if isinstance(block, str) else block.text() for block in blocks), "DD"])


def said(*blocks: PlainBlock | str) -> list[Finding]:
    return list(parse_program(text_of(*blocks)).findings)


def codes(*blocks: PlainBlock | str) -> list[str]:
    return [finding.code for finding in said(*blocks)]


@pytest.mark.parametrize(("sense", "written"), list(itertools.product(LABEL_OF_WAY, SIGNS)))
def test_each_way_along_an_axis_has_one_label(sense: str, written: int) -> None:
    for x, y in ((900, 0), (0, 900), (2, 0), (0, 2)):
        way = (SIGNS[written][0], 0) if x else (0, SIGNS[written][1])
        counts_x = bool(x) == (sense == "L")
        block = PlainBlock(x, y, 900, "X" if counts_x else "Y", sense, written)
        found = [finding.values for finding in said(block) if finding.code == "3B203"]
        right = LABEL_OF_WAY[sense][way]
        sign, axis = "+" if sum(way) > 0 else "−", "X" if x else "Y"
        told = [(values["written"], values["ruled"], values["way"]) for values in found]
        assert told == ([] if right == written else [(f"{sense}{written}", f"{sense}{right}", f"{sign}{axis}")])


def test_off_the_axes_the_label_is_the_one_written() -> None:
    blocks = [PlainBlock(3, 4, 4, "Y", sense, quadrant) for sense in LABEL_OF_WAY for quadrant in SIGNS]
    words = decoded_words(parse_program(text_of(*blocks)).toolpath)
    assert ruled_label(words).tolist() == [block.quadrant for block in blocks]


def fits(block: PlainBlock) -> bool:
    """As docs/3b.md §1 and the page of 3B208 say of a line: J is its side, a multiple of it, or scales a slope."""
    side = block.x if block.axis == "X" else block.y
    if block.sense != "L" or side == 0 or block.count == 0:
        return True
    is_slope = math.gcd(block.x, block.y) == 1 and max(block.x, block.y) <= 1000
    return (
        abs(block.count - side) <= 1
        or block.count % side == 0
        or (is_slope and block.count >= 10 * max(block.x, block.y))
    )


def test_counts_of_lines_fit_as_a_plain_loop_finds_them() -> None:
    sides = [(x, y) for x in range(13) for y in range(13) if x or y]
    sides += [(1000, 577), (577, 1000), (1001, 577), (577, 1001), (1000, 500), (998, 1000)]
    near = (0, 1, 2, 5, 9, 10, 11, 25, 119, 120, 121)
    far = (576, 577, 578, 579, 999, 1000, 1001, 1002, 1003, 1999, 9999, 10000, 10001, 10009, 10010, 10011)
    blocks = [
        PlainBlock(x, y, count, axis, sense, 1)
        for x, y in sides
        for count in (near if x < 13 else far)
        for axis in "XY"
        for sense in ("L", "NR")
    ]
    words = decoded_words(parse_program(text_of(*blocks)).toolpath)
    assert counts_fit(words).tolist() == [fits(block) for block in blocks]


@pytest.mark.parametrize(
    ("block", "goes", "by"),
    [("B9900B0B9990GXL1", "too-far", 90), ("B9900B0B9810GXL1", "too-short", 90), ("B30B9900B9898GYL1", "too-short", 2)],
)
def test_a_wrong_count_is_told_by_how_much_and_which_way(block: str, goes: str, by: int) -> None:
    (finding,) = said(block)
    assert (finding.code, finding.values["goes"], finding.values["by"]) == ("3B208", goes, by)
    side = finding.values["extent"]
    assert (finding.values["axis"], side) == ("Y" if "GY" in block else "X", 9900)
    assert finding.values["count"] == side + (by if goes == "too-far" else -by)


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        ("B100B50B300GXL1", ["3B209"]),
        ("B100B50B100GXL1", []),  # once, as an end point is
        ("B99B33B297GXL1", []),  # so small that it may be a slope not brought to its lowest terms
        ("B101B50B303GXL1", []),  # in lowest terms: J carries the length
        ("B100B50B301GXL1", ["3B208"]),
        ("B102B50B204GXL1", ["3B209"]),
    ],
)
def test_a_multiple_is_told_of_an_end_point_alone(block: str, expected: list[str]) -> None:
    assert codes(block) == expected


def test_a_multiple_is_told_with_its_times_and_its_side() -> None:
    (finding,) = said("B100B50B300GXL1")
    assert dict(finding.values) == {"count": 300, "extent": 100, "axis": "X", "times": 3}


@pytest.mark.parametrize(("count", "expected"), [(39604, []), (39605, ["3B210"]), (79200, ["3B210"])])
def test_a_full_turn_is_four_radii_and_four_micrometres_at_most(count: int, expected: list[str]) -> None:
    circle = PlainBlock(9900, 0, count, "Y", "NR", 1)
    assert codes(circle) == expected
    for finding in said(circle):
        assert dict(finding.values) == {"count": count, "full": 39600, "turns": round(count / 39600, 1)}


@pytest.mark.parametrize(
    ("radius", "is_wrong"), [(4998, True), (4999, False), (5000, False), (5001, False), (5002, True)]
)
def test_r_of_4b_is_that_of_x_and_y_to_1_um(radius: int, is_wrong: bool) -> None:
    # 3-4-5: the radius is 5000 µm to the last bit.
    found = [f for f in said(f"B3000B4000B1000B{radius}GXDNR1", "B100B0B100B0GXL1") if f.code == "3B212"]
    assert [dict(finding.values) for finding in found] == [{"radius": radius, "decoded": 5000.0}] * is_wrong


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        ("B0B0B10GXNR1", ["3B201"]),
        ("B0B0B10GXNR2", ["3B201"]),  # from no axis: there is no label for it
        ("B1B0B10GXNR1", ["3B201"]),
        ("B1B1B1GXNR1", []),  # a radius of 1.4 µm is counted out
        ("B2B0B2GXNR1", []),
        ("B0B5B5GXL2", ["3B202"]),
        ("B5B0B5GYL1", ["3B202"]),
        ("B0B5B0GXL2", ["3B205"]),  # without a count there is nothing to wait for
        ("B5B5B0GXL1", ["3B205"]),
        ("B5B5B1GXL1", ["3B208"]),
    ],
)
def test_blocks_that_never_end_and_those_that_never_begin(block: str, expected: list[str]) -> None:
    assert codes(block) == expected
