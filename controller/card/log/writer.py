"""The log of a card: every call with its time, the coordinate status after it, arguments and answer, as text.

The first line names the format, the second holds the settings as JSON, the last how the card ended::

    drycut card log 1
    settings {"axes": 4, "cards": 1, …}
    0.0                      2001 GT_Open(65535) = 0
    2e-05                    2001 GT_SetSynVel(1.5) = 0
    …
    end {"t_s": 4e-05, "status": "2001", "places": [[0, 0, 0, 0]], "pulses": null}

Time is in seconds, the status in hexadecimal. Numbers stand in their shortest form that reads back the same.

Settings of the card as one line of JSON, and back; what is infinite is the text ``inf`` or ``-inf``.

They are read from any table of keys and values too, such as that of a file of TOML.
"""

import contextlib
import json
import math
import operator
from dataclasses import asdict, fields
from typing import Any, TextIO

from controller.card.calls.base import Logged
from controller.card.core.settings import CardSettings, Switches
from controller.card.ge import GECard
from controller.stepping.pulses import Pulses


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
