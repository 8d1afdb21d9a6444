"""A tick of 1 ms: what happens, sparks, and what the control makes of them."""

import math

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.events import begin_events, stand, tear_wire
from sim.process.ticks.gap import find_gap, let_spark, place_um
from sim.process.ticks.log import note, record
from sim.process.ticks.servo import move, way_of_law
from sim.process.ticks.state import (
    AT,
    AT_ORIGIN,
    BREAKS_AGAIN,
    BREAKS_HERE,
    BROKEN,
    COLLIDED,
    CORNER_UNTIL,
    FARTHEST,
    FINISHED,
    HAND_UM,
    HOLD_UNTIL,
    IN_VAIN,
    IS_BY_HAND,
    LOST_TICKS,
    POWER_OUT,
    POWERLESS,
    PROGRESS_TICK,
    REMOVED_UM3,
    ROW,
    RUNNING,
    SHORT_TICKS,
    SHORTED,
    SINGLE_S,
    STALLED,
    STOPPED,
    TICK_S,
    TICKS,
    WIRE_OUT,
    Job,
)
from sim.process.ticks.watch import breaks, watch_short

_STALL_TICKS = 600000.0
"""Without way, after which the control stops: ten minutes (assumed)."""
_MOST_BREAKS_HERE = 5.0
"""Breaks in one place, after which somebody has to look for their cause (assumed)."""


@loop_part("f8(Job, f8[::1])", Job)
def way_of_tick(job: Job, state: Floats) -> float:
    """Way that a tick makes, µm: by hand, none while the feed is held, else by the law."""
    if state[IS_BY_HAND] > 0.0:
        state[PROGRESS_TICK] = state[TICKS]
        return float(state[HAND_UM])
    if state[TICKS] < state[HOLD_UNTIL]:
        state[LOST_TICKS] += 1.0
        state[PROGRESS_TICK] = state[TICKS]
        return 0.0
    if state[TICKS] < state[CORNER_UNTIL]:
        state[PROGRESS_TICK] = state[TICKS]
        return 0.0
    return way_of_law(job, state)


@loop_part("i8(f8[::1])")
def waits_for(state: Floats) -> int:
    """What a cut waits for: somebody to thread the wire, or to switch the power on; else `RUNNING`."""
    if state[AT_ORIGIN] > 0.0:
        return COLLIDED
    if state[WIRE_OUT] > 0.0:
        return BREAKS_AGAIN if state[BREAKS_HERE] >= _MOST_BREAKS_HERE else BROKEN
    return POWERLESS if state[POWER_OUT] > 0.0 else RUNNING


@loop_part("void(Job, f8[::1], i8)", Job)
def end_block(job: Job, state: Floats, row: int) -> None:
    """Stand at the end of a block: under sparks at a corner, without in single block."""
    state[CORNER_UNTIL] = state[TICKS] + math.floor(job.way.wait_s[row] / TICK_S + 0.5)
    if state[SINGLE_S] > 0.0:
        stand(state, state[SINGLE_S])


@loop_part("i8(Job, f8[::1], b1)", Job)
def alarm(job: Job, state: Floats, is_in_vain: bool) -> int:
    """Why the control stops by itself, `RUNNING` where it does not; by hand it goes where hands want."""
    if state[IS_BY_HAND] > 0.0:
        return RUNNING
    if is_in_vain:
        return IN_VAIN
    if state[SHORT_TICKS] * TICK_S > job.bounds.short_s:
        return SHORTED
    return STALLED if state[TICKS] - state[PROGRESS_TICK] > _STALL_TICKS else RUNNING


@loop_part("i8(Job, f8[::1])", Job)
def tick(job: Job, state: Floats) -> int:
    """One tick: what happens, sparks, what the control makes of them; `RUNNING`, or why it stops."""
    begin_events(job, state)
    waiting = waits_for(state)
    if waiting != RUNNING:
        return waiting
    place = place_um(job, state)
    find_gap(job, state, place)
    removed = state[REMOVED_UM3]
    let_spark(job, state, place)
    watch_short(job, state)
    record(job, state)
    if breaks(job, state, state[REMOVED_UM3] - removed):
        tear_wire(job, state)
        return BREAKS_AGAIN if state[BREAKS_HERE] >= _MOST_BREAKS_HERE else waits_for(state)
    row = state[ROW]
    is_in_vain = move(job, state, way_of_tick(job, state))
    state[TICKS] += 1.0
    if state[ROW] > row and state[AT] == state[FARTHEST]:
        end_block(job, state, int(row))
    return alarm(job, state, is_in_vain)


@compiled("i8(Job, f8[::1], i8)", Job)
def run_ticks(job: Job, state: Floats, most: int) -> int:
    """Run so many ticks at most: `FINISHED` at the end of the path, else what the last tick came to."""
    end = job.way.before[len(job.way.before) - 1]
    for _ in range(most):
        if state[AT] >= end:
            return FINISHED
        came_to = tick(job, state)
        if came_to != RUNNING:
            if came_to not in (BROKEN, POWERLESS):
                note(job, state, STOPPED, float(came_to))
            return came_to
    return RUNNING
