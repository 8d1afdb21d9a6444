"""Settings of the card as one line of JSON, and back; what is infinite is the text ``inf`` or ``-inf``.

They are read from any table of keys and values too, such as that of a file of TOML.
"""

import json
import math
from dataclasses import asdict, fields
from typing import Any

from controller.card.core.settings import CardSettings, Switches


def settings_text(settings: CardSettings) -> str:
    """The settings as JSON."""
    return json.dumps(_written(asdict(settings)), allow_nan=False)


def settings_from(text: str) -> CardSettings:
    """The settings of a JSON text. ValueError where they are none; keys that are left out take their defaults."""
    return settings_of(json.loads(text))


def settings_of(told: Any) -> CardSettings:
    """The settings of a table. ValueError where they are none; keys that are left out take their defaults."""
    given = _table(told, CardSettings, "settings")
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
