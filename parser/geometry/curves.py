"""Lines and arcs in absolute µm, as columns, one row a curve."""

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
