"""Bins of time: the lowest, the highest and the mean value of each; their memory does not grow with the ticks."""

from typing import NamedTuple

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats


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
def _add(bins: Bins, number: int, length_s: float, values: Values) -> None:
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
        _add(bins, number, border_s[number + 1] - since_s, values)
        number += 1
        since_s = border_s[number]
    _add(bins, number, min(until_s, border_s[last + 1]) - since_s, values)
    return number
