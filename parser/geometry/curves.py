"""Lines and arcs in absolute µm, as columns, one row a curve.

How far lines and arcs reach.

Whether places lie within closed contours of lines and arcs: by the angle that a contour turns about them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


class CurveKind(IntEnum):
    """What a row is: a cut along a line or an arc, or a line in the air without the wire cutting."""

    LINE = 0
    ARC = 1
    JUMP = 2


def box_of(place_um: Floats) -> Floats:
    """The lowest and the highest (x, y) of places (n, 2), n ≥ 1, as (2, 2): the box around them.

    Column by column: numpy takes 25 times as long over both in one go.
    """
    columns = place_um.T
    return np.array([[column.min() for column in columns], [column.max() for column in columns]])


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """n lines and arcs, absolute µm and rad, exact to double precision.

    Attributes
    ----------
    kind
        (n,) int64, values of `CurveKind`.
    start_um, end_um, center_um
        (n, 2) float64; the centre of a line is NaN.
    radius_um, start_angle_rad
        (n,) float64; NaN on lines.
    sweep_rad
        (n,) float64, signed, positive counter-clockwise; 0 on lines; beyond 2π for more than one turn.
    length_um
        (n,) float64, length along the curve.
    """

    kind: Ints
    start_um: Floats
    end_um: Floats
    center_um: Floats
    radius_um: Floats
    start_angle_rad: Floats
    sweep_rad: Floats
    length_um: Floats

    def __len__(self) -> int:
        return len(self.kind)

    @property
    def is_arc(self) -> Bools:
        """(n,) True on arcs."""
        arc: Bools = self.kind == CurveKind.ARC
        return arc

    @property
    def before_um(self) -> Floats:
        """(n + 1,) length of all curves before each one, and of all at the end."""
        return total_before(self.length_um)

    def picked(self, row: Ints | slice | Bools) -> "Curves":
        """The rows `row`, as bare curves."""
        return Curves(*(getattr(self, field.name)[row] for field in fields(Curves)))


def total_before(values: Floats) -> Floats:
    """(n + 1,) total of the values (n,) before each one, and of all at the end."""
    return np.concatenate([[0.0], np.cumsum(values)])


def curves_between(start_um: Floats, end_um: Floats, center_um: Floats, sweep_rad: Floats) -> Curves:
    """Curves (n,) from their ends (n, 2): lines where the sweep (n,) is 0, else arcs about the centres (n, 2).

    The radius is the distance of the start from the centre. A centre of a line is not looked at.
    """
    arc = sweep_rad != 0.0
    out = np.where(arc[:, None], start_um - center_um, np.nan)
    by = end_um - start_um
    radius = np.hypot(out[:, 0], out[:, 1])
    return Curves(
        kind=np.where(arc, CurveKind.ARC, CurveKind.LINE).astype(np.int64),
        start_um=start_um,
        end_um=end_um,
        center_um=np.where(arc[:, None], center_um, np.nan),
        radius_um=radius,
        start_angle_rad=np.arctan2(out[:, 1], out[:, 0]),
        sweep_rad=sweep_rad,
        length_um=np.where(arc, radius * np.abs(sweep_rad), np.hypot(by[:, 0], by[:, 1])),
    )


def joined(parts: Sequence[Curves]) -> Curves:
    """Rows of one or more parts, one behind the other."""
    return Curves(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(Curves)))


def jump_between(start_um: Floats, end_um: Floats) -> Curves:
    """One row: the jump from a place (2,) to another."""
    jump = curves_between(start_um[None], end_um[None], np.full((1, 2), np.nan), np.zeros(1))
    jump.kind[:] = CurveKind.JUMP
    return jump


def extents(curves: Curves) -> tuple[Floats, Floats]:
    """Lowest and highest places (n, 2) µm of each curve."""
    low = np.minimum(curves.start_um, curves.end_um)
    high = np.maximum(curves.start_um, curves.end_um)
    arc = np.flatnonzero(curves.is_arc)
    first = curves.start_angle_rad[arc] + np.minimum(curves.sweep_rad[arc], 0.0)
    reach = np.abs(curves.sweep_rad[arc])
    for quarter, (sign_x, sign_y) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        passed = np.mod(quarter * np.pi / 2.0 - first, 2.0 * np.pi) <= reach
        rows = arc[passed]
        extreme = curves.center_um[rows] + curves.radius_um[rows, None] * np.array([sign_x, sign_y])
        axis = int(sign_x == 0)
        low[rows, axis] = np.minimum(low[rows, axis], extreme[:, axis])
        high[rows, axis] = np.maximum(high[rows, axis], extreme[:, axis])
    return low, high


_FULL_RAD = 2.0 * np.pi


def is_inside(contour: Curves, place_um: Floats) -> Bools:
    """(m,) whether places (m, 2) lie within a closed contour: it turns once about those that do."""
    start = contour.start_um[None] - place_um[:, None]
    end = contour.end_um[None] - place_um[:, None]
    out = contour.center_um[None] - place_um[:, None]
    in_disc = np.hypot(out[..., 0], out[..., 1]) < contour.radius_um
    turned = turned_about(start, end, np.broadcast_to(contour.sweep_rad, in_disc.shape), in_disc).sum(axis=1)
    inside: Bools = np.abs(turned) > np.pi
    return inside


def turned_about(start: Floats, end: Floats, turn_rad: Floats, in_disc: Bools) -> Floats:
    """Signed angles (…) that lines and arcs from `start` to `end` (…, 2) turn about the origin.

    The angle is that of the chord, and a full turn more where the origin lies between chord and arc. `turn_rad` is 0 on
    lines; `in_disc` says where the origin is nearer to the centre of an arc than its radius.
    """
    cross = start[..., 0] * end[..., 1] - start[..., 1] * end[..., 0]
    chord = np.arctan2(cross, (start * end).sum(axis=-1))
    # On the chord itself, as in the middle of a half circle, the sign of a zero must not tell.
    chord = np.where((cross == 0.0) & in_disc, np.abs(chord) * np.sign(turn_rad), chord)
    beyond = (cross * turn_rad < 0.0) | (np.abs(turn_rad) >= _FULL_RAD)
    turned: Floats = chord + np.where(in_disc & beyond, _FULL_RAD * np.sign(turn_rad), 0.0)
    return turned
