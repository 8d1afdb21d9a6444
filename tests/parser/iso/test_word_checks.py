"""Words in one block that exclude each other, are unknown, or have numbers they cannot have."""

from random import Random

import pytest

from parser.dialect.reader import Choices
from parser.findings.codes import Severity
from parser.findings.findings import Finding, TooLarge, telling
from parser.iso.listing.lexer import read_listing
from parser.iso.profiles.profile import PROFILES, profile
from parser.iso.word_checks import GROUPS, word_findings
from parser.program import parse_program
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

CODES = {f"ISO{number}" for number in (200, 201, 202, 203, 205, 206, 209)}


NUMBERS = (0, 1, 2, 3, 17, 40, 41, 90, 91, 5.5, -3, 123, 1200)


def found(block: str, dialect: str = "common") -> list[tuple[str, int]]:
    """Codes and columns of the findings of one block."""
    return [(one.code, one.column) for one in word_findings(read_listing(block), profile(dialect))]


@pytest.mark.parametrize(
    ("block", "expected"),
    [
        ("G01 G02 X1 I1", [("ISO200", 5)]),
        ("G90 G91", [("ISO200", 5)]),
        ("G41 G01 X1 G40", [("ISO200", 12)]),
        ("G01 G01 X1", [("ISO200", 5)]),
        ("G54 G92 X0 Y0", []),
        ("G04 X1 G01", []),
        ("G90 G01 G41 X1", []),
        ("G90 G90.1", []),
        ("X1 X2", [("ISO201", 4)]),
        ("G01 X1 Y2 X3 X4", [("ISO201", 11), ("ISO201", 14)]),
        ("N10 N20 X1", [("ISO201", 5)]),
        ("G02 X1 I1 R1", [("ISO202", 11)]),
        ("G02 X1 R1", []),
        ("G123 X1", [("ISO203", 1)]),
        ("M123", [("ISO203", 1)]),
        ("N1.5 X1", [("ISO205", 1)]),
        ("G41 D1.2", [("ISO205", 5)]),
        ("G1.5 X1", [("ISO205", 1)]),
        ("M1.5", [("ISO205", 1)]),
        ("G90.1 G91", []),
        ("D1. X1", []),
        ("G04 P0.5", []),
        ("F-5", [("ISO206", 1)]),
        ("G41 D1000", [("ISO206", 5)]),
        ("F0", [("ISO206", 1)]),
        ("F.06", []),
        ("G42 H1000", [("ISO206", 5)]),
        ("G41 D999 H999", []),
        ("G41 D-1", [("ISO206", 5)]),
        ("X10000001", [("ISO206", 1)]),
        ("X10000000 Y-10000. U10000. V0 Z10000.", []),
        ("Y-10000001", [("ISO206", 1)]),
        ("X10000.001", [("ISO206", 1)]),
        ("G02 X1 R1000000.", []),
        ("G02 X1 R1000001.", [("ISO206", 8)]),
        ("G03 X1 I1000000. J-1000001.", [("ISO206", 18)]),
        ("M05 M05", [("ISO209", 5)]),
        ("M80 M82 M84", []),
    ],
)
def test_each_fault_is_told_at_its_word(block: str, expected: list[tuple[str, int]]) -> None:
    assert found(block) == expected


def test_families_differ() -> None:
    assert found("M78 M78") == [("ISO209", 5)]
    assert found("M78 M78", "mitsubishi") == []
    assert found("T84 T94") == []
    assert found("G38") == [("ISO203", 1)]
    assert found("G38 G39", "robofil") == [("ISO200", 5)]
    assert found("G149") == [("ISO203", 1)]
    assert found("G149", "sodick") == []


@pytest.mark.parametrize("name", PROFILES)
def test_effects_of_profiles_are_known(name: str) -> None:
    of = profile(name)
    assert set(of.g.values()) <= {*GROUPS, "once", "switch", "path"}
    assert set(of.m.values()) <= {"stop", "end", "call", "return", "thread", "cut", "switch", "path"}
    assert set(of.repeatable + of.whole + of.angle + of.offset_letters) <= set(of.letters)
    assert all(low <= 1e-4 < high and letter in of.letters for letter, (low, high) in of.range.items())
    assert {"0", "1", "2", "3", "40", "41", "42", "90", "91", "92"} <= set(of.g)


def _slow(block: str) -> list[str]:
    """Codes of a block, from the rules as they are written, word by word."""
    told, seen, groups, switches = [], [], [], []
    of = profile("common")
    words = block.split()
    for word in words:
        letter, number = word[0], float(word[1:])
        if letter not in of.repeatable and letter in seen:
            told.append("ISO201")
        seen.append(letter)
        if letter in "GM":
            table = of.g if letter == "G" else of.m
            effect = table.get(f"{number:g}")
            told += ["ISO203"] if effect is None and number == int(number) else []
            told += ["ISO205"] if effect is None and number != int(number) else []
            told += ["ISO200"] if letter == "G" and effect in GROUPS and effect in groups else []
            groups += [effect] if letter == "G" else []
            told += ["ISO209"] if letter == "M" and number in switches else []
            switches += [number] if letter == "M" else []
        elif letter in of.whole and number != int(number):
            told.append("ISO205")
        low, high = of.range.get(letter, (-1e9, 1e9))
        told += ["ISO206"] if not low <= number <= high else []
    told += ["ISO202"] * (seen.count("R") if {"I", "J"} & set(seen) else 0)
    return sorted(told)


