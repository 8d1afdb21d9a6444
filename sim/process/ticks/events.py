"""What happens in a cut, at a step or at a time."""

import math

from controller.compiled.loops import loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.gap import place_um
from sim.process.ticks.log import note
from sim.process.ticks.state import (
    AREA_RATE,
    AT,
    AT_ORIGIN,
    BREAK,
    BREAK_UM,
    BREAKS,
    BREAKS_HERE,
    BUSY_US,
    CHIP_CLEAR_UM,
    CHIP_UM,
    CHIP_UNTIL,
    CHIPS,
    CHIPS_FACTOR,
    CHIPS_UNTIL,
    DRUM_OFF,
    DRUMLESS_UNTIL,
    FAR_ROW,
    FARTHEST,
    FLOOR_UM,
    FRONT_UM,
    HOLD_UNTIL,
    KNOB,
    LOST_TICKS,
    NEXT_BY_CUT,
    NEXT_BY_STEP,
    NEXT_BY_TIME,
    ORIGIN,
    PAUSE,
    POWER,
    POWER_OUT,
    PROGRESS_TICK,
    PUMP_OFF,
    PUMPLESS_UNTIL,
    RESET_UM_S,
    RESIDUE,
    ROW,
    SET_SHARE,
    SHORT,
    SINGLE,
    SINGLE_S,
    SKIP,
    SPARKLESS_UNTIL,
    SPARKS_OFF,
    STOOD_TICKS,
    TICK_S,
    TICKS,
    UNCOOLED_TICKS,
    WIRE_OUT,
    Job,
)

_SAME_PLACE_UM = 1000.0
"""Breaks within it are in one place (assumed)."""


@loop_part("void(f8[::1], f8)")
def stand(state: Floats, seconds: float) -> None:
    """Let time go by without sparks."""
    ticks = math.floor(seconds / TICK_S + 0.5)
    state[TICKS] += ticks
    state[STOOD_TICKS] += ticks
    state[LOST_TICKS] += ticks
    state[PROGRESS_TICK] = state[TICKS]
    state[BUSY_US] = 0.0
    state[RESET_UM_S] = 0.0
    state[RESIDUE] = 0.0


@loop_part("void(Job, f8[::1], f8)", Job)
def thread_wire(job: Job, state: Floats, is_from_start: float) -> None:
    """Thread a broken wire, in place or at the start, from where it goes through the slot again."""
    back_um = place_um(job, state) - job.way.thread_um[int(state[ROW])]
    stand(state, job.bounds.thread_s + 2.0 * back_um * is_from_start / job.bounds.jog_um_s)
    if job.bounds.is_manned == 0.0:
        state[PUMPLESS_UNTIL] = 0.0
        state[DRUMLESS_UNTIL] = 0.0
    state[UNCOOLED_TICKS] = 0.0
    state[AREA_RATE] = 0.0
    state[WIRE_OUT] = 0.0
    state[AT_ORIGIN] = 0.0


@loop_part("void(Job, f8[::1])", Job)
def tear_wire(job: Job, state: Floats) -> None:
    """Let the wire break: it is threaded at once, or waits for somebody who does it."""
    note(job, state, BREAK, 0.0)
    state[BREAKS] += 1.0
    place = place_um(job, state)
    is_here = state[BREAKS_HERE] > 0.0 and place - state[BREAK_UM] < _SAME_PLACE_UM
    state[BREAKS_HERE] = state[BREAKS_HERE] + 1.0 if is_here else 1.0
    state[BREAK_UM] = place if state[BREAKS_HERE] == 1.0 else state[BREAK_UM]
    state[WIRE_OUT] = 1.0
    if job.bounds.is_manned + job.bounds.is_reversed == 0.0:
        thread_wire(job, state, job.bounds.is_from_start)


@loop_part("void(Job, f8[::1], f8)", Job)
def restart(job: Job, state: Floats, remembers: float) -> None:
    """Go on after a power loss: at the step where it came, or at the begin of the block."""
    stand(state, job.bounds.restart_s)
    state[POWER_OUT] = 0.0
    if remembers == 0.0:
        state[AT] = job.way.before[int(state[ROW])]


