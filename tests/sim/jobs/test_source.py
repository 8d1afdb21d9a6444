"""Where the program of a scenario comes from: one with words of its own for end and pause is read by them."""

from dataclasses import replace
from pathlib import Path

import pytest
from runs import plain_scenario

from parser.findings.errors import SettingsError
from sim.jobs.shop import Source, program_read
from sim.setup.making import ToMake, Writing, refuse_misfits

SQUARE = "B100B0B100GXL1\nB0B100B100GYL2\nB100B0B100GXL3\nB0B100B100GYL4\n"
JUMP = "B5000B0B5000GXL1\n"


@pytest.mark.parametrize(("end", "pause"), [("T85", None), (None, "M00"), ("E", "A"), ("T85", "DD"), ("停机", "暂停")])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_a_program_with_words_of_its_own_is_read_by_them(end: str | None, pause: str | None, newline: str) -> None:
    stop = f"{pause or 'D'}\n"
    text = f"{SQUARE}{stop}{JUMP}{stop}{SQUARE}N 10: {end or 'DD'}\n".replace("\n", newline)
    writing = Writing(end_code=end, pause_code=pause, encoding="gbk")
    scenario = replace(plain_scenario(), to_make=ToMake(Path("made.3b"), writing=writing))
    program = program_read(scenario, Source(text.encode("gbk"), is_made=True))
    assert [stop.kind for stop in program.toolpath.stops] == ["pause", "pause", "end"]
    assert program.findings == ()


def test_one_word_for_the_end_and_a_pause_is_refused() -> None:
    for writing in (Writing(end_code="M00", pause_code="M00"), Writing(end_code="D"), Writing(pause_code="DD")):
        with pytest.raises(SettingsError, match="different words"):
            refuse_misfits(writing, "3b", "here")
    refuse_misfits(Writing(end_code="D", pause_code="M00"), "3b", "here")
