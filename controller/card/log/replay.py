"""A log of a card replayed: the same calls at the same simulated times on a card of the same settings, compared."""

import functools
import inspect
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings
from controller.card.ge import GECard
from controller.card.log.lines import CardLogError, Damaged, End, call_of, check_format, end_of, settings_of
from controller.card.log.writer import call_text, end_text
from controller.stepping.pulses import Pulses
from parser.files import read_text

OWN = ("set_input", "sleep", "step_block")
"""Calls in a log that are no functions of the library."""


class Difference(NamedTuple):
    """A line of the log, from 1, that the replay does not repeat."""

    line: int
    expected: str
    found: str


class Replay:
    """A log being replayed; iterate to replay it and get the differences.

    Parameters
    ----------
    name
        Of the log, in errors.
    lines
        Of the log, without their ends.

    Attributes
    ----------
    card
        The card as the calls so far left it.
    calls
        Number of calls so far.
    pulses
        Number of pulses that the card has handed out so far.
    """

    def __init__(self, name: str, lines: Iterable[str]) -> None:
        self._name, self._lines = name, enumerate(lines, start=1)
        self._heard: list[Logged] = []
        self._placed(*self._line(), check_format)
        settings: CardSettings = self._placed(*self._line(), settings_of)
        self.card = GECard(settings, on_pulses=self._count, on_call=self._heard.append)
        self.calls = self.pulses = 0

    def __iter__(self) -> Iterator[Difference]:
        """Replay the rest. CardLogError where a line is damaged or the end is missing."""
        while True:
            number, text = self._line()
            if text.startswith("end "):
                yield from self._ended(number, text)
                return
            yield from self._repeated(number, text)

    def _count(self, pulses: Pulses) -> None:
        self.pulses += len(pulses.t_s)

    def _line(self) -> tuple[int, str]:
        number, text = next(self._lines, (0, ""))
        if not number:
            raise CardLogError("log-breaks-off", name=self._name)
        return number, text

    def _placed(self, number: int, text: Any, read: Callable[[Any], Any]) -> Any:
        try:
            return read(text)
        except Damaged as error:
            raise CardLogError("in-line", file=self._name, line=number, message=error.message) from None

    def _repeated(self, number: int, text: str) -> Iterator[Difference]:
        expected = self._placed(number, text, call_of)
        self._placed(number, expected, functools.partial(call, self.card))
        found = self._heard.pop()
        self.calls += 1
        if found != expected:
            yield Difference(number, call_text(expected), call_text(found))

    def _ended(self, number: int, text: str) -> Iterator[Difference]:
        expected: End = self._placed(number, text, end_of)
        places = self.card.places  # hands out the pulses that are due
        found = end_text(self.card, places, None if expected.pulses is None else self.pulses)
        if expected != end_of(found):
            yield Difference(number, text, found)
        if any(more.strip() for _, more in self._lines):
            raise CardLogError("log-goes-on", name=self._name, line=number + 1)


def call(card: GECard, logged: Logged) -> None:
    """Make a logged call. Damaged where the card has none of that name, or not with these arguments."""
    if not _fits(logged.name, len(logged.arguments)):
        raise Damaged("no-card-function", name=logged.name, arguments=len(logged.arguments))
    try:
        getattr(card, logged.name)(*logged.arguments)
    except (TypeError, ValueError) as error:
        if logged.name not in OWN:
            raise
        raise Damaged("quoted", text=str(error)) from None


@functools.cache
def _fits(name: str, count: int) -> bool:
    if name not in OWN and not name.startswith("GT_"):
        return False
    function = getattr(GECard, name, None)
    if function is None:
        return False
    parameters = [*inspect.signature(function).parameters.values()][1:]
    needed = [parameter for parameter in parameters if parameter.default is inspect.Parameter.empty]
    return len(needed) <= count <= len(parameters)


def replay_file(path: Path) -> Replay:
    """Replay of a file. FileUnreadableError or CardLogError where it is none."""
    try:
        text = read_text(path)
    except UnicodeDecodeError:
        raise CardLogError("no-card-log", path=path) from None
    return Replay(str(path), text.splitlines())
