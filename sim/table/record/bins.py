"""Bins of time: the lowest, the highest and the mean value of each; their memory does not grow with the ticks."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints


class Envelope(NamedTuple):
    """One quantity in each of b bins, of X and Y: its lowest, its highest, and its mean over the time, each (b, 2)."""

    low: Floats
    high: Floats
    mean: Floats


class Share(NamedTuple):
    """The bins that n ticks lie in, k of them; a tick across a border is in both its bins.

    Attributes
    ----------
    bins
        Which.
    first, last
        (k,), first and last tick in each.
    before_s, after_s
        (k, 1), how much of the first tick lies before the bin, and how much of the last tick lies after it.
    length_s
        (n, 1), length of the ticks.
    """

    bins: slice
    first: Ints
    last: Ints
    before_s: Floats
    after_s: Floats
    length_s: Floats

    def reduced(self, ufunc: np.ufunc, values: Floats) -> Floats:
        """Values (n, 2) of the ticks, reduced by a ufunc to one value for each bin, (k, 2)."""
        last = len(values) - 1
        pairs = np.stack([self.first, np.minimum(self.last + 1, last)], axis=1).ravel()  # no index is past the last
        reduced = np.asarray(ufunc.reduceat(values, pairs, axis=0), dtype=np.float64)[::2]  # every other is of no bin
        without = (self.first < last) & (self.last == last)
        reduced[without] = ufunc(reduced[without], values[last])
        return reduced


def share_of(bin_s: Floats, tick_s: Floats) -> Share:
    """The bins that n ticks lie in; `bin_s` are the borders of all bins, `tick_s` (n + 1,) those of the ticks."""
    low, high = tick_s[[0, -1]]
    begin, end = int(np.searchsorted(bin_s, low, side="right")) - 1, int(np.searchsorted(bin_s, high))
    border_s = np.clip(bin_s[begin : end + 1], low, high)
    first = np.searchsorted(tick_s, border_s[:-1], side="right") - 1
    last = np.searchsorted(tick_s, border_s[1:]) - 1
    before_s, after_s = border_s[:-1] - tick_s[first], tick_s[last + 1] - border_s[1:]
    return Share(slice(begin, end), first, last, before_s[:, None], after_s[:, None], np.diff(tick_s)[:, None])


class Tally:
    """Lowest and highest of one quantity in each bin, and its integral over time."""

    def __init__(self, bins: int) -> None:
        self._low, self._high = np.full((bins, 2), np.inf), np.full((bins, 2), -np.inf)
        self._area = np.zeros((bins, 2))

    def take(self, share: Share, values: Floats, ends: Floats) -> None:
        """Take in the ticks of a share, (n, 2) each: `values` go into the mean, `ends` into the lowest and highest."""
        self.show(share, share.reduced(np.minimum, ends), share.reduced(np.maximum, ends))
        area = self._area[share.bins]
        area += share.reduced(np.add, values * share.length_s)
        area -= values[share.first] * share.before_s + values[share.last] * share.after_s

    def show(self, share: Share, lowest: Floats, highest: Floats) -> None:
        """Widen the bins of a share so that they reach down to `lowest` and up to `highest`, each (k, 2)."""
        low, high = self._low[share.bins], self._high[share.bins]
        np.minimum(low, lowest, out=low)
        np.maximum(high, highest, out=high)

    def result(self, width_s: Floats) -> Envelope:
        """Envelope of the first b bins, whose widths are `width_s` (b,)."""
        bins = len(width_s)
        return Envelope(self._low[:bins], self._high[:bins], self._area[:bins] / width_s[:, None])
