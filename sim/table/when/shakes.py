"""Shakes: where the velocity changes by enough to be felt, along the path and round its corners."""

import numpy as np

from controller.motion.plan import Plan
from parser.geometry.curves import Floats
from parser.geometry.directions import directions
from parser.toolpath import Toolpath
from sim.table.when.rhythm import Rhythm

FELT_UM = 0.25
"""Ringing of less than this is not finer resolved than a step."""


def shakes(toolpath: Toolpath, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
    """Windows (n, 2) s from each shake until it has died: ramps of speed, corners."""
    ramps, corners = _ramps(plan, rhythm), _corners(toolpath, plan, before, rhythm)
    windows = np.concatenate([ramps, np.stack([corners, corners], axis=1)])
    windows[:, 1] += rhythm.died_s
    return windows


def _ramps(plan: Plan, rhythm: Rhythm) -> Floats:
    """Phases (n, 2) s that bend the drives enough: lag is a / ω², and no more than Δv / ω."""
    time = np.diff(plan.time_s)
    ends = plan.acceleration_um_s2 + plan.jerk_um_s3 * time
    lag = np.maximum(np.abs(plan.acceleration_um_s2), np.abs(ends)) / rhythm.frequency**2
    change = np.abs(plan.acceleration_um_s2 + ends) * time / 2.0
    felt = np.minimum(lag, change / rhythm.frequency) > FELT_UM
    return np.stack([plan.time_s[:-1], plan.time_s[1:]], axis=1)[felt]


def _corners(toolpath: Toolpath, plan: Plan, before: Floats, rhythm: Rhythm) -> Floats:
    """Times of the block borders at which the velocity jumps enough: swing is Δv / ω."""
    ways = directions(toolpath)
    change = ways.leaving[1:] - ways.arriving[:-1]
    turn = np.hypot(change[:, 0], change[:, 1])
    speed = plan.speed_at(before[1:-1])
    shakes: Floats = plan.time_at(before[1:-1])[turn * speed / rhythm.frequency > FELT_UM]
    return shakes
