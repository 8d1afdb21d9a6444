"""What is kept of the ticks of one axis as it goes through them: bins of time, peaks, slips, samples."""

import math
from typing import NamedTuple

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from sim.table.physics.state import Slide
from sim.table.record.bins import Bins, Values

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
def _held(record: Record, number: int, value: float, limit: float, slide: Slide) -> None:
    """Take a value for a peak, if it is the largest share of its limit; the largest of all where there is none."""
    at = number * PEAK_COLUMNS
    of = limit if limit < math.inf else 1.0
    if value > record.peaks[at] * of:
        record.peaks[at], record.peaks[at + 1], record.peaks[at + 2] = value / of, value, limit
        record.peaks[at + 3], record.peaks[at + 4] = slide.t_s, slide.at_um


@compiled("(Record, Values, Limits, Slide)", Record, Values, Limits, Slide)
def peaked(record: Record, values: Values, limits: Limits, slide: Slide) -> None:
    """Take a tick for the peaks; `slide` is that at its end."""
    _held(record, 0, abs(values.force), limits.force, slide)
    _held(record, 1, abs(values.velocity), limits.speed, slide)
    _held(record, 2, abs(values.lag_um), limits.lag_um, slide)


@compiled("i8(Record, i8, Slide, f8, f8)", Record, Slide)
def sampled(record: Record, number: int, slide: Slide, velocity: float, until_s: float) -> int:
    """Note samples, from one on, while a slide goes on at a velocity until a time; the first one after that."""
    while record.sample_s[number] <= until_s:
        record.sampled_um[number] = slide.at_um + velocity * (record.sample_s[number] - slide.t_s)
        number += 1
    return number
