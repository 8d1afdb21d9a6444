"""A program started against the card's library, how it ended, and its log as events.

The log of a program's card as events: what it told the card, and in one event all that it asked until the next.

A program asks thousands of times whether the axes have come to rest; what it asks changes nothing.
"""

import contextlib
import os
import re
import signal
import subprocess
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, NamedTuple, TypeAlias

from controller.card.abi.environment import CALL_S, CARD, LOG
from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings
from controller.card.log import CardLogError, Damaged, call_of, check_format, settings_of_line, time_of
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


_HEAD: Final = 2
"""Lines before the first call: the format, and the settings."""
_LINE: Final = re.compile(r"(\S+) +[0-9a-f]{4,8} ((\w+)\(.*\)) = (\(?(-?\d+)\b.*)")
_QUESTIONS: Final = frozenset(
    ("GT_ExInpt", "GT_EncPos", "GT_EncVel", "GT_ChkVrsn", "GT_SrvGrdErr")
)  # and all whose names begin with GT_Get
_ALWAYS_ANSWERED: Final = "GT_GetCurrentCardNo"
"""Its answer is a number, and no code."""


class ClientCall(NamedTuple):
    """A call that may change something, a question that was refused, or a sleep; with its line in the log, from 1."""

    line: int
    call: Logged
    is_question: bool = False

    @property
    def answered(self) -> int:
        """What it was answered; 0 of a sleep."""
        answer = self.call.answer
        code = answer[0] if isinstance(answer, tuple) else answer
        return code if isinstance(code, int) else 0

    @property
    def is_sleep(self) -> bool:
        """Whether the program only slept."""
        return self.call.name == "sleep"


class Times(NamedTuple):
    """How often something was asked, and when last, s."""

    often: int
    last_s: float


@dataclass(slots=True)
class Questions:
    """All that was asked in a row and answered, by how it is written, such as ``GT_GetSts(1)``; its first line."""

    line: int
    t_s: float
    calls: dict[str, Times] = field(default_factory=dict)

    def add(self, text: str, t_s: float) -> None:
        """Count a question."""
        before = self.calls.get(text)
        self.calls[text] = Times((before.often if before else 0) + 1, t_s)

    @property
    def count(self) -> int:
        """Questions in all."""
        return sum(times.often for times in self.calls.values())


Event: TypeAlias = ClientCall | Questions


class Session(NamedTuple):
    """The log of a card.

    Attributes
    ----------
    settings
        Of the card.
    events
        In order.
    end_s
        When the last call was made.
    is_whole
        Whether the log has its last line: a program that was killed leaves none.
    """

    settings: CardSettings
    events: tuple[Event, ...]
    end_s: float
    is_whole: bool

    @property
    def calls(self) -> int:
        """Calls to the card, without sleeps."""
        told_events = (event.count if isinstance(event, Questions) else not event.is_sleep for event in self.events)
        return sum(map(int, told_events))


def session_of(name: str, lines: Iterable[str]) -> Session:
    """The session of a log with its line ends. CardLogError where a line is damaged, but for a last one cut short."""
    numbered = enumerate(lines, start=1)
    settings = _head(name, numbered)
    events: list[Event] = []
    end_s = 0.0
    for number, text in numbered:
        if text.startswith("end "):
            return Session(settings, tuple(events), end_s, is_whole=True)
        if not text.endswith("\n"):
            break
        end_s = _add(events, name, number, text.rstrip("\n"))
    return Session(settings, tuple(events), end_s, is_whole=False)


def _head(name: str, numbered: Iterator[tuple[int, str]]) -> CardSettings:
    try:
        check_format(next(numbered, (1, ""))[1].rstrip("\n"))
        return settings_of_line(next(numbered, (2, ""))[1].rstrip("\n"))
    except Damaged as error:
        raise CardLogError("in-file", file=name, message=error.message) from None


def _add(events: list[Event], name: str, number: int, text: str) -> float:
    """Add the call of a line; when it was made."""
    found = _LINE.fullmatch(text)
    asks = found is not None and (found[3].startswith("GT_Get") or found[3] in _QUESTIONS)
    try:
        if found is not None and asks and (found[5] == "0" or found[3] == _ALWAYS_ANSWERED):
            t_s = time_of(found[1])
            if not events or not isinstance(events[-1], Questions):
                events.append(Questions(number, t_s))
            events[-1].add(found[2], t_s)  # type: ignore[union-attr]  # the one just added
            return t_s
        call = call_of(text)
    except Damaged as error:
        raise CardLogError("in-line", file=name, line=number, message=error.message) from None
    events.append(ClientCall(number, call, is_question=asks))
    return call.t_s
