"""What steppers lose against the stops of the travel, in closed form: a slide that stands there needs no ticks for it.

Against a stop a motor gets ahead of its slide until the lag is past the pull-out, and then slips by whole electrical
periods until it is within again. So what is lost is, in whole periods, the most by which the motor would ever have been
past stop and pull-out. This is the play operator of hysteresis again (`sim.table.solve.slow_step`), as wide as the
travel.
"""

import numpy as np

from parser.geometry.curves import Floats
from sim.table.physics.drive import drives_of
from sim.table.solve.march import RunTable, pull_out_um
from sim.table.solve.slab import Slab


def lost_at_stops_um(slab: Slab, before_um: Floats, table: RunTable) -> Floats:
    """Way (n + 1, 2) µm that the motors have lost when each tick of a slab begins, if they lose it at the stops alone.

    `before_um` (2,) is what they had lost when the slab began. Of a slab that meets both stops of an axis only the
    first loss is right.
    """
    if table.model.motor.kind == "servo":
        return np.broadcast_to(before_um, slab.place_um.shape)
    least = pull_out_um(drives_of(table.model), table.model, slab.limit.T).T
    low, high = table.room_um
    at = slab.place_um - before_um
    forward = _periods(at - high - least, table)
    backward = _periods(low - least - (at - forward), table)
    lost: Floats = before_um + forward - backward
    return np.concatenate([before_um[None], lost[:-1]])


def _periods(past_um: Floats, table: RunTable) -> Floats:
    """Whole periods (n, 2) µm that hold the most that any row so far was past a limit."""
    period = table.model.motor.electrical_period_um
    periods: Floats = np.maximum.accumulate(np.ceil(np.maximum(past_um, 0.0) / period), axis=0) * period
    return periods
