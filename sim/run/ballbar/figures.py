"""The figures of the circular test, as ISO 230-4 (Test code for machine tools, part 4: circular tests) defines them.

Zones are taken about the least-squares circle's centre, which the standard allows beside the minimum zone; they are
never narrower than the minimum zone.

A measured turn: where the table went on one full circle, seen from the circle's centre.
"""

from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

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


class Direction(NamedTuple):
    """Figures of one direction, µm.

    Attributes
    ----------
    circularity_um
        Circular deviation G: width of the ring about the least-squares centre that holds the path.
    radial_max_um, radial_min_um
        Radial deviation F, largest and smallest: path from the nominal circle, about the nominal centre.
    mean_radius_um
        Radius of the least-squares circle less the nominal one.
    """

    circularity_um: float
    radial_max_um: float
    radial_min_um: float
    mean_radius_um: float


class Figures(NamedTuple):
    """Figures of both directions, µm.

    Attributes
    ----------
    circularity_um
        Bi-directional circular deviation G(b): width of the ring about the common least-squares centre that holds
        both paths.
    mean_radial_um
        Mean bi-directional radial deviation D: radius of the least-squares circle of both paths less the nominal one.
    hysteresis_um
        Circular hysteresis H of the standard's first edition (1996): largest radial difference of the two paths in one
        direction from the common centre.
    center_um
        Common least-squares centre (x, y) from the nominal one.
    ccw, cw
        Of each direction.
    """

    circularity_um: float
    mean_radial_um: float
    hysteresis_um: float
    center_um: tuple[float, float]
    ccw: Direction
    cw: Direction


def figures_of(ccw: MeasuredTurn, cw: MeasuredTurn, radius_um: float) -> Figures:
    """Figures of two turns that go round on a nominal radius."""
    center, mean = least_squares_circle(ccw, cw)
    radii = np.concatenate([ccw.radii_um(center), cw.radii_um(center)])
    apart = np.abs(ccw.radii_on_grid(center) - cw.radii_on_grid(center))
    return Figures(
        circularity_um=float(np.ptp(radii)),
        mean_radial_um=mean - radius_um,
        hysteresis_um=float(apart.max()),
        center_um=(float(center[0]), float(center[1])),
        ccw=_direction(ccw, radius_um),
        cw=_direction(cw, radius_um),
    )


def circularity(turn: MeasuredTurn) -> float:
    """Circular deviation G of one turn, µm."""
    return float(np.ptp(turn.radii_um(least_squares_circle(turn)[0])))


def least_squares_circle(*turns: MeasuredTurn) -> tuple[Floats, float]:
    """Centre (2,) µm from the nominal one, and radius µm, of the circle that fits the turns best.

    In closed form, by I. Kåsa, "A circle fitting procedure and its error analysis", IEEE Trans. Instrum. Meas. 25
    (1976): the circle x² + y² = 2ax + 2by + c is linear in a, b and c. It equals the least-squares circle but for
    terms of (deviation / radius)².
    """
    unit = np.stack([np.cos(GRID_RAD), np.sin(GRID_RAD)], axis=1)
    points = np.concatenate([turn.radii_on_grid(np.zeros(2))[:, None] * unit for turn in turns])
    scale = float(np.abs(points).max())
    u = points / scale
    (a, b, c), *_ = np.linalg.lstsq(np.column_stack([2.0 * u, np.ones(len(u))]), (u**2).sum(axis=1))
    return np.array([a, b]) * scale, float(np.sqrt(c + a**2 + b**2)) * scale


def _direction(turn: MeasuredTurn, radius_um: float) -> Direction:
    off = turn.radii_um(np.zeros(2)) - radius_um
    return Direction(
        circularity_um=circularity(turn),
        radial_max_um=float(off.max()),
        radial_min_um=float(off.min()),
        mean_radius_um=least_squares_circle(turn)[1] - radius_um,
    )
