"""``drycut check --watch`` as a process of its own, with real edits, each awaited for no longer than it may take."""

import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import pytest
from checking import SOUND, WRONG_AXIS
from command import run_inside
from places import ROOT

from sim.cli.check.watching import rest_s

_END = "ended, and no longer watching"
LONGEST_S = 60.0  # a loaded machine takes its time; a round takes some half a second


class Watcher:
    """The command; what it prints on stdout and stderr between two rests is a round."""

    def __init__(self, cwd: Path, *arguments: str) -> None:
        command = [sys.executable, "-m", "drycut", "check", *arguments, "--watch"]
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1", "LC_ALL": "C.UTF-8"}
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(
            command, cwd=cwd, env=environment, stdout=pipe, stderr=subprocess.STDOUT, text=True, encoding="utf-8"
        )
        assert self.process.stdout
        self._lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._read, args=(self.process.stdout,), daemon=True).start()

    def _read(self, stream: IO[str]) -> None:
        with stream:
            for line in stream:
                self._lines.put(line)
        self._lines.put(_END)

    def round(self) -> str:
        """All that is printed up to the line that says that it waits."""
        lines = [self._lines.get(timeout=LONGEST_S)]
        while "watching" not in lines[-1]:
            lines.append(self._lines.get(timeout=LONGEST_S))
        return "".join(lines)

    def end(self) -> tuple[int, str]:
        """Exit code after Ctrl-C, and what was printed since the last round."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(LONGEST_S)
        rest = []
        while (line := self._lines.get(timeout=LONGEST_S)) != _END:
            rest.append(line)
        return code, "".join(rest)


@pytest.fixture
def watcher(tmp_path: Path) -> Iterator[Watcher]:
    (tmp_path / "deep").mkdir()
    (tmp_path / "a.3b").write_text(SOUND, "ascii")
    (tmp_path / "notes.txt").write_text("x", "ascii")
    watcher = Watcher(tmp_path, ".", "**/*.?b", "a.3b", "--format=text", "--format=json=found.json")
    yield watcher
    if watcher.process.poll() is None:
        watcher.process.kill()
        watcher.process.wait()


@pytest.mark.deeper
@pytest.mark.skipif(os.name == "nt", reason="a process there is not sent Ctrl-C alone")
def test_each_settled_change_is_checked_once_until_ctrl_c(tmp_path: Path, watcher: Watcher) -> None:
    first = watcher.round()
    assert "a.3b: pass" in first
    assert first.endswith("watching for changes; Ctrl-C ends\n")
    assert "\033" not in first  # no terminal, so no screen to clear
    # A burst of edits is one change; a new file in a folder is one too, another file is none.
    for number in range(20):
        (tmp_path / "a.3b").write_text(SOUND[: 3 * number], "ascii")
    (tmp_path / "notes.txt").write_text("y", "ascii")
    (tmp_path / "a.3b").write_text(WRONG_AXIS, "ascii")
    (tmp_path / "deep" / "c.4b").write_text(SOUND, "ascii")
    second = watcher.round()
    assert "a.3b: fail: 1 error" in second
    assert "2 files: 1 pass, 1 fail" in second
    assert '"verdict": "fail"' in (tmp_path / "found.json").read_text("ascii")
    # What is gone, and what is no program, is told, and the watch goes on.
    (tmp_path / "a.3b").unlink()
    (tmp_path / "deep" / "c.4b").write_bytes(b"\0\1half")
    third = watcher.round()
    assert "a.3b: error[3B100]" in third
    assert "deep/c.4b: error[3B100]" in third
    (tmp_path / "deep" / "c.4b").unlink()
    assert "no program there" in watcher.round()
    (tmp_path / "a.new").write_text(SOUND, "ascii")
    (tmp_path / "a.new").replace(tmp_path / "b2.3b")
    assert "2 files: 1 pass, 1 fail" in watcher.round()
    (tmp_path / "drycut.toml").write_text('ignore = ["3B100"]\nselect = ["3B9"]\n', "ascii")
    assert "no code begins with '3B9'" in watcher.round()
    (tmp_path / "drycut.toml").write_text('ignore = ["3B102"]\n', "ascii")
    assert "2 files: 1 pass, 1 fail" in watcher.round()
    code, rest = watcher.end()
    assert (code, rest.strip()) == (130, "")


@pytest.mark.skipif(os.name == "nt", reason="a terminal there is no file")
def test_a_terminal_is_cleared_before_each_check(tmp_path: Path) -> None:
    import pty

    (tmp_path / "a.3b").write_text(SOUND, "ascii")
    ours, theirs = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "LC_ALL": "C.UTF-8", "TERM": "xterm", "NO_COLOR": "1"}
    command = [sys.executable, "-m", "drycut", "check", "a.3b", "--watch"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=theirs, stderr=theirs) as process:
        shown = b""
        try:
            while b"watching" not in shown:
                shown += os.read(ours, 1024)
            process.send_signal(signal.SIGINT)
            assert process.wait(LONGEST_S) == 130
        finally:  # where Ctrl-C is ignored, as beneath nohup, it would go on for ever
            process.kill()
    for end in (ours, theirs):
        os.close(end)
    assert shown.startswith(b"\x1b[2J\x1b[1;1Ha.3b: pass")


def test_looks_take_a_hundredth_of_the_time_up_to_some_seconds() -> None:
    assert [rest_s(look) for look in (0.0, 0.001, 0.02, 5.0)] == [0.3, 0.3, 2.0, 3.0]


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (["-", "--watch"], "--watch looks at files"),
        (["a.3b", "--watch", "--fix"], "--fix and --watch cannot be done in one run"),
        (["a.3b", "--watch", "--diff"], "--diff and --watch cannot be done in one run"),
        (["a.3b", "--watch", "--write-baseline", "known.json"], "--write-baseline has no place beside it"),
        (["a.3b", "--watch", "-o", "a.3b"], "a.3b: is one of the programs"),
        (["none", "--watch"], "none: no program there"),
        (["a.3b", "--watch", "--select", "X"], "no code begins with 'X'"),
    ],
)
def test_what_cannot_be_watched_is_bad_use(tmp_path: Path, options: list[str], complaint: str) -> None:
    (tmp_path / "none").mkdir()
    (tmp_path / "a.3b").write_text(SOUND, "ascii")
    done = run_inside("check", *options, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert complaint in done.stderr.decode()
