"""The family of a program is told by its marks, and what was assumed is said."""

import pytest

from parser.dialect.reader import Choices
from parser.findings.catalogue import LANGUAGES, term
from parser.iso.profiles.profile import PROFILES
from parser.program import Program, parse_program

SQUARE = "G01 X0 Y5000\nX5000 Y5000\nX5000 Y-5000\nX-5000 Y-5000\nX-5000 Y5000\nX0 Y5000\nM02\n"
ROBOFIL = "%\nG92X0Y0\nG60\nG38\nG41D0\nG01X6500Y0\nG03X-6500Y0I0J0\nX6500Y0I0J0\nM02\n%\n"
SKD2 = "H001=110\nE001=   004 005\nG92 X0 Y0\nG90\nM98 P0001\nM02\nN0001\nG01 X4000 Y0\nX4000 Y4000\nM99\n"
SODICK = (
    "C000   = 012 014 ;\nH000 = +000000.0100 ;\nG90 G92 X0. Y0. Z0. ;\nT94 ;\nT84 ;\nG41 H000 G01 X5. Y2. ;\nM02 ;\n"
)
MITSUBISHI = "%\nL001\nH1 =.00995 + H175\nH175=.0\nG90 G92 X0. Y0.\nM78 M78\nE1281\nG41 H1 G1 Y-.013\nM02\n%\n"
FANUC = "%\nO0027\nG91\nG92 X0 Y0\nS1 D1\nG42\nG01 X0.1034 Y0.5\nM30\n%\n"
FAST = "G92 X115000 Y-10000\nG91 G01 X-10000 Y0\nM02\n"


def read(text: str, **choices: str) -> Program:
    return parse_program(text, choices=Choices(**choices))


def assumed(program: Program) -> dict[str, tuple[str, str]]:
    return {one.what.removeprefix("assumed-"): (one.taken, one.why) for one in program.reading.assumptions}


@pytest.mark.parametrize(
    ("text", "dialect", "why"),
    [
        (ROBOFIL, "robofil", "because-g38"),
        (ROBOFIL.replace("G38\n", ""), "robofil", "because-g60"),
        (SKD2, "skd2", "because-registers-um"),
        (SKD2.replace("H001=110\n", ""), "skd2", "because-e-table"),
        (SKD2.split("\n", 2)[2], "skd2", "because-called-labels"),
        (SODICK, "sodick", "because-tables"),
        (SODICK.split("\n", 1)[1], "sodick", "because-registers-mm"),
        (SODICK.split("\n", 2)[2].replace("T84", "G149\nT84"), "sodick", "because-t84-g149"),
        (MITSUBISHI, "mitsubishi", "because-register-sum"),
        (MITSUBISHI.replace("+ H175", ""), "mitsubishi", "because-conditions"),
        (MITSUBISHI.replace("+ H175", "").replace("E1281\n", ""), "mitsubishi", "because-switches"),
        (FANUC, "fanuc", "because-o-number"),
        (FANUC.replace("S1 D1\n", ""), "fanuc", "because-o-inches"),
        (FANUC.replace("S1 D1\n", "").replace(".1034", ".103"), "common", "because-none"),
        (FAST, "fast-wire", "because-long-integers"),
        (FAST.replace("M02", ""), "fast-wire", "because-long-integers"),  # a missing end, mended, changes nothing
        (FAST.replace("M02", "G04 X2.5\nM02"), "fast-wire", "because-long-integers"),
        ("G92 X0 Y0\nG91\nG01 X-10 Y20\nM02\n", "common", "because-none"),
        ("G92 X0 Y0\nG90\nG01 X10.5 Y20.\nM02\n", "common", "because-none"),
    ],
)
def test_marks_tell_the_family(text: str, dialect: str, why: str) -> None:
    program = read(text)
    assert program.reading.dialect == dialect
    assert assumed(program)["dialect"] == (dialect, why)


@pytest.mark.parametrize("dialect", PROFILES)
def test_a_chosen_family_counts_before_all_marks(dialect: str) -> None:
    program = read(ROBOFIL, dialect=dialect)
    assert program.reading.dialect == dialect
    assert "dialect" not in assumed(program)


@pytest.mark.parametrize(
    ("text", "taken", "why"),
    [
        (FAST, "1 = 0.001 mm", "because-profile"),
        (SODICK, "1. = 1 mm", "because-profile"),
        (MITSUBISHI, "1. = 1 inch", "because-small-offsets"),
        (MITSUBISHI.replace(".00995 + H175", ".2527 + H175"), "1. = 1 mm", "because-profile"),
        (FANUC, "1. = 1 inch", "because-four-digits"),
        (FANUC.replace(".1034", ".103"), "1. = 1 mm", "because-profile"),
        ("G92 X0 Y0\nG90 G01 X5000 Y7.5\nM02\n", "1 = 0.001 mm, 1. = 1 mm", "because-profile"),
    ],
)
def test_the_unit_is_that_of_the_family_or_told_by_the_numbers(text: str, taken: str, why: str) -> None:
    assert assumed(read(text))["unit"] == (taken, why)


