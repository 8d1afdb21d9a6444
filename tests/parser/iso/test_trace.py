"""The way of a block through the decoder, held against the worked example of the CNC course and by hand."""

import pytest

from parser.dialect.decoding import UNREAD, DecodedBlock
from parser.dialect.reader import Choices
from parser.iso.listing.lexer import read_listing
from parser.iso.profiles.profile import profile
from parser.iso.trace import Trace, binary_coded, flags

COURSE = "N06 G90 G41 D11 G01 X200 Y300 F200 ;"


def decoded(text: str, dialect: str = "classroom") -> tuple[DecodedBlock, ...]:
    return Trace(read_listing(text), profile(dialect), Choices(registers=(("D11", 100.0),))).blocks()


def test_the_example_of_the_course_comes_out_with_its_figures() -> None:
    (block,) = decoded(COURSE)

    assert (block.number, block.number_bcd) == (6, 0x06)
    assert block.coor_um == {"X": 200000.0, "Y": 300000.0}
    assert (block.f, block.d, block.g0) == (200.0, 11.0, 0x42)


def test_the_example_of_the_course_is_decoded_in_nine_steps() -> None:
    (block,) = decoded(COURSE)

    assert [tuple(step) for step in block.steps] == [
        (1, "N06", 1, "block_num", 6.0),
        (2, "G90", 5, "G0.D5", 0),
        (3, "G41", 9, "G0.D7D6", 1),
        (4, "D11", 13, "D", 11.0),
        (5, "G01", 17, "G0.D1", 1),
        (6, "X200", 21, "COOR[1]", 200000.0),
        (7, "Y300", 26, "COOR[2]", 300000.0),
        (8, "F200", 31, "F", 200.0),
        (9, ";", 36, "buf_state", 1),
    ]


def test_an_incremental_arc_to_the_right_sets_its_flags() -> None:
    (block,) = decoded("N12 G91 G42 D01 G02 X1.5 Y-.5 I.75 J-.25")

    assert (block.number, block.number_bcd, block.g0, block.d) == (12, 0x12, 0xA4, 1.0)
    assert block.coor_um == {"X": 1500.0, "Y": -500.0, "I": 750.0, "J": -250.0}
    assert block.f is None


def test_a_cancel_has_the_bits_of_nothing_said_but_is_told_among_its_g_words() -> None:
    cancel, line = decoded("G40 G01 X0 Y0\nG01 X0 Y0")

    assert (cancel.g0, line.g0) == (0x02, 0x02)
    assert (cancel.g, line.g) == ((40.0, 1.0), (1.0,))
    assert cancel.number is None
    assert cancel.coor_um == {"X": 0.0, "Y": 0.0}


def test_what_is_in_force_from_earlier_blocks_is_not_in_the_buffer() -> None:
    _, block = decoded(f"{COURSE}\nX10")

    assert (block.g0, block.d, block.f, block.g) == (0, None, None, ())
    assert block.coor_um == {"X": 10000.0}
    assert block.in_force == ("G01", "G90", "G41", "D11", 100.0, 200.0)


def test_the_end_of_a_line_closes_a_block_that_has_no_sign_of_its_own() -> None:
    (block,) = decoded("G01 X1  (to the right)")

    assert block.steps[-1][1:] == ("", 7, "buf_state", 1)


def test_a_sign_behind_a_remark_closes_the_block() -> None:
    (block,) = decoded("G01 X1 (here; there) ;")

    assert block.steps[-1][1:] == (";", 22, "buf_state", 1)


@pytest.mark.parametrize(
    ("words", "byte"),
    [
        ((), 0x00),
        ((0,), 0x01),
        ((3,), 0x08),
        ((6,), 0x10),
        ((91,), 0x20),
        ((41,), 0x40),
        ((42,), 0x80),
        ((92, 28), 0x00),
        ((91, 90), 0x00),
        ((41, 42), 0x80),
    ],
)
def test_g_words_set_their_bits_and_the_later_of_two_counts(words: tuple[float, ...], byte: int) -> None:
    assert flags(words) == byte


def test_a_g_word_without_a_bit_is_told_as_given() -> None:
    (block,) = decoded("G92 G06 X1 Y1 M00 M20 T84 E1281 H2")

    assert block.g == (92.0, 6.0)
    assert block.g0 == 0x10
    assert block.m == (0.0, 20.0)
    assert (block.t, block.h) == (84.0, 2.0)
    assert block.others == {"E": 1281.0}


def test_a_register_that_is_set_to_a_number_tells_it_and_a_sum_does_not() -> None:
    set_um, of_sum = decoded("H001=110\nH1 =.0085 + H175", "common")

    assert set_um.steps[0] == (1, "H001=110", 1, "H1", 110.0)
    assert of_sum.steps[0][3:] == ("H1", None)


@pytest.mark.parametrize("number", [0, 6, 12, 99, 1420, 9999])
def test_binary_coded_digits_read_as_written(number: int) -> None:
    assert f"{binary_coded(number):x}" == str(number)


def test_a_unit_word_scales_the_words_behind_it() -> None:
    *_, block = decoded("G20\nG01 X.5 Y5", "common")

    assert block.coor_um == {"X": 12700.0, "Y": 12.7}


def test_nothing_is_in_force_in_a_block_that_never_runs() -> None:
    *_, dead = decoded("G01 X1\nM02\nX2")

    assert dead.in_force is None
    assert dead.coor_um == {"X": 2000.0}


def test_what_is_no_word_stands_among_the_steps_and_sets_no_field() -> None:
    (block,) = decoded("G01 X10 ,5 Y20")

    assert [(step.word, step.field, step.value) for step in block.steps[:-1]] == [
        ("G01", "G0.D1", 1),
        ("X10", "COOR[1]", 10000.0),
        (",5", UNREAD, None),
        ("Y20", "COOR[2]", 20000.0),
    ]


def test_lines_in_other_forms_than_words_are_told_and_set_no_field() -> None:
    setting, function = decoded("C000   = 012  014 ;\nQAIC(2,1,0.1250) ;", "sodick")

    assert setting.steps[0] == (1, "C000 = 012 014", 1, "setting", None)
    assert function.steps[0] == (1, "QAIC(2,1,0.1250)", 1, "function", None)


@pytest.mark.parametrize("number", ["1e5", "99999999999999999999", "007", "0"])
def test_a_number_of_a_block_of_any_length_is_told(number: str) -> None:
    block, *_ = decoded(f"N{number} G01 X1")

    assert block.number is None or block.number_bcd == int(str(block.number), 16)
