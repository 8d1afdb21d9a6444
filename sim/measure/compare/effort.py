"""How much work a comparison may be: chords that places are held against, counted before they are looked at."""

import numpy as np

from parser.findings.errors import DrawingError
from parser.geometry.curves import Floats, Ints

MOST_HELD = 300_000_000
"""Chords of a drawing or an edge that all places together are held against: half a minute. 50,000 curves laid on
50,000 others need a sixth of it; thousands of curves at nearly one distance from thousands of places need more."""
_CELLS = 128  # along each side of the chords


class Effort:
    """What the chords of one index have been asked so far.

    Parameters
    ----------
    middle_um
        (m, 2) middles of the chords, one or more.
    """

    def __init__(self, middle_um: Floats) -> None:
        self._low = middle_um.min(axis=0)
        self._cell = np.maximum(np.ptp(middle_um, axis=0) / _CELLS, 1.0)
        at = np.minimum((middle_um - self._low) / self._cell, _CELLS - 1).astype(np.int64)
        number = np.bincount(at[:, 0] * _CELLS + at[:, 1], minlength=_CELLS * _CELLS).reshape(_CELLS, _CELLS)
        self._before = np.pad(number.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))  # below and left of each cell
        self.held = 0

    def spend(self, place_um: Floats, within_um: Floats) -> Ints:
        """About how many chords (p,) lie in a square of half side `within_um` (p,) about each of some places (p, 2).

        Raises DrawingError, without the name of the file, where all that were asked for come to more than `MOST_HELD`.
        """
        low, high = (
            np.clip((place_um + side * within_um[:, None] - self._low) / self._cell, -1.0, _CELLS).astype(np.int64)
            for side in (-1.0, 1.0)
        )
        low, high = np.clip(low, 0, _CELLS), np.clip(high + 1, 0, _CELLS)
        left, right, below, above = low[:, 0], high[:, 0], low[:, 1], high[:, 1]
        before = self._before
        number: Ints = before[right, above] - before[left, above] - before[right, below] + before[left, below]
        self.held += int(number.sum())
        if self.held > MOST_HELD:
            raise DrawingError(
                f"cannot be compared: more than {MOST_HELD:,} pairs of places and curves would have to be looked at; "
                "compare one layer, or a drawing of fewer curves"
            )
        return number
