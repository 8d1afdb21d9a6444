"""Junctions: how fast the border between two rows may be passed, by the rule of the controller.

The turn is the angle between the direction of leaving one row and of entering the next, 0 straight on, π back. Rows
without length have no direction: the rows around them meet, at the border behind the first of the two.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from controller.motion.path import Path
from parser.geometry.curves import Floats, Ints

STRAIGHT_RAD = 1e-12
"""A turn of less is rounding: a line cut in two turns by some 10⁻¹⁶, by more the longer the way from the origin."""


class Through(NamedTuple):
    """Full speed through every junction."""


class SlowAt(NamedTuple):
    """No more than a speed at corners."""

    speed_um_s: float


class StopEach(NamedTuple):
    """Every block ends at rest."""


class JunctionDeviation(NamedTuple):
    """As fast as a circle that touches both directions and leaves the corner by `deviation_um` could be run.

    ``v² = a δ sin(θ/2) / (1 − sin(θ/2))`` with θ between the two rows, π − turn (S. Jeon, "Improving Grbl: Cornering
    Algorithm", 2011; grbl, planner.c).
    """

    deviation_um: float


class CornerTime(NamedTuple):
    """As fast as an acceleration can turn the velocity within a time: ``2 v sin(turn/2) ≤ A T``."""

    time_s: float
    acceleration_um_s2: float


Junction: TypeAlias = Through | SlowAt | StopEach | JunctionDeviation | CornerTime


def junction_speeds(path: Path, rule: Junction, corner_angle_rad: float, acceleration_um_s2: Floats) -> Floats:
    """Highest speed (n − 1,) µm/s at each border inside a path of n rows; inf where nothing limits.

    A turn of more than `corner_angle_rad` is a corner, to the rules that know corners; `acceleration_um_s2` (n,) is
    that of each row, to the rule that takes it from there.
    """
    if isinstance(rule, Through):
        return np.full(max(len(path) - 1, 0), np.inf)
    turn = turns(path)
    match rule:
        case SlowAt(speed_um_s=speed):
            return np.where(turn > corner_angle_rad, speed, np.inf)
        case JunctionDeviation(deviation_um=deviation):
            return _deviation_speeds(turn, deviation, _at_meetings(path, acceleration_um_s2))
        case CornerTime(time_s=time, acceleration_um_s2=acceleration):
            return _over(acceleration * time, 2.0 * np.sin(turn / 2.0))
    # What remains is the rule to stop at each block, whatever the turn.
    return np.zeros_like(turn)


def turns(path: Path) -> Floats:
    """Turn (n − 1,) rad, 0 to π, at each border inside a path of n rows; 0 where it is no more than rounding."""
    before, after = _meetings(path)
    leaving, entering = path.leaving[before], path.tangent[after]
    turn = np.zeros(max(len(path) - 1, 0))
    # Exact for small angles and near π, where the arc cosine of the dot product is not (W. Kahan, 2006).
    turn[before] = 2.0 * np.arctan2(_norm(leaving - entering), _norm(leaving + entering))
    turn[turn < STRAIGHT_RAD] = 0.0
    return turn


def _deviation_speeds(turn: Floats, deviation_um: float, acceleration: Floats) -> Floats:
    # sin(θ/2) = cos(turn/2), and 1 − cos(turn/2) = 2 sin²(turn/4) without loss.
    radius = _over(deviation_um * np.cos(turn / 2.0), 2.0 * np.sin(turn / 4.0) ** 2)
    speeds: Floats = np.sqrt(acceleration * radius)
    return speeds


def _meetings(path: Path) -> tuple[Ints, Ints]:
    """Rows with length, each but the last, and the row with length after it."""
    moving = np.flatnonzero(path.length_um > 0.0)
    return moving[:-1], moving[1:]


def _at_meetings(path: Path, acceleration: Floats) -> Floats:
    """The less of the accelerations of the two rows that meet at each border; 1 where none do."""
    before, after = _meetings(path)
    least = np.ones(max(len(path) - 1, 0))
    least[before] = np.minimum(acceleration[before], acceleration[after])
    return least


def _over(dividend: float | Floats, divisor: Floats) -> Floats:
    return np.divide(dividend, divisor, out=np.full_like(divisor, np.inf), where=divisor > 0.0)


def _norm(vectors: Floats) -> Floats:
    norm: Floats = np.sqrt(np.sum(vectors * vectors, axis=1))
    return norm
