"""Peaks: the largest force, speed and lag of each axis, and how near they came to their limits."""

from typing import Literal, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Axis
from sim.setup.machine.table_model import TableModel
from sim.table.physics.drive import drives_of
from sim.table.record.travelled import Travelled
from sim.table.solve.march import pull_out_um
from sim.units import newtons

Quantity = Literal["force", "speed", "lag"]


class Peak(NamedTuple):
    """Where an axis came nearest to a limit.

    Attributes
    ----------
    quantity
        ``force`` of the drive, N; ``speed`` of the slide, µm/s; ``lag`` of the slide behind its motor, µm.
    axis
        Whose.
    value, limit
        Largest magnitude, and the limit at that moment, infinite where there is none. Where the limit changes with the
        step rate, they are those of the moment with the largest share.
    row, t_s, x_um, y_um
        Block (row of the toolpath), time, and place of the table in program coordinates.
    """

    quantity: Quantity
    axis: Axis
    value: float
    limit: float
    row: int
    t_s: float
    x_um: float
    y_um: float

    @property
    def share(self) -> float:
        """Value over limit; 0 without a limit."""
        return self.value / self.limit


class PeakMeter:
    """Finds the peaks as a table travels; `speed_limit_um_s` is that of each axis, infinite where there is none."""

    def __init__(self, model: TableModel, speed_limit_um_s: tuple[float, float]) -> None:
        self._model, self._drives = model, drives_of(model)
        self._speed_limit = np.array(speed_limit_um_s)
        self._peaks: dict[tuple[Quantity, int], Peak] = {}

    def take(self, travelled: Travelled) -> None:
        """Take the next ticks."""
        if not len(travelled.t_s):
            return
        mass = self._drives.mass_kg[:, 0]
        most_n = newtons(travelled.limit * mass)
        self._hold("force", newtons(np.abs(travelled.force) * mass), most_n, travelled)
        speed = np.abs(travelled.velocity)
        self._hold("speed", speed, np.broadcast_to(self._speed_limit, speed.shape), travelled)
        servo = self._model.motor.kind == "servo"
        lag_limit = np.full_like(travelled.limit, self._model.motor.following_error_limit_um)
        if not servo:
            lag_limit = pull_out_um(self._drives, self._model, travelled.limit.T).T
        self._hold("lag", np.abs(travelled.lag_um), lag_limit, travelled)

    def result(self) -> tuple[Peak, ...]:
        """Peaks of force, speed and lag, of X and Y each; none where nothing moved."""
        return tuple(self._peaks.values())

    def _hold(self, quantity: Quantity, values: Floats, limits: Floats, travelled: Travelled) -> None:
        for axis in (Axis.X, Axis.Y):
            value, limit = values[:, axis], limits[:, axis]
            tick = int(np.argmax(value / limit if np.isfinite(limit).all() else value))
            x_um, y_um = travelled.place_um[tick].tolist()
            peak = Peak(
                quantity,
                axis,
                float(value[tick]),
                float(limit[tick]),
                int(travelled.row[tick]),
                float(travelled.t_s[tick]),
                x_um,
                y_um,
            )
            known = self._peaks.get((quantity, axis))
            if known is None or (peak.share, peak.value) > (known.share, known.value):
                self._peaks[quantity, axis] = peak
