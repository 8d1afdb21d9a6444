"""History: velocity, acceleration, lag, following error and force of each axis over the time of a whole run.

Its memory does not grow with the ticks: time is cut into at most 2000 bins, and each bin keeps the lowest, the highest
and the mean value of the ticks in it.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from sim.base.units import newtons
from sim.table.physics.drive import Drive
from sim.table.record.bins import VALUES, Envelope
from sim.table.record.gather import Record
from sim.table.when.ticks import Ticks

BINS: Final = 2000
"""Most bins of a run: about one for each pixel across a picture."""
LEAST_BINS: Final = 100
SAMPLES_A_BIN: Final = 2
"""Samples of the trace in a bin, where a run has too few for `BINS`: between two samples the slide may only creep."""
QUANTITIES: Final = ("velocity_um_s", "acceleration_um_s2", "lag_um", "following_error_um", "force_n")
"""What is kept, in the order of `sim.table.record.bins.Values`."""


@dataclass(frozen=True, slots=True, eq=False)
class History:
    """Motion of the table over time, in b bins.

    Attributes
    ----------
    t_s
        (b + 1,) float64, borders of the bins, from 0 until the table has come to rest, or a drive tripped.
    velocity_um_s, acceleration_um_s2
        Of the table. The mean velocity is way over time, the mean acceleration is change of velocity over time.
    lag_um
        Of the table behind its motors. A stepper's pull-out and a servo's limit are limits of the lag.
    following_error_um
        Of the table behind the place commanded; way that its motors lost stays in it.
    force_n
        Of the drives.
    """

    t_s: Floats
    velocity_um_s: Envelope
    acceleration_um_s2: Envelope
    lag_um: Envelope
    following_error_um: Envelope
    force_n: Envelope


def borders_s(ticks: Ticks) -> Floats:
    """Borders (b + 1,) of the bins of a run."""
    bins = min(max(len(ticks.t_s) // SAMPLES_A_BIN, LEAST_BINS), BINS)
    return np.linspace(0.0, ticks.t_s[-1], bins + 1)


def history_of(records: tuple[Record, Record], drives: tuple[Drive, Drive], until_s: float) -> History:
    """History of both axes until a time."""
    border_s = records[0].bins.border_s
    bins = int(np.searchsorted(border_s, until_s))
    t_s = np.append(border_s[:bins], until_s)
    envelopes = {}
    for number, name in enumerate(QUANTITIES):
        low, high, area = (
            np.stack([column.reshape(-1, VALUES)[:bins, number] for column in columns], axis=1)
            for columns in zip(*(one.bins[1:] for one in records), strict=True)
        )
        envelope = Envelope(low, high, area / np.diff(t_s)[:, None])
        if name == "force_n":
            mass_kg = np.array([drive.mass_kg for drive in drives])
            envelope = Envelope(*(newtons(column * mass_kg) for column in envelope))
        envelopes[name] = envelope
    return History(t_s, **envelopes)
