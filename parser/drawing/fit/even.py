"""As few arcs as can be along strings, each as full as the others: the best start, and the least tolerance for it."""

import numpy as np

from parser.drawing.fit.longest import Arcs, Runs, joined_arcs, longest_arcs
from parser.drawing.fit.strings import Strings
from parser.geometry.curves import Bools, Floats, Ints

_MOST_STARTS = 24
_STARTS_AT_ONCE = 3_000  # over all closed curves of a drawing: many have few starts each
_ROUNDS = 5  # the last arc then is as full as the others within a thirtieth


def best_starts(strings: Strings, runs: Runs, closed: Bools, tolerance_um: Floats) -> Runs:
    """The runs, those that are closed begun where the arcs are fewest, and of these where the last one is shortest."""
    at = np.flatnonzero(closed)
    if not len(at):
        return runs
    number = int(np.clip(_STARTS_AT_ONCE // len(at), 1, _MOST_STARTS))
    of = np.repeat(at, number)
    length = (runs.high - runs.low)[of]
    low = runs.low[of] + length * np.tile(np.arange(number) / number, len(at))
    tried = Runs(low, low + length, runs.first[of], runs.last[of])
    arcs = longest_arcs(strings, tried, tolerance_um[of])
    count, last = _counts(arcs, len(of))
    order = np.lexsort((last / length, count, of))
    best = order[np.searchsorted(of, at)]
    low, high = runs.low.copy(), runs.high.copy()
    low[at], high[at] = tried.low[best], tried.high[best]
    return runs._replace(low=low, high=high)


def even_arcs(strings: Strings, runs: Runs, tolerance_um: Floats) -> Arcs:
    """Arcs as few as a tolerance (r,) allows, of the least tolerance that needs no more of them.

    The length of an arc goes with the cube root of its tolerance, so that is what is halved.
    """
    best = longest_arcs(strings, runs, tolerance_um)
    count, _ = _counts(best, len(runs.low))
    low, high = (count - 1) / np.maximum(count, 1), np.ones(len(count))
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        found = longest_arcs(strings, runs, tolerance_um * middle**3)
        enough = _counts(found, len(count))[0] <= count
        low, high = np.where(enough, low, middle), np.where(enough, middle, high)
        best = _merged(best, found, enough)
    return best


def _counts(arcs: Arcs, runs: int) -> tuple[Ints, Floats]:
    """How many arcs each run has, and how long its last one is."""
    count = np.bincount(arcs.run, minlength=runs)
    last = np.cumsum(count) - 1
    return count, (arcs.end - arcs.start)[last]


def _merged(arcs: Arcs, better: Arcs, is_better: Bools) -> Arcs:
    parts = arcs.picked(~is_better[arcs.run]), better.picked(is_better[better.run])
    return joined_arcs(parts)
