"""Strings: curves that an entity runs through in one go, each from the end of the one before it."""

from typing import NamedTuple

import numpy as np

from parser.drawing.model import SAME_WITHIN_UM
from parser.geometry.curves import Bools, Curves, Ints


class Strings(NamedTuple):
    """First and last rows (s,) of the strings, and whether each closes upon itself."""

    first: Ints
    last: Ints
    closed: Bools

    @property
    def of_row(self) -> Ints:
        """(n,) string of each row."""
        return np.repeat(np.arange(len(self.first)), self.last - self.first + 1)


def strings_of(curves: Curves, entity: Ints) -> Strings:
    """Strings of curves (n,) by their entities (n,), numbers that do not decrease."""
    apart = np.hypot(*(curves.start_um[1:] - curves.end_um[:-1]).T) > SAME_WITHIN_UM
    cut = np.flatnonzero(apart | (np.diff(entity) != 0)) + 1
    first, last = np.append(0, cut), np.append(cut, len(curves)) - 1
    gap = np.hypot(*(curves.start_um[first] - curves.end_um[last]).T)
    return Strings(first, last, gap <= SAME_WITHIN_UM)
