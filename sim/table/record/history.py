"""History: velocity, acceleration, lag, following error and force of each axis over the time of a whole run.

Its memory does not grow with the ticks: time is cut into at most 2000 bins, and each bin keeps the lowest, the highest
and the mean value of the ticks in it.

What is kept of the ticks of one axis as it goes through them: bins of time, peaks, slips, samples.
"""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from sim.base.units import newtons
from sim.table.physics.drive import Drive
from sim.table.physics.state import Slide
from sim.table.record.bins import VALUES, Bins, Envelope, Values
from sim.table.when.ticks import Ticks

PEAKS = 3
"""What has a peak: force, speed, lag."""
PEAK_COLUMNS = 5
"""Of a peak: share, value, limit, time, place of the slide."""


class Limits(NamedTuple):
    """Limits of force over mass, µm/s², of speed, µm/s, and of the lag, µm; infinite where there is none."""

    force: float
    speed: float
    lag_um: float


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


@compiled("(Record, i8, f8, f8, Slide)", Record, Slide)
def _take_peak(record: Record, number: int, value: float, limit: float, slide: Slide) -> None:
    """Take a value for a peak, if it is the largest share of its limit; the largest of all where there is none."""
    at = number * PEAK_COLUMNS
    of = limit if limit < math.inf else 1.0
    if value > record.peaks[at] * of:
        record.peaks[at], record.peaks[at + 1], record.peaks[at + 2] = value / of, value, limit
        record.peaks[at + 3], record.peaks[at + 4] = slide.t_s, slide.at_um


@compiled("(Record, Values, Limits, Slide)", Record, Values, Limits, Slide)
def peaked(record: Record, values: Values, limits: Limits, slide: Slide) -> None:
    """Take a tick for the peaks; `slide` is that at its end."""
    _take_peak(record, 0, abs(values.force), limits.force, slide)
    _take_peak(record, 1, abs(values.velocity), limits.speed, slide)
    _take_peak(record, 2, abs(values.lag_um), limits.lag_um, slide)


@compiled("i8(Record, i8, Slide, f8, f8)", Record, Slide)
def sampled(record: Record, number: int, slide: Slide, velocity: float, until_s: float) -> int:
    """Note samples, from one on, while a slide goes on at a velocity until a time; the first one after that."""
    while record.sample_s[number] <= until_s:
        record.sampled_um[number] = slide.at_um + velocity * (record.sample_s[number] - slide.t_s)
        number += 1
    return number


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
            for columns in zip(*(record.bins[1:] for record in records), strict=True)
        )
        envelope = Envelope(low, high, area / np.diff(t_s)[:, None])
        if name == "force_n":
            mass_kg = np.array([drive.mass_kg for drive in drives])
            envelope = Envelope(*(newtons(column * mass_kg) for column in envelope))
        envelopes[name] = envelope
    return History(t_s, **envelopes)
