"""Several outputs of one ``drycut check``: each as a run of its own would give it, whole or not at all."""

import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS
from command import run_command, run_inside
from places import ROOT

from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.cli.check.outputs import Output, write
from sim.show.findings import FORMATS
from sim.show.findings.wording import Options

REMARKED = "N1: B9900B0B9900GXL4//切入\n"


@pytest.fixture
def programs(tmp_path: Path) -> Path:
    folder = tmp_path / "programs"
    (folder / "deep").mkdir(parents=True)
    (folder / "sound.3b").write_text(SOUND, "ascii")
    (folder / "wrong.3b").write_text(WRONG_AXIS, "ascii")
    (folder / "deep" / "零件.4b").write_bytes((REMARKED + SOUND).encode("gb18030"))
    (folder / "none.3b").write_bytes(b"")
    return tmp_path


def alone(form: str, cwd: Path, *more: object) -> bytes:
    return run_inside("check", "programs", "--format", form, *more, cwd=cwd).stdout


@pytest.mark.alike(1)
@pytest.mark.parametrize("lang", ["en", "zh"])
def test_outputs_of_one_run_are_those_of_runs_of_their_own(programs: Path, lang: str) -> None:
    into = {form: f"out/{form}.txt" for form in FORMATS}
    asked = [f"--format={form}={file}" for form, file in into.items()]
    done = run_inside("check", "programs", *asked, "--format", "text", "--statistics", "--lang", lang, cwd=programs)
    assert (done.returncode, done.stderr) == (2, b"")
    assert done.stdout == alone("text", programs, "--statistics", "--lang", lang)
    for form, file in into.items():
        assert (programs / file).read_bytes() == alone(form, programs, "--statistics", "--lang", lang), form
    assert len(list((programs / "out").iterdir())) == len(FORMATS)


@pytest.mark.deeper
def test_outputs_over_all_cores_are_those_of_runs_of_their_own(tmp_path: Path) -> None:
    (tmp_path / "programs").mkdir()
    for number in range(210):
        (tmp_path / "programs" / f"{number:03}.3b").write_text("" if number % 30 else WRONG_AXIS, "ascii")
    both = run_command("check", "programs", "--format=json", "--format=sarif=a/b/check.sarif", cwd=tmp_path)
    sarif = run_command("check", "programs", "--format=sarif", cwd=tmp_path)
    assert (both.returncode, sarif.returncode) == (2, 2)
    assert (tmp_path / "a" / "b" / "check.sarif").read_bytes() == sarif.stdout
    assert both.stdout == alone("json", tmp_path)


def test_no_more_than_one_result_is_held_for_all_outputs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    held: dict[str, list[int]] = {"text": [], "json": []}
    (tmp_path / "a.3b").write_text(WRONG_AXIS, "ascii")
    job = Job("a.3b", tmp_path / "a.3b", CheckSettings())

    def counting(form: str) -> Callable[..., Iterator[str]]:
        def rendered(results: Iterator[CheckResult], options: Options) -> Iterator[str]:
            for _ in results:
                held[form].append(sum(isinstance(one, CheckResult) for one in gc.get_objects()))
                yield ""

        return rendered

    for form in held:
        monkeypatch.setattr(f"sim.show.findings.{form}.render", counting(form))
    write((check_file(job) for _ in range(5)), [Output(form, tmp_path / form) for form in held], Options())
    assert [len(of) for of in held.values()] == [5, 5]
    assert max(max(of) for of in held.values()) <= 2  # that which was read last, and the one before it


def test_an_output_file_takes_the_place_of_stdout(programs: Path) -> None:
    for options in ((), ("--format", "junit")):
        done = run_inside("check", "programs", *options, "-o", "new/folder/found", cwd=programs)
        assert (done.returncode, done.stdout) == (2, b"")
        found = (programs / "new" / "folder" / "found").read_bytes()
        assert found == run_inside("check", "programs", *options, cwd=programs).stdout


