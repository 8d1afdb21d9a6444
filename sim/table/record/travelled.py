"""The ticks of a slab that the table has run, in order of time."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.table.solve.lanes import Lanes
from sim.table.solve.slab import Slab


class Travelled(NamedTuple):
    """Ticks of a slab once the table has made them, each (n, 2) or (n,).

    Attributes
    ----------
    t_s, row
        End of each tick, and the row of the toolpath that was running.
    place_um, velocity
        Of the table, at the end of each tick.
    force, limit
        Of the drives over the mass, µm/s²: what they gave, and the most they had.
    lag_um, lost_um
        Lag of the table behind its motors, and way that these lost in each tick.
    """

    t_s: Floats
    row: Ints
    place_um: Floats
    velocity: Floats
    force: Floats
    limit: Floats
    lag_um: Floats
    lost_um: Floats

    def until(self, t_s: float) -> "Travelled":
        """The ticks that end by a time."""
        count = int(np.searchsorted(self.t_s, t_s, side="right"))
        return Travelled._make(column[:count] for column in self)


def travelled_of(slab: Slab, lanes: Lanes, row: Ints) -> Travelled:
    """Ticks of a slab in order of time; `row` is that of each stretch of the run."""
    record = lanes.record
    after = np.concatenate([record.place_um[1:], lanes.end.at_um.T[None]])
    inside = lanes.inside.T

    def in_order(records: Floats) -> Floats:
        return records.transpose(2, 0, 1)[inside]

    return Travelled(
        t_s=slab.t_s[1:],
        row=row[slab.stretch],
        place_um=in_order(after),
        velocity=in_order(record.velocity),
        force=in_order(record.force),
        limit=slab.limit[:-1],
        lag_um=in_order(record.lag_um),
        lost_um=in_order(record.lost_um),
    )
