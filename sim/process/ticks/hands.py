"""What an operator's hands do at a cut, and whether it goes on then: how drills of operation are judged."""

from controller.compiled.loops import compiled, loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.events import restart, thread_wire
from sim.process.ticks.gap import place_um
from sim.process.ticks.state import (
    BREAKS,
    BREAKS_HERE,
    DRUMLESS_UNTIL,
    FINISHED,
    HAND_UM,
    IS_BY_HAND,
    POWER_OUT,
    PROGRESS_TICK,
    PUMPLESS_UNTIL,
    RUNNING,
    SET_SHARE,
    SHORT_TICKS,
    SHORTS,
    SPARKLESS_UNTIL,
    TICKS,
    WIRE_OUT,
    Job,
)
from sim.process.ticks.tick import run_ticks

# What hands do.
KNOB_UP = 0
KNOB_DOWN = 1
PUMP_ON = 2
DRUM_ON = 3
GENERATOR_ON = 4
GO_BACK = 5
THREAD_HERE = 6
THREAD_AT_START = 7
POWER_ON = 8
BEGIN_BLOCK_AGAIN = 9
CLEAR_ALARM = 10

# What it comes to.
GOES_ON = 0
STANDS = 1
BREAKS_THEN = 2
SHORTS_THEN = 3
TOO_SLOW = 4

_KNOB = 0.3
_LEAST_SHARE = 0.02
_MOST_SHARE = 0.9
_HAND_UM = -0.3
_HAND_TICKS = 1000
_BETWEEN_TICKS = 2000
_THEN_TICKS = 20000
_FEW_SHORTS = 1.0


@loop_part("void(f8[::1], f8)")
def turn_knob(state: Floats, by: float) -> None:
    """Turn the set value by a share of the open voltage."""
    state[SET_SHARE] = min(max(state[SET_SHARE] + by, _LEAST_SHARE), _MOST_SHARE)


@loop_part("void(f8[::1])")
def clear_alarm(state: Floats) -> None:
    """Let the control forget what it stopped for."""
    state[SHORT_TICKS] = 0.0
    state[BREAKS_HERE] = 0.0
    state[PROGRESS_TICK] = state[TICKS]


@loop_part("void(f8[::1], i8)")
def switch_on(state: Floats, action: int) -> None:
    """Switch pump, wire drum or generator on."""
    if action == PUMP_ON:
        state[PUMPLESS_UNTIL] = 0.0
    elif action == DRUM_ON:
        state[DRUMLESS_UNTIL] = 0.0
    else:
        state[SPARKLESS_UNTIL] = 0.0


@loop_part("void(Job, f8[::1], i8)", Job)
def see_to(job: Job, state: Floats, action: int) -> None:
    """Thread a wire that is broken, switch a power on that failed; nothing where neither is so."""
    if action in (THREAD_HERE, THREAD_AT_START):
        if state[WIRE_OUT] > 0.0:
            thread_wire(job, state, 1.0 if action == THREAD_AT_START else 0.0)
    elif state[POWER_OUT] > 0.0:
        restart(job, state, 1.0 if action == POWER_ON else 0.0)


@loop_part("void(Job, f8[::1], i8)", Job)
def act(job: Job, state: Floats, action: int) -> None:
    """One thing that hands do; back by hand for a second."""
    if action == KNOB_UP:
        turn_knob(state, _KNOB)
    elif action == KNOB_DOWN:
        turn_knob(state, -_KNOB)
    elif action == GO_BACK:
        state[IS_BY_HAND] = 1.0
        state[HAND_UM] = _HAND_UM
        run_ticks(job, state, _HAND_TICKS)
        state[IS_BY_HAND] = 0.0
    elif action in (THREAD_HERE, THREAD_AT_START, POWER_ON, BEGIN_BLOCK_AGAIN):
        see_to(job, state, action)
    elif action == CLEAR_ALARM:
        clear_alarm(state)
    else:
        switch_on(state, action)


@compiled("i8(Job, f8[::1], f8[::1], f8)", Job)
def judge(job: Job, state: Floats, actions: Floats, least_um: float) -> int:
    """What a cut comes to after actions in their order, two seconds apart, in the twenty seconds behind the last.

    It goes on where it makes `least_um` of way, or comes to its end, without a break and with no more than one short.
    """
    for at in range(len(actions)):
        act(job, state, int(actions[at]))
        run_ticks(job, state, _BETWEEN_TICKS)
    breaks, shorts, place = state[BREAKS], state[SHORTS], place_um(job, state)
    came_to = run_ticks(job, state, _THEN_TICKS)
    if state[BREAKS] > breaks:
        return BREAKS_THEN
    if came_to not in (RUNNING, FINISHED):
        return STANDS
    if state[SHORTS] > shorts + _FEW_SHORTS:
        return SHORTS_THEN
    if came_to == RUNNING and place_um(job, state) - place < least_um:
        return TOO_SLOW
    return GOES_ON