def test_random_blocks_are_told_what_a_slow_reading_tells() -> None:
    random = Random(11)
    for _ in range(20):
        blocks = [
            " ".join(f"{random.choice('GGGMXYIJRDFHTSN')}{random.choice(NUMBERS)}" for _ in range(random.randint(1, 7)))
            for _ in range(40)
        ]
        listing = read_listing("\n".join(blocks))
        told: list[list[str]] = [[] for _ in blocks]
        for finding in word_findings(listing, profile("common")):
            told[finding.line - 1].append(finding.code)
        assert [sorted(codes) for codes in told] == [_slow(block) for block in blocks]


def test_a_length_beyond_any_table_is_not_worked_out() -> None:
    program = parse_program("G92 X0 Y0\nG91\nG01 X10000001 Y0\nM02\n", choices=Choices(dialect="fast-wire"))
    assert [finding.values["limits"] for finding, _ in telling(program.findings, TooLarge)] == ["±10 m"]


def test_lengths_in_inches_have_the_same_bound() -> None:
    text = "G92 X0. Y0.\nG90\nG01 X393. Y0.\nX{} Y0.\nM02\n"
    for x, codes in (("393.7", []), ("393.71", ["ISO206"])):
        found = parse_program(text.format(x), choices=Choices(dialect="mitsubishi", unit="inch")).findings
        assert [finding.code for finding, _ in telling(found, TooLarge)] == codes


SQUARE = "G92 X0 Y0\nG90\n{}\nG01 X0 Y5000\nX5000 Y5000\nX5000 Y-5000\nX-5000 Y-5000\nX-5000 Y5000\nX0 Y5000\nM02\n"


def check(line: str, dialect: str = "common") -> tuple[list[Finding], set[str], str]:
    """What is not simulated, why checks are incomplete, and the verdict."""
    settings = CheckSettings(dialect=dialect)
    result = check_file(Job("part.iso", SQUARE.format(line).encode(), settings))
    reasons = {state.reason for state in result.coverage.checks if state.state == "incomplete"}
    wanted = {"ISO204", "ISO402", "ISO600"}
    return [one for one in result.findings if one.code in wanted], reasons, result.verdict


@pytest.mark.parametrize(
    ("line", "code", "word"),
    [
        ("G26", "ISO204", "G26"),
        ("G05", "ISO204", "G05"),
        ("G18", "ISO204", "G18"),
        ("G68", "ISO204", "G68"),
        ("M96", "ISO204", "M96"),
        ("#100 = 5", "ISO402", "#100 = 5"),
        ("IF [#1 GT 0] GOTO 10", "ISO402", "IF [#1 GT 0] GOTO 10"),
    ],
)
def test_what_is_not_simulated_leaves_the_verdict_open_by_its_name(line: str, code: str, word: str) -> None:
    findings, reasons, verdict = check(line)
    assert [(one.code, one.line, one.values.get("word", one.values.get("text"))) for one in findings] == [
        (code, 3, word)
    ]
    assert [one.severity for one in findings] == [Severity.WARNING]
    assert (reasons, verdict) == ({"reason-other-paths" if code == "ISO204" else "reason-macros"}, "incomplete")


def test_a_contour_with_a_block_of_a_macro_is_not_called_open() -> None:
    text = SQUARE.format("G91").replace("G91\n", "").replace("X0 Y5000\nM02", "X0 Y#100\nM02")
    result = check_file(Job("part.iso", text.encode(), CheckSettings(dialect="common")))
    assert [one.code for one in result.findings if one.severity is not Severity.NOTE] == ["ISO402"]
    assert result.verdict == "incomplete"


def test_checks_name_the_words_that_they_stop_at() -> None:
    text = SQUARE.format("G26 G51 A1.5\nG18\n#100 = 5").replace("Y-5000", "Y-5000 U10")
    coverage = check_file(Job("part.iso", text.encode(), CheckSettings(dialect="common"))).coverage
    stopped = [state for state in coverage.checks if state.state == "incomplete"]
    assert {(state.reason, state.words) for state in stopped} == {
        ("reason-other-paths", ("G26", "G18", "#100 = 5", "A", "U"))
    }
    assert stopped[0].because("en").endswith("not simulated: G26, G18, #100 = 5, A, U")
    assert stopped[0].because("zh").endswith("：G26, G18, #100 = 5, A, U")


def test_at_most_eight_words_are_named() -> None:
    numbers = (5, 6, 7, 8, 9, 26, 27, 28, 29, 30)
    text = SQUARE.format("\n".join(f"G{one}" for one in numbers))
    coverage = check_file(Job("part.iso", text.encode(), CheckSettings(dialect="common"))).coverage
    named = {state.words for state in coverage.checks if state.words}
    assert named == {(*(f"G{one}" for one in numbers[:8]), "…")}


@pytest.mark.parametrize(
    "line", ["G51", "G51 A95.", "G51 A1.5 U.04", "G52 A2. G01 X0 Y2500 : G01 X0 Y2000", "G02 X0 Y2500 J1250 U.04"]
)
def test_a_lean_that_is_not_known_is_judged_in_the_plane_that_is_programmed(line: str) -> None:
    findings, reasons, verdict = check(line)
    assert [one.code for one in findings] == ["ISO600"]
    assert (reasons, verdict) == ({"reason-taper"}, "incomplete")


@pytest.mark.parametrize("line", ["G50", "G51 A0", "U0 V0. G01 Y100", "T84", "M80 M82", "G04 X2.", "G60", "G54"])
def test_what_leaves_the_path_as_it_is_says_nothing(line: str) -> None:
    assert check(line) == ([], set(), "pass")


@pytest.mark.parametrize("line", ["G51 A1.5", "G52 A-2", "G01 U.04 V0", "G01 X0 Y2500 : G01 X0 Y2000"])
def test_a_lean_that_is_known_leaves_the_verdict_to_the_programmed_plane(line: str) -> None:
    assert check(line) == ([], set(), "pass")
