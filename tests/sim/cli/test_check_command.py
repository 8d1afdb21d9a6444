"""``drycut check`` and ``drycut explain`` as a user meets them."""

import json
import random
import re
import subprocess
import sys
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS, drycut
from iso_programs import FAMILIES, program
from places import SCENARIOS

from parser.findings.catalogue import page
from parser.findings.codes import CODES


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.3b"
    path.write_text(SOUND, "ascii")
    return path


def test_a_sound_program_passes_in_one_line(part: Path) -> None:
    code, out, err = drycut("check", part.name, cwd=part.parent)
    assert (code, err) == (0, "")
    assert out == "part.3b: pass; 3 blocks; checks: 8 complete, 4 not asked\n"
    assert drycut("check", part, "--quiet") == (0, "", "")


def test_a_fault_is_told_with_place_line_caret_and_hint(part: Path) -> None:
    part.write_text(WRONG_AXIS, "ascii")
    code, out, _ = drycut("check", part.name, cwd=part.parent)
    first, source, caret, found, *_, hint, verdict = out.splitlines()
    assert code == 1
    assert first == "part.3b:2:14: error[3B204]: wrong count axis"
    assert found == "    = found:    block 2: the block counts on X, and its steps end 140.00 µm from"
    assert source == "  2 | B9900B0B39600GXNR1"
    assert caret == "    |              ^^"
    assert hint == "    = hint:     write GY, with J 39600"
    assert verdict == "part.3b: fail: 1 error; 3 blocks; checks: 8 complete, 4 not asked"


def test_the_standard_input_is_read(part: Path) -> None:
    code, out, _ = drycut("check", "-", stdin=WRONG_AXIS.encode())
    assert code == 1
    assert out.startswith("<stdin>:2:14: error[3B204]")


def test_folders_globs_and_files_are_each_checked_once(tmp_path: Path) -> None:
    for name in ("b.3B", "a.4b", "deep/c.3b", "notes.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(SOUND, "ascii")
    code, out, _ = drycut("check", tmp_path, tmp_path / "*.4b", "--format", "json")
    names = [Path(file["name"]).name for file in json.loads(out)["files"]]
    assert code == 0
    assert names == ["a.4b", "b.3B", "c.3b"]
    _, out, _ = drycut("check", tmp_path / "notes.txt", "--format", "json")
    assert json.loads(out)["verdict"] == "pass"


@pytest.mark.alike(3)
@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["empty"], "empty: no program there"),
        (["*.3b"], "*.3b: no program there"),
        ([".", "--select", "3C1"], "--select: no code begins with '3C1'"),
        (["-", "--gap", "10"], "'10' is no length"),
        (["-", "--gap", "9mm"], "--gap in mm is 9"),
        (["-", "--machine", "dk1"], "machine 'dk1' is not shipped"),
        (["-", "--wire-diameter", "0.02mm", "--gap=-20um"], "cuts no kerf"),
        (["-", "--fix"], "--fix mends files"),
        ([], "Missing argument"),
    ],
)
def test_bad_use_is_one_clear_line_and_exit_2(tmp_path: Path, arguments: list[str], complaint: str) -> None:
    (tmp_path / "empty").mkdir()
    code, out, err = drycut("check", *arguments, stdin=SOUND.encode(), cwd=tmp_path)
    assert (code, out) == (2, "")
    assert complaint in err
    assert "Traceback" not in err


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "empty"),
        (b"\0\1\2", "no text"),
        (b"\x89PNG\r\n\x1a\n", "a picture"),
        (b"hello", "no block"),
        (None, "cannot be read"),
    ],
)
def test_what_is_no_program_is_a_finding_and_exit_2(tmp_path: Path, content: bytes | None, words: str) -> None:
    path = tmp_path / "x.3b"
    if content is not None:
        path.write_bytes(content)
    good = tmp_path / "good.3b"
    good.write_text(SOUND, "ascii")
    code, out, _ = drycut("check", path, good)
    assert code == 2
    assert words in out.splitlines()[1]
    assert "error[3B100]" in out
    assert "2 files: 1 pass, 1 fail" in " ".join(out.split())  # the others are checked all the same
    assert f"{path}: fail: 1 error; nothing was checked " in " ".join(out.split())


