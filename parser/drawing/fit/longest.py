"""The longest arcs along strings, one behind the other, over all strings at once."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.strings import Strings, places_on
from parser.drawing.fit.through import Bends, bends_near
from parser.geometry.curves import Bools, Floats, Ints

_PLACES = 33  # of a curve that an arc is held against; its deviation swings once to either side
_GOOD_SPARE = 0.006  # of the tolerance: 0.2 % of the length
_GOOD_STEP = 1e-3  # of the length
_AIM = 0.003  # of the tolerance that the next try shall spare
_MOST_TRIES = 10  # from where on only the middle is tried


class Runs(NamedTuple):
    """Ways along strings that are to be covered: from `low` to `high` (r,) on pieces `first` to before `last` (r,)."""

    low: Floats
    high: Floats
    first: Ints
    last: Ints

    def picked(self, row: Ints | Bools) -> "Runs":
        """The rows `row`."""
        return Runs(self.low[row], self.high[row], self.first[row], self.last[row])


class Arcs(NamedTuple):
    """Arcs (n,) along runs: the run of each, where on it it starts and ends, and its bend (see `Bends`)."""

    run: Ints
    start: Floats
    end: Floats
    bend: Floats

    def picked(self, row: Ints | Bools) -> "Arcs":
        """The rows `row`."""
        return Arcs(self.run[row], self.start[row], self.end[row], self.bend[row])


class _Search:
    """Where each of the runs that are not yet covered stands.

    From `start` the arc to `good` is near with `bend`, that to `bad` is not, and `next` is to be tried.
    """

    def __init__(self, runs: Runs, tolerance_um: Floats) -> None:
        self.row = np.arange(len(runs.low))
        self.runs, self.tolerance_um = runs, tolerance_um
        self.start, self.next = runs.low.copy(), runs.high.copy()
        self.good, self.bad = runs.low.copy(), np.full(len(runs.low), np.inf)
        self.bend = np.zeros(len(runs.low))
        self.tries = np.zeros(len(runs.low), dtype=np.int64)

    def keep(self, row: Bools) -> None:
        """Let go of the runs that are covered."""
        self.runs = self.runs.picked(row)
        for name in ("row", "tolerance_um", "start", "next", "good", "bad", "bend", "tries"):
            setattr(self, name, getattr(self, name)[row])


_SHARES = np.linspace(0.0, 1.0, _PLACES)


def longest_arcs(strings: Strings, runs: Runs, tolerance_um: Floats) -> Arcs:
    """Arcs that cover the runs, each as long as it may be within a tolerance (r,) of the places looked at."""
    search = _Search(runs, tolerance_um)
    found: list[Arcs] = []
    while len(search.row):
        along = search.start[:, None] + (search.next - search.start)[:, None] * _SHARES
        place = places_on(strings, along, search.runs.first, search.runs.last)
        done = _learn(search, bends_near(place, search.tolerance_um))
        found.append(Arcs(search.row[done], search.start[done], search.good[done], search.bend[done]))
        _go_on(search, done)
    return joined_arcs(found)


def joined_arcs(parts: Sequence[Arcs]) -> Arcs:
    """Arcs of one or more parts, by runs and along them."""
    run, start, end, bend = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Arcs(run, start, end, bend).picked(np.lexsort((start, run)))


def _learn(search: _Search, bends: Bends) -> Bools:
    """Take in what the tries gave, and choose the next; which (k,) rows have found their arc."""
    near, tried = bends.is_near, search.next
    length = tried - search.start
    hopeless = ~near & (length <= 0.1 * search.tolerance_um)  # nothing so short can be far off
    near = near | hopeless
    search.good = np.where(near, tried, search.good)
    search.bend = np.where(near, np.where(hopeless, 0.0, bends.bend), search.bend)
    search.bad = np.where(near, search.bad, tried)
    search.tries += 1
    spare = np.where(near, np.maximum(bends.spare, 0.0), np.minimum(bends.spare, -1e-3))
    by = length * np.cbrt((1.0 - _AIM) / np.maximum(1.0 - spare, 0.03))
    bracketed = np.isfinite(search.bad)
    between = search.bad - search.good
    low = np.where(bracketed, search.good + 0.03 * between, search.start + 1.05 * length)
    high = np.where(bracketed, search.bad - 0.03 * between, np.inf)
    next_end = np.clip(search.start + by, low, np.maximum(low, high))
    halfway = bracketed & (search.tries > _MOST_TRIES)
    next_end = np.where(halfway, search.good + 0.5 * np.where(bracketed, between, 0.0), next_end)
    search.next = np.minimum(next_end, search.runs.high)
    reached = search.good - search.start
    close = (between <= _GOOD_STEP * reached) | hopeless
    return np.asarray((reached > 0.0) & ((search.good >= search.runs.high) | close | (near & (spare <= _GOOD_SPARE))))


def _go_on(search: _Search, done: Bools) -> None:
    """Start the next arc of the rows that found theirs, at first as long as the last one."""
    length = search.good - search.start
    search.start = np.where(done, search.good, search.start)
    search.next = np.where(done, np.minimum(search.good + length, search.runs.high), search.next)
    search.bad = np.where(done, np.inf, search.bad)
    search.tries = np.where(done, 0, search.tries)
    search.keep(search.start < search.runs.high)
