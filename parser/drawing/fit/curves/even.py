"""As few arcs as can be along strings, each as full as the others: the best start, and the least tolerance for it."""

import numpy as np

from parser.drawing.fit.curves.longest import STEPS, Arcs, Runs, joined_arcs, longest_arcs
from parser.drawing.fit.curves.strings import Strings
from parser.geometry.curves import Bools, Floats, Ints

_MOST_STARTS = 24
_STARTS_AT_ONCE = 1_000  # over all closed curves of a drawing: many have few starts each
_ROUNDS = 3
_FULL = 0.9  # of the length of an arc
_TAIL = 4  # arcs
_LEAST = 1e-3  # of the tolerance: what lies nearer needs no less


def best_starts(strings: Strings, runs: Runs, closed: Bools, tolerance_um: Floats) -> Runs:
    """The runs, those that are closed begun where the arcs are fewest, and of these where the last one is shortest."""
    at = np.flatnonzero(closed)
    number = min(_STARTS_AT_ONCE // max(len(at), 1), _MOST_STARTS)
    if not len(at) or number < 2:
        return runs
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


def even_arcs(strings: Strings, runs: Runs, tolerance_um: Floats, steps: int = STEPS) -> Arcs:
    """Arcs as few as a tolerance (r,) allows, of about the least tolerance that needs no more of them.

    About vertices a little less may take one arc more: there the last arcs alone share what the very last one lacks.
    """
    best = _evened(strings, runs, tolerance_um, longest_arcs(strings, runs, tolerance_um, steps=steps), steps)
    count, _ = _counts(best, len(runs.low))
    rows = np.flatnonzero((_filled(best, count) < 1.0) & (count > _TAIL))
    if not len(rows):
        return best
    last = np.cumsum(count)
    tail = np.isin(best.run, rows) & (last[best.run] - np.arange(len(best.run)) <= _TAIL)
    own = best.picked(tail)
    ends = runs.picked(rows)._replace(low=best.start[last[rows] - _TAIL])
    better = _evened(strings, ends, tolerance_um[rows], own._replace(run=np.searchsorted(rows, own.run)), steps)
    return joined_arcs([best.picked(~tail), better._replace(run=rows[better.run])])


def _evened(strings: Strings, runs: Runs, tolerance_um: Floats, best: Arcs, steps: int) -> Arcs:
    """Arcs of a lower tolerance, no more of them than the `best` so far.

    The length of an arc goes with the cube root of its tolerance: so all arcs are made shorter by what the last one
    lacks, and where that was too much, by half of it.
    """
    count, _ = _counts(best, len(runs.low))
    low, high = (count - 1) / np.maximum(count, 1), np.ones(len(count))
    share = high * _filled(best, count)
    for _ in range(_ROUNDS):
        todo = np.flatnonzero(share < high)
        if not len(todo):
            break
        found = longest_arcs(strings, runs.picked(todo), (tolerance_um * share**3)[todo], _of_runs(best, todo), steps)
        enough = _counts(found, len(todo))[0] <= count[todo]
        low[todo], high[todo] = np.where(enough, low[todo], share[todo]), np.where(enough, share[todo], high[todo])
        better = found.picked(enough[found.run])
        best = _merged(best, better._replace(run=todo[better.run]), np.isin(np.arange(len(count)), todo[enough]))
        count, _ = _counts(best, len(count))
        next_share = high * _filled(best, count)
        share = np.where(next_share < high, np.maximum(next_share, 0.5 * (low + high)), high)
    return best


def _filled(arcs: Arcs, count: Ints) -> Floats:
    """By what all arcs (r,) are longer than they would be if the last one were as full; 1 where that is little."""
    last = arcs.spare[np.cumsum(count) - 1]
    full = np.cbrt(np.clip(1.0 - last, _LEAST, 1.0))
    return np.where(full < _FULL, (count - 1 + full) / count, 1.0)


def _of_runs(arcs: Arcs, which: Ints) -> Arcs:
    """The arcs of some runs, by their number among these."""
    some = arcs.picked(np.isin(arcs.run, which))
    return some._replace(run=np.searchsorted(which, some.run))


def _counts(arcs: Arcs, runs: int) -> tuple[Ints, Floats]:
    """How many arcs each run has, and how long its last one is."""
    count = np.bincount(arcs.run, minlength=runs)
    last = np.cumsum(count) - 1
    return count, (arcs.end - arcs.start)[last]


def _merged(arcs: Arcs, better: Arcs, is_better: Bools) -> Arcs:
    parts = arcs.picked(~is_better[arcs.run]), better.picked(is_better[better.run])
    return joined_arcs(parts)