def test_select_ignore_and_fail_on(part: Path) -> None:
    part.write_text(SOUND.replace("GXL1", "GXL4").replace("GYNR1", "GXNR1"), "ascii")
    found = {"all": drycut("check", part), "only": drycut("check", part, "--select", "3B203")}
    assert "3B203" in found["all"][1]
    assert "3B204" in found["all"][1]
    assert found["only"][0] == 0
    assert "3B204" not in found["only"][1]
    assert drycut("check", part, "--select", "3b203", "--fail-on", "warning")[0] == 1
    assert drycut("check", part, "--ignore", "3B2")[0] == 0


def test_chinese_by_option_and_by_locale(part: Path) -> None:
    part.write_text(WRONG_AXIS, "ascii")
    asked = drycut("check", part, "--lang", "zh")[1]
    assert "错误[3B204]" in asked
    assert drycut("check", part, LC_ALL="zh_CN.UTF-8")[1] == asked
    assert "error[3B204]" in drycut("check", part, "--lang", "en", LC_ALL="zh_CN.UTF-8")[1]


def test_travel_and_corners_are_checked_when_asked_for(part: Path) -> None:
    part.write_text("B300000B0B300000GXL1\nDD\n", "ascii")
    assert "travel 1" in drycut("check", part, "--statistics")[1].partition("not asked    ")[2]
    code, out, _ = drycut("check", part, "--machine", "dk7740", "--wire-diameter", "0.18mm", "--statistics")
    assert code == 1
    assert "error[3B401]" in out
    assert "\nnot asked    printed ends 1, header length 1\n" in out


def test_settings_stand_above_the_file_and_options_come_first(tmp_path: Path) -> None:
    (tmp_path / "drycut.toml").write_text('fail_on = "warning"\nignore = ["3B102"]\nend_marks = ["E"]\n', "utf-8")
    path = tmp_path / "deep" / "part.3b"
    path.parent.mkdir()
    path.write_text(SOUND.replace("GXL1", "GXL4").replace("DD", "E"), "ascii")
    code, out, _ = drycut("check", path, cwd=tmp_path)
    assert code == 1
    assert out.count("[3B") == 1
    assert "3B203" in out
    assert drycut("check", path, "--fail-on", "error", cwd=tmp_path)[0] == 0
    (tmp_path / "drycut.toml").unlink()
    (tmp_path / "pyproject.toml").write_text('[tool.drycut]\nignore = ["3B2"]\n', "utf-8")
    assert "3B105" in drycut("check", path, cwd=tmp_path)[1]
    (tmp_path / "pyproject.toml").write_text("[tool.drycut]\nignor = []\n", "utf-8")
    code, _, err = drycut("check", path, cwd=tmp_path)
    assert code == 2
    assert "unknown key 'ignor'; did you mean ignore?" in err


def test_each_file_is_checked_once_and_broken_links_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.3b"
    path.write_text(SOUND, "ascii")
    (tmp_path / "loop").symlink_to(tmp_path)
    (tmp_path / "gone.3b").symlink_to(tmp_path / "nowhere.3b")
    names = (path, f"{tmp_path}/./a.3b", f"{tmp_path}/**/a.3b", tmp_path)
    code, out, _ = drycut("check", *names, "--format", "json")
    found = [(Path(file["name"]).name, file["verdict"]) for file in json.loads(out)["files"]]
    assert sorted(found) == [("a.3b", "pass"), ("gone.3b", "fail")]
    assert code == 2


def test_the_verdict_follows_what_is_to_fail(part: Path) -> None:
    part.write_text(SOUND.replace("GXL1", "GXL4"), "ascii")
    assert "part.3b: pass: 1 warning;" in drycut("check", part)[1]
    assert "part.3b: fail: 1 warning;" in drycut("check", part, "--fail-on", "warning")[1]
    assert json.loads(drycut("check", part, "--fail-on", "warning", "--format", "json")[1])["verdict"] == "fail"


