"""TOML files changed as trees of keys and values, and written again: wrong kinds, extreme values, unknown keys."""

import copy
import datetime
import json
import math
import random
import tomllib
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from fuzzing.mutate import TEXTS, damaged

_HEX = 16**5000
"""A whole number of more digits than Python writes in decimal; files may have it in hexadecimal."""
_NUMBERS: tuple[Any, ...] = (
    *(
        0,
        1,
        -1,
        2,
        7,
        400,
        10**6,
        2**31,
        -(2**31),
        2**63 - 1,
        2**63,
        10**400,
        _HEX,
        0.0,
        -0.0,
        1e-300,
        5e-324,
        0.5,
        1.5,
        1e5,
    ),
    *(1e12, 1e300, -1e300, math.inf, -math.inf, math.nan, True, False),
)
_STRANGE: tuple[Any, ...] = (
    *(*_NUMBERS, [], {}, [[]], [{}], [0, "a"], [1.0, 2.0], [[1.0, 2.0], [3.0]], {"min": 1}, {"min": 2, "max": 1}),
    *({"a": {"b": {}}}, datetime.datetime(2026, 1, 1), datetime.date(1, 1, 1), datetime.time(23, 59)),
)
_DEEP = 40
_DEEPER = (200, 2000, 20_000)


def fuzzed_toml(rng: random.Random, seeds: Sequence[bytes], names: Sequence[str]) -> bytes:
    """One file: seeds are TOML, `names` the keys that some file may have."""
    seed = rng.choice(seeds)
    if rng.random() < 0.1:
        return damaged(rng, seed, seeds)
    tree = tomllib.loads(seed.decode())
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        change(rng, tree, seeds, names)
    written = toml_of(tree, rng)
    if rng.random() < 0.01:
        written += deep(rng)
    data = written.encode("utf-8", "surrogatepass")
    return damaged(rng, data, seeds) if rng.random() < 0.05 else data


def change(rng: random.Random, tree: dict[str, Any], seeds: Sequence[bytes], names: Sequence[str]) -> None:
    """One change at a place that is chosen by walking down the tree."""
    at: Any = tree
    while True:
        inner = [entry for entry in (at.values() if isinstance(at, dict) else at) if isinstance(entry, dict | list)]
        inner = [entry for entry in inner if entry]
        if not inner or rng.random() < 0.4:
            break
        at = rng.choice(inner)
    changes: tuple[Callable[[], None], ...] = (
        *[partial(_replace, rng, at)] * 5,
        *[partial(_add, rng, at, names)] * 2,
        partial(_remove, rng, at),
        partial(_graft, rng, at, seeds),
    )
    rng.choice(changes)()


def _keys(at: Any) -> list[Any]:
    return list(at) if isinstance(at, dict) else list(range(len(at)))


def _replace(rng: random.Random, at: Any) -> None:
    keys = _keys(at)
    if keys:
        key = rng.choice(keys)
        at[key] = _other(rng, at[key])


def _add(rng: random.Random, at: Any, names: Sequence[str]) -> None:
    value = _other(rng, rng.choice((1.0, "text", True, [1.0, 2.0])))
    if isinstance(at, dict):
        at[rng.choice(names) if rng.random() < 0.8 else rng.choice(TEXTS)] = value
    else:
        at.insert(rng.randint(0, len(at)), value if rng.random() < 0.5 or not at else rng.choice(at))


def _remove(rng: random.Random, at: Any) -> None:
    keys = _keys(at)
    if keys:
        del at[rng.choice(keys)]


def _graft(rng: random.Random, at: Any, seeds: Sequence[bytes]) -> None:
    """A table or value of another file, under its own name."""
    other = tomllib.loads(rng.choice(seeds).decode())
    if isinstance(at, dict) and other:
        key = rng.choice(list(other))
        at[key] = other[key]


def _other(rng: random.Random, value: Any) -> Any:
    """A value in place of another: near it, of its kind, or of none that fits."""
    what = rng.random()
    if what < 0.25:
        return copy.deepcopy(rng.choice(_STRANGE))
    if what < 0.3:
        return _nested(rng, value)
    if isinstance(value, bool):
        return not value
    if isinstance(value, list) and value:
        changed = list(value)
        at = rng.randrange(len(changed))
        changed[at] = _other(rng, changed[at])
        return rng.choice((changed, changed[:at], changed * rng.choice((2, 50)), changed[::-1]))
    return copy.deepcopy(rng.choice(_alike(rng, value)))


def _alike(rng: random.Random, value: Any) -> Sequence[Any]:
    """Values of the same kind as a single one."""
    if isinstance(value, bool):
        return (not value,)
    if isinstance(value, str):
        return *TEXTS, value.upper(), value[:-1], value + rng.choice(TEXTS), value * 2
    if not isinstance(value, int | float) or abs(value) > 1e300:
        return _STRANGE
    scaled = value * rng.choice((1e-6, 0.1, 1.001, 1e3))
    return value * 2, value // 3, -value, value + 1, scaled, rng.uniform(-10, 10), *_NUMBERS


def _nested(rng: random.Random, value: Any) -> Any:
    for _ in range(rng.randint(1, _DEEP)):
        value = [value] if rng.random() < 0.5 else {"a": value}
    return value


def deep(rng: random.Random) -> str:
    """A value nested deeper than any reader goes."""
    depth = rng.choice(_DEEPER)
    return rng.choice((f"\nx = {'[' * depth}{']' * depth}\n", f"\n[{'a.' * depth}b]\n", f"\nx = {'{a=' * depth}1\n"))


def toml_of(tree: dict[str, Any], rng: random.Random) -> str:
    """A tree as TOML; what may be a table of its own stands in one line now and then."""
    lines = list[str]()
    tables = list[str]()
    for key, value in tree.items():
        inline = rng.random() < 0.1
        if isinstance(value, dict) and not inline:
            tables.append(f"[{_text(key)}]\n" + "".join(_line(*entry) for entry in value.items()))
        elif isinstance(value, list) and value and all(isinstance(one, dict) for one in value) and not inline:
            of_one = [f"[[{_text(key)}]]\n" + "".join(_line(*entry) for entry in one.items()) for one in value]
            tables += of_one
        else:
            lines.append(_line(key, value))
    return "".join([*lines, *tables])


def _line(key: str, value: Any) -> str:
    return f"{_text(key)} = {_value(value)}\n"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_text(key)} = {_value(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, int):
        return hex(value) if abs(value) > 10**4000 else str(value)
    if isinstance(value, float):
        return repr(value)
    return value.isoformat() if isinstance(value, datetime.date | datetime.time) else _text(str(value))


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f").replace("\x85", "\\u0085")
