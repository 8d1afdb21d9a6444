"""The list of the card: what is to be run, in order, and where it ends."""

from collections import deque
from itertools import islice

import numpy as np

from controller.card.core.codes import Code, Refused
from controller.card.engine.entries import ORIGIN, Entry, PathEntry, Place, Segment, Stepped, Stepping, line
from controller.stepping.point_by_point import interpolate_words
from controller.stepping.steps import Steps
from parser.controller_words import StepWords

_KEPT = 4096
"""Blocks are kept to count their steps at once; never more than these."""


class MotionList:
    """Entries that are not finished, and where the next one starts.

    Attributes
    ----------
    entries
        In order. Those of the stretch that runs stay until the stretch is cut or ends.
    is_open
        Whether path calls are stored.
    number
        Number of the next path entry: 0 for the positioning move that opens a list; every other has 1 or more.
    executed
        Number of the path entry executed last, as far as a cut or the end of its stretch told.
    begun
        How often the list was emptied to begin anew.
    start
        Where the first entry starts.
    """

    def __init__(self) -> None:
        self.entries: deque[Entry] = deque()
        self.is_open = False
        self.number = self.executed = 0
        self.begun = 0
        self.start = self._end = ORIGIN
        self._uncounted: list[Stepped] = []

    def clear(self, *, is_open: bool) -> None:
        """Forget all entries; numbers begin anew."""
        self.entries.clear()
        self.begun += 1
        self.is_open, self.number, self.executed = is_open, 0, 0

    def begin(self, place: Place) -> None:
        """Let the entries begin at a place; for an empty list."""
        self.start, self._end = place, place
        self._uncounted.clear()

    def push(self, entry: Entry) -> None:
        """Append an entry; a line or an arc starts at the `end` asked for before."""
        self.entries.append(entry)
        if isinstance(entry, Segment):
            self.number, self._end = entry.number + 1, entry.end
        elif isinstance(entry, Stepped):
            self.number = entry.number + 1
            self._uncounted.append(entry)
            if len(self._uncounted) >= _KEPT:
                self.end()

    def end(self) -> Place:
        """Where the next entry starts."""
        if self._uncounted:
            x, y = steps_of(self._uncounted).corner_um[-1].tolist()
            place = self._end
            self._end = (float(np.rint(place[0]) + x), float(np.rint(place[1]) + y), place[2], place[3])
            self._uncounted.clear()
        return self._end

    def first_run(self) -> list[Entry]:
        """The entries from the front that one interpolator runs."""
        kind: Stepping | None = None
        for n, entry in enumerate(self.entries):
            own = entry.kind
            if own is not None and kind is not None and own is not kind:
                return list(islice(self.entries, n))
            kind = own or kind
        return list(self.entries)

    def start_from(self, place: Place) -> None:
        """Let the list begin at a place. Refused with 1 unless its first path entry, if it has one, is a line."""
        paths = ((n, entry) for n, entry in enumerate(self.entries) if isinstance(entry, PathEntry))
        first, entry = next(paths, (0, None))
        if entry is None:
            self.begin(place)
            return
        if not isinstance(entry, Segment) or entry.curvature:
            raise Refused(Code.COMMAND)
        self.entries[first] = line(entry.number, entry.pace, place, entry.end)._replace(call=entry.call)

    def replace(self, n: int, left: list[Entry]) -> None:
        """Put what is left of the first n entries in their place."""
        for _ in range(n):
            self.entries.popleft()
        self.entries.extendleft(reversed(left))


def steps_of(blocks: list[Stepped]) -> Steps:
    """Steps of whole blocks, whatever part of them is made."""
    columns = np.array([block[2:8] for block in blocks], dtype=np.int64).reshape(-1, 6).T
    x, y, count, axis, quadrant, turn = np.ascontiguousarray(columns)
    words = StepWords(x, y, count, axis, quadrant, turn, radius_um=np.full_like(x, -1), curve=np.zeros_like(x))
    return interpolate_words(words, np.array([block.length_um for block in blocks], dtype=np.float64))
