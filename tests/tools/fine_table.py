"""One axis of the table in ticks of some nanoseconds: the same model written from its description, without events.

Explicit velocity and then place (semi-implicit Euler): its error falls with the tick. Where neighbouring inputs part, a
slide between the flanks of its nut without friction, it does not settle: `settled` says where it does.
"""

import math
from typing import Any, NamedTuple

import numba
import numpy as np

from parser.geometry.curves import Floats
from sim.setup.machine.table import TableModel

TICKS_S = (1e-7, 1e-8, 1e-9)
"""Ticks of which the last two that are tried have to agree."""


class FineAxis(NamedTuple):
    """An axis over its moved mass, kg: k/m 1/s², damper 1/s, friction µm/s², viscous 1/s, half the backlash µm.

    Then the largest force over the mass, µm/s², the electrical period, µm, the time of a step, s, the ends of the
    travel, µm; and of a position loop its period, s, 0 without one, gain, 1/s, feed forward, how near is near enough,
    µm, and whether it looks at the slide.
    """

    mass_kg: float
    spring: float
    damper: float
    friction: float
    viscous: float
    slack_um: float
    limit: float
    period_um: float
    step_time_s: float
    low_um: float = -1e9
    high_um: float = 1e9
    look_s: float = 0.0
    gain: float = 0.0
    forward: float = 0.0
    near_um: float = 0.0
    by_scale: bool = False


def fine_axis(model: TableModel, axis: int) -> FineAxis:
    """An axis of a model whose motor is as strong at all rates; units worked out here by themselves."""
    mass = (model.saddle_mass_kg, 0.0)[axis] + model.carriage_mass_kg
    spring = model.drive_stiffness_n_um * 1e6 / mass
    return FineAxis(
        mass_kg=mass,
        spring=spring,
        damper=2.0 * model.drive_damping_ratio * math.sqrt(spring),
        friction=model.friction_n[axis] * 1e6 / mass,
        viscous=model.viscous_n_s_mm[axis] * 1e3 / mass,
        slack_um=model.backlash_um[axis] / 2.0,
        limit=model.motor.force_curve[0][1] * 1e6 / mass,
        period_um=model.motor.electrical_period_um,
        step_time_s=model.motor.step_time_s,
        **_loop(model),
    )


def _loop(model: TableModel) -> dict[str, Any]:
    loop = model.motor.loop
    if loop is None:
        return {}
    return {
        "look_s": loop.period_s,
        "gain": loop.gain_per_s,
        "forward": loop.feed_forward,
        "near_um": loop.in_position_um,
        "by_scale": loop.feedback == "scale",
    }


class Fine(NamedTuple):
    """What an axis does in fine ticks.

    Attributes
    ----------
    at_um
        (n,) places at the samples.
    lost_um
        Way lost, and all of it where it was made good.
    farthest
        (3,) how far velocity, µm/s, lag, µm, and force over the mass, µm/s², come from 0.
    settled
        Whether finer ticks agree.
    """

    at_um: Floats
    lost_um: float
    farthest: Floats
    settled: bool


def followed(axis: FineAxis, t_s: Floats, place_um: Floats, sample_s: Floats, within_um: float = 0.01) -> Fine:
    """An axis that follows steps at times (m,) to places (m,), in ever finer ticks until two agree."""
    before = None
    for tick_s in TICKS_S:
        at_um, farthest = np.empty(len(sample_s)), np.zeros(3)
        lost_um = _run(axis, (t_s, place_um), sample_s, tick_s, (at_um, farthest))
        if before is not None and lost_um == before.lost_um and np.abs(at_um - before.at_um).max() < within_um:
            return Fine(at_um, lost_um, farthest, True)
        before = Fine(at_um, lost_um, farthest, False)
    assert before is not None
    return before


