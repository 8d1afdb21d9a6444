"""One axis of the table, plainly: the same model written from its description, in tiny ticks, one after the other."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

TICK_S = 2e-6


@dataclass(frozen=True, slots=True)
class PlainAxis:
    """A mass behind a spring and damper with slack, against friction; N, kg, µm, s.

    A stepper slips by whole `period_um` where it lags too far.
    """

    mass_kg: float
    stiffness_n_um: float
    ratio: float
    friction_n: float = 0.0
    viscous_n_s_mm: float = 0.0
    backlash_um: float = 0.0
    force_n: float = math.inf
    period_um: float = 6.0


def plain_motor(step_s: list[float], place_um: list[int], step_time_s: float, until_s: float) -> list[float]:
    """Places of a motor at the ends of the ticks: ramps from step to step, summed up at their corners."""
    slopes: dict[float, float] = {0.0: 0.0}
    before = 0
    for t_s, place in zip(step_s, place_um, strict=True):
        slope = (place - before) / step_time_s
        slopes[t_s] = slopes.get(t_s, 0.0) + slope
        slopes[t_s + step_time_s] = slopes.get(t_s + step_time_s, 0.0) - slope
        before = place
    times, places, slope = sorted(slopes), [0.0], 0.0
    for begin, end in pairwise(times):
        slope += slopes[begin]
        places.append(places[-1] + slope * (end - begin))
    ticks = np.arange(round(until_s / TICK_S) + 1) * TICK_S
    return np.interp(ticks, times, places).tolist()


def plain_places(axis: PlainAxis, motor_um: list[float]) -> tuple[list[float], list[float]]:
    """Places of the slide at the start of each tick, and the slips of the motor.

    Steps of explicit velocity and then place (semi-implicit Euler); friction takes from the velocity what it can.
    """
    per_n = 1e6 / axis.mass_kg  # µm/s² for a newton
    stiffness, slack = axis.stiffness_n_um, axis.backlash_um / 2.0
    damping = 2.0 * axis.ratio * math.sqrt(stiffness * 1e6 * axis.mass_kg) / 1e6  # N s/µm
    viscous, rub = axis.viscous_n_s_mm / 1e3, axis.friction_n * per_n * TICK_S
    pull_out = axis.force_n / stiffness + slack + axis.period_um / 2.0
    at = velocity = lost = 0.0
    places, slips = [], []
    for here, there in pairwise(motor_um):
        places.append(at)
        lag = here - lost - at
        if abs(lag) > pull_out:
            slip = math.copysign(math.ceil((abs(lag) - pull_out) / axis.period_um) * axis.period_um, lag)
            slips.append(slip)
            lost += slip
            lag -= slip
        past = lag - slack if lag > slack else lag + slack if lag < -slack else 0.0
        force = 0.0
        if past or not slack:
            force = stiffness * past + damping * ((there - here) / TICK_S - velocity)
            force = max(-axis.force_n, min(axis.force_n, force))
            if slack and force * past < 0.0:  # a flank pushes, and never pulls
                force = 0.0
        velocity += TICK_S * per_n * (force - viscous * velocity)
        velocity -= max(-rub, min(rub, velocity))
        at += TICK_S * velocity
    return places, slips
