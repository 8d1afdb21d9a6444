"""Numbers, order and commands of blocks as text: what is told of them, and what is not."""

from dataclasses import replace

import pytest

from parser.dialect.reader import Choices
from parser.findings.codes import Severity
from parser.findings.findings import Finding, edited
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Listing
from parser.iso.numbering import checked
from parser.iso.profiles.profile import profile
from parser.program import parse_program

COMMON = profile("common")


def judged(text: str) -> Listing:
    return checked(read_listing(text), COMMON)


def told(text: str) -> list[tuple[str, int, int]]:
    """Code, line and column of each finding of a text."""
    return [(found.code, found.line, found.column) for found in judged(text).findings]


def numbered(*numbers: str) -> str:
    return "".join(f"{number} G01 X{row}\n" for row, number in enumerate(numbers))


@pytest.mark.parametrize(
    ("numbers", "lines"),
    [
        (("N10", "N20", "N30"), []),
        (("N1", "", "N2", "", "N7"), []),
        (("N20", "N10"), [2]),
        (("N10", "N10"), [2]),
        (("N10", "N20", "N15", "N30", "N25"), [3, 5]),
        (("N9980", "N9990", "N10", "N20"), []),
        (("N99998", "N99999", "N0", "N1"), []),
        (("N9980", "N9990", "N500"), [3]),
        (("O1 N10", "N20", "O2 N10", "N20"), []),
        (("N0001", "N0002 M02", "N0001"), []),
        (("N10", "N20 M99", "N10"), []),
    ],
)
def test_block_numbers_rise(numbers: tuple[str, ...], lines: list[int]) -> None:
    assert [line for code, line, _ in told(numbered(*numbers)) if code == "ISO120"] == lines


def test_labels_that_are_called_may_stand_anywhere() -> None:
    text = "G01 X0\nN10 X1\nM98 P5\nN20 M98 P7\nM00\nN5\nX1\nN7\nX2\nM99\n"
    assert [found for found in told(text) if found[0] == "ISO120"] == []


def found_in(text: str, code: str) -> list[Finding]:
    return [found for found in judged(text).findings if found.code == code]


def test_block_numbers_are_numbered_again_in_their_step_and_width() -> None:
    text = "N005 G01 X0\nN010 X1\n(N1)\nN010 X2\nX5\nN0020 X3\nN 015 X4\n"
    first, second = found_in(text, "ISO120")
    assert second.edits == ()
    assert edited(text, first.edits) == "N005 G01 X0\nN010 X1\n(N1)\nN015 X2\nX5\nN0020 X3\nN025 X4\n"
    assert told(edited(text, first.edits)) == []


@pytest.mark.parametrize(
    "text",
    [
        "N10 G01 X1\nN5 M98 P30\nM02\nN30\nX1\nM99\n",
        "O1\nN10 G01 X1\nN5 X2\n",
        "N10 G01 X1\nN5 X2\nGOTO 5\n",
        "N9990 G01 X1\nN20 X2\n",
        "N10 G01 X1\nN5.5 X2\n",
    ],
)
def test_block_numbers_that_may_be_meant_are_left_alone(text: str) -> None:
    assert [found.edits for found in found_in(text, "ISO120")] == [()]


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("G01 X0\nN1.5 X1\n", [(2, 1)]),
        ("G01 X0\nN-1 X1\n", [(2, 1)]),
        ("G01 X0\nM98 P1\nM02\nN0001\nX1\nM99\nN01 X2\nM99\n", [(7, 1)]),
        ("G01 X0\nM02\nN1\nX1\nM99\nN1\nX2\nM99\n", [(6, 1)]),
        ("O1\nG01 X0\nM99\nO1\nM99\nO2\nM99\nO1\nM99\n", [(4, 1), (8, 1)]),
        ("G01 X0\nN1 X1\nN2 X1\n", []),
    ],
)
def test_labels_are_whole_numbers_of_their_own(text: str, places: list[tuple[int, int]]) -> None:
    assert [found[1:] for found in told(text) if found[0] == "ISO121"] == places


