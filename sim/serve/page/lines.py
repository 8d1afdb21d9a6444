"""Which lines of a text are others than in an earlier one."""

from collections.abc import Sequence
from difflib import SequenceMatcher
from itertools import takewhile
from typing import Any, Final

_MOST_COMPARED: Final = 2000
"""Lines between the first and the last change that are told apart; of more all count as changed."""
_MOST_PLACES: Final = 100
_MOST_LINES: Final = 40
"""Of one place, that are told."""


def changed_lines(before: str, after: str) -> dict[str, Any]:
    """The places where the lines of two texts differ, from the top; ``more`` are those beyond the first hundred.

    A place has ``line``, from 1, where it stands in the text after, what stood there and what stands there, and how
    many ``lines`` each of the two has: of long ones the first forty are told.
    """
    was, now = before.split("\n"), after.split("\n")
    places = [_place(was[a:b], now[c:d], c) for a, b, c, d in _changes(was, now)]
    return {"places": places[:_MOST_PLACES], "more": max(len(places) - _MOST_PLACES, 0)}


def _changes(was: Sequence[str], now: Sequence[str]) -> list[tuple[int, int, int, int]]:
    """First and past row before, first and past row after, of each change."""
    head = _same(was, now)
    tail = _same(was[head:][::-1], now[head:][::-1])
    inner, other = was[head : len(was) - tail], now[head : len(now) - tail]
    if max(len(inner), len(other)) > _MOST_COMPARED:  # the library takes a time that grows with their square
        return [(head, len(was) - tail, head, len(now) - tail)]
    found = SequenceMatcher(None, inner, other).get_opcodes()
    return [(head + a, head + b, head + c, head + d) for kind, a, b, c, d in found if kind != "equal"]


def _same(one: Sequence[str], other: Sequence[str]) -> int:
    """How many lines are the same at the begin."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _place(was: Sequence[str], now: Sequence[str], row: int) -> dict[str, Any]:
    return {
        "line": row + 1,
        "before": "\n".join(was[:_MOST_LINES]),
        "after": "\n".join(now[:_MOST_LINES]),
        "lines": [len(was), len(now)],
    }
