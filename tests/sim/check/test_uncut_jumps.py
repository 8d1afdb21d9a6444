"""Ways cut from one closed figure to the next, where a pause and a jump were meant."""

import pytest

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
