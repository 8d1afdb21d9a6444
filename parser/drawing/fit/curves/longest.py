"""The longest arcs along strings, one behind the other, over all strings at once."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.curves.strings import Strings, places_on
from parser.drawing.fit.curves.through import Bends, bends_near
from parser.geometry.curves import Bools, Floats, Ints

STEPS = 18
"""In which an arc is held against the curve. On most curves the deviation is largest at 0.211 and 0.789 of its length,
about a vertex in the middle and at 0.117 and 0.883: eighteenths come near to all of these, within 0.2 % of it."""
MOST_ARCS = 600_000
_GOOD_SPARE = 0.01  # of the tolerance: 0.3 % of the length
_GOOD_STEP = 2e-3  # of the length
_AIM = 0.005  # of the tolerance that the next try shall spare
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
    """Arcs (n,) along runs: the run of each, where on it it starts and ends, its bend and what it spares (`Bends`)."""

    run: Ints
    start: Floats
    end: Floats
    bend: Floats
    spare: Floats

    def picked(self, row: Ints | Bools) -> "Arcs":
        """The rows `row`."""
        return Arcs(self.run[row], self.start[row], self.end[row], self.bend[row], self.spare[row])


class _Search:
    """Where each of the runs that are not yet covered stands.

    From `start` the arc to `good` is near with `bend` and `spare`, that to `bad` is not, and `next` is to be tried.
    """

    def __init__(self, runs: Runs, tolerance_um: Floats, like: Arcs | None) -> None:
        self.row = np.arange(len(runs.low))
        self.runs, self.tolerance_um = runs, tolerance_um
        self.start, self.next = runs.low.copy(), runs.high.copy()
        self.good, self.bad = runs.low.copy(), np.full(len(runs.low), np.inf)
        self.bend, self.spare = np.zeros((2, len(runs.low)))
        self.tries, self.arc = np.zeros((2, len(runs.low)), dtype=np.int64)
        if like is not None:
            self.length = like.end - like.start
            self.arc = np.searchsorted(like.run, self.row)
            self.last = np.searchsorted(like.run, self.row, side="right") - 1
            self.next = np.minimum(self.start + self.length[self.arc], runs.high)
        else:
            self.length, self.last = np.empty(0), self.arc

    def likely(self) -> Floats:
        """How long the next arc of each row is likely to be: as that of the arcs given to go by, or as the last one."""
        if not len(self.length):
            return np.asarray(self.good - self.start)
        return np.asarray(self.length[np.minimum(self.arc, self.last)])

    def keep(self, row: Bools) -> None:
        """Let go of the runs that are covered."""
        self.runs = self.runs.picked(row)
        for name in ("row", "tolerance_um", "start", "next", "good", "bad", "bend", "spare", "tries", "arc", "last"):
            setattr(self, name, getattr(self, name)[row])


def longest_arcs(
    strings: Strings, runs: Runs, tolerance_um: Floats, like: Arcs | None = None, steps: int = STEPS
) -> Arcs:
    """Arcs that cover the runs, each as long as it may be within a tolerance (r,) of the places looked at.

    `like` are arcs that cover them within about that tolerance: with these it goes faster, and a run that needs more
    arcs than it has there is left when it has one more. ValueError where there are arcs without number.
    """
    search = _Search(runs, tolerance_um, like)
    share = np.arange(steps + 1) / steps
    found: list[Arcs] = []
    total = 0
    while len(search.row):
        along = search.start[:, None] + (search.next - search.start)[:, None] * share
        place = places_on(strings, along, search.runs.first, search.runs.last)
        done = _learn(search, bends_near(place, search.tolerance_um))
        found.append(
            Arcs(search.row[done], search.start[done], search.good[done], search.bend[done], search.spare[done])
        )
        total += int(done.sum())
        if total > MOST_ARCS:
            raise ValueError("arcs without number")
        _go_on(search, done)
    return joined_arcs(found)


def joined_arcs(parts: Sequence[Arcs]) -> Arcs:
    """Arcs of one or more parts, by runs and along them."""
    run, start, end, bend, spare = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Arcs(run, start, end, bend, spare).picked(np.lexsort((start, run)))


def _learn(search: _Search, bends: Bends) -> Bools:
    """Take in what the tries gave, and choose the next; which (k,) rows have found their arc."""
    near, tried = bends.is_near, search.next
    length = tried - search.start
    hopeless = ~near & (length <= 0.1 * search.tolerance_um)  # nothing so short can be far off
    near = near | hopeless
    search.good = np.where(near, tried, search.good)
    search.bend = np.where(near, np.where(hopeless, 0.0, bends.bend), search.bend)
    search.spare = np.where(near, bends.spare, search.spare)
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
    """Start the next arc of the rows that found theirs."""
    search.arc = search.arc + done
    length = search.likely()
    search.start = np.where(done, search.good, search.start)
    search.next = np.where(done, np.minimum(search.good + length, search.runs.high), search.next)
    search.bad = np.where(done, np.inf, search.bad)
    search.tries = np.where(done, 0, search.tries)
    more = (search.arc <= search.last + 1) if len(search.length) else np.ones(len(length), dtype=np.bool_)
    search.keep((search.start < search.runs.high) & more)
