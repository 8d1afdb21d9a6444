"""Strokes forth and back, blocks in the wrong order and blocks put in twice are found; slits that are meant are not."""

import random
from collections import Counter

import pytest
import single_damages as damaged
from depth import cases

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

LOST_SIDE = "B0B4120B4120GYL4 B25400B0B25400GXL1 B0B7046B7046GYL2 B0B7046B7046GYL4 B0B4120B4120GYL2 DD"
SWAPPED_SIDES = """B0B598B598GYL2 B9165B0B9165GXL1 B9165B0B9165GXL3 B0B25785B25785GYL2 B0B25785B25785GYL4
B0B598B598GYL4 D B14034B7541B14034GXL3 D B0B598B598GYL2 B16572B0B16572GXL1 B0B21090B21090GYL2 B16572B0B16572GXL3
B0B21090B21090GYL4 B0B598B598GYL4 DD"""
FORTH, BACK = "B9900B0B9900GXL1", "B9900B0B9900GXL3"
SQUARE = (
    "B0B4000B4000GYL4 B5000B0B5000GXL1 B0B9100B9100GYL2 B10000B0B10000GXL3 B0B9100B9100GYL4 B5000B0B5000GXL1 "
    "B0B4000B4000GYL2"
)


def codes(text: str) -> list[str]:
    return [finding.code for finding in check_file(Job("part.3b", text.encode(), CheckSettings())).findings]


def test_a_side_left_out_is_an_open_contour_though_the_path_runs_back_to_its_start() -> None:
    assert codes(LOST_SIDE) == ["3B317", "3B301"]


def test_two_sides_swapped_enclose_nothing_and_are_found() -> None:
    assert codes(SWAPPED_SIDES) == ["3B317"]


@pytest.mark.parametrize(
    "text",
    [
        f"{FORTH} {BACK} DD",
        f"{FORTH} {BACK} {FORTH} {BACK} DD",
        f"B2000B0B2000GXL1 B2000B0B2000GXL3 {SQUARE} DD",
        f"{FORTH} {BACK} B0B9900B9900GYL2 B0B9900B9900GYL4 {BACK} {FORTH} DD",
    ],
    ids=["one slit", "one slit twice", "a slit, then a square", "a cross"],
)
def test_slits_that_are_meant_are_no_findings(text: str) -> None:
    assert codes(text) == []


def test_an_overcut_as_long_as_the_last_side_is_no_block_put_in_twice() -> None:
    *sides, out = SQUARE.split(" ")
    assert codes(" ".join([*sides, "B5000B0B5000GXL1", "B5000B0B5000GXL3", out, "DD"])) == []
    assert "3B319" in codes(" ".join([*sides, "B5000B0B5000GXL1", out, "DD"]))


def test_a_lead_that_is_put_in_twice_is_found() -> None:
    first, *rest = SQUARE.split()
    assert "3B319" in codes(" ".join([first, first, *rest, "DD"]))


@pytest.mark.deeper
def test_of_all_single_block_damages_few_pass_in_silence_and_sound_programs_are_silent() -> None:
    """Before there was a judge of strokes, 15 % of doublings, 9 % of losses and 89 % of swaps of these were silent."""
    tried: Counter[str] = Counter()
    silent: Counter[str] = Counter()
    rng = random.Random(35)
    for _ in cases(1, 20):
        for damage in damaged.trials(3, rng.randrange(10**6)):
            if damage.kind == "sound":
                assert damage.codes == ("3B102",), damage.text  # no end mark in the corpus
                continue
            tried[damage.kind] += 1
            silent[damage.kind] += not damage.codes
    share = {kind: silent[kind] / tried[kind] for kind in damaged.KINDS}
    assert share["lost"] <= 0.2, share
    assert share["doubled"] <= 0.12, share
    assert share["swapped"] <= 0.5, share


def test_a_block_of_a_few_um_is_swapped_with_none() -> None:
    """A step of 1 µm has any direction; in another place it would move nothing by more."""
    slot = (
        "B6B1055B1055GYL1 B17B2920B1186GXNR1 B597B1366B386GYNR2 B526B446B444GYNR2 B1B0B1GXL1 B661B35B380GYNR3 "
        "B967B753B352GXNR3 B1152B1938B653GXNR3 B748B3133B1662GXNR3 B644B2127B470GXNR4 B627B1104B355GYNR4 "
        "B537B377B384GYNR4 B1B0B1GXL3 B692B42B444GYNR1 B1105B1043B546GXNR1 B1123B2735B1199GXNR1 B12B2922B81GXNR1 "
        "B79B2919B100GXSR2 B6B1055B1055GYL3 DD"
    )
    assert "3B318" not in codes(slot)
