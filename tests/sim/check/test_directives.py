"""Remarks in a program silence codes on their line or in the file, and nothing else does."""

import time

import pytest
from checking import SOUND, WRONG_AXIS

from parser.findings.catalogue import texts
from parser.program import parse_program
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult, Silenced
from sim.check.settings import CheckSettings
from sim.check.silence import heed

LEAD, CIRCLE, BACK, END = WRONG_AXIS.splitlines()
LABEL = SOUND.replace("GXL1", "GXL4")  # 3B203 in line 1


def checked(text: str, encoding: str = "utf-8", **settings: object) -> CheckResult:
    return check_file(Job("part.3b", text.encode(encoding), CheckSettings(**settings)))  # type: ignore[arg-type]


def codes(text: str, **settings: object) -> list[str]:
    return [finding.code for finding in checked(text, **settings).findings]


def program(*lines: str) -> str:
    return "\n".join(lines)


@pytest.mark.parametrize(
    "remark",
    [
        "// drycut: ignore 3B204",
        "//drycut:ignore 3b204",
        "; drycut: ignore: 3B204, 3B301",
        "(drycut: ignore 3B2)",
        "//--- DRYCUT: Ignore 3B2 3B3 tried out on 2026-11-02",
        "// drycut: ignore 3B204 试切过，没问题",
        "；drycut：ignore 3B301，3B204",
        ";9.900,0.000//drycut: ignore 3B204",
    ],
)
def test_a_remark_silences_codes_on_its_line(remark: str) -> None:
    result = checked(program(LEAD, f"{CIRCLE} {remark}", BACK, END), encoding="gb18030")
    assert {finding.code for finding in result.findings} <= {"3B114"}
    assert result.silenced == Silenced(remarks=1)


def test_a_remark_between_blocks_silences_on_its_line_too() -> None:
    assert codes(program(LEAD, f"(drycut: ignore 3B204) {CIRCLE}", BACK, END)) == []
    assert codes(f"{LEAD}{CIRCLE}{BACK}(drycut: ignore 3B204){END}") == []


def test_alone_on_its_line_it_means_the_next_line_that_holds_more() -> None:
    remark = "// drycut: ignore 3B204"
    assert codes(program(LEAD, remark, CIRCLE, BACK, END)) == []
    assert codes(program(LEAD, remark, "", "// turned over here", f"{CIRCLE} // by hand", BACK, END)) == []
    assert codes(program(remark, LEAD, CIRCLE, BACK, END)) == ["3B114", "3B204"]
    assert codes(program(LEAD, CIRCLE, remark, BACK, END)) == ["3B204", "3B114"]
    assert codes(program(LEAD, CIRCLE, BACK, END, remark)) == ["3B204", "3B114"]


def test_a_remark_for_the_file_may_stand_anywhere() -> None:
    remark = "// drycut: ignore-file 3B102, 3B2"
    fault = WRONG_AXIS.replace("DD", "")
    for text in (f"{remark}\n{fault}", f"{fault}{remark}"):
        result = checked(text)
        assert result.findings == ()
        assert (result.verdict, result.silenced) == ("pass", Silenced(remarks=2))


@pytest.mark.parametrize(
    ("remark", "said"),
    [
        ("// drycut: ignore", "without a code: `ignore`"),
        ("// drycut: ignore-file ,3B204", "without a code: `ignore-file ,3B204`"),
        ("// drycut: ignore 3B999", "that there is not: `3B999`"),
        ("// drycut: ignore 3B204, 38204", "that there is not: `38204`"),
        ("// drycut: ignore because it is so", "that there is not: `because`"),
        ("// drycut: ignore-all 3B204", "nothing it knows: `ignore-all 3B204`"),
        ("// drycut: ok", "nothing it knows: `ok`"),
        (f"// drycut: {'x' * 90}", f"nothing it knows: `{'x' * 40}…`"),
        ("// drycut:", "nothing it knows: ``"),
    ],
)
def test_a_remark_that_cannot_be_read_is_told_and_silences_nothing(remark: str, said: str) -> None:
    result = checked(program(LEAD, CIRCLE, f"{BACK} {remark}", END))
    (told,) = [finding for finding in result.findings if finding.code == "3B113"]
    assert said in texts(told).found
    assert "3B204" in [finding.code for finding in result.findings]
    assert checked(program(LEAD, f"{CIRCLE.replace('GX', 'GY')} {remark}", BACK, END)).verdict == "pass"


@pytest.mark.parametrize(
    "remark",
    [
        "// 线割程序 drycut: ignore 3B204",
        "// see drycut: ignore 3B204",
        "// drycut ignore 3B204",
        "// checked with drycut",
        "// drycuts: ignore 3B204",
        "// NOQA",
    ],
)
def test_a_remark_that_does_not_begin_with_drycut_is_none_of_its_business(remark: str) -> None:
    assert codes(program(LEAD, f"{CIRCLE} {remark}", BACK, END)) == ["3B204"]


def test_only_a_remark_can_silence() -> None:
    for line in ("drycut: ignore-file 3B2", "**** drycut: ignore-file 3B2", "CAXA drycut: ignore-file 3B2"):
        assert "3B204" in codes(program(line, WRONG_AXIS)), line


def test_what_silences_nothing_is_told_each_code_by_itself() -> None:
    result = checked(program(LEAD, f"{CIRCLE} // drycut: ignore 3B204, 3B301", BACK, END))
    (told,) = result.findings
    assert (told.code, told.values["silenced"], told.line, told.column) == ("3B114", "3B301", 2, 45)
    assert result.verdict == "pass"


def test_nothing_is_told_where_the_check_was_not_asked_for_or_could_not_look() -> None:
    remark = "// drycut: ignore-file 3B401"
    assert codes(program(remark, SOUND)) == []
    damaged = program("// drycut: ignore-file 3B301", SOUND.replace("B39600", "B396O0"))
    assert codes(damaged) == ["3B106"]
    assert codes(program("// drycut: ignore-file 3B402", SOUND)) == ["3B114"], "a check never gives it"


def test_a_code_that_options_silence_counts_as_theirs_and_the_remark_is_in_use() -> None:
    said = program(LEAD, f"{CIRCLE} // drycut: ignore 3B204", BACK, END)
    assert checked(said, ignore=("3B204",)).silenced == Silenced(settings=1)
    options = CheckSettings(ignore=("3B1",)).with_options({"ignore": ("3B204",)})
    result = check_file(Job("part.3b", said.encode(), options))
    assert (result.findings, result.silenced) == ((), Silenced(options=1))


def test_notes_on_remarks_are_silenced_as_all_are() -> None:
    said = program(f"{SOUND}// drycut: ignore 3B204", "// drycut: ignore")
    assert codes(said) == ["3B114", "3B113"]
    assert checked(said, ignore=("3B113", "3B114")).silenced == Silenced(settings=2)


def test_what_is_no_program_stays_so() -> None:
    result = checked("// drycut: ignore-file 3B1\n")
    assert [finding.code for finding in result.findings] == ["3B100"]
    assert result.unreadable


@pytest.mark.deeper
def test_ten_thousand_remarks_take_no_long_time() -> None:
    wrong = LABEL.splitlines()[0]
    in_lines = f"{wrong} // drycut: ignore 3B203\n" * 10_000
    in_one_line = f"{wrong}(drycut: ignore 3B203)" * 10_000
    above = "// drycut: ignore 3B203\n" * 10_000 + wrong
    for text in (in_lines, in_one_line, above):
        read = parse_program(text)
        begin = time.perf_counter()
        assert heed(read, read.findings, ()).silenced
        assert time.perf_counter() - begin < 5.0
