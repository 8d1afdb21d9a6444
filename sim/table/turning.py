"""How a motor turns: from step to step, or as a position loop lets it. Its place over time has a corner at each change.

A position loop is one of a drive that works in periods, as they all do: at each look the motor is set to go on evenly,
until the next one, at

    v = gain · (command − place) + feed forward · (command − command at the look before) / period.

The place is that of the motor by its encoder, or that of the slide by a scale: then backlash, and what the drive train
gives way, lie within the loop. At an even feed v it stays v (1 − feed forward) / gain behind; where the command stands,
1 − gain · period of a way is left after each look (G. F. Franklin, J. D. Powell, M. L. Workman, "Digital Control of
Dynamic Systems", 3rd edition, 1998: a sampled first-order loop).
"""

import math
from typing import NamedTuple

import numpy as np

from controller.compiled.loops import compiled, loop_part
from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.setup.machine.motor import Motor

_EARLY = 1e-6
"""Share of a period by which rounding may move a look: 10⁻⁹ s of periods of 1 ms over months of cutting."""
_ARRIVED_UM = 1e-6
"""A motor this near to its command has come to it: what is left of a way never becomes 0."""


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
        Way that it makes in the time of a step, or in the period of its loop.
    begun, done
        Pulses whose steps have begun, and ended; of a loop both are the pulses that it has seen.
    look
        Number of the next look of a loop; 0 without one.
    """

    place_um: float
    t_s: float
    rising_um: float
    begun: int
    done: int
    look: int


class Loop(NamedTuple):
    """A position loop; `period_s` is 0 where none is closed.

    Attributes
    ----------
    period_s
        From look to look.
    gain, forward
        1/s, and the share of the command's own speed.
    in_position_um
        How near to a command that stands the motor stands too.
    by_scale
        Whether it looks at the slide, not at the motor.
    """

    period_s: float
    gain: float
    forward: float
    in_position_um: float
    by_scale: bool


_OPEN = Loop(0.0, 0.0, 0.0, 0.0, False)


def loop_of(motor: Motor) -> Loop:
    """The position loop of a motor."""
    own = motor.loop
    if own is None:
        return _OPEN
    return Loop(own.period_s, own.gain_per_s, own.feed_forward, own.in_position_um, own.feedback == "scale")


@compiled("b1(Loop)", Loop)
def is_closed(loop: Loop) -> bool:
    """Whether a loop is closed."""
    return loop.period_s > 0.0


@compiled("f8(Loop, f8)", Loop)
def looks_at_s(loop: Loop, t_s: float) -> float:
    """When a loop looks first at or after a time; infinite at infinity."""
    return float(np.ceil(t_s / loop.period_s - _EARLY) * loop.period_s)


@compiled("f8(Loop, Train, Turn, f8)", Loop, Train, Turn)
def away_um(loop: Loop, train: Train, turn: Turn, slide_um: float) -> float:
    """How far what a loop looks at is behind the command that it saw last."""
    return float(train.place_um[turn.begun] - (slide_um if loop.by_scale else turn.place_um))


@compiled("b1(Loop, Train, Turn, f8)", Loop, Train, Turn)
def is_idle(loop: Loop, train: Train, turn: Turn, slide_um: float) -> bool:
    """Whether a motor stands until the next pulse, if its slide stays at a place."""
    if turn.done < turn.begun or turn.rising_um != 0.0:
        return False
    return not is_closed(loop) or abs(away_um(loop, train, turn, slide_um)) <= max(loop.in_position_um, _ARRIVED_UM)


@loop_part("f8(Loop, f8, Train, Turn)", Loop, Train, Turn)
def corner_s(loop: Loop, step_time_s: float, train: Train, turn: Turn) -> float:
    """When the speed of a motor changes next."""
    if is_closed(loop):
        return turn.look * loop.period_s
    ends_s = train.t_s[turn.done] + step_time_s if turn.done < turn.begun else math.inf
    return float(min(train.t_s[turn.begun], ends_s))


@loop_part("(Loop, Train, Turn, f8)", Loop, Train, Turn)
def _looked(loop: Loop, train: Train, turn: Turn, slide_um: float) -> Turn:
    """A motor after a look of its loop, which is due."""
    at_s, before_um, seen = turn.look * loop.period_s, train.place_um[turn.begun], turn.begun
    place_um = turn.place_um + turn.rising_um * (at_s - turn.t_s) / loop.period_s
    while train.t_s[seen] <= at_s + _EARLY * loop.period_s:
        seen += 1
    came_um = train.place_um[seen] - before_um
    now = Turn(place_um, at_s, 0.0, seen, seen, turn.look + 1)
    behind_um = away_um(loop, train, now, slide_um)
    if came_um == 0.0 and abs(behind_um) <= max(loop.in_position_um, _ARRIVED_UM):
        arrived = not loop.by_scale and abs(behind_um) <= _ARRIVED_UM
        return Turn(train.place_um[seen] if arrived else place_um, at_s, 0.0, seen, seen, turn.look + 1)
    rising_um = loop.gain * loop.period_s * behind_um + loop.forward * came_um
    return Turn(place_um, at_s, rising_um, seen, seen, turn.look + 1)


@compiled("(Loop, Train, Turn, f8, f8)", Loop, Train, Turn)
def steered(loop: Loop, train: Train, turn: Turn, slide_um: float, t_s: float) -> Turn:
    """A motor of a closed loop at a later time, its slide at a place since the looks that come until then."""
    look = max(turn.look, int(np.ceil(turn.t_s / loop.period_s - _EARLY)))  # at rest it need not look
    turn = Turn(turn.place_um, turn.t_s, turn.rising_um, turn.begun, turn.done, look)
    while turn.look * loop.period_s <= t_s + _EARLY * loop.period_s:
        turn = _looked(loop, train, turn, slide_um)
    place_um = turn.place_um + turn.rising_um * (t_s - turn.t_s) / loop.period_s
    return Turn(place_um, t_s, turn.rising_um, turn.begun, turn.done, turn.look)


@compiled("(Train, f8, Turn, f8)", Train, Turn)
def turned(train: Train, step_time_s: float, turn: Turn, t_s: float) -> Turn:
    """The motor at a later time; it makes each step evenly in `step_time_s`, and steps that come faster add up."""
    place, since, rising, begun, done, look = turn
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
    return Turn(place, t_s, rising, begun, done, look)


@compiled("void(Train, f8, f8[::1], f8[::1])", Train)
def _turned_to(train: Train, step_time_s: float, t_s: Floats, place_um: Floats) -> None:
    """Fill in the places (n,) of the motor at rising times (n,)."""
    turn = Turn(train.place_um[0], 0.0, 0.0, 0, 0, 0)
    for at in range(len(t_s)):
        turn = turned(train, step_time_s, turn, t_s[at])
        place_um[at] = turn.place_um


def motors_um(pulses: Pulses, before_um: Floats, step_time_s: float, t_s: Floats) -> Floats:
    """Places (n, 2) of both motors at rising times (n,) s, where they turn from step to step.

    `before_um` (2,) is the place before the first pulse.
    """
    place_um = np.empty((2, len(t_s)))
    for before, column, into in zip(before_um, (pulses.x_um, pulses.y_um), place_um, strict=True):
        commanded = np.append(before, column.astype(np.float64))
        steps = np.flatnonzero(np.diff(commanded))
        train = Train(np.append(pulses.t_s[steps], np.inf), np.append(before, commanded[steps + 1]))
        _turned_to(train, step_time_s, np.ascontiguousarray(t_s), into)
    return place_um.T