@pytest.mark.parametrize(
    ("unit", "word", "end_um"),
    [
        *(("um", "X50", 50.0), ("um", "X50.", 50_000.0), ("mm", "X50", 50_000.0), ("mm", "X50.", 50_000.0)),
        *(("inch", "X50", 127.0), ("inch", "X.5", 12_700.0)),
    ],
)
def test_a_unit_that_is_named_holds_and_is_no_assumption(unit: str, word: str, end_um: float) -> None:
    program = read(f"G92 X0 Y0\nG90 G01 {word} Y0\nM02\n", unit=unit)
    assert program.toolpath.end_um[-1].tolist() == pytest.approx([end_um, 0.0])
    assert "unit" not in assumed(program)
    assert "ISO216" not in [finding.code for finding in program.findings]


@pytest.mark.parametrize("unit_word", ["G20", "G21", "G70", "G71"])
def test_a_program_that_says_its_unit_is_believed(unit_word: str) -> None:
    program = read(f"{unit_word}\nG92 X0 Y0\nG90 G01 X1.5 Y0\nM02\n")
    assert "unit" not in assumed(program)
    times = 25.4 if unit_word in {"G20", "G70"} else 1.0
    assert program.toolpath.end_um[-1, 0] == pytest.approx(1500.0 * times)


def test_what_integers_are_no_unit_word_says() -> None:
    program = read("G21\nG92 X0 Y0\nG90 G01 X50 Y0\nM02\n")
    assert assumed(program)["unit"] == ("1 = 0.001 mm", "because-profile")
    assert "ISO216" in [finding.code for finding in program.findings]
    program = read("G20\nG92 X0 Y0\nG90 G01 X50000 Y0\nM02\n")
    assert assumed(program)["unit"] == ("1 = 0.0001 inch", "because-profile")
    assert program.toolpath.end_um[-1, 0] == pytest.approx(127_000.0)


@pytest.mark.parametrize(
    ("dialect", "taken"),
    [("fast-wire", "G91"), ("classroom", "G91"), ("fanuc", "G91"), ("robofil", "G90"), ("sodick", "G90")],
)
def test_the_mode_at_the_start_is_that_of_the_family_where_nothing_says_it(dialect: str, taken: str) -> None:
    program = read("G92 X1000 Y0\nG01 X5000 Y0\nX0 Y5000\nM02\n", dialect=dialect)
    assert assumed(program)["distance"] == (taken, "because-chosen")
    scale = 1000.0 if dialect == "classroom" else 1.0
    last = [6000.0, 5000.0] if taken == "G91" else [0.0, 5000.0]
    assert (program.toolpath.end_um[-1] / scale).tolist() == last


def test_a_mode_that_is_written_is_no_assumption_but_one_behind_the_first_motion_is() -> None:
    assert "distance" not in assumed(read("G92 X0 Y0\nG90\n" + SQUARE))
    assert "distance" not in assumed(read("G92 X0 Y0\nG90" + SQUARE))
    assert assumed(read("G92 X0 Y0\nG01 X9000 Y0\nG90\n" + SQUARE))["distance"] == ("G91", "because-profile")


def test_a_note_says_how_the_program_was_read_until_the_family_is_chosen() -> None:
    [note] = [finding for finding in read("G92 X0 Y0\nG90\n" + SQUARE).findings if finding.code == "ISO112"]
    assert note.values == {
        **{"dialect": "fast-wire", "integer": "0.001 mm", "point": "1 mm"},
        **{"distance": "G90", "centers": "centres-from-start"},
    }
    assert read("G92 X0 Y0\nG90\n" + SQUARE, dialect="fast-wire").findings == ()


def test_inches_that_are_told_by_the_numbers_are_noted_even_in_a_family_that_is_chosen() -> None:
    assert [finding.code for finding in read(FANUC, dialect="fanuc").findings if finding.code == "ISO112"] == ["ISO112"]
    assert "ISO112" not in [finding.code for finding in read(FANUC, dialect="fanuc", unit="inch").findings]


@pytest.mark.parametrize("text", [ROBOFIL, SKD2, SODICK, MITSUBISHI, FANUC, FAST])
def test_terms_of_assumptions_are_in_the_catalogue(text: str) -> None:
    for assumption in read(text).reading.assumptions:
        for language in LANGUAGES:
            assert "`" not in term(assumption.what, language) + term(assumption.why, language)
