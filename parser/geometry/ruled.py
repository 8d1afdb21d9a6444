"""Ruled surfaces: two contours at two heights, matched row by row, between which the wire runs straight.

A row of the lower contour and the same row of the upper one are run in the same time, each in even shares: where share
t of the lower one is done, the wire leads from there to share t of the upper one. At the height z it then is at
``P(t) = L(t) + (U(t) − L(t)) (z − z_lower) / (z_upper − z_lower)``.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from parser.geometry.along import headings, places, to_left
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, curves_between

_NODES = 24
"""Places of Gauss and Legendre in a row: an arc of a whole turn against a line is then right to 10⁻¹² of its area."""
_SAGITTA_UM: Final = 0.02
"""Of chords that stand for what is no arc any more."""
_SAME_RAD: Final = 1e-9
_NOTHING_UM: Final = 1e-6


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

    @property
    def length_um(self) -> Floats:
        """(n,) length of the longer of the two contours in each row."""
        longer: Floats = np.maximum(self.lower.length_um, self.upper.length_um)
        return longer

    @property
    def is_jump(self) -> Bools:
        """(n,) True on jumps."""
        jump: Bools = self.lower.kind == CurveKind.JUMP
        return jump

    def wires(self, row: Ints, share: Floats) -> tuple[Floats, Floats]:
        """The wire at shares (m,) of the rows (m,): places (m, 2) µm on the lower contour, and leans (m, 2).

        A lean is a tangent: how far the wire leads aside for each µm up.
        """
        low = places(self.lower, row, share)
        return low, (places(self.upper, row, share) - low) / self.height_um

    def places(self, row: Ints, share: Floats, z_um: float) -> Floats:
        """Places (m, 2) µm of the wire at a height, at shares (m,) of the rows (m,); beyond the contours too."""
        low, lean = self.wires(row, share)
        return low + lean * (z_um - self.lower_z_um)

    def leans(self, row: Ints, share: Floats) -> Floats:
        """By how much (m, 2) the wire leans at shares (m,) of the rows (m,), as tangents."""
        return self.wires(row, share)[1]

    def across(self, row: Ints, share: Floats) -> Floats:
        """Unit directions (m, 2) across the walls at shares (m,) of the rows (m,): square to the longer contour."""
        longer = self.lower.length_um >= self.upper.length_um
        low, high = (to_left(headings(of, row, share)) for of in (self.lower, self.upper))
        return np.where(longer[row][:, None], low, high)

    def section(self, z_um: float) -> tuple[Curves, Ints]:
        """The curves at a height, and the row (k,) of this surface that each of them belongs to.

        Lines between lines are lines, and arcs about one centre by one angle are arcs about it; all else is cut into
        chords.
        """
        lower, upper = self.lower, self.upper
        share = (z_um - self.lower_z_um) / self.height_um
        alike = lower.is_arc & upper.is_arc & (np.abs(lower.sweep_rad - upper.sweep_rad) < _SAME_RAD)
        alike &= np.abs(lower.start_angle_rad - upper.start_angle_rad) < _SAME_RAD
        one_stands = (lower.is_arc != upper.is_arc) & (np.minimum(lower.length_um, upper.length_um) == 0.0)
        row, number, count = self._chords((lower.is_arc | upper.is_arc) & ~alike & ~one_stands)
        start, end = (self.places(row, (number + by) / count[row], z_um) for by in (0, 1))
        sweep = np.where(alike | one_stands, np.where(lower.is_arc, lower.sweep_rad, upper.sweep_rad), 0.0)
        low, high = (np.where(of.is_arc[:, None], of.center_um, of.start_um) for of in (lower, upper))
        center = (low + share * (high - low))[row]
        stands = np.hypot(*(start - center).T) < _NOTHING_UM
        made = curves_between(start, end, center, np.where(stands, 0.0, sweep[row]))
        made.kind[self.is_jump[row]] = CurveKind.JUMP
        return made, row

    def _chords(self, bent: Bools) -> tuple[Ints, Ints, Ints]:
        """Chords for rows that are bent, one for each of the others: row and number (k,) of each, and counts (n,)."""
        reach = np.maximum(np.nan_to_num(self.lower.radius_um), np.nan_to_num(self.upper.radius_um))
        # A chord c leaves a circle of radius R by c² / 8 R.
        chord = np.sqrt(8.0 * np.maximum(reach, 1.0) * _SAGITTA_UM)
        count = np.where(bent, np.ceil(self.length_um / chord), 1.0).astype(np.int64)
        row = np.repeat(np.arange(len(self)), count)
        return row, np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count), count

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
