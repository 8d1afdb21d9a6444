"""A shell completes words of the command: what it is handed, and how it looks in a terminal."""

import fcntl
import os
import pty
import re
import select
import shutil
import struct
import subprocess
import sys
import termios
import time
from pathlib import Path

import pytest
from command import run_command

SETUP = {
    "bash": 'eval "$(_DRYCUT_COMPLETE=bash_source drycut)"',
    "zsh": 'autoload -U compinit; compinit -u -D; eval "$(_DRYCUT_COMPLETE=zsh_source drycut)"',
    "fish": "_DRYCUT_COMPLETE=fish_source drycut | source",
}
SHELLS = {"bash": ["--norc", "-i"], "zsh": ["-f", "-i"], "fish": ["--no-config", "-i"]}
LONGEST_S = 20.0
STYLE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
OWN_TERMINAL = (
    "import fcntl, os, sys, termios;"
    "os.setsid(); fcntl.ioctl(0, termios.TIOCSCTTY, 0); os.execvp(sys.argv[1], sys.argv[1:])"
)


def offered(words: str, number: int, **environment: str) -> list[str]:
    """What bash is handed for the word of a number."""
    done = run_command(COMP_WORDS=words, COMP_CWORD=str(number), _DRYCUT_COMPLETE="bash_complete", **environment)
    assert (done.returncode, done.stderr) == (0, b"")
    return done.stdout.decode().splitlines()


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    ("words", "number", "found"),
    [
        ("drycut ru", 1, ["plain,run"]),
        ("drycut run --interpolator ", 3, ["plain,point-by-point", "plain,card"]),
        ("drycut run --machine dk774", 3, ["plain,dk7740", "file,dk774"]),
        ("drycut run pa", 2, ["file,pa"]),
        ("drycut check pa", 2, ["file,pa"]),
        ("drycut draw pa", 2, ["file,pa"]),
        ("drycut explain 3b204", 2, ["plain,3B204"]),
        ("drycut explain repo", 2, ["plain,report"]),
    ],
)
def test_words_of_each_kind_are_offered(words: str, number: int, found: list[str]) -> None:
    assert offered(words, number) == found


@pytest.mark.parametrize("shell", SHELLS)
def test_a_script_is_printed_for_each_shell(shell: str) -> None:
    done = run_command(_DRYCUT_COMPLETE=f"{shell}_source")
    assert (done.returncode, done.stderr) == (0, b"")
    assert f"_DRYCUT_COMPLETE={shell}_complete" in done.stdout.decode()


def test_fish_is_handed_a_word_and_what_it_is_for_apart() -> None:
    done = run_command(COMP_WORDS="drycut --lang zh ru", COMP_CWORD="ru", _DRYCUT_COMPLETE="fish_complete")
    assert done.stdout.decode().startswith("plain,run\t")


class Terminal:
    """A shell in a terminal of its own."""

    def __init__(self, command: list[str], folder: Path) -> None:
        self._own, other = pty.openpty()
        fcntl.ioctl(other, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "TERM": "xterm", "HOME": str(folder), "PS1": "$ "}
        whole = [sys.executable, "-c", OWN_TERMINAL, *command]
        self._process = subprocess.Popen(whole, stdin=other, stdout=other, stderr=other, cwd=folder, env=environment)
        os.close(other)
        self._shown = ""

    def types(self, text: str) -> None:
        os.write(self._own, text.encode())

    def waits_for(self, text: str) -> None:
        """Read until a text is shown, behind all that was waited for before."""
        end_s = time.monotonic() + LONGEST_S
        while text not in self._shown:
            ready, _, _ = select.select([self._own], [], [], max(end_s - time.monotonic(), 0.0))
            assert ready, self._shown
            self._shown = STYLE.sub("", self._shown + os.read(self._own, 4096).decode("utf-8", "replace"))
        self._shown = self._shown.split(text, 1)[1]

    def end(self) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._own)


@pytest.mark.parametrize("shell", SHELLS)
def test_a_word_is_completed_in_a_terminal(shell: str, tmp_path: Path) -> None:
    program = shutil.which(shell) or pytest.skip(f"there is no {shell}")
    (tmp_path / "part.3b").write_text("B9B0B9GXL1\nDD\n")
    terminal = Terminal([program, *SHELLS[shell]], tmp_path)
    try:
        terminal.types(f"{SETUP[shell]}\recho rea''dy\r")
        terminal.waits_for("ready")
        terminal.types("drycut chec\t")
        terminal.waits_for("check ")
        terminal.types("pa\t")
        terminal.waits_for("part.3b ")
        terminal.types("\r")
        terminal.waits_for("part.3b: pass")
    finally:
        terminal.end()
