"""Lanes: time slices of a slab, run side by side, each by a table of its own in one engine (see `sim.table.solve`)."""

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.table.physics.state import State
from sim.table.solve.march import March, Record, RunTable
from sim.table.solve.slab import Slab

STILL_UM = 1e-4
"""Way of less than this is none."""
NEAR_STOP_UM = 20.0
"""Distance from the stops of the travel within which they may be felt."""


class Lanes:
    """Lanes of a slab, and what came of running them: a record (l, 2, k) of k lanes of up to l ticks.

    `begun` and `end` are the states of their tables before and after, `moved` (k, 2) tells which axes moved at all.

    Parameters
    ----------
    slab, borders
        The slab, and the first ticks of the k lanes with the end of the last, (k + 1,).
    table
        The table that runs them.
    """

    def __init__(self, slab: Slab, borders: Ints, table: RunTable) -> None:
        number = np.arange(int(np.diff(borders).max()))[:, None] + borders[:-1]
        self.inside = number < borders[1:]
        self._tick = np.where(self.inside, number, len(slab))
        self._slab, self._table = slab, table
        self.record: Record
        self.begun, self.end = _blank(len(borders) - 1), _blank(len(borders) - 1)
        self.moved = np.zeros((len(borders) - 1, 2), dtype=bool)

    def run(self, lanes: Ints, begin: State) -> None:
        """Run some of the lanes, each from its state in `begin` (of all)."""
        record, end = March(self._slab, self._tick[:, lanes], self._table).run(begin.of(lanes))
        if len(lanes) == len(self.moved):
            self.record = record
        else:
            for column, value in zip(self.record, record, strict=True):
                column[:, :, lanes] = value
        self.begun.put(lanes, begin.of(lanes))
        self.end.put(lanes, end)
        moved = np.ptp(record.place_um, axis=0).T > STILL_UM
        self.moved[lanes] = moved | (np.abs(end.at_um - record.place_um[-1].T) > STILL_UM)  # and in the last tick

    @property
    def room_um(self) -> Floats:
        """Lowest and highest place of the travel, (2, 2)."""
        return self._table.room_um

    def shift(self, lane: int, lost_um: Floats) -> None:
        """Let a lane begin with (2,) more lost than it was run with, far from the stops: then all of it is shifted."""
        self.record.place_um[:, :, lane] -= lost_um
        for state in (self.begun, self.end):
            state.at_um[lane] -= lost_um
            state.lost_um[lane] += lost_um

    def near_stop(self, lane: int, lost_um: Floats) -> bool:
        """Whether a lane comes near the stops of the travel, as run or with (2,) more lost."""
        places, room = self.record.place_um[:, :, lane], self._table.room_um
        low, high = places.min(axis=0) - np.maximum(lost_um, 0.0), places.max(axis=0) - np.minimum(lost_um, 0.0)
        return bool((low < room[0] + NEAR_STOP_UM).any() or (high > room[1] - NEAR_STOP_UM).any())


def _blank(count: int) -> State:
    return State(np.zeros((count, 2)), np.zeros((count, 2)), np.zeros((count, 2)), np.zeros(count, dtype=bool))
