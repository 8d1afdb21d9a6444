"""I J tested: in which reading, from the start or as places, the radii of the arcs agree (docs/iso.md §4)."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats
from parser.iso.path.arc_checks import GRAVE_UM
from parser.iso.path.places import Coordinates, Modes, Places
from parser.iso.path.rows import Rows

_MOST, _HALF = 0.9, 0.5
_SLIGHT = 0.01  # of a radius
_APART_UM = 1.0  # chords, and ways from the zero point, that are too short to tell the readings apart


class Agreement(NamedTuple):
    """How many arcs tell the readings of I J apart, and the shares of them whose radii agree as read, and otherwise."""

    arcs: int = 0
    as_read: float = 0.0
    otherwise: float = 0.0

    @property
    def is_otherwise(self) -> bool:
        """Whether the arcs agree only in the other reading."""
        return self.otherwise >= _MOST and self.as_read < _HALF

    @property
    def is_sure(self) -> bool:
        """Whether the arcs agree in one of the readings."""
        return max(self.as_read, self.otherwise) >= _MOST

    @property
    def is_neither(self) -> bool:
        """Whether some arcs, more than one, agree in neither reading."""
        return self.arcs > 1 and max(self.as_read, self.otherwise) < _HALF

    @property
    def why(self) -> str:
        """Term of what the arcs say of the reading that was taken; empty where no arc says anything."""
        if not self.arcs:
            return ""
        if self.as_read >= _MOST:
            return "because-arcs-both" if self.otherwise >= _HALF else "because-arcs"
        return "because-arcs-neither"


def agreement(mode: Modes, numbers: Coordinates, place: Places, path: Rows, slack_um: float) -> Agreement:
    """How the arcs of the running blocks agree with either reading of their I J.

    The rounding of the file lets radii differ by `slack_um`.
    """
    at = path.at[path.turning]
    start, end = path.curves.start_um[path.turning], path.curves.end_um[path.turning]
    center, base = numbers.center[at], place.shift_um[at]
    tells = ~np.isnan(center).any(axis=1) & (_length(end - start) > _APART_UM) & (_length(start - base) > _APART_UM)
    if not tells.any():
        return Agreement()
    start, end, center, base = start[tells], end[tells], center[tells], base[tells]
    is_absolute = mode.has_absolute_centers[at[tells], None]
    as_read = _agrees(start, end, center + np.where(is_absolute, base, start), slack_um)
    otherwise = _agrees(start, end, center + np.where(is_absolute, start, base), slack_um)
    return Agreement(int(tells.sum()), float(as_read.mean()), float(otherwise.mean()))


def _agrees(start: Floats, end: Floats, center: Floats, slack_um: float) -> Bools:
    """(k,) whether the radii at both ends of arcs (k, 2) agree as well as their size lets one tell."""
    out = _length(start - center)
    near: Bools = np.abs(_length(end - center) - out) <= np.maximum(slack_um, np.minimum(GRAVE_UM, _SLIGHT * out))
    return near


def _length(by: Floats) -> Floats:
    return np.hypot(by[:, 0], by[:, 1])
