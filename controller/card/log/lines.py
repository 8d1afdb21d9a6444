"""Lines of a log of a card, read: calls are taken apart by hand, and nothing of a log is ever run but those calls."""

import ast
import json
import math
import re
from typing import Any, NamedTuple

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings
from controller.card.log.writer import FORMAT, settings_from
from parser.findings.errors import DrycutError

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


def settings_of(line: str) -> CardSettings:
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
    return Logged(time_of(t_s), name, _value(f"({arguments},)" if arguments else "()"), _value(answer), int(status, 16))


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


def _value(text: str) -> Any:
    try:
        if text.isdecimal():
            return int(text)
        return _read(ast.parse(text.strip(), mode="eval").body)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        raise Damaged("log-no-value", found=text[:40]) from None


def _read(node: ast.expr) -> Any:
    match node:
        case ast.Constant(value=int() | float() | str() | None as value):
            return value
        case ast.Tuple(elts=entries):
            return tuple(_read(entry) for entry in entries)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_number(_read(operand))
        case ast.Name(id=name) if name in _NAMES:
            return _NAMES[name]
    raise ValueError("neither number nor text nor tuple")


def _number(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError("not a number")
    return value
