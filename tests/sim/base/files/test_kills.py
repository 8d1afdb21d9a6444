"""Runs that are killed, that meet in one folder, or that a signal ends: one whole set, and nothing left behind."""

import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import pytest
from command import HANGUP, run_inside
from places import ROOT
from swaps import NAMES, NEW, OLD, found, left, write

from parser import locks
from parser.findings.errors import FileUnreadableError
from sim.base.files import replace_file, scratch, staged, stages

TOOLS = ROOT / "tests" / "tools"
PART = "B500B0B500GXL1\nB500B0B2000GYNR1\nB500B0B500GXL3\nDD\n"
posix = pytest.mark.skipif(os.name == "nt", reason="Windows neither forks nor tells a process to end")


def counted(tool: str, *options: str) -> dict[str, int]:
    done = subprocess.run(
        [sys.executable, TOOLS / tool, *options],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=True,
    )
    counts: dict[str, int] = json.loads(done.stdout)
    return counts


@pytest.mark.alike(1)
@posix
@pytest.mark.parametrize(("way", "in_part"), [((), False), (("--moves",), True)])
def test_a_reader_finds_one_set_after_a_kill_at_any_step(way: tuple[str, ...], in_part: bool) -> None:
    """By moves files may be missing until the next run."""
    counts = counted("killed_swaps.py", "--random", "12", *way)
    assert counts["kills"] > 40
    assert counts["stages"] > 20, "the kills met no swap"
    assert 5 < counts["new"] < counts["kills"] - 5
    assert ("parts" in counts) == in_part
    assert not {"mixed", "not_whole_after_next_run", "left_after_next_run"} & counts.keys()


@posix
def test_runs_that_meet_in_one_folder_all_end_well(tmp_path: Path) -> None:
    counts = counted("meeting_runs.py")
    assert counts["failed"] == 0
    assert counts["reads"] > 100
    assert counts["missing"] == counts["mixed"] == counts["left"] == 0


def test_a_living_run_keeps_its_files_while_another_clears_up(tmp_path: Path) -> None:
    with staged(tmp_path, NAMES) as stage:
        (stage / "a.html").write_text("first")
        write(tmp_path, OLD)
        assert (stage / "a.html").exists()
    assert (found(tmp_path), left(tmp_path)) == ({"a.html": "first"}, [])


def test_a_folder_that_another_run_holds_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stages, "MOST_WAIT_S", 0.01)
    with stages.alone_in(tmp_path), pytest.raises(FileUnreadableError, match="another run has been changing its files"):
        write(tmp_path, OLD)
    assert (found(tmp_path), left(tmp_path)) == ({}, [])


def test_a_file_system_without_locks_is_written_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def lacking(folder: Path) -> int:
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr(locks, "_locked", lacking)
    write(tmp_path, OLD)
    write(tmp_path, NEW)
    assert (found(tmp_path), left(tmp_path)) == (NEW, [])


def test_what_is_not_a_stage_of_this_user_is_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    theirs = [tmp_path / ".drycut-mine", tmp_path / ".drycut-0123456789abcdef"]
    theirs[0].mkdir()
    theirs[1].write_text("a file")
    write(tmp_path, OLD)
    assert left(tmp_path) == [".drycut-mine"]
    assert theirs[1].read_text() == "a file"
    theirs[1].unlink()
    theirs[1].mkdir()
    if hasattr(os, "geteuid"):
        with monkeypatch.context() as patch:
            patch.setattr(os, "geteuid", lambda: 12345)
            write(tmp_path, NEW)
        assert theirs[1].exists()
    write(tmp_path, NEW)
    assert left(tmp_path) == [".drycut-mine"]


@pytest.mark.parametrize("names", [NAMES, ["a.html"]])
def test_a_run_whose_hidden_folder_was_deleted_is_refused(tmp_path: Path, names: Sequence[str]) -> None:
    write(tmp_path, OLD)
    swap = staged(tmp_path, names)
    shutil.rmtree(swap.__enter__())
    with pytest.raises(FileUnreadableError, match=r"\.drycut-[0-9a-f]+: cannot be written: No such file"):
        swap.__exit__(None, None, None)
    assert (found(tmp_path), left(tmp_path)) == (OLD, [])


def test_what_a_killed_mend_left_is_cleared_by_the_next(tmp_path: Path) -> None:
    (tmp_path / ".drycut-0123456789abcdef").mkdir()
    (tmp_path / ".drycut-0123456789abcdef" / "mended").write_text("half of i")
    (tmp_path / "part.3b").write_text("old")
    replace_file(tmp_path / "part.3b", b"old", b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["part.3b"]


def test_what_a_killed_run_left_among_temporary_files_is_cleared_by_the_next(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    (tmp_path / ".drycut-0123456789abcdef").mkdir()
    (tmp_path / ".drycut-0123456789abcdef" / "step_t_s.npy").write_text("of a killed run")
    with scratch() as folder:
        assert list(tmp_path.iterdir()) == [folder]
        assert os.name == "nt" or stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert list(tmp_path.iterdir()) == []


NOT_IGNORED = {  # as a terminal has them; under nohup, say, one of them is ignored
    signal.SIGTERM: signal.SIG_DFL,
    HANGUP: signal.SIG_DFL,
    signal.SIGINT: signal.default_int_handler,
}


@posix
@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGTERM, 128 + signal.SIGTERM), (HANGUP, 128 + HANGUP), (signal.SIGINT, 130)]
)
def test_a_run_that_is_told_to_end_takes_its_files_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals, code: int
) -> None:
    def told_to_end(*_: object) -> None:
        assert list((tmp_path / "out").glob(".drycut-*"))
        os.kill(os.getpid(), number)
        time.sleep(10)

    monkeypatch.setattr("sim.jobs.run_into.dry_run", told_to_end)
    (tmp_path / "part.3b").write_text(PART)
    before = signal.signal(number, NOT_IGNORED[number])
    try:
        done = run_inside("run", tmp_path / "part.3b", "-o", tmp_path / "out", "--card-log", tmp_path / "part.log")
    finally:
        signal.signal(number, before)
    assert (done.returncode, done.stdout) == (code, b"")
    assert [path.name for path in tmp_path.iterdir()] == ["part.3b"]


@posix
def test_a_signal_that_is_ignored_stays_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As under nohup."""
    before = signal.signal(HANGUP, signal.SIG_IGN)
    try:
        run_inside("--version")
        os.kill(os.getpid(), HANGUP)
    finally:
        signal.signal(HANGUP, before)
