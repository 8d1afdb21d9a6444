"""What is recorded of one axis as it goes through its ticks, and the history of a run that is made of it.

The history is velocity, acceleration, lag, following error and force of each axis over time. Its memory does not grow
with the ticks: time is cut into at most 2000 bins, of which each has the lowest, the highest and the mean value of its
ticks. Beside them stand peaks, slips of the motor, and the samples of the trace.
"""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from sim.base.units import newtons
from sim.table.drive import Drive, Slide
from sim.table.ticks import Ticks


class Envelope(NamedTuple):
    """One quantity in each of b bins, of X and Y: its lowest, its highest, and its mean over the time, each (b, 2)."""

    low: Floats
    high: Floats
    mean: Floats


class Values(NamedTuple):
    """What an axis does in a tick: µm/s, µm/s², µm, µm, and the drive's force over the mass, µm/s²."""

    velocity: float
    acceleration: float
    lag_um: float
    error_um: float
    force: float


VALUES = len(Values._fields)
"""Quantities in each bin."""


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


@compiled("(Bins, i8, f8, f8)", Bins)
def _widened(bins: Bins, at: int, value: float, length_s: float) -> None:
    """Take a value into a cell of the bins, for as long as it lasted in it."""
    bins.low[at] = min(bins.low[at], value)
    bins.high[at] = max(bins.high[at], value)
    bins.area[at] += value * length_s


@compiled("(Bins, i8, f8, Values)", Bins, Values)
def add_values(bins: Bins, number: int, length_s: float, values: Values) -> None:
    """Take values into a bin."""
    at = number * VALUES
    _widened(bins, at, values.velocity, length_s)
    _widened(bins, at + 1, values.acceleration, length_s)
    _widened(bins, at + 2, values.lag_um, length_s)
    _widened(bins, at + 3, values.error_um, length_s)
    _widened(bins, at + 4, values.force, length_s)


@compiled("i8(Bins, i8, f8, f8, Values)", Bins, Values)
def binned(bins: Bins, number: int, since_s: float, until_s: float, values: Values) -> int:
    """Take values that lasted from a time to another into bins, none before a number; the bin where they ended."""
    border_s, last = bins.border_s, len(bins.border_s) - 2
    while number < last and border_s[number + 1] <= since_s:
        number += 1
    while number < last and border_s[number + 1] < until_s:
        add_values(bins, number, border_s[number + 1] - since_s, values)
        number += 1
        since_s = border_s[number]
    add_values(bins, number, min(until_s, border_s[last + 1]) - since_s, values)
    return number


PEAKS = 3
"""What has a peak: force, speed, lag."""
PEAK_COLUMNS = 5
"""Of a peak: share, value, limit, time, place of the slide."""
_BEYOND_ROUNDING = 1.0 + 1e-6


class Limits(NamedTuple):
    """Limits of force over mass, µm/s², of speed, µm/s, and of the lag, µm; infinite where there is none."""

    force: float
    speed: float
    lag_um: float


SWINGS = 64
"""Swings that are stored of an axis: a power of two."""
SWING_TICKS = 128
"""Most ticks of a swing that is stored: two and a half periods of ringing."""


class Swings(NamedTuple):
    """Swings of one axis, n of them: what a step from rest did until the slide rested again.

    Attributes
    ----------
    lag_um, step_um
        (n,), lag at which the slide stood, NaN where none is stored, and the step.
    lasts_s, rest_lag_um, reach_um
        (n,), time until the slide rests, its lag then, and the most that it was away from where it stood.
    last_lag_um, last_force
        (n,), lag of its last tick, and force over the mass, µm/s².
    way_um
        (n * SWING_TICKS,), of each: way of the slide by the end of each tick.
    bins
        Lowest, highest and integral of each of `Values`, as of n bins; the following error without what was lost.
    peaks, peak_s, peak_way_um
        (n * PEAKS,), of each: highest force, speed and lag, and the time and the way of each since it began.
    """

    lag_um: Floats
    step_um: Floats
    lasts_s: Floats
    rest_lag_um: Floats
    reach_um: Floats
    last_lag_um: Floats
    last_force: Floats
    way_um: Floats
    bins: Bins
    peaks: Floats
    peak_s: Floats
    peak_way_um: Floats


def no_swings() -> Swings:
    """Room for swings, none of them stored."""
    low, high, area = (np.zeros(SWINGS * VALUES) for _ in range(3))
    step, lasts, rest_lag, reach, last_lag, last_force = (np.zeros(SWINGS) for _ in range(6))
    peaks, peak_s, peak_way = (np.zeros(SWINGS * PEAKS) for _ in range(3))
    return Swings(
        lag_um=np.full(SWINGS, np.nan),
        step_um=step,
        lasts_s=lasts,
        rest_lag_um=rest_lag,
        reach_um=reach,
        last_lag_um=last_lag,
        last_force=last_force,
        way_um=np.zeros(SWINGS * SWING_TICKS),
        bins=Bins(np.zeros(SWINGS + 1), low, high, area),
        peaks=peaks,
        peak_s=peak_s,
        peak_way_um=peak_way,
    )


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
    swings
        Swings that it has made so far, which `sim.table.swings` repeats.
    """

    bins: Bins
    peaks: Floats
    sample_s: Floats
    sampled_um: Floats
    slip_s: Floats
    slip_um: Floats
    slip_at_um: Floats
    swings: Swings


class PeakPlace(NamedTuple):
    """When a peak is reached, and where the slide is then."""

    t_s: float
    at_um: float


@compiled("void(Record, i8, f8, f8, PeakPlace)", Record, PeakPlace)
def take_peak(record: Record, number: int, value: float, limit: float, place: PeakPlace) -> None:
    """Take a value for a peak, if it is the largest share of its limit; the largest of all where there is none.

    Of values alike but for rounding it is the first.
    """
    at = number * PEAK_COLUMNS
    of = limit if limit < math.inf else 1.0
    if value > record.peaks[at] * of * _BEYOND_ROUNDING:
        record.peaks[at], record.peaks[at + 1], record.peaks[at + 2] = value / of, value, limit
        record.peaks[at + 3], record.peaks[at + 4] = place.t_s, place.at_um


@compiled("(Record, Values, Limits, Slide)", Record, Values, Limits, Slide)
def peaked(record: Record, values: Values, limits: Limits, slide: Slide) -> None:
    """Take a tick for the peaks; `slide` is that at its end."""
    place = PeakPlace(slide.t_s, slide.at_um)
    take_peak(record, 0, abs(values.force), limits.force, place)
    take_peak(record, 1, abs(values.velocity), limits.speed, place)
    take_peak(record, 2, abs(values.lag_um), limits.lag_um, place)


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
"""What is kept, in the order of `sim.table.history.Values`."""


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
