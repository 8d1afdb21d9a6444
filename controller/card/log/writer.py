"""The log of a card: every call with its time, the coordinate status after it, arguments and answer, as text.

The first line names the format, the second holds the settings as JSON, the last how the card ended::

    drycut card log 1
    settings {"axes": 4, "cards": 1, …}
    0.0                      2001 GT_Open(65535) = 0
    2e-05                    2001 GT_SetSynVel(1.5) = 0
    …
    end {"t_s": 4e-05, "status": "2001", "places": [[0, 0, 0, 0]], "pulses": null}

Time is in seconds, the status in hexadecimal. Numbers stand in their shortest form that reads back the same.
"""

import contextlib
import json
import operator
from typing import Any, TextIO

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings
from controller.card.ge import GECard
from controller.card.log.settings_text import settings_text
from controller.stepping.pulses import Pulses

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
