"""Peaks: the largest force, speed and lag of each axis, and how near they came to their limits."""

from typing import Final, Literal, NamedTuple

from parser.told.step_words import Axis
from sim.base.units import newtons
from sim.table.physics.drive import Drive
from sim.table.record.gather import PEAK_COLUMNS, Record
from sim.table.trace import Trace
from sim.table.when.ticks import Ticks

Quantity = Literal["force", "speed", "lag"]
_QUANTITIES: Final[tuple[Quantity, ...]] = ("force", "speed", "lag")


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
        Block (row of the toolpath), time, and place of the table in program coordinates; that of the other axis is
        taken between two samples of the trace.
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


def peaks_of(
    records: tuple[Record, Record], drives: tuple[Drive, Drive], trace: Trace, ticks: Ticks
) -> tuple[Peak, ...]:
    """Peaks of force, speed and lag, of X and Y each."""
    peaks = []
    for number, quantity in enumerate(_QUANTITIES):
        for axis in Axis:
            peak = records[axis].peaks[number * PEAK_COLUMNS : (number + 1) * PEAK_COLUMNS].tolist()
            _, value, limit, t_s, at_um = peak
            if quantity == "force":
                value, limit = (newtons(one * drives[axis].mass_kg) for one in (value, limit))
            place = trace.place_with(axis, at_um, t_s)
            peaks.append(Peak(quantity, axis, value, limit, ticks.row_at(t_s), t_s, *place))
    return tuple(peaks)
