"""What is recorded of one axis, and the history of a run that is made of it.

The history is velocity, acceleration, lag, following error and force of each axis over time. Its memory does not grow
with the run: time is cut into at most 2000 bins, of which each has the lowest, the highest and the mean value in it.
Beside them stand peaks, slips of the motor, and the samples of the trace.
"""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats
from sim.base.units import newtons
from sim.table.drive import Drive
from sim.table.ticks import Ticks


class Envelope(NamedTuple):
    """One quantity in each of b bins, of X and Y: its lowest, its highest, and its mean over the time, each (b, 2)."""

    low: Floats
    high: Floats
    mean: Floats


VALUES = 5
"""Quantities in each bin: velocity, acceleration, lag, following error, force over the mass; µm, s."""


class Bins(NamedTuple):
    """The bins of one axis, b of them.

    Attributes
    ----------
    border_s
        (b + 1,), their borders.
    low, high, area
        (b * VALUES,), lowest and highest of each quantity in each bin, and its integral over time.
    """

    border_s: Floats
    low: Floats
    high: Floats
    area: Floats


@compiled("void(Bins, i8, f8, f8, f8)", Bins)
def widened(bins: Bins, at: int, low: float, high: float, area: float) -> None:
    """Take a range of values into a cell of the bins, and their integral over the time of it."""
    bins.low[at] = min(bins.low[at], low)
    bins.high[at] = max(bins.high[at], high)
    bins.area[at] += area


PEAKS = 3
"""What has a peak: force, speed, lag."""
PEAK_COLUMNS = 5
"""Of a peak: share, value, limit, time, place of the slide."""
_BEYOND_ROUNDING = 1.0 + 1e-6


class Limits(NamedTuple):
    """Limits of force over mass, µm/s², of speed, µm/s, and of the lag, µm; infinite where there is none.

    Where a position loop is closed, what counts as the lag is `behind_um`, how far what it looks at is behind its
    command; below 0 where none is.
    """

    force: float
    speed: float
    lag_um: float
    behind_um: float


class Record(NamedTuple):
    """What is kept of one axis.

    Attributes
    ----------
    bins
        What it did over time.
    peaks
        (PEAKS * PEAK_COLUMNS,).
    sample_s, sampled_um
        (n + 1,) and (n,), times of the samples, and infinity; place of the slide then.
    slip_s, slip_um, slip_at_um
        (s,), slips of a stepper: when, by how much, and where the slide was.
    """

    bins: Bins
    peaks: Floats
    sample_s: Floats
    sampled_um: Floats
    slip_s: Floats
    slip_um: Floats
    slip_at_um: Floats


class PeakPlace(NamedTuple):
    """When a peak is reached, and where the slide is then."""

    t_s: float
    at_um: float


@loop_part("b1(Record, i8, f8, f8)", Record)
def is_peak(record: Record, number: int, value: float, limit: float) -> bool:
    """Whether a value is the largest share of its limit so far; the largest of all where there is none.

    Of values alike but for rounding it is the first.
    """
    of = limit if limit < math.inf else 1.0
    return bool(value > record.peaks[number * PEAK_COLUMNS] * of * _BEYOND_ROUNDING)


@compiled("void(Record, i8, f8, f8, PeakPlace)", Record, PeakPlace)
def take_peak(record: Record, number: int, value: float, limit: float, place: PeakPlace) -> None:
    """Take a value for a peak, if it is one."""
    at = number * PEAK_COLUMNS
    of = limit if limit < math.inf else 1.0
    if is_peak(record, number, value, limit):
        record.peaks[at], record.peaks[at + 1], record.peaks[at + 2] = value / of, value, limit
        record.peaks[at + 3], record.peaks[at + 4] = place.t_s, place.at_um


BINS: Final = 2000
"""Most bins of a run: about one for each pixel across a picture."""
LEAST_BINS: Final = 100
SAMPLES_A_BIN: Final = 2
"""Samples of the trace in a bin, where a run has too few for `BINS`: between two samples the slide may only creep."""
QUANTITIES: Final = ("velocity_um_s", "acceleration_um_s2", "lag_um", "following_error_um", "force_n")
"""What is kept, in the order in which bins have it."""


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
            for columns in zip(*(record.bins[1:] for record in records), strict=True)
        )
        envelope = Envelope(low, high, area / np.diff(t_s)[:, None])
        if name == "force_n":
            mass_kg = np.array([drive.mass_kg for drive in drives])
            envelope = Envelope(*(newtons(column * mass_kg) for column in envelope))
        envelopes[name] = envelope
    return History(t_s, **envelopes)
