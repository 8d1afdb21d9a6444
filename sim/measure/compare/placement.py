"""Where the drawing lies in the program's coordinates."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Floats


class Placement(NamedTuple):
    """A place x of the drawing lies at turned(mirrored(x)) + shift in the program's coordinates.

    Attributes
    ----------
    turn_rad
        Counter-clockwise about (0, 0), after the mirror.
    shift_um
        (x, y) after the turn.
    mirror
        Whether x → −x comes first.
    """

    turn_rad: float
    shift_um: tuple[float, float]
    mirror: bool


IN_PLACE = Placement(0.0, (0.0, 0.0), mirror=False)


def placed(curves: Curves, placement: Placement) -> Curves:
    """The curves moved, in their order; arcs stay arcs of their radii."""
    matrix, shift = turning(placement.turn_rad, mirror=placement.mirror), np.array(placement.shift_um)
    side = -1.0 if placement.mirror else 1.0
    start = curves.start_angle_rad * side + (np.pi if placement.mirror else 0.0) + placement.turn_rad
    return Curves(
        kind=curves.kind,
        start_um=curves.start_um @ matrix.T + shift,
        end_um=curves.end_um @ matrix.T + shift,
        center_um=curves.center_um @ matrix.T + shift,
        radius_um=curves.radius_um,
        start_angle_rad=start,
        sweep_rad=curves.sweep_rad * side,
        length_um=curves.length_um,
    )


def turning(turn_rad: float, *, mirror: bool = False) -> Floats:
    """Matrix (2, 2) of a turn, behind x → −x where mirrored."""
    cos, sin = np.cos(turn_rad), np.sin(turn_rad)
    matrix = np.array([[cos, -sin], [sin, cos]])
    return matrix @ np.diag([-1.0, 1.0]) if mirror else matrix


def scaled(curves: Curves, factor: float) -> Curves:
    """The curves `factor` times as large about (0, 0)."""
    return replace(
        curves.picked(slice(None)),
        start_um=curves.start_um * factor,
        end_um=curves.end_um * factor,
        center_um=curves.center_um * factor,
        radius_um=curves.radius_um * factor,
        length_um=curves.length_um * factor,
    )
