"""Ruled surfaces: two contours at two heights, matched row by row, between which the wire runs straight.

A row of the lower contour and the same row of the upper one are run in the same time, each in even shares: where share
t of the lower one is done, the wire leads from there to share t of the upper one. At the height z it then is at
``P(t) = L(t) + (U(t) − L(t)) (z − z_lower) / (z_upper − z_lower)``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.along import headings, places, to_left
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, curves_between, joined

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
        (curves,), row = self.sections((z_um,))
        return curves, row

    def sections(self, heights_um: Sequence[float]) -> tuple[tuple[Curves, ...], Ints]:
        """The curves at several heights, as `section` has them, all with the same rows (k,) of this surface."""
        lower, upper = self.lower, self.upper
        alike = lower.is_arc & upper.is_arc & (np.abs(lower.sweep_rad - upper.sweep_rad) < _SAME_RAD)
        alike &= np.abs(lower.start_angle_rad - upper.start_angle_rad) < _SAME_RAD
        one_stands = (lower.is_arc != upper.is_arc) & (np.minimum(lower.length_um, upper.length_um) == 0.0)
        chords = self._chords((lower.is_arc | upper.is_arc) & ~alike & ~one_stands, heights_um)
        sweep = np.where(alike | one_stands, np.where(lower.is_arc, lower.sweep_rad, upper.sweep_rad), 0.0)
        return tuple(self._curves(chords, sweep, z_um) for z_um in heights_um), chords.row

    def _curves(self, chords: "_Chords", sweep_rad: Floats, z_um: float) -> Curves:
        """The curves of chords at a height; rows that turn by `sweep_rad` (n,) are arcs there."""
        row, since, until = chords
        share = self._share(z_um)
        start, end = self.places(row, since, z_um), self.places(row, until, z_um)
        low, high = (np.where(of.is_arc[:, None], of.center_um, of.start_um) for of in (self.lower, self.upper))
        center = (low + share * (high - low))[row]
        stands = np.hypot(*(start - center).T) < _NOTHING_UM
        made = curves_between(start, end, center, np.where(stands, 0.0, sweep_rad[row]))
        made.kind[self.is_jump[row]] = CurveKind.JUMP
        return made

    def _chords(self, bent: Bools, heights_um: Sequence[float], sagitta_um: float = _SAGITTA_UM) -> "_Chords":
        """Chords for rows that are bent, one for each of the others, near enough at both contours and some heights."""
        # A place moves by P(t) = (1 - w) L(t) + w U(t), and an arc of radius R that turns by s has |L''| = R s². A
        # chord over a share c of the row leaves the row by |P''| c² / 8.
        bends = [np.nan_to_num(of.radius_um) * of.sweep_rad**2 for of in (self.lower, self.upper)]
        shares = [0.0, 1.0, *map(self._share, heights_um)]
        bend = np.maximum.reduce([abs(1.0 - share) * bends[0] + abs(share) * bends[1] for share in shares])
        count = np.where(bent, np.maximum(np.ceil(np.sqrt(bend / (8.0 * sagitta_um))), 1.0), 1.0).astype(np.int64)
        row = np.repeat(np.arange(len(self)), count)
        number = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        return _Chords(row, number / count[row], (number + 1) / count[row])

    def _share(self, z_um: float) -> float:
        """A height as a share of the way from the lower contour to the upper one."""
        return (z_um - self.lower_z_um) / self.height_um

    def straightened(self, bent: Bools, sagitta_um: float) -> tuple["Ruled", Ints]:
        """The surface with some rows (n,) cut into chords, no farther off in both contours; and the row (k,) of each.

        The other rows stay as they are.
        """
        row, since, until = self._chords(bent, (), sagitta_um)
        at = np.where(bent[row], len(self) + np.arange(len(row)), row)
        straight = np.zeros(len(row))
        contours = [
            joined([of, curves_between(places(of, row, since), places(of, row, until), of.end_um[row], straight)])
            for of in (self.lower, self.upper)
        ]
        lower, upper = (of.picked(at) for of in contours)
        return Ruled(lower, upper, self.lower_z_um, self.upper_z_um), row

    def area_um2(self, rows: Ints, z_um: float) -> float:
        """Signed area within the closed section that rows (k,) make at a height, positive counter-clockwise.

        ½ ∮ P × dP by the rule of Gauss and Legendre in each row.
        """
        node, weight = np.polynomial.legendre.leggauss(_NODES)
        share, weight = 0.5 * (node + 1.0), 0.5 * weight
        row = np.repeat(rows, _NODES)
        at = np.tile(share, len(rows))
        w = self._share(z_um)
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


_UNEVEN: Final = 3.0
"""Partners, one of which has so many times the share of its contour that the other has, are most likely not meant for
each other: a square over a circle has 1.27, a slot over its taper of 10° 1.5."""
_SHORT_UM: Final = 500.0
"""Partners that are both shorter belong to corners."""
_STANDS_UM: Final = 1.0
"""What is shorter stands at a corner, but for rounding, while its partner moves."""


def uneven_partners(lower_um: Floats, upper_um: Floats) -> Bools:
    """(n,) whether partners are of very unequal length, µm, each against the size of its contour."""
    lower, upper = (length / max(float(length.sum()), 1.0) for length in (lower_um, upper_um))
    is_wall = (np.maximum(lower_um, upper_um) > _SHORT_UM) & (np.minimum(lower_um, upper_um) > _STANDS_UM)
    uneven: Bools = is_wall & (np.maximum(lower, upper) > _UNEVEN * np.minimum(lower, upper))
    return uneven


class _Chords(NamedTuple):
    """Row (k,) of each chord, and the shares (k,) of the row from which and to which it leads."""

    row: Ints
    since: Floats
    until: Floats


def _rates(curves: Curves, row: Ints, share: Floats) -> Floats:
    """Derivatives (m, 2) of places by the share."""
    rate = (curves.end_um - curves.start_um)[row]
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    angle = curves.start_angle_rad[on] + share[arc] * curves.sweep_rad[on]
    size = curves.radius_um[on] * curves.sweep_rad[on]
    rate[arc] = np.stack([-np.sin(angle) * size, np.cos(angle) * size], axis=1)
    return rate
