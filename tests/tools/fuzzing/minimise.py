"""An input that breaks a promise made shorter, as long as it still breaks the same one (delta debugging, ddmin)."""

import re
import time
from collections.abc import Callable, Sequence
from itertools import islice
from typing import TypeVar

from fuzzing.pool import Pool
from fuzzing.target import Input
from fuzzing.worker import Failure, Task

MOST_TRIES = 600
MOST_S = 120.0
_WALL_S = 10.0
_Unit = TypeVar("_Unit", bytes, str)


def kind_of(promise: str) -> str:
    """What two broken promises have in common where only numbers and quoted texts are different."""
    return re.sub(r"\d+|'[^']*'|\"[^\"]*\"", "*", promise)


def minimised(failure: Failure) -> Input:
    """The shortest input found that breaks the same promise: first by lines, then by bytes; words of a command."""
    data = failure.target.input(failure.seed, failure.number)
    until = time.monotonic() + MOST_S
    with Pool(1) as pool:

        def breaks(tried: Input) -> bool:
            if time.monotonic() > until:
                return False
            task = Task(failure.target, failure.seed, failure.number, failure.number + 1, tried, _WALL_S)
            found = [told for told in pool.run([task]) if isinstance(told, Failure)]
            return any(kind_of(told.promise) == kind_of(failure.promise) for told in found)

        if isinstance(data, tuple):
            return tuple(shortest(data, lambda words: breaks(tuple(words))))
        lines = shortest(data.splitlines(keepends=True), lambda units: breaks(b"".join(units)))
        single = [bytes([byte]) for byte in b"".join(lines)]
        return b"".join(shortest(single, lambda units: breaks(b"".join(units))))


def shortest(units: Sequence[_Unit], breaks: Callable[[Sequence[_Unit]], bool]) -> Sequence[_Unit]:
    """A part of the units that still breaks, of which no single one can be left out; or what the tries led to."""
    parts, tries = 2, iter(range(MOST_TRIES))
    while len(units) > 1:
        size = -(-len(units) // parts)
        shorter = ([*units[:at], *units[at + size :]] for at in range(0, len(units), size))
        allowed = (one for _, one in zip(islice(tries, len(units) + 1), shorter, strict=False))
        found = next((one for one in allowed if breaks(one)), None)
        if found is not None:
            units, parts = found, max(parts - 1, 2)
        elif size == 1 or next(tries, None) is None:
            break
        else:
            parts = min(2 * parts, len(units))
    return units