@pytest.mark.parametrize(
    ("block", "word"),
    [
        ("N06 G90 G41 D11 G01 X200 Y300 F200", "G01"),
        ("N1 G90 G01 X1 Y1 I1 J1 H1 D1 F1 S1 T1 M0", ""),
        ("G02 X1 Y1 J1 I1", ""),
        ("G02 X1 Y1 R1 H1", ""),
        ("G01 Y1 X1", "X1"),
        ("G01 X1 N5", "N5"),
        ("M98 P1 L2", ""),
        ("G01 U1 X1 V1 Y1", ""),
        ("M91 G92", "G92"),
    ],
)
def test_words_have_an_order(block: str, word: str) -> None:
    text = f"G90 G01 X0\n{block}\n{block}\n"
    found = found_in(text, "ISO130")
    assert [one.values["word"] for one in found] == [word] * bool(word)
    for one in found:
        assert (one.line, one.values["more"], one.severity) == (2, 1, Severity.NOTE)
        assert text.splitlines()[1][one.column - 1 :].startswith(word)


def test_a_strict_controller_takes_no_other_order_in_any_block() -> None:
    found = checked(read_listing("G01 Y1 X1\nX2 Y2\nY3 X3 G01\n"), profile("strict")).findings
    assert [(one.code, one.severity, one.line, one.values["more"]) for one in found] == [
        ("ISO130", Severity.ERROR, 1, 0),
        ("ISO130", Severity.ERROR, 3, 0),
    ]


@pytest.mark.parametrize(
    ("text", "what", "places"),
    [
        ("G92 X0 Y0\nG90\nX10 Y0\nX20\nG01 X1\n", "no-motion-yet", [(3, 1), (4, 1)]),
        ("G92 X0 Y0\nG90 X10\nG01 X1\n", "no-motion-yet", [(2, 5)]),
        ("X1\n", "no-motion-yet", [(1, 1)]),
        ("G92 X0 Y0\nG01 X1\nX2\nM01\nX3\n", "", []),
        ("M20\nG54 G90\nS1 D1\nG00 X1\n", "", []),
        ("G01 X1\nN10\nX2\nN20\n", "nothing-but-n", [(2, 1), (4, 1)]),
        ("G01 X1\nN10 (second pass)\nX2\n", "", []),
        ("G01 X1\nM98 P10\nN10\nX2\nM99\n", "", []),
        ("G01 X1\nM02\nN10\nX2\nM99\n", "", []),
        ("G01 X1\nN10 H001=110\nN20 C001 = 1\n", "", []),
    ],
)
def test_every_line_commands_something(text: str, what: str, places: list[tuple[int, int]]) -> None:
    program = parse_program(text, choices=Choices(dialect="common"))
    found = [one for one in program.findings if one.code == "ISO110"]
    assert [(one.line, one.column) for one in found] == places
    assert {one.values["what"] for one in found} == {what} - {""}


def test_places_before_any_motion_are_damage() -> None:
    reading = parse_program("X1\nG01 X2\nN5\n", choices=Choices(dialect="common")).reading
    assert [damage.span for damage in reading.damages] == [(0, 2)]


def test_letters_that_a_controller_does_not_know_are_told_at_each_word() -> None:
    listing = checked(read_listing("G01 X0\nW1 X1\nX2 ~\nW2 Q1\nQ2 W3\n"), replace(COMMON, letters="GX"))
    found = [one for one in listing.findings if one.code == "ISO103"]
    assert [(one.line, one.column, one.values["letter"]) for one in found] == [
        (2, 1, "W"),
        (4, 1, "W"),
        (4, 4, "Q"),
        (5, 1, "Q"),
        (5, 4, "W"),
    ]
    assert listing.blocks.is_damaged.tolist() == [False, True, True, True, True]
    assert [one.block for one in listing.unread] == [1, 2, 3, 4]
