"""A program started against the card's library, and how it ended."""

import contextlib
import os
import re
import signal
import subprocess
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from controller.card.abi.environment import CALL_S, CARD, LOG
from parser.findings.errors import DrycutError, FileUnreadableError
from parser.text.encoding import printable
from sim.clients.library import LIBRARY, SLEEP


class StartError(DrycutError, RuntimeError):
    """A program that cannot be started, or a library that is none; says why."""


class Wanted(NamedTuple):
    """How a program is to be started.

    Attributes
    ----------
    command
        Program and its arguments.
    library
        Folder of the card's library.
    card, call_s
        File of the card's settings, and time of a call, s; None for the usual ones.
    longest_s
        Real time after which it is stopped.
    """

    command: Sequence[str]
    library: Path
    card: Path | None
    call_s: float | None
    longest_s: float


class Ended(NamedTuple):
    """How a program ended.

    Attributes
    ----------
    exit_code
        None where it was killed.
    signal
        Name of the signal that killed it, such as ``SIGSEGV``; empty where none did.
    is_stopped
        Whether it was stopped because it ran for too long.
    """

    exit_code: int | None
    signal: str = ""
    is_stopped: bool = False


def started(wanted: Wanted, log: Path, *, out: int | None = None) -> Ended:
    """Start a program, wait for its end, and stop it with all that it started where it runs for too long.

    Its calls go to the file `log`. `out` is where its standard output goes; None for that of drycut. StartError where
    it cannot be started, FileUnreadableError where the library is not in its folder.
    """
    for name in (LIBRARY, SLEEP):
        if not (wanted.library / name).is_file():
            raise FileUnreadableError("no-libges-there", file=wanted.library / name)
    if re.search(r"[\s:;]", str(wanted.library.resolve())):  # the loader parts its lists there, and nothing hinders it
        raise StartError("library-folder-blank", folder=printable(str(wanted.library)))
    command = [_program(wanted.command[0]), *wanted.command[1:]]
    try:
        child = subprocess.Popen(  # noqa: S603 - the user's own program
            command, env=_environment(wanted, log), stdout=out, start_new_session=True
        )
    except OSError as error:
        why = error.strerror or str(error)
        raise StartError("not-startable", program=printable(wanted.command[0]), why=why) from None
    with _ended_with_us(child):
        return _waited(child, wanted.longest_s)


def _program(name: str) -> str:
    """A file of this folder is meant by its name alone, too; what is none is looked for as a shell does."""
    return str(Path(name).resolve()) if Path(name).is_file() else name


def _environment(wanted: Wanted, log: Path) -> dict[str, str]:
    library = wanted.library.resolve()
    variables = {CARD: str(wanted.card.resolve()) if wanted.card else "", LOG: str(log.resolve())}
    variables[CALL_S] = "" if wanted.call_s is None else repr(wanted.call_s)
    ours = {"LD_LIBRARY_PATH": str(library), "LD_PRELOAD": str(library / SLEEP)}
    joined = {name: ":".join(filter(None, (value, os.environ.get(name, "")))) for name, value in ours.items()}
    return {**os.environ, **joined, **variables}


def _waited(child: subprocess.Popen[bytes], longest_s: float) -> Ended:
    try:
        code = child.wait(longest_s)
    except subprocess.TimeoutExpired:
        _kill(child)
        child.wait()
        return Ended(None, is_stopped=True)
    if code >= 0:
        return Ended(code)
    return Ended(None, signal.Signals(-code).name if -code in set(signal.Signals) else f"signal {-code}")


@contextlib.contextmanager
def _ended_with_us(child: subprocess.Popen[bytes]) -> Iterator[None]:
    """Where we are stopped, so is the program; what it left behind goes with it."""
    try:
        yield
    finally:
        _kill(child)
        deadline = time.monotonic() + 1.0
        while child.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)


def _kill(child: subprocess.Popen[bytes]) -> None:
    """The program and all that it started: the session is its own."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(child.pid, signal.SIGKILL)
