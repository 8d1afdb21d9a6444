"""The figures of the circular test, as ISO 230-4 (Test code for machine tools, part 4: circular tests) defines them.

Zones are taken about the least-squares circle's centre, which the standard allows beside the minimum zone; they are
never narrower than the minimum zone.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.run.ballbar.turn import GRID_RAD, MeasuredTurn


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
