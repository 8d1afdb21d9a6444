"""The library at work in a program's process: its card, its clock, its log, and a Python function for each in C."""

import contextlib
import ctypes
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any, TextIO

from controller.card.abi.environment import CardEnvironment, Clock, SimulatedClock, WallClock
from controller.card.abi.table import Prototype, prototypes
from controller.card.abi.turns import Passed, Tasks, Turns
from controller.card.core.settings import CardSettings
from controller.card.ge import GECard
from controller.card.log import CardLog
from parser.findings.errors import FileUnreadableError, system_message
from parser.text.encoding import printable

_HOOK = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_short)
"""``void CCommandHandle(char *name, short code)``."""


class Library:
    """One card for all threads of a program.

    Parameters
    ----------
    wanted
        What the environment asks for.
    tasks, passed
        As `Turns` has them.
    """

    def __init__(self, wanted: CardEnvironment, tasks: Tasks, passed: Passed) -> None:
        self._stream = _opened(wanted.log) if wanted.log else None
        self._log = _begun(self._stream, wanted.settings) if self._stream else None
        self.card = GECard(wanted.settings, on_call=self._log)
        self.clock: Clock = (
            SimulatedClock(self.card, Turns(tasks, passed))
            if wanted.times is None
            else WallClock(self.card, wanted.times)
        )
        self._told: set[str] = set()

    def functions(self) -> tuple[Callable[..., Any], ...]:
        """Those of the card in the order of the table; a sleep, s; the card's time, ms; the end.

        They raise nothing: one that cannot be answered gives None.
        """
        others = (self._sleep, self._milliseconds, self._end)
        return (*(self._guarded(prototype.name, self._of_card(prototype)) for prototype in prototypes()), *others)

    def _of_card(self, prototype: Prototype) -> Callable[..., Any]:
        function: Callable[..., Any] = getattr(self.card, prototype.name)
        takes_hook = any(parameter.letter == "K" for parameter in prototype.parameters)
        return (lambda place: function(_hook(place))) if takes_hook else function

    def _guarded(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        begin, end = self.clock.begin, self.clock.end

        def called(*given: Any) -> Any:
            try:
                begin()
                try:
                    return function(*given)
                finally:
                    end()
            except Exception as error:
                self._fault(name, error)
                return None

        return called

    def _sleep(self, seconds: float) -> bool | None:
        try:
            self.clock.sleep(seconds)
        except Exception as error:
            self._fault("sleep", error)
            return None
        return True

    def _milliseconds(self) -> int:
        return round(self.card.time_s * 1e3)

    def _end(self) -> None:
        """Write how the card ended; a thread that uses it still gets no answer then."""
        if self._log is None or self._stream is None:
            return
        try:
            self.clock.begin()
            self._log.close(self.card)
            self._stream.close()
        except Exception as error:
            self._fault("end", error)

    def _fault(self, name: str, error: Exception) -> None:
        """Tell once of each fault, on stderr, and where it is."""
        frame = traceback.extract_tb(error.__traceback__)[-1]
        text = (
            f"{name} cannot be answered: {type(error).__name__}: {error} ({Path(frame.filename).name}:{frame.lineno})"
        )
        if text not in self._told and sys.stderr is not None:
            self._told.add(text)
            print(f"drycut: error: {printable(text)}", file=sys.stderr, flush=True)


def _opened(path: Path) -> TextIO:
    """The file of a log, in which each line stands as soon as it is made. FileUnreadableError where it cannot be."""
    try:
        return path.open("w", encoding="utf-8", buffering=1)
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=path, why=system_message(error)) from None


def _begun(stream: TextIO, settings: CardSettings) -> CardLog:
    """A log in a file, which is closed where its head cannot be written. OSError then."""
    try:
        return CardLog(stream, settings)
    except OSError:
        with contextlib.suppress(OSError):
            stream.close()  # else Python complains of it once more when the process ends
        raise


def _hook(place: int) -> Callable[[str, int], None] | None:
    """A function of the program in C, by its place in memory."""
    if not place:
        return None
    in_c = _HOOK(place)
    return lambda name, code: in_c(name.encode(), code)
