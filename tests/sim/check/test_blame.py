"""One wrong word is named, by all that speaks for it, and nothing is told against it."""

import random
import re

import pytest
from bench_path import contour_text
from cam_programs import sound_program
from depth import cases
from slips import contradiction, measured

from parser.findings.findings import edited
from parser.program import Program
from sim.check import path_checks
from sim.check.file_check import Job, check_file
from sim.check.path_checks import Checked, Demands
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings

KEYHOLE = (
    "N1: B0 B24900 B24900 GYL2;0.000,24.900\n"
    "N2: B0 B24900 B49800 GXNR2;0.000,-24.900\n"
    "N3: B56757 B0 B56757 GXL1;56.757,-24.900\n"
    "N4: B43243 B24900 B149800 GYNR3;56.756,24.898\n"
    "N5: B56756 B2 B56756 GXL2;0.000,24.900\n"
    "N6: B0 B24900 B24900 GYL4;0.000,0.000\n"
    "DD\n"
)
HALF = "B0B2900B2900GYL4\nB5000B0B5000GXL1\nB0B2900B5800GXNR4\nB10000B0B10000GXL3\n{}\nB5000B0B5000GXL1\nDD\n"


def checked(text: str) -> CheckResult:
    return check_file(Job("part.3b", text.encode(), CheckSettings()))


@pytest.mark.parametrize(
    ("right", "wrong", "field"),
    [
        ("GXL1", "GXL3", "field-sense"),
        ("GYL4", "GYL2", "field-sense"),  # in the last block: its end is a corner of the contour
        ("GYNR3", "GYSR3", "field-sense"),
        ("GYNR3", "GYNR2", "field-sense"),
        ("GYNR3", "GXNR3", "field-axis"),
        ("B149800", "B14980", "field-count"),
        ("B43243", "B43343", "field-x"),
    ],
)
def test_a_word_that_printed_ends_prove_wrong_is_named_and_mended(right: str, wrong: str, field: str) -> None:
    result = checked(KEYHOLE.replace(right, wrong))
    named = [finding for finding in result.findings if finding.code == "3B217"]
    assert [(one.values["field"], one.values["other"]) for one in named] == [
        (field, right.removeprefix("B") if right.startswith("B") else right[2:] if field == "field-sense" else "GY")
    ]
    assert {finding.code for finding in result.findings} <= {"3B217", "3B301", "3B311"}
    assert edited(KEYHOLE.replace(right, wrong), named[0].edits) == KEYHOLE


def test_a_printed_end_that_is_wrong_alone_accuses_no_block() -> None:
    result = checked(KEYHOLE.replace("56.757,-24.900", "56.757,-24.090"))
    assert [(f.code, f.values["advice"], f.edits) for f in result.findings] == [("3B207", "correct-print", ())]


def test_an_end_that_no_one_slip_explains_names_no_word() -> None:
    text = "B9900B0B9900GXL1;9.900,0.000\nB9900B0B39600GYNR1;9.900,0.005\nB9900B0B9900GXL3;0.000,0.005\nDD\n"
    assert [finding.code for finding in checked(text).findings] == ["3B207"]


@pytest.mark.parametrize(("written", "word"), [("B0B2900B5800GXSR1", "NR2"), ("B0B2900B5800GXSR2", "NR2")])
def test_a_sense_that_the_joints_prove_wrong_is_named_with_its_quadrant(written: str, word: str) -> None:
    findings = checked(HALF.format(written)).findings
    assert [(finding.code, finding.values["word"]) for finding in findings] == [("3B306", word)]


def test_an_arc_label_that_may_be_a_slip_of_either_sense_names_both() -> None:
    text = (
        "B0B12000B12000GYL4\nB10000B0B10000GXL1\nB0B4000B4000GYL2\n"
        "B0B2000B4000GXNR3\nB0B4000B4000GYL2\nB10000B0B10000GXL3\nDD\n"
    )
    (found,) = checked(text).findings
    assert (found.code, found.values["ruled"], found.edits) == ("3B203", "NR4", ())
    assert "SR3" in found.values["others"].split(" / ")


@pytest.mark.deeper
def test_slips_in_printed_programs_are_named_right_and_never_told_two_ways() -> None:
    done = list(measured(random.Random(20261122), len(cases(2, 12)), printed=True))
    assert [contradiction(one.result) for one in done if one.contradicts] == []
    assert not [one.slip for one in done if one.mended is False]
    assert sum(one.verdict == "right" for one in done) >= 0.95 * len(done)
    assert sum(one.verdict == "wrong" for one in done) <= 0.01 * len(done)


def test_a_sound_printed_program_is_silent() -> None:
    rng = random.Random(5)
    assert all(checked(sound_program(rng, printed=True).text).findings == () for _ in range(20))


SQUARE = "B0B10000B10000GYL2\nB10000B0B10000GXL1\nB0B10000B10000GYL4\n{}\nDD\n"


