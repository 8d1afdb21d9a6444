"""What passes and may still spoil the part is to be checked by a person, and says so wherever a verdict stands."""

import json
import re
from pathlib import Path

import pytest
from checking import drycut
from places import ROOT

from parser.findings.catalogue import example, page
from parser.findings.codes import CODES, Severity
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

SPOILING = sorted(code for code, of in CODES.items() if of.spoils)
TWICE = example("3B319")


def outcome_of(text: str, name: str = "a.3b", **settings: str) -> str:
    return check_file(Job(name, text.encode(), CheckSettings(**settings))).outcome  # type: ignore[arg-type]


def test_each_code_that_may_spoil_a_part_is_a_warning_whose_page_says_what_becomes_of_it() -> None:
    assert len(SPOILING) > 15
    for code in SPOILING:
        assert CODES[code].severity is Severity.WARNING
        assert page(code).machine


@pytest.mark.parametrize("document", ["check.md", "check.zh.md"])
def test_the_document_lists_these_codes_and_no_others(document: str) -> None:
    text = (ROOT / "docs" / document).read_text("utf-8")
    (told,) = re.findall(r"(?:These are the warnings of|这些警告是)(.*?)[.。]", text, re.DOTALL)
    assert re.findall(r"(?:3B|ISO|PMC)\d{3}", told) == SPOILING


def test_a_warning_of_such_a_code_is_to_be_checked_and_its_mend_is_not() -> None:
    seen = set()
    for code in SPOILING:
        shown = example(code)
        name = "a.3b" if code.startswith("3B") else "a.iso"
        if shown is None or shown.options or outcome_of(shown.program, name) in ("fail", "incomplete"):
            continue
        assert outcome_of(shown.program, name) == "to-check", code
        assert outcome_of(shown.mended, name) == "pass", code
        assert outcome_of(shown.program, name, fail_on="warning") == "fail", code
        seen.add(code)
    assert len(seen) >= 9


@pytest.mark.parametrize("file", sorted((ROOT / "scenarios").glob("*/program.*")), ids=lambda file: file.parent.name)
def test_no_example_is_to_be_checked_by_its_text_alone(file: Path) -> None:
    assert not check_file(Job(file.name, file, CheckSettings())).to_check


def test_the_line_of_a_file_says_so_in_both_languages_and_its_exit_code_stays(tmp_path: Path) -> None:
    assert TWICE is not None
    (tmp_path / "a.3b").write_text(TWICE.program, "utf-8")
    (tmp_path / "b.3b").write_text(TWICE.mended, "utf-8")
    code, out, _ = drycut("check", "--lang", "en", "a.3b", cwd=tmp_path)
    assert (code, "a.3b: to be checked: 1 warning" in out) == (0, True)
    code, out, _ = drycut("check", "--lang", "zh", "a.3b", "b.3b", cwd=tmp_path)
    assert (code, "a.3b: 请核对：1 个警告" in out, "1 通过，1 请核对" in out) == (0, True, True)
    assert drycut("check", "--fail-on", "warning", "a.3b", cwd=tmp_path)[0] == 1
    found = json.loads(drycut("check", "--format", "json", "a.3b", "b.3b", cwd=tmp_path)[1])
    assert [(file["verdict"], file["to_check"]) for file in found["files"]] == [("pass", True), ("pass", False)]
    assert (found["totals"]["files"]["pass"], found["totals"]["files"]["to_check"]) == (2, 1)


@pytest.mark.deeper
def test_a_run_and_a_batch_say_so_too(tmp_path: Path) -> None:
    assert TWICE is not None
    (tmp_path / "shop").mkdir()
    (tmp_path / "shop" / "a.3b").write_text(TWICE.program, "utf-8")
    code, out, _ = drycut("run", "--lang", "zh", "shop/a.3b", "-o", "out", cwd=tmp_path)
    assert (code, out.splitlines()[-1 if "结论" in out.splitlines()[-1] else -2]) == (0, "结论：通过，请核对")
    report = json.loads((tmp_path / "out" / "report.json").read_bytes())
    assert (report["verdict"], report["to_check"]) == ("pass", True)
    text = (tmp_path / "out" / "report.html").read_text("utf-8")
    assert '<div class="verdict to-check">' in text
    assert "切割前请核对 3B319" in text
    assert '<span class="verdict to-check">' in (tmp_path / "out" / "replay.html").read_text("utf-8")
    code, out, _ = drycut("run", "--lang", "en", "shop", "-o", "many", cwd=tmp_path)
    assert code == 0
    assert out.splitlines()[0] == "shop/a.3b: to be checked: 3B319"
    assert "1 program: 1 to be checked" in out
    index = json.loads((tmp_path / "many" / "index.json").read_bytes())
    assert (index["programs"][0]["to_check"], index["counts"]["to_check"]) == (True, 1)
