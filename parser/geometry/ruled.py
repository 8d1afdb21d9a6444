"""Ruled surfaces: two contours at two heights, matched row by row, between which the wire runs straight.

A row of the lower contour and the same row of the upper one are run in the same time, each in even shares: where share
t of the lower one is done, the wire leads from there to share t of the upper one. At the height z it then is at
``P(t) = L(t) + (U(t) − L(t)) (z − z_lower) / (z_upper − z_lower)``.
"""

from dataclasses import dataclass

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints

_NODES = 24
"""Places of Gauss and Legendre in a row: an arc of a whole turn against a line is then right to 10⁻¹² of its area."""


@dataclass(frozen=True, slots=True, eq=False)
class Ruled:
    """n rows of two contours at two heights.

    Attributes
    ----------
    lower, upper
        The contours, n rows each; a row without length is a place at which that end of the wire stands.
    lower_z_um, upper_z_um
        Their heights, the upper one above the lower one.
    """

    lower: Curves
    upper: Curves
    lower_z_um: float
    upper_z_um: float

    def __post_init__(self) -> None:
        """Raise ValueError where rows or heights do not match."""
        if len(self.lower) != len(self.upper):
            raise ValueError(f"{len(self.lower)} rows below, {len(self.upper)} rows above")
        if not self.lower_z_um < self.upper_z_um:
            raise ValueError(f"the upper contour at {self.upper_z_um} µm, the lower one at {self.lower_z_um} µm")

    def __len__(self) -> int:
        return len(self.lower)

    @property
    def height_um(self) -> float:
        """From the lower contour to the upper one."""
        return self.upper_z_um - self.lower_z_um

    def places(self, row: Ints, share: Floats, z_um: float) -> Floats:
        """Places (m, 2) µm of the wire at a height, at shares (m,) of the rows (m,); beyond the contours too."""
        low = places(self.lower, row, share)
        high = places(self.upper, row, share)
        return low + (high - low) * ((z_um - self.lower_z_um) / self.height_um)

    def leans(self, row: Ints, share: Floats) -> Floats:
        """By how much (m, 2) the wire leans, as tangents: how far it leads aside for each µm up."""
        return (places(self.upper, row, share) - places(self.lower, row, share)) / self.height_um

    def area_um2(self, rows: Ints, z_um: float) -> float:
        """Signed area within the closed section that rows (k,) make at a height, positive counter-clockwise.

        ½ ∮ P × dP by the rule of Gauss and Legendre in each row.
        """
        node, weight = np.polynomial.legendre.leggauss(_NODES)
        share, weight = 0.5 * (node + 1.0), 0.5 * weight
        row = np.repeat(rows, _NODES)
        at = np.tile(share, len(rows))
        w = (z_um - self.lower_z_um) / self.height_um
        place = self.places(row, at, z_um)
        place -= place[:1]
        way = (1.0 - w) * _rates(self.lower, row, at) + w * _rates(self.upper, row, at)
        cross = place[:, 0] * way[:, 1] - place[:, 1] * way[:, 0]
        return float(0.5 * (cross * np.tile(weight, len(rows))).sum())

    def volume_um3(self, rows: Ints, low_um: float, high_um: float) -> float:
        """Signed volume between two heights of what closed rows (k,) enclose.

        The area is quadratic in z, so Simpson's rule is exact.
        """
        low, middle, high = (self.area_um2(rows, z) for z in (low_um, 0.5 * (low_um + high_um), high_um))
        return (high_um - low_um) * (low + 4.0 * middle + high) / 6.0


def _rates(curves: Curves, row: Ints, share: Floats) -> Floats:
    """Derivatives (m, 2) of places by the share."""
    rate = (curves.end_um - curves.start_um)[row]
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    angle = curves.start_angle_rad[on] + share[arc] * curves.sweep_rad[on]
    size = curves.radius_um[on] * curves.sweep_rad[on]
    rate[arc] = np.stack([-np.sin(angle) * size, np.cos(angle) * size], axis=1)
    return rate