@numba.njit
def _run(axis, steps, sample_s, tick_s, into):  # type: ignore[no-untyped-def]
    """Fill in the places of the slide at the samples, and how far it comes; what its motor lost in all."""
    at_um, farthest = into
    at = velocity = lost = lost_either_way = 0.0
    span, sample, begin_s, number, loop = (0, 0), 0, 0.0, 0, (0.0, 0.0, 0.0, 0.0, 0)
    while sample < len(sample_s):
        now, number = begin_s + number * tick_s, number + 1
        while sample < len(sample_s) and sample_s[sample] <= now:
            at_um[sample] = at
            sample += 1
        if axis.look_s > 0.0:
            if now >= loop[4] * axis.look_s - 1e-13:
                loop = _looked(axis, steps, loop, at)
            motor, speed = loop[0] + loop[1] * (now - loop[2]), loop[1]
            turn_s, tick = loop[4] * axis.look_s, tick_s
        else:
            motor, speed, span = _motor(axis, steps, now, span)
            turn_s, tick = _next_turn(axis, steps, span), tick_s
        if now + tick_s >= turn_s:
            begin_s, number, tick = turn_s, 0, turn_s - now
        slip = _slip(axis, motor - lost - at)
        lost, lost_either_way = lost + slip, lost_either_way + abs(slip)
        force = _force(axis, motor - lost - at, speed, velocity)
        farthest[0], farthest[1] = max(farthest[0], abs(velocity)), max(farthest[1], abs(motor - lost - at))
        farthest[2] = max(farthest[2], abs(force))
        velocity += tick * (force - axis.viscous * velocity)
        rub = axis.friction * tick
        velocity = max(velocity - rub, 0.0) + min(velocity + rub, 0.0)
        at += tick * velocity
        if at >= axis.high_um or at <= axis.low_um:
            at, velocity = min(max(at, axis.low_um), axis.high_um), 0.0
    return lost if lost != 0.0 else lost_either_way


@numba.njit
def _looked(axis, steps, loop, at):  # type: ignore[no-untyped-def]
    """Place, speed and time of the motor, the command that its loop sees, and the number of its next look."""
    (t_s, place_um), (place, speed, since, seen, number) = steps, loop
    now = number * axis.look_s
    place += speed * (now - since)
    due = np.searchsorted(t_s, now + 1e-6 * axis.look_s, side="right")
    command = place_um[due - 1] if due > 0 else 0.0
    behind = command - (at if axis.by_scale else place)
    if command == seen and abs(behind) <= axis.near_um:
        return place, 0.0, now, command, number + 1
    return place, axis.gain * behind + axis.forward * (command - seen) / axis.look_s, now, command, number + 1


@numba.njit
def _motor(axis, steps, now, span):  # type: ignore[no-untyped-def]
    """Place and speed of the motor: each step is a ramp, and ramps add up; `span` are those that it is making."""
    (t_s, place_um), (done, begun) = steps, span
    while begun < len(t_s) and t_s[begun] <= now:
        begun += 1
    while done < begun and t_s[done] + axis.step_time_s <= now:
        done += 1
    motor, speed = (place_um[done - 1] if done > 0 else 0.0), 0.0
    for step in range(done, begun):
        way = place_um[step] - (place_um[step - 1] if step > 0 else 0.0)
        motor += way * (now - t_s[step]) / axis.step_time_s
        speed += way / axis.step_time_s
    return motor, speed, (done, begun)


@numba.njit
def _next_turn(axis, steps, span):  # type: ignore[no-untyped-def]
    """When the next step begins or the oldest one ends: a tick ends there, or its error is that of the time."""
    (t_s, _), (done, begun) = steps, span
    begin_s = t_s[begun] if begun < len(t_s) else math.inf
    return min(begin_s, t_s[done] + axis.step_time_s) if done < begun else begin_s


@numba.njit
def _slip(axis, lag):  # type: ignore[no-untyped-def]
    """Way that a motor loses which lags too far: whole periods."""
    beyond = abs(lag) - (axis.limit / axis.spring + axis.slack_um + axis.period_um / 2.0)
    return math.copysign(max(math.ceil(beyond / axis.period_um), 1) * axis.period_um, lag) if beyond > 0.0 else 0.0


@numba.njit
def _force(axis, lag, speed, velocity):  # type: ignore[no-untyped-def]
    """Force of the drive: spring and damper past the slack, limited; a flank pushes, and never pulls."""
    past = max(lag - axis.slack_um, 0.0) + min(lag + axis.slack_um, 0.0)
    if past == 0.0 and axis.slack_um > 0.0:
        return 0.0
    force = axis.spring * past + axis.damper * (speed - velocity)
    force = min(max(force, -axis.limit), axis.limit)
    return 0.0 if axis.slack_um > 0.0 and force * past < 0.0 else force
