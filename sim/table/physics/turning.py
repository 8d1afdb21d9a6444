"""A motor that turns from step to step: its place over time has a corner where a step begins, and where it ends."""

import math
from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats


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
