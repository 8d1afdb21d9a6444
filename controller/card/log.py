"""The log of a card: written, read, and replayed call by call. A `Logged` call is a line of it.

It holds every call with its time, the coordinate status after it, arguments and answer, as text. The first line names
the format, the second holds the settings as JSON, the last how the card ended::

    drycut card log 1
    settings {"axes": 4, "cards": 1, …}
    0.0                      2001 GT_Open(65535) = 0
    2e-05                    2001 GT_SetSynVel(1.5) = 0
    …
    end {"t_s": 4e-05, "status": "2001", "places": [[0, 0, 0, 0]], "pulses": null}

Time is in seconds, the status in hexadecimal. Numbers stand in their shortest form that reads back the same.

Settings of the card as one line of JSON, and back; what is infinite is the text ``inf`` or ``-inf``.
They are read from any table of keys and values too, such as that of a file of TOML.

Lines are read by taking their calls apart by hand: nothing of a log is ever run but those calls. Replayed, the same
calls come at the same simulated times to a card of the same settings, and what it answers is compared.
"""

import ast
import contextlib
import functools
import inspect
import json
import math
import operator
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, NamedTuple, TextIO

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings, Switches
from controller.card.ge import GECard
from controller.stepping.pulses import Pulses
from parser.files import read_text
from parser.findings.errors import DrycutError


def settings_text(settings: CardSettings) -> str:
    """The settings as JSON."""
    return json.dumps(_written(asdict(settings)), allow_nan=False)


def settings_from(text: str) -> CardSettings:
    """The settings of a JSON text. ValueError where they are none; keys that are left out take their defaults."""
    return settings_of(json.loads(text))


def settings_of(value: Any) -> CardSettings:
    """The settings of a table. ValueError where they are none; keys that are left out take their defaults."""
    given = _table(value, CardSettings, "settings")
    switches = given.get("switches", [])
    if not isinstance(switches, list):
        raise ValueError("switches are a list with a table for each axis")
    return CardSettings(**{**given, "switches": tuple(_switches(entry) for entry in switches)})


def _switches(entry: Any) -> Switches:
    given = _table(entry, Switches, "switches")
    home = given.pop("home", [math.inf, math.inf])
    if not isinstance(home, list) or len(home) != 2 or not {_kind(place) for place in home} <= {int, float}:
        raise ValueError(f"home is two places, not {home!r}")
    return Switches(**given, home=(_read(home[0]), _read(home[1])))


def _table(value: Any, kind: type, what: str) -> dict[str, Any]:
    """The value, a table with keys of a dataclass, numbers where its defaults are numbers."""
    if not isinstance(value, dict):
        raise ValueError(f"{what} are a table of keys and values, not {value!r}")
    defaults = {key.name: key.default for key in fields(kind)}
    if unknown := sorted(set(value) - set(defaults)):
        raise ValueError(f"{what} have no key {unknown[0]!r}")
    for key, entry in value.items():
        wanted = _kind(defaults[key])
        if wanted is not None and not (_kind(entry) is wanted or (wanted is float and _kind(entry) is int)):
            raise ValueError(f"{key} is of kind {wanted.__name__}, not {entry!r}")
    return {key: _read(entry) for key, entry in value.items()}


def _kind(value: Any) -> type | None:
    """Of a single value: bool, int or float; None of anything else."""
    if value in ("inf", "-inf"):
        return float
    return type(value) if isinstance(value, bool | int | float) else None


def _read(value: Any) -> Any:
    return float(value) if value in ("inf", "-inf") else value