@pytest.mark.parametrize(
    ("last", "told"),
    [
        ("B10000B0B10000GXL3;0.000,0.000", []),
        ("B10000B0B10000GXL3;0.030,0.000", [("3B207", "compare-print")]),  # the contour closes without it
        ("B10000B0B10400GXL3;0.000,0.000", [("3B301", 1), ("3B217", "10000")]),
        ("B10000B0B10000GXL1;0.000,0.000", [("3B301", 1), ("3B217", "L3")]),
    ],
)
@pytest.mark.parametrize("before", ["", SQUARE.format("B10000B0B10000GXL3")[:-3] + "D\nB30000B0B30000GXL1\nD\n"])
def test_of_the_last_printed_end_its_contour_tells(last: str, told: list[tuple[str, object]], before: str) -> None:
    text = before + SQUARE.format(last)
    if before:
        text = text.replace(";0.0", ";30.0")
    found = checked(text).findings
    first = 6 if before else 1
    keys = {"3B207": "advice", "3B301": "first", "3B217": "other"}
    assert [(f.code, f.values[keys[f.code]]) for f in found] == [
        (code, first if code == "3B301" else value) for code, value in told
    ]


@pytest.mark.parametrize(("wrong", "is_looked_for"), [(50, True), (51, False)])
def test_where_more_than_fifty_ends_are_off_no_word_is_looked_for(wrong: int, *, is_looked_for: bool) -> None:
    blocks = "".join(f"B0B10000B10400GYL2;0.000,{10 * number}.000\n" for number in range(1, wrong + 1))
    codes = [finding.code for finding in checked(f"{blocks}B10000B0B10000GXL1\nDD\n").findings]
    assert codes.count("3B217") == (wrong - 1 if is_looked_for else 0)
    assert codes.count("3B207") == (1 if is_looked_for else wrong)


def mended(text: str) -> list[tuple[str, int, bool]]:
    return [(found.code, found.block, bool(found.edits)) for found in checked(text).findings]


WRONG_LABEL = SQUARE.replace("GYL2", "GYL3").format("B10000B0B10000GXL3")
"""L3 leads to the wrong place and is no label of a line straight up."""
TURNED_BACK = SQUARE.replace("GYL2", "GYL4").format("B10000B0B10000GXL3")
"""L4 is one, of a line straight down: either side may be the one that is wrong."""


def test_a_suspect_is_mended_where_its_label_breaks_the_rule_as_well() -> None:
    assert mended(WRONG_LABEL) == [("3B304", 1, True), ("3B301", 4, False)]
    assert mended(TURNED_BACK) == [("3B304", 1, False), ("3B304", 3, False), ("3B301", 4, False)]


def test_figures_with_one_suspect_and_with_two_are_each_told_as_by_themselves() -> None:
    first = TURNED_BACK.replace("DD", "D\nB30000B0B30000GXL1\nD")
    behind = [(code, block + 5, is_mended) for code, block, is_mended in mended(WRONG_LABEL)]
    assert mended(first + WRONG_LABEL) == mended(TURNED_BACK) + behind


@pytest.mark.parametrize(("most", "is_settled"), [(4, True), (3, False)])
def test_a_longer_program_keeps_all_that_its_checks_suspect(
    most: int, monkeypatch: pytest.MonkeyPatch, *, is_settled: bool
) -> None:
    monkeypatch.setattr("sim.check.blame.settle.MOST_BLOCKS", most)
    found = mended(WRONG_LABEL)
    assert (("3B304", 1, True) in found) == is_settled
    assert [one for one in found if one[2]] == ([("3B304", 1, True)] if is_settled else [])


def checks_made(monkeypatch: pytest.MonkeyPatch, text: str) -> tuple[int, set[str]]:
    """How often every check is run on a program, and the codes of what they find."""
    made = []
    every_check = path_checks._every_check

    def counted(program: Program, demands: Demands) -> Checked:
        made.append(program)
        return every_check(program, demands)

    monkeypatch.setattr(path_checks, "_every_check", counted)
    result = check_file(Job("part.3b", text.encode(), CheckSettings()))
    return len(made), {finding.code for finding in result.findings}


def test_the_only_word_that_explains_an_open_contour_alone_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    text = contour_text(100, crosses=False)
    assert checks_made(monkeypatch, text) == (1, set())
    count = re.findall(r"B\d+ B\d+ B(\d+)", text)[50]
    found = checks_made(monkeypatch, text.replace(f"B{count} G", f"B{count}{count[-1]} G", 1))
    assert found == (2, {"3B301", "3B304"})


def test_a_word_that_may_explain_more_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    text = (
        "B1000B0B1000GXL1;1.0,0.0\nB0B1000B10000GYL2;1.0,1.0\nB1000B0B1000GXL3;0.0,1.0\nB0B1000B1000GYL4;0.0,0.0\nDD\n"
    )
    assert checks_made(monkeypatch, text) == (2, {"3B217", "3B301"})


def test_a_mend_that_leaves_no_block_proves_nothing() -> None:
    """The only block of the text is behind words that a mend would join it with; check ended without a finding."""
    text = "Offset F= 0.0B99000B9900GXL3; -0.000 , 0.0001\n\uff22B9900B0B39600GYNR1;9.9 ,0.\n"
    result = check_file(Job("part.3b", text.encode(), CheckSettings()))
    assert result.findings
    assert all(finding.line for finding in result.findings)
