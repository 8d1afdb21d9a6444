"""What a motor can do at its step rate: the force that it has left, and the lag that it holds."""

from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats
from sim.base.units import engine_force
from sim.setup.machine.motor import Motor
from sim.table.drive import Drive
from sim.table.turning import Train

RATE_WINDOW_S = 0.02
"""Time over which the step rate is taken, to each side; 50 Hz is one step of it. It is taken anew as often."""


class Strength(NamedTuple):
    """What a motor can do on its axis.

    Attributes
    ----------
    rate_hz, limit
        (p,), step rates, rising from 0, and largest force over the mass at each, µm/s².
    spring, slack_um
        Those of its drive.
    period_um
        Electrical period of a stepper; infinite for a servo, which does not slip.
    """

    rate_hz: Floats
    limit: Floats
    spring: float
    slack_um: float
    period_um: float


class Rating(NamedTuple):
    """What a motor can do at its step rate.

    Attributes
    ----------
    limit
        Largest force over the mass, µm/s².
    pull_out_um
        Lag at which a stepper slips: its train wound up by its largest force, slack, half a period. Half a period from
        where it belongs a rotor stands between two places alike: the unstable balance of its torque over its angle,
        past which it falls to the next. Infinite for servos.
    until_s
        When the rate is taken anew.
    first, last
        Pulses before the time over which the rate was taken, and by its end.
    """

    limit: float
    pull_out_um: float
    until_s: float
    first: int
    last: int


@loop_part("f8(Strength, f8)", Strength)
def limit_at(strength: Strength, rate_hz: float) -> float:
    """Largest force over the mass at a step rate: linear between the points of the curve, constant past the last."""
    rates, limits = strength.rate_hz, strength.limit
    after = 0
    while after < len(rates) and rates[after] <= rate_hz:
        after += 1
    if after == len(rates):
        return float(limits[after - 1])
    share = (rate_hz - rates[after - 1]) / (rates[after] - rates[after - 1])
    return float(limits[after - 1] + share * (limits[after] - limits[after - 1]))


@compiled("(Strength, Train, Rating, f8)", Strength, Train, Rating)
def rated(strength: Strength, train: Train, before: Rating, t_s: float) -> Rating:
    """What a motor can do from a time on: the rate is that about the middle of the time for which it will hold."""
    middle_s, first, last = t_s + RATE_WINDOW_S / 2.0, before.first, before.last
    while train.t_s[first] <= middle_s - RATE_WINDOW_S:
        first += 1
    while train.t_s[last] <= middle_s + RATE_WINDOW_S:
        last += 1
    rate_hz = abs(train.place_um[last] - train.place_um[first]) / (2.0 * RATE_WINDOW_S)
    limit = limit_at(strength, rate_hz)
    pull_out_um = limit / strength.spring + strength.slack_um + strength.period_um / 2.0
    return Rating(limit, pull_out_um, t_s + RATE_WINDOW_S, first, last)


def strength_of(motor: Motor, drive: Drive) -> Strength:
    """What a motor can do on a drive."""
    rate_hz, force_n = np.array(motor.force_curve).T
    period_um = motor.electrical_period_um if motor.kind == "stepper" else np.inf
    limit = engine_force(force_n) / drive.mass_kg
    return Strength(np.ascontiguousarray(rate_hz), limit, drive.spring, drive.slack_um, period_um)
