"""Faults of drycut itself: exit code 3, a message for people, and the other files of a check are still checked."""

import os
import re
import shutil
import signal
import sys
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS
from command import run_inside

import sim.check.file_check
from parser.program import Program
from parser.text.places import cells
from sim.cli.faults import EXIT


def raising(error: BaseException, at: str = "") -> object:
    """`load_program` that raises an error at the file of a name, or at every file."""
    loaded = sim.check.file_check.load_program

    def load(data: bytes, name: str, *others: object) -> Program:
        if at in name:
            raise error
        return loaded(data, name, *others)

    return load


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Three programs, of which the last is wrong; what is kept of faults goes beside them."""
    (tmp_path / "kept").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "kept"))
    for name, text in {"a.3b": SOUND, "faulty\x1b.3b": SOUND, "wrong.3b": WRONG_AXIS}.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def kept(folder: Path) -> str:
    (path,) = (folder / "kept").iterdir()
    return path.read_text("utf-8")


@pytest.mark.parametrize("language", ["en_GB", "zh_CN"])
@pytest.mark.parametrize("error", [ZeroDivisionError("a\x1b[31m ##vso[b]"), RecursionError("deep"), MemoryError()])
def test_a_fault_is_told_for_people_and_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, language: str
) -> None:
    monkeypatch.setattr("sim.show.findings.pages.list_text", lambda language: (_ for _ in ()).throw(error))
    done = run_inside("explain", "--lang", "en", cwd=folder, LC_ALL=f"{language}.UTF-8")
    assert (done.returncode, done.stdout) == (EXIT, b"")
    told = done.stderr.decode()
    assert type(error).__name__ in told
    assert max(map(cells, told.splitlines())) <= 80
    assert "drycut explain --lang en" in told
    assert sys.version.split()[0] in told
    assert "Traceback" not in told
    assert "Traceback" in kept(folder)
    assert not re.search(r"\x1b|##vso\[", told + kept(folder))


def test_the_fault_of_one_file_leaves_the_others_checked(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.check.file_check.load_program", raising(ZeroDivisionError("boom"), "faulty"))
    done = run_inside("check", ".", cwd=folder)
    assert done.returncode == EXIT
    assert "faulty\ufffd.3b: incomplete" in done.stdout.decode()
    assert "a fault of drycut itself" in done.stdout.decode()
    assert "wrong.3b: fail: 1 error" in done.stdout.decode()
    assert "drycut: fault: faulty\ufffd.3b: ZeroDivisionError: boom\n" in done.stderr.decode()
    assert "ZeroDivisionError: boom" in kept(folder)


def test_a_fault_goes_before_all_else_that_an_exit_code_tells(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.check.file_check.load_program", raising(ZeroDivisionError("boom"), "faulty"))
    assert run_inside("check", ".", "none.3b", "--exit-zero", cwd=folder).returncode == EXIT


def test_where_nothing_can_be_kept_that_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(folder / "nowhere"))
    monkeypatch.setattr("sim.check.file_check.load_program", raising(ZeroDivisionError("boom")))
    done = run_inside("check", "a.3b", cwd=folder)
    assert done.returncode == EXIT
    assert "could not be written" in done.stderr.decode()


def test_ctrl_c_is_130(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.check.file_check.load_program", raising(KeyboardInterrupt()))
    done = run_inside("check", ".", cwd=folder)
    assert (done.returncode, done.stderr.strip()) == (130, b"")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="has no such signal, and starts its processes otherwise")
def test_a_process_that_dies_is_told_by_its_file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.check.file_check.PARALLEL_FROM", 2)
    monkeypatch.setattr("sim.check.parallel._FILES_A_TASK", 4)
    names = [f"{number}.3b" for number in range(10, 24)]
    for name in names:
        shutil.copy(folder / "wrong.3b", folder / name)
    check = sim.check.file_check.check_file

    def dying(job: sim.check.file_check.Job) -> sim.check.file_check.CheckResult:
        if job.name in {"15.3b", "23.3b"}:
            os.kill(os.getpid(), signal.SIGKILL)
        return check(job)

    monkeypatch.setattr("sim.check.file_check.check_file", dying)
    done = run_inside("check", *names, "--format", "concise", cwd=folder)
    assert done.returncode == EXIT
    found = {line.split(":")[0] for line in done.stdout.decode().splitlines() if "[3B204]" in line}
    assert set(names) - found == {"15.3b", "23.3b"}
    told = done.stderr.decode()
    assert told.count("drycut: fault: ") == 2
    assert "drycut: fault: 15.3b: its process ended at once" in told
