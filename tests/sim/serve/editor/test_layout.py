"""Layout: columns and blanks, and a program that says the same as before."""

import random
from pathlib import Path

import numpy as np
import pytest
import sound
from places import ROOT

from parser.dialect.reader import Choices
from parser.findings.findings import edited
from parser.program import Program, load_program, parse_program
from sim.serve.editor.shown import layout_of

MESSY = """// part ( B1B2B3 )
N   1: b 9900 B0b 39600gy nr1 ; -9.9 , 0
B100B 0B100GXL1 // to the left
D
B1B2B3 nonsense
DD
B7B7B7
"""


def laid(program: Program) -> str:
    return edited(program.text, layout_of(program))


def test_numbers_stand_in_columns_and_nothing_else_moves() -> None:
    assert (
        laid(parse_program(MESSY))
        == """// part ( B1B2B3 )
N   1: B  9900 B     0 B 39600 GY NR1 ; -9.9 , 0
B   100 B     0 B   100 GX L1 // to the left
D
B1B2B3 nonsense
DD
B7B7B7
"""
    )


def test_blocks_of_4b_keep_their_radius_and_mark() -> None:
    text = "B0B300B300GYL2\nB300B0B600B300GYDNR1\nDD\n"
    assert laid(parse_program(text)) == "B   0 B 300 B 300 GY L2\nB 300 B   0 B 600 B 300 GYD NR1\nDD\n"


def test_words_of_iso_stand_apart_and_remarks_stay() -> None:
    program = parse_program(
        "%\ng90G92x0Y0 (start)\nN10G01X5.F60\nG1 X 5.Y-5.\nM02\n", choices=Choices(dialect="common", unit="mm")
    )
    assert laid(program) == "%\nG90 G92 X0 Y0 (start)\nN10 G01 X5. F60\nG1 X5. Y-5.\nM02\n"


@pytest.mark.parametrize("seed", range(20))
def test_a_random_program_says_the_same_and_is_laid_out_once(seed: int) -> None:
    program = load_program(sound.sound_program(random.Random(seed)).data, "part.3b")
    text = laid(program)
    again = parse_program(text)
    assert np.array_equal(again.toolpath.end_um, program.toolpath.end_um)
    assert [finding.code for finding in again.findings] == [finding.code for finding in program.findings]
    assert layout_of(again) == ()


@pytest.mark.parametrize("path", sorted((ROOT / "scenarios").glob("*/program.*")), ids=lambda path: path.parent.name)
def test_shipped_programs_say_the_same(path: Path) -> None:
    program = load_program(path.read_bytes(), path.name)
    again = load_program(laid(program).encode(), path.name)
    assert np.array_equal(again.toolpath.end_um, program.toolpath.end_um)
    assert layout_of(again) == ()


def test_what_would_be_read_otherwise_stays() -> None:
    program = parse_program("B1B2B3GXL1 B1B2B3GX L1\nDD\n")
    assert parse_program(laid(program)).toolpath.end_um.tolist() == program.toolpath.end_um.tolist()
