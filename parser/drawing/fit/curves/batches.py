"""Curves fitted many at a time; where some of them cannot be fitted, the others are."""

from collections.abc import Callable, Sequence

import numpy as np

from parser.drawing.fit.fitted import Fitted, no_curves
from parser.geometry.curves import Ints, joined

_AT_ONCE = 1_000  # curves: lengths along all of them are then told apart, and arrays stay small


def in_batches(number: int, fitted: Callable[[Ints], Fitted]) -> tuple[Fitted, Ints]:
    """What `fitted` makes of all curves, by their rows, and the rows that it has none for.

    Where it raises ValueError for several curves, each half of them is tried.
    """
    todo = [np.arange(first, min(first + _AT_ONCE, number)) for first in range(0, number, _AT_ONCE)][::-1]
    parts: list[tuple[Fitted, Ints]] = []
    refused: list[int] = []
    while todo:
        rows = todo.pop()
        try:
            made = fitted(rows)
        except ValueError:
            if len(rows) == 1:
                refused.append(int(rows[0]))
            else:
                todo += [rows[len(rows) // 2 :], rows[: len(rows) // 2]]
            continue
        parts.append((made._replace(of=rows[made.of]), np.empty(0, dtype=np.int64)))
    return several(parts, np.array(refused, dtype=np.int64))


def several(parts: Sequence[tuple[Fitted, Ints]], refused: Ints) -> tuple[Fitted, Ints]:
    """Parts in one, by rows, with all that is refused."""
    curves = joined([no_curves(), *(made.curves for made, _ in parts)])
    of = np.concatenate([np.empty(0, dtype=np.int64), *(made.of for made, _ in parts)])
    order = np.argsort(of, kind="stable")
    most = max((made.max_um for made, _ in parts), default=0.0)
    return Fitted(curves.picked(order), of[order], most), np.sort(np.concatenate([refused, *(no for _, no in parts)]))
