"""A measured turn: where the table went on one full circle, seen from the circle's centre."""

from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from parser.geometry.curves import Floats

Sense = Literal[1, -1]
SENSES: Final[tuple[Sense, Sense]] = (1, -1)
"""Counter-clockwise and clockwise, the order in which the two directions are run and told."""
NAMES: Final[dict[Sense, str]] = {1: "ccw", -1: "cw"}

_TURN: Final = 2.0 * np.pi
GRID: Final = 14_400
GRID_RAD: Final = np.asarray((np.arange(GRID) + 0.5) * (_TURN / GRID), dtype=np.float64)
"""Directions, 40 to the degree, in which turns are compared and fitted, each weighing alike; none lies on an axis."""
WIDEST_GAP_RAD: Final = np.radians(5.0)
"""A turn with a wider hole in its directions is none."""


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredTurn:
    """One full circle in one direction.

    Attributes
    ----------
    sense
        1 counter-clockwise, −1 clockwise.
    points_um
        (n, 2) float64, places in the order of time, from the nominal centre.
    """

    sense: Sense
    points_um: Floats

    def angles_rad(self) -> Floats:
        """Directions (n,) of the places, 0 to 2π, 0 along +X."""
        return _angles(self.points_um)

    def radii_um(self, center_um: Floats) -> Floats:
        """Distances (n,) from a centre (2,), itself from the nominal one."""
        return _radii(self.points_um - center_um)

    def radii_on_grid(self, center_um: Floats) -> Floats:
        """Distances (`GRID`,) from a centre (2,), each the mean over its cell of the grid around that centre."""
        points = self.points_um - center_um
        return _cell_means(_angles(points), _radii(points))

    @property
    def goes_round(self) -> bool:
        """Whether its places lie all around the centre."""
        if not len(self.points_um):
            return False
        angles = np.sort(self.angles_rad())
        gaps = np.diff(angles, append=angles[0] + _TURN)
        return bool(gaps.max() <= WIDEST_GAP_RAD)


def _angles(points: Floats) -> Floats:
    angles: Floats = np.mod(np.arctan2(points[:, 1], points[:, 0]), _TURN)
    return angles


def _radii(points: Floats) -> Floats:
    radii: Floats = np.hypot(points[:, 0], points[:, 1])
    return radii


def _cell_means(angle: Floats, value: Floats) -> Floats:
    """Means (`GRID`,) over the cells of the grid of what is `value` (n,) at angles (n,) and straight between them."""
    order = np.argsort(angle, kind="stable")
    around = np.concatenate([angle[order[-1:]] - _TURN, angle[order], angle[order[:1]] + _TURN])
    values = value[np.concatenate([order[-1:], order, order[:1]])]
    area = np.cumsum(np.diff(around) * (values[1:] + values[:-1]) / 2.0)
    borders = np.arange(GRID + 1) * (_TURN / GRID)
    means: Floats = np.diff(np.interp(borders, around, np.concatenate([[0.0], area]))) * (GRID / _TURN)
    return means
