"""ISO goes wherever 3B goes: run, report, pages, pictures, replay, quiz, shop; a subprogram's lines run again."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from checking import SOUND, drycut
from iso_at_home import DIE, ROUNDS, ROUNDS_CUT_UM
from replayed import recording_of
from report_schema import validator
from runs import plain_scenario

from parser.dialect.reader import Reading, in_codes
from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.program import parse_program
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.run.report import build_report
from sim.setup.quiz import Question
from sim.show.refusals import taken_for_granted
from sim.show.replay.document import replay_document
from sim.show.replay.quiz import quiz_of

SUBPROGRAM = [11, 12, 13, 16, 17, 18, 16, 17, 18]
"""Lines of the blocks of `ROUNDS` that cut, in the order in which they run."""


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    return replay_document(recording_of(ROUNDS))


def codes_of(text: str) -> dict[str, str]:
    return dict(parse_program(text).reading.codes)


# Codes


def test_findings_of_path_and_machine_have_the_codes_of_iso() -> None:
    reading: Reading = parse_program(DIE).reading
    assert [found.code for found in in_codes(reading, [Finding("3B301"), Finding("3B402"), Finding("ISO210")])] == [
        *("ISO300", "3B402", "ISO210")
    ]
    assert codes_of(SOUND) == {}
    assert {*codes_of(DIE), *codes_of(DIE).values()} <= set(CODES)


def test_an_open_contour_of_iso_is_no_finding_of_3b() -> None:
    text = DIE.replace("G41 D1\n", "").replace("G01 X-10000 Y-5000", "G01 X-9000 Y-5000").replace("G40\n", "")
    found = checked(text.replace("G01 X10000 Y0\nG01 X0 Y0\n", "G01 X9500 Y0\nG01 X9000 Y7000\n"))
    assert "ISO300" in {finding.code for finding in found.findings}
    assert "3B301" not in {finding.code for finding in found.findings}


def checked(text: str) -> CheckResult:
    return check_file(Job("part.iso", text.encode(), CheckSettings()))


# Run, report, replay


def test_a_report_says_how_the_text_was_read_and_keeps_its_schema() -> None:
    run = recording_of(ROUNDS).run
    report = build_report(run)
    assert {error.json_path for error in validator().iter_errors(report)} <= {"$.program.header"}
    assert report["program"]["dialect"] == "skd2"
    what = [assumption["what"] for assumption in report["assumptions"]["program"]]
    assert what[:3] == ["dialect", "unit", "centres"]
    first, *_ = taken_for_granted(run)
    assert first.en.startswith("The program was read as: dialect skd2 (")
    assert first.zh.startswith("程序按以下约定读入：系统 skd2（")
    assert report["summary"]["length_um"] == pytest.approx(ROUNDS_CUT_UM + 30_000.0, rel=1e-9)


def test_lines_of_a_subprogram_run_again_in_report_and_replay(document: dict[str, Any]) -> None:
    blocks = document["blocks"]
    cuts = [line for line, kind in zip(blocks["line"], blocks["kind"], strict=True) if kind != "jump"]
    assert cuts == SUBPROGRAM
    lines = ROUNDS.splitlines()
    for line, first, count in zip(blocks["line"], blocks["character"], blocks["characters"], strict=True):
        assert lines[line - 1][first : first + count].strip()
    assert [label for label in blocks["label"] if label][:2] == ["N110", "N120"]


def test_a_quiz_asks_about_places_and_senses_of_iso() -> None:
    recording = recording_of(ROUNDS, quiz=(Question(2, "turn", "here"), Question(2, "end", "here")))
    turn, end = quiz_of(recording.run, recording.steps)["own"]
    assert turn["answers"][turn["right"]]["en"] == "counter-clockwise (G03)"
    assert turn["why"]["zh"] == "程序段写的是 G03：G02 为顺圆，G03 为逆圆。"
    assert end["answers"][end["right"]]["en"] == "X 5.000 mm, Y 0.000 mm"


@pytest.mark.deeper
def test_a_shop_of_both_families_is_run_with_its_settings(tmp_path: Path) -> None:
    shop = tmp_path / "shop"
    shop.mkdir()
    (shop / "part.3b").write_text(SOUND, "ascii")
    (shop / "rounds.nc").write_text(ROUNDS, "ascii")
    code, out, err = drycut("run", shop, "-o", tmp_path / "out", "--dialect", "common", "--json", "--jobs", "1")
    assert code == 0, err
    assert [program["file"].rpartition("/")[2] for program in json.loads(out)["programs"]] == ["part.3b", "rounds.nc"]
    report = json.loads((tmp_path / "out" / "rounds.nc" / "report.json").read_text("utf-8"))
    assert report["program"]["dialect"] == "common"
    page = (tmp_path / "out" / "rounds.nc" / "report.html").read_text("utf-8")
    assert "The program was read as" in page
    assert "N210 G01 X35000 Y0" in page
    shutil.rmtree(tmp_path / "out")


# Silence and mends


def test_remarks_of_iso_silence_codes_of_iso() -> None:
    noted = ROUNDS.replace("N110 G01", "N105 G01", 1).replace("N120 G03", "N100 G03", 1)
    assert "ISO120" in {finding.code for finding in checked(noted).findings}
    found = checked("(drycut: ignore-file ISO120, ISO112 tried out)\n" + noted)
    assert {finding.code for finding in found.findings} & {"ISO120", "ISO112", "3B113", "3B114"} == set()
    assert found.silenced.remarks >= 2


def test_mends_that_findings_carry_are_made(tmp_path: Path) -> None:
    part = tmp_path / "part.iso"
    part.write_text(DIE.replace("G01 X10000 Y5000", "g01 x10000 y5000").replace("M02\n", ""), "ascii")
    code, _, err = drycut("check", part, "--fix", "--offset", "D1=0.1mm")
    assert code == 0, err
    assert part.read_text("ascii") == DIE


def test_a_run_takes_the_value_of_a_register_that_it_is_given() -> None:
    scenario = plain_scenario(registers=(("D1", 110.0),))
    compensation = parse_program(DIE, choices=scenario.choices).toolpath.compensation
    assert compensation is not None
    assert {*compensation.by_um.tolist()} == {0.0, 110.0}
