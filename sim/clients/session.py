"""The log of a program's card as events: what it told the card, and in one event all that it asked until the next.

A program asks thousands of times whether the axes have come to rest; what it asks changes nothing.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final, NamedTuple, TypeAlias

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings
from controller.card.log import (
    CardLogError,
    Damaged,
    call_of,
    check_format,
    settings_of_line,
    time_of,
)

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
