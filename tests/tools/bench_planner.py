"""The planner beside others, on the same rows in one run: ruckig, state to state a row, and the plain planner."""

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from plain_planner import plain_duration
from ruckig import InputParameter, Result, Ruckig, Trajectory

from controller.motion.planner import RowLimits, plan_rows
from controller.motion.s_curve import Stretches, border_speeds
from parser.geometry.curves import Floats

JERK_UM_S3 = 1e7
MM = 1e-3
"""ruckig's tolerances are absolute: it is asked in mm, since in µm it fails on some rows (0.19.4)."""
BELOW = 1.0 - 1e-10
"""Of a border speed, what ruckig is asked to reach: it takes no state that the last bits put out of reach."""


class Comparison(NamedTuple):
    """Seconds to plan the same rows: here and plain without a jerk limit, here and by ruckig with one.

    ruckig is told the border speeds, whose look-ahead is not counted against it; `rows` are those with length.
    """

    rows: int
    ours_s: float
    plain_s: float
    ours_jerk_s: float
    ruckig_s: float


def compare(limits: RowLimits, rounds: int = 3) -> Comparison:
    """Time every planner, the fastest of some rounds, and raise ValueError where they do not find the same plan."""
    moves = limits.length_um > 0.0
    stretches = Stretches(*(column[moves] for column in limits[:3]))
    if not moves.all() or limits.wait_s.any():
        raise ValueError("rows with length and without waits are compared")
    limit = limits.border_um_s.copy()
    np.minimum(limit[:-1], stretches.speed_um_s, out=limit[:-1])
    np.minimum(limit[1:], stretches.speed_um_s, out=limit[1:])
    borders = border_speeds(stretches, limit, JERK_UM_S3)
    ours_s, ours = _timed(lambda: plan_rows(limits).duration_s, rounds)
    jerk_s, jerked = _timed(lambda: plan_rows(limits, jerk_um_s3=JERK_UM_S3).duration_s, rounds)
    plain_s, plain = _timed(lambda: plain_duration(limits), 1)
    ruckig_s, state_to_state = _timed(lambda: ruckig_duration(stretches, borders * BELOW), 1)
    if abs(ours / plain - 1.0) > 1e-9 or jerked > state_to_state * (1.0 + 1e-8):
        raise ValueError(f"plans of {ours} and {plain} s, under a jerk limit of {jerked} and {state_to_state} s")
    return Comparison(len(stretches.length_um), ours_s, plain_s, jerk_s, ruckig_s)


def ruckig_duration(stretches: Stretches, border_um_s: Floats) -> float:
    """Time of the whole path in which ruckig runs each row from border speed to border speed."""
    planner, state, trajectory = Ruckig(1), InputParameter(1), Trajectory(1)
    state.current_position, state.max_jerk = [0.0], [JERK_UM_S3 * MM]
    total = 0.0
    speeds = (border_um_s * MM).tolist()
    rows = zip(*((column * MM).tolist() for column in stretches), speeds[:-1], speeds[1:], strict=True)
    for length, speed, a, first, last in rows:
        state.target_position, state.current_velocity, state.target_velocity = [length], [first], [last]
        state.max_velocity, state.max_acceleration = [speed], [a]
        if planner.calculate(state, trajectory) != Result.Working:
            raise ValueError(f"ruckig finds no motion over {length} mm from {first} to {last} mm/s")
        total += trajectory.duration
    return total


def _timed(run: Callable[[], float], rounds: int) -> tuple[float, float]:
    times = []
    for _ in range(rounds):
        began = time.perf_counter()
        duration = run()
        times.append(time.perf_counter() - began)
    return min(times), duration
