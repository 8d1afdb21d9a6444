"""A baseline knows findings again, and no others."""

import json
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS

from parser.findings.errors import DrycutError
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult, CheckState, Silenced, gap_marks
from sim.check.settings import CheckSettings
from sim.check.silence import (
    Baseline,
    baseline_text,
    known_of,
    read_baseline,
)

LABEL = "B9900B0B9900GXL4\nB9900B0B9900GXL3\n"  # 3B203


def checked(text: str, known: frozenset[str] = frozenset()) -> CheckResult:
    return check_file(Job("part.3b", text.encode(), CheckSettings(), known))


def test_known_findings_are_silenced_and_new_ones_fail() -> None:
    known = frozenset(known_of(checked(WRONG_AXIS)))
    again = checked(LABEL + WRONG_AXIS, known)
    assert [finding.code for finding in again.findings] == ["3B203"]
    assert again.silenced == Silenced(baseline=1)
    assert (checked(WRONG_AXIS, known).verdict, checked(WRONG_AXIS).verdict) == ("pass", "fail")


def test_one_more_of_a_known_finding_is_new() -> None:
    known = frozenset(known_of(checked(f"{LABEL * 2}DD")))
    assert checked(f"{LABEL * 2}DD", known).findings == ()
    again = checked(f"{LABEL * 3}DD", known)
    assert ([finding.line for finding in again.findings], again.silenced.baseline) == ([5], 2)


def test_a_file_that_is_no_program_is_never_known() -> None:
    nothing = checked("hello")
    assert known_of(nothing) == {}
    assert checked("hello", frozenset("0" * 32)).findings == nothing.findings


def test_files_are_named_from_the_folder_of_the_baseline(tmp_path: Path) -> None:
    baseline = Baseline(tmp_path / "ci" / "known.json", {"../parts/a.3b": {"0": "3B204"}})
    assert baseline.key(tmp_path / "parts" / "a.3b") == "../parts/a.3b"
    assert baseline.of(tmp_path / "parts" / "a.3b") == {"0": "3B204"}
    assert baseline.of(tmp_path / "a.3b") == {}


def test_the_text_is_sorted_ascii_and_reads_back(tmp_path: Path) -> None:
    known = {"零件.3b": {"b": "3B204", "a": "3B301"}, "a.3b": {}, "0.3b": {"c": "3B203"}}
    text = baseline_text(known)
    assert text.isascii()
    assert text == baseline_text(dict(reversed(known.items())))
    assert list(json.loads(text)["files"]) == ["0.3b", "零件.3b"]
    file = tmp_path / "known.json"
    file.write_text(text, "ascii")
    assert read_baseline(file).known == {"零件.3b": {"a": "3B301", "b": "3B204"}, "0.3b": {"c": "3B203"}}


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (None, "cannot be read"),
        (b"", "is no baseline"),
        (b"{", "is no baseline"),
        (b"\xff", "is no baseline"),
        (b"[" * 200_000, "is no baseline"),
        (b"[]", "is no baseline; write it with --write-baseline"),
        (b'{"schema": "drycut.baseline/1"}', "is no baseline"),
        (b'{"schema": "drycut.baseline/9", "files": {}}', "is of schema 'drycut.baseline/9'"),
        (b'{"schema": "drycut.baseline/1", "files": {"a.3b": []}}', "a.3b: expected codes"),
        (b'{"schema": "drycut.baseline/1", "files": {"a.3b": {"0": 1}}}', "a.3b: expected codes"),
        (b'{"schema": "drycut.baseline/1", "files": {"a.3b": {"0": "3B999"}}}', "a.3b: expected codes"),
    ],
)
def test_a_broken_baseline_is_told(tmp_path: Path, content: bytes | None, why: str) -> None:
    file = tmp_path / "known.json"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(DrycutError, match=why):
        read_baseline(file)


def test_a_sound_program_has_nothing_to_know() -> None:
    assert known_of(checked(SOUND)) == {}


OPEN = "B9900B0B9900GXL1\nB5000B0B5000GXL1\nB0B9900B9900GYL2\nB3000B2000B3000GXL3\nB3000B2000B3000GXL2\nDD\n"
TAPER = "G92 X0 Y0\nG90 G51\nG01 X0 Y5000\nX5000 Y5000\nX5000 Y0\nX0 Y0\nG50\nM02\n"


@pytest.mark.parametrize(("name", "text"), [("a.3b", OPEN), ("a.iso", TAPER)])
def test_a_check_that_is_known_not_to_end_fails_nothing_and_is_counted(name: str, text: str) -> None:
    def result(known: frozenset[str] = frozenset()) -> CheckResult:
        return check_file(Job(name, text.encode(), CheckSettings(), known))

    before = known_of(result())
    gaps = {check.name for check in result().coverage.checks if check.state == "incomplete"}
    assert gaps
    assert gaps <= set(before.values())
    again = result(frozenset(before))
    assert (again.verdict, again.findings, again.silenced.checks) == ("pass", (), len(gaps))
    assert {check.name for check in again.coverage.checks if check.state == "known"} == gaps
    assert not again.coverage.is_complete
    only_findings = frozenset(mark for mark, code in before.items() if not code.startswith("check-"))
    assert result(only_findings).verdict == "incomplete"


def test_of_a_gap_that_words_make_each_word_is_known_by_itself() -> None:
    one, both = (CheckState("check-blocks", "incomplete", "reason-taper", words) for words in (("A",), ("A", "B")))
    assert set(gap_marks(one)) < set(gap_marks(both))
    assert len(set(gap_marks(both))) == 2


def test_a_baseline_of_findings_alone_is_read_still(tmp_path: Path) -> None:
    file = tmp_path / "known.json"
    file.write_text('{"schema": "drycut.baseline/1", "files": {"a.3b": {"0": "3B204"}}}', "ascii")
    assert read_baseline(file).known == {"a.3b": {"0": "3B204"}}
