"""What a motor can do at its step rate: the force that it has left, and the lag that it holds.

A motor that turns from step to step: its place over time has a corner where a step begins, and where it ends.
"""

import math
from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.base.units import engine_force
from sim.setup.machine.table import Motor
from sim.table.drive import Drive


class Train(NamedTuple):
    """The pulses of one axis, n of them known.

    Attributes
    ----------
    t_s
        (n + 1,), time of each pulse, and infinity.
    place_um
        (n + 1,), place commanded before each pulse, and after the last.
    """

    t_s: Floats
    place_um: Floats


class Turn(NamedTuple):
    """Where a motor stands.

    Attributes
    ----------
    place_um, t_s
        Its place, and the time of it.
    rising_um
        Sum of the steps that it is just making.
    begun, done
        Pulses whose steps have begun, and ended.
    """

    place_um: float
    t_s: float
    rising_um: float
    begun: int
    done: int


@compiled("(Train, f8, Turn, f8)", Train, Turn)
def turned(train: Train, step_time_s: float, turn: Turn, t_s: float) -> Turn:
    """The motor at a later time; it makes each step evenly in `step_time_s`, and steps that come faster add up."""
    place, since, rising, begun, done = turn
    while True:
        begins = train.t_s[begun]
        ends = train.t_s[done] + step_time_s if done < begun else math.inf
        corner = min(begins, ends)
        if corner > t_s:
            break
        if rising != 0.0:
            place += rising * (corner - since) / step_time_s
        since = corner
        if ends <= begins:
            rising -= train.place_um[done + 1] - train.place_um[done]
            done += 1
        else:
            rising += train.place_um[begun + 1] - train.place_um[begun]
            begun += 1
        if done == begun:
            place = train.place_um[done]
    if rising != 0.0:
        place += rising * (t_s - since) / step_time_s
    return Turn(place, t_s, rising, begun, done)


@compiled("void(Train, f8, f8[::1], f8[::1])", Train)
def _turned_to(train: Train, step_time_s: float, t_s: Floats, place_um: Floats) -> None:
    """Fill in the places (n,) of the motor at rising times (n,)."""
    turn = Turn(train.place_um[0], 0.0, 0.0, 0, 0)
    for at in range(len(t_s)):
        turn = turned(train, step_time_s, turn, t_s[at])
        place_um[at] = turn.place_um


def motors_um(pulses: Pulses, before_um: Floats, step_time_s: float, t_s: Floats) -> Floats:
    """Places (n, 2) of both motors at rising times (n,) s; `before_um` (2,) is the place before the first pulse."""
    place_um = np.empty((2, len(t_s)))
    for before, column, into in zip(before_um, (pulses.x_um, pulses.y_um), place_um, strict=True):
        commanded = np.append(before, column.astype(np.float64))
        steps = np.flatnonzero(np.diff(commanded))
        train = Train(np.append(pulses.t_s[steps], np.inf), np.append(before, commanded[steps + 1]))
        _turned_to(train, step_time_s, np.ascontiguousarray(t_s), into)
    return place_um.T


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