def _written(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _written(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_written(entry) for entry in value]
    return str(value) if isinstance(value, float) and math.isinf(value) else value


FORMAT = "drycut card log 1"
_PLAIN = frozenset((int, float, str, bool, type(None)))


class CardLog:
    """Listener of a card (`on_call`) that writes its log; `count` hears its pulses.

    Parameters
    ----------
    stream
        Where to; it stays open.
    settings
        Those of the card.
    """

    def __init__(self, stream: TextIO, settings: CardSettings) -> None:
        self._stream = stream
        self._pulses: int | None = None
        stream.write(f"{FORMAT}\nsettings {settings_text(settings)}\n")

    def __call__(self, call: Logged) -> None:
        """Write one call."""
        self._stream.write(f"{call_text(call)}\n")

    def count(self, pulses: Pulses) -> None:
        """Count pulses that the card handed out, for the end of the log."""
        self._pulses = (self._pulses or 0) + len(pulses.t_s)

    def close(self, card: GECard) -> None:
        """Write how the card ended."""
        places = card.places  # hands out the pulses that are due
        self._stream.write(f"{end_text(card, places, self._pulses)}\n")


def call_text(call: Logged) -> str:
    """Line of one call, without its end."""
    t_s, name, arguments, answer, status = call
    return f"{t_s!r:<24} {status:04x} {name}({_inner(arguments)}) = {_value(answer)}"


def end_text(card: GECard, places: list[list[int]], pulses: int | None) -> str:
    """Line of the end: time, coordinate status, places of the axes of each card, number of pulses if known."""
    end = {"t_s": card.time_s, "status": f"{card.status:04x}", "places": places, "pulses": pulses}
    return f"end {json.dumps(end)}"


def _inner(arguments: tuple[Any, ...]) -> str:
    text = repr(arguments if _PLAIN.issuperset(map(type, arguments)) else plain(arguments))
    return text[1:-2] if len(arguments) == 1 else text[1:-1]


def _value(answer: Any) -> str:
    return repr(answer if type(answer) in _PLAIN else plain(answer))


def plain(value: Any) -> Any:
    """The value as tuples of built-in numbers and texts; None where it is neither."""
    if isinstance(value, tuple | list):
        return tuple(plain(entry) for entry in value)
    if type(value) in _PLAIN:
        return value
    if isinstance(value, str | bytes | bytearray):
        return str(value)
    for kind in (operator.index, float):
        with contextlib.suppress(TypeError, ValueError, OverflowError):
            return kind(value)
    return None


_CALL = re.compile(r"(\S+) +([0-9a-f]{4,8}) ([A-Za-z]\w*)\((.*)\) = (.*)")
_NAMES = {"inf": math.inf, "nan": math.nan}
LONGEST_S = 1e6
"""Of a session: 11 days. What the axes still have to do behind it is waited for as long."""


class CardLogError(DrycutError, ValueError):
    """A log of a card that cannot be read; names the file and, where one is at fault, the line."""


class Damaged(DrycutError, ValueError):  # noqa: N818 - becomes a `CardLogError` where file and line are known
    """A line that is no line of a log."""


class End(NamedTuple):
    """How the card ended: time, coordinate status, places of the axes of each card, number of pulses if known."""

    t_s: float
    status: str
    places: list[list[int]]
    pulses: int | None


def check_format(line: str) -> None:
    """Damaged where the first line is not that of a log."""
    if line != FORMAT:
        raise Damaged("log-of-another-format", format=FORMAT, found=line[:40])


def settings_of_line(line: str) -> CardSettings:
    """Settings of the card from the second line. Damaged where it holds none."""
    if not line.startswith("settings "):
        raise Damaged("log-without-settings")
    try:
        return settings_from(line.removeprefix("settings "))
    except json.JSONDecodeError as error:
        raise Damaged("log-settings-no-json", why=str(error)) from None
    except RecursionError:
        raise Damaged("log-settings-nested") from None
    except ValueError as error:
        raise Damaged("quoted", text=str(error)) from None


def call_of(line: str) -> Logged:
    """The call of a line. Damaged where it holds none."""
    found = _CALL.fullmatch(line)
    if found is None:
        raise Damaged("log-no-call")
    t_s, status, name, arguments, answer = found.groups()
    return Logged(
        time_of(t_s),
        name,
        _value_of_text(f"({arguments},)" if arguments else "()"),
        _value_of_text(answer),
        int(status, 16),
    )


def end_of(line: str) -> End:
    """The end of a log. Damaged where the line is none."""
    try:
        entry = json.loads(line.removeprefix("end "))
        return End(**entry)
    except (ValueError, TypeError, RecursionError):
        raise Damaged("log-end-damaged") from None


def time_of(text: str) -> float:
    """The time of a call, s. Damaged for what is no number, or lies beyond any session."""
    try:
        t_s = float(text)
    except ValueError:
        raise Damaged("log-time-no-number", found=text[:40]) from None
    if not 0.0 <= t_s <= LONGEST_S:
        raise Damaged("log-time-out-of-bounds", most_s=LONGEST_S, found=text[:40])
    return t_s


def _value_of_text(text: str) -> Any:
    try:
        if text.isdecimal():
            return int(text)
        return _value_of_node(ast.parse(text.strip(), mode="eval").body)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise Damaged("log-no-value", found=text[:40]) from None


def _value_of_node(node: ast.expr) -> Any:
    match node:
        case ast.Constant(value=int() | float() | str() | None as value):
            return value
        case ast.Tuple(elts=entries):
            return tuple(_value_of_node(entry) for entry in entries)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_number(_value_of_node(operand))
        case ast.Name(id=name) if name in _NAMES:
            return _NAMES[name]
    raise ValueError("neither number nor text nor tuple")


def _number(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError("not a number")
    return value


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
        settings: CardSettings = self._placed(*self._line(), settings_of_line)
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
