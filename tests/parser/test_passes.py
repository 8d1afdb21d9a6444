"""Passes over one edge are found in whatever way they are written, and a contour that is cut once is one pass."""

import random

import pytest
from rough_and_trim import RoughAndTrim, rough_and_trim
from sound import sound_program

from parser.program import load_program
from parser.shape.passes import Pass, find_passes

ROUNDED_UM = 4.0  # places in whole µm, radii that follow them
WAVE_UM = 10.0  # of many small arcs in a row, whose ends drift


def passes_of(text: str) -> tuple[Pass, ...]:
    return find_passes(load_program(text.encode(), "program.3b").toolpath).passes


def true_shifts(program: RoughAndTrim) -> list[float]:
    last = {(one.edge, one.is_tab): one.offset_um for one in program.passes}
    return [one.offset_um - last[one.edge, one.is_tab] for one in program.passes]


@pytest.mark.parametrize("part", range(4))
def test_passes_of_random_programs_are_those_that_were_written(part: int) -> None:
    rng = random.Random(f"passes {part}")
    for _ in range(15):
        program = rough_and_trim(rng)
        found = passes_of(program.text)
        told = [(one.edge, one.number, one.first, one.last, one.is_back, one.is_tab) for one in found]
        true = [(one.edge, one.number, one.first, one.last, one.is_back, one.is_tab) for one in program.passes]
        assert told == true, f"{program.name}\n{program.text}"
        assert [one.shift_um for one in found] == pytest.approx(
            true_shifts(program), abs=WAVE_UM if "wave" in program.name else ROUNDED_UM
        )


def test_rows_tell_their_pass_and_leads_none() -> None:
    program = load_program(rough_and_trim(random.Random(3)).text.encode(), "program.3b")
    passes, of_row = find_passes(program.toolpath)
    for number, one in enumerate(passes):
        assert (of_row[one.first : one.last + 1] == number).all()
    assert (of_row >= 0).sum() == sum(one.last - one.first + 1 for one in passes)


def test_contours_that_are_cut_once_are_one_pass_each() -> None:
    rng = random.Random("once")
    for _ in range(60):
        program = sound_program(rng)
        if "trimmed" not in program.name:
            assert {one.number for one in passes_of(program.data.decode())} == {1}, program.name