@loop_part("void(Job, f8[::1])", Job)
def cut_power(job: Job, state: Floats) -> None:
    """Let the power fail, and wait for somebody who switches it on."""
    note(job, state, POWER, 1.0)
    state[POWER_OUT] = 1.0


@loop_part("void(Job, f8[::1])", Job)
def skip_block(job: Job, state: Floats) -> None:
    """Leave out the rest of a block: the control counts from where it stands, and the wire cuts on from there.

    What lies behind is not on the path that comes: there is no way back over it.
    """
    row = int(state[ROW])
    gap_um = state[FRONT_UM] - place_um(job, state)
    state[AT] = job.way.before[row + 1]
    state[FARTHEST] = state[AT]
    row = min(row + 1, len(job.way.before) - 2)
    state[ROW] = float(row)
    state[FAR_ROW] = float(row)
    state[FLOOR_UM] = place_um(job, state)
    state[FRONT_UM] = state[FLOOR_UM] + gap_um
    state[RESIDUE] = 0.0


@loop_part("void(f8[::1], f8, f8, f8)")
def turn_switch(state: Floats, kind: float, until: float, size: float) -> None:
    """Turn a switch or the knob, or let chips gather, until a tick."""
    if kind == CHIPS:
        state[CHIPS_UNTIL] = until
        state[CHIPS_FACTOR] = size
    elif kind == PAUSE:
        state[HOLD_UNTIL] = until
    elif kind == SPARKS_OFF:
        state[SPARKLESS_UNTIL] = until
    elif kind == PUMP_OFF:
        state[PUMPLESS_UNTIL] = until
    elif kind == DRUM_OFF:
        state[DRUMLESS_UNTIL] = until
    elif kind == KNOB:
        state[SET_SHARE] = size
    elif kind == SINGLE:
        state[SINGLE_S] = size


@loop_part("void(Job, f8[::1], i8)", Job)
def begin_event(job: Job, state: Floats, at: int) -> None:
    """Begin one of the events."""
    kind = job.events.kind[at]
    size = job.events.size[at]
    seconds = job.events.for_s[at]
    until = state[TICKS] + math.floor(seconds / TICK_S + 0.5)
    if kind == BREAK:
        tear_wire(job, state)
        return
    if kind == SHORT:  # noted when it is seen
        state[CHIP_UM] = place_um(job, state)
        state[CHIP_CLEAR_UM] = size
        state[CHIP_UNTIL] = until
        return
    if kind == POWER:
        cut_power(job, state)
        if job.bounds.is_manned == 0.0:
            restart(job, state, size)
        return
    note(job, state, kind, size)
    if kind == SKIP:
        skip_block(job, state)
    elif kind == ORIGIN:
        state[AT_ORIGIN] = 1.0
        state[WIRE_OUT] = 1.0
    else:
        turn_switch(state, kind, until, size)


@loop_part("void(Job, f8[::1])", Job)
def begin_events(job: Job, state: Floats) -> None:
    """Begin what happens at this step, at this time, and after so much time of cutting."""
    events = job.events
    by_step = int(events.by_step[0])
    by_time = by_step + int(events.by_time[0])
    while state[NEXT_BY_STEP] < by_step and events.at[int(state[NEXT_BY_STEP])] <= state[AT]:
        state[NEXT_BY_STEP] += 1.0
        begin_event(job, state, int(state[NEXT_BY_STEP]) - 1)
    while by_step + state[NEXT_BY_TIME] < by_time and events.at[by_step + int(state[NEXT_BY_TIME])] <= state[TICKS]:
        state[NEXT_BY_TIME] += 1.0
        begin_event(job, state, by_step + int(state[NEXT_BY_TIME]) - 1)
    rest = len(events.at) - by_time
    while (
        state[NEXT_BY_CUT] < rest and events.at[by_time + int(state[NEXT_BY_CUT])] <= state[TICKS] - state[STOOD_TICKS]
    ):
        state[NEXT_BY_CUT] += 1.0
        begin_event(job, state, by_time + int(state[NEXT_BY_CUT]) - 1)