def test_the_exit_code_does_not_depend_on_the_outputs(programs: Path) -> None:
    for name, code in {"sound.3b": 0, "wrong.3b": 1, "none.3b": 2}.items():
        for options in (("--format=json=a.json",), ("--format=json=a.json", "--format=text"), ("-o", "a.txt")):
            assert run_inside("check", f"programs/{name}", *options, cwd=programs).returncode == code


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["--format=text", "--format=json"], "text and json cannot go to one place"),
        (["--format=text", "--format=json", "-o", "x"], "text and json cannot go to one place"),
        (["--format=sarif=x", "--format=json=./x"], "x: two outputs cannot go into one file"),
        (["--format=sarif=x", "-o", "programs/../x", "--format=text"], "x: two outputs cannot go into one file"),
        (["--format=sarif=x", "-o", "y"], "--output-file has nothing to hold"),
        (["--format=xml"], "'xml' is not one of text, concise, json"),
        (["--format=xml=x"], "'xml' is not one of text, concise, json"),
        (["--format=sarif="], "'sarif=' lacks the name of a file"),
        (["-o", "programs/sound.3b"], "programs/sound.3b: is one of the programs"),
        (["--format=sarif=link"], "link: is one of the programs"),
        (["--write-baseline", "x", "-o", "./x"], "x: two outputs cannot go into one file"),
        (["--baseline", "known.json", "-o", "known.json"], "known.json: is read by this run"),
        (["--config", "drycut.toml", "--format=json=drycut.toml"], "drycut.toml: is read by this run"),
        (["-o", "programs"], "programs: is a folder"),
        (["-o", "programs/sound.3b/x"], "is a file; a folder of this name"),
    ],
)
def test_outputs_that_cannot_be_are_bad_use_before_any_work(
    programs: Path, options: list[str], complaint: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (programs / "link").symlink_to("programs/wrong.3b")
    (programs / "known.json").write_text('{"schema": "drycut.baseline/1", "files": {}}', "ascii")
    (programs / "drycut.toml").write_text("", "ascii")
    monkeypatch.setattr("sim.check.file_check.check_file", lambda job: pytest.fail("a file was checked"))
    before = {path: path.read_bytes() for path in programs.rglob("*") if path.is_file()}
    done = run_inside("check", "programs", *options, cwd=programs)
    assert (done.returncode, done.stdout) == (2, b"")
    assert complaint in done.stderr.decode()
    assert {path: path.read_bytes() for path in programs.rglob("*") if path.is_file()} == before


def test_no_output_file_is_left_where_one_cannot_be_written(programs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(results: object, options: object) -> Iterator[str]:
        yield "begun"
        raise OSError(28, "No space left on device")

    (programs / "check.sarif").write_text("of the run before", "ascii")
    monkeypatch.setattr("sim.show.findings.json.render", full)
    done = run_inside("check", "programs", "--format=sarif=check.sarif", "--format=json=check.json", cwd=programs)
    assert done.returncode == 2
    assert b"No space left on device" in done.stderr
    assert (programs / "check.sarif").read_text("ascii") == "of the run before"
    assert sorted(path.name for path in programs.iterdir()) == ["check.sarif", "programs"]


@pytest.mark.skipif(os.name == "nt", reason="a pipe whose reader is gone is told otherwise there")
def test_files_are_whole_where_the_reader_of_stdout_goes_away(programs: Path) -> None:
    command = [sys.executable, "-m", "drycut", "check", "programs", "--format=text", "--format=sarif=check.sarif"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1", "LC_ALL": "C.UTF-8"}
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=programs, env=environment, stdout=pipe, stderr=pipe) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()  # before anything is written
        err = process.stderr.read()
        assert process.wait(60) != 0
    assert b"Traceback" not in err
    assert (programs / "check.sarif").read_bytes() == alone("sarif", programs)