@pytest.mark.parametrize(
    "line",
    [
        'pause_marks = ["DD"]',
        'end_marks = ["d"]',
        'end_marks = ["E"]\npause_marks = ["e"]',
        *(f'end_marks = ["{letter}"]' for letter in "BNLSGXY"),
    ],
)
def test_marks_that_mean_something_else_are_refused(tmp_path: Path, part: Path, line: str) -> None:
    (tmp_path / "drycut.toml").write_text(line, "utf-8")
    code, _, err = drycut("check", part)
    assert code == 2
    assert "_marks" in err


def test_an_incomplete_check_is_never_clean(part: Path) -> None:
    part.write_text(SOUND.replace("B9900B0B9900GXL3", "B9900B0B99O0GXL3"), "ascii")
    code, out, _ = drycut("check", part, "--ignore", "3B106")
    assert code == 1
    assert "part.3b: incomplete: 1 not shown; 2 of 3 blocks read" in " ".join(out.split())
    assert "closure of contours" in out.partition("4 not asked\n")[2]


@pytest.mark.deeper
def test_many_files_go_over_all_cores_in_their_order(tmp_path: Path) -> None:
    for number in range(240):
        (tmp_path / f"{number:03}.3b").write_text(SOUND if number % 7 else WRONG_AXIS, "ascii")
    code, out, _ = drycut("check", tmp_path, "--format", "json")
    report = json.loads(out)
    assert code == 1
    assert [Path(file["name"]).stem for file in report["files"]] == [f"{number:03}" for number in range(240)]
    assert [file["verdict"] == "fail" for file in report["files"]] == [number % 7 == 0 for number in range(240)]


def test_explain_shows_the_page_and_lists_all_codes() -> None:
    code, out, _ = drycut("explain", "3b204")
    assert code == 0
    assert page("3B204").title in out.splitlines()[0]
    assert "B9900B0B39600GXNR1" in out
    assert page("3B204", "zh").title in drycut("explain", "3B204", "--lang", "zh")[1]
    listed = drycut("explain")[1]
    assert re.findall(r"^ *((?:3B|GEC|ISO|PMC)\d{3}) ", listed, re.MULTILINE) == sorted(CODES)
    code, _, err = drycut("explain", "3B999")
    assert code == 2
    assert "'3B999'" in err


def test_check_needs_no_engine_and_no_pictures(part: Path) -> None:
    script = (
        "import sys; from sim.cli import cli\n"
        "heavy = {'pymunk', 'numba', 'pygame', 'PIL', 'rich', 'numpy.ma', 'multiprocessing'}\n"
        "try: cli.main(['check', *sys.argv[1:]], standalone_mode=False)\n"
        "finally: print(sorted(heavy & set(sys.modules)))"
    )
    for family in FAMILIES:
        (part.parent / f"{family}.iso").write_text(program(random.Random(3), family).text, "utf-8")
    command = [sys.executable, "-c", script, str(part.parent), str(SCENARIOS / "keyhole")]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.splitlines()[-1] == "[]"


def test_blocks_behind_the_end_code_are_counted_whole_or_damaged(part: Path) -> None:
    part.write_text(SOUND + "B1B0B1GXL1\nBxB0B1GXL1\n", "ascii")
    code, out, _ = drycut("check", part)
    assert code == 1
    assert "blocks after DD: 2" in out
    assert "4 of 5 blocks read, 3 decoded" in " ".join(out.split())


@pytest.mark.deeper
def test_open_lets_a_stepped_edge_stay_open_as_in_scenarios(part: Path) -> None:
    part.write_text("B0B2000B2000GYL2 B3000B0B3000GXL1 B0B1000B1000GYL2 B3000B0B3000GXL1 B0B4000B4000GYL4 DD", "utf-8")
    for command in (["check"], ["run", "-o", str(part.parent / "out")]):
        code, out, err = drycut(*command, part)
        assert (code, "3B301" in out + err) == (1, True)
        code, out, err = drycut(*command, part, "--open")
        assert (code, "3B301" in out + err) == (0, False)
