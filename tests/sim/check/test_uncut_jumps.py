"""Ways cut from one closed figure to the next, where a pause and a jump were meant."""

import pytest

from parser.findings.codes import Severity
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

SQUARE = "B0B9000B9000GYL2 B9000B0B9000GXL1 B0B9000B9000GYL4 B9000B0B9000GXL3"


def told(text: str) -> list[tuple[int, float]]:
    found = check_file(Job("part.3b", f"{text} DD".encode(), CheckSettings())).findings
    return [(one.block, one.values["length"]) for one in found if one.code == "3B310"]


@pytest.mark.parametrize(("way_um", "found"), [(900, []), (1000, []), (1001, [(5, 1001.0)]), (30000, [(5, 30000.0)])])
def test_figures_more_than_1_mm_apart_are_two(way_um: int, found: list[tuple[int, float]]) -> None:
    assert told(f"{SQUARE} B{way_um}B0B{way_um}GXL3 {SQUARE}") == found


def test_the_whole_way_is_told_at_its_first_line() -> None:
    way = "B30000B0B30000GXL3 B0B4000B4000GYL2"
    assert told(f"{SQUARE} {way} {SQUARE}") == [(5, 34000.0)]
    assert told(f"{SQUARE} {way} {SQUARE} {way} {SQUARE}") == [(5, 34000.0), (11, 34000.0)]


def test_a_pause_and_a_jump_or_an_arc_between_them_is_none() -> None:
    assert told(f"{SQUARE} D B30000B0B30000GXL3 D {SQUARE}") == []
    assert told(f"{SQUARE} B0B9000B9000GYNR4 B30000B0B30000GXL3 {SQUARE}") == []


HOLE = "B4900B0B4900GXL1 B4900B0B19600GYNR1"


@pytest.mark.parametrize(
    ("text", "severities"),
    [
        (f"{HOLE} B4900B0B4900GXL3 B20000B0B20000GXL1 {HOLE} B4900B0B4900GXL3", [Severity.ERROR]),  # back to its hole
        (f"{HOLE} B4600B0B4600GXL3 B20000B0B20000GXL1 {HOLE} B4900B0B4900GXL3", [Severity.ERROR]),
        (f"{HOLE} B190B0B190GXL3 B20000B0B20000GXL1 {HOLE} B4900B0B4900GXL3", [Severity.WARNING]),  # an overlap
        (f"{HOLE} B20000B0B20000GXL1 B4900B0B19600GYNR3 B200B0B200GXL1", [Severity.WARNING]),  # a slit
        (f"{SQUARE} B30000B0B30000GXL3 {SQUARE}", [Severity.WARNING]),  # outlines
        (f"{HOLE} B4900B0B4900GXL3 D B20000B0B20000GXL1 D {HOLE} B4900B0B4900GXL3", []),
    ],
)
def test_a_way_by_the_inside_of_the_figure_is_an_error(text: str, severities: list[Severity]) -> None:
    found = check_file(Job("part.3b", f"{text} DD".encode(), CheckSettings())).findings
    assert [each.severity for each in found if each.code == "3B310"] == severities
