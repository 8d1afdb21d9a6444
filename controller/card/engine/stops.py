"""Stops: braking along the path to rest."""

import numpy as np

from controller.motion.plan import EMPTY_PLAN, Plan
from controller.motion.planner import RowLimits


def braking(limits: RowLimits, speed_um_s: float, deceleration_um_s2: float) -> tuple[Plan, float]:
    """Plan from `speed_um_s` to rest, and the deceleration it takes.

    That is the least constant one, `deceleration_um_s2` or more, that keeps the speed of every border ahead: with
    ``v² − 2 a s``, a speed w at distance s takes a ≥ (v² − w²) / 2 s. At the end of the rows it stops with what the
    border allows. Which deceleration the card takes where the set one is too weak for a corner is grade C; so is that a
    stop knows no jerk limit.
    """
    ends = np.cumsum(limits.length_um)
    ahead = ends > 0.0
    if speed_um_s <= 0.0 or not ahead.any():
        return EMPTY_PLAN, deceleration_um_s2
    square = speed_um_s**2
    needed = (square - limits.border_um_s[1:][ahead] ** 2) / (2.0 * ends[ahead])
    a = max(deceleration_um_s2, float(needed.max()))
    way = min(square / (2.0 * a), float(ends[-1]))
    last = max(square - 2.0 * a * way, 0.0) ** 0.5
    time = 2.0 * way / (speed_um_s + last)
    columns = ([0.0, way], [0.0, time], [speed_um_s], [-a], [0.0])
    return Plan(*(np.array(column) for column in columns)), a
