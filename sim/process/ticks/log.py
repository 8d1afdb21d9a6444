"""What a cut writes down: what happened, times of blocks and of walls, its history."""

from controller.compiled.loops import loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.gap import mean_current, mean_voltage, place_um
from sim.process.ticks.state import (
    ALL_GAP_UM,
    ALL_ON_US,
    ALL_OPEN_US,
    ALL_SPARKS,
    AT,
    CURRENT_SUM,
    FAR_ROW,
    GAP_UM,
    HISTORY_ROWS,
    HISTORY_STRIDE,
    HISTORY_TICKS,
    LIVE_TICKS,
    LOGGED,
    ON_US,
    OPEN_US,
    ROW,
    SHORT_US,
    SPARKLESS_UNTIL,
    TICK_S,
    TICK_SPARKS,
    TICKS,
    VOLTAGE_SUM,
    Job,
)

_LOG_WIDTH = 4
_HISTORY_WIDTH = 4


@loop_part("void(Job, f8[::1], f8, f8)", Job)
def note(job: Job, state: Floats, kind: float, size: float) -> None:
    """Write a row of the log; those for which there is no room are counted alone."""
    log = job.records.log
    row = int(state[LOGGED]) * _LOG_WIDTH
    state[LOGGED] += 1.0
    if row + _LOG_WIDTH > len(log):
        return
    log[row] = state[TICKS] * TICK_S
    log[row + 1] = state[AT]
    log[row + 2] = kind
    log[row + 3] = size


@loop_part("void(f8[::1], f8[::1])")
def thin(state: Floats, history: Floats) -> None:
    """Make one row of two of the history: half of its room is free again."""
    rows = int(state[HISTORY_ROWS]) // 2
    for row in range(rows):
        first = 2 * row * _HISTORY_WIDTH
        to = row * _HISTORY_WIDTH
        history[to] = history[first + 4]
        history[to + 1] = history[first + 5]
        history[to + 2] = (history[first + 2] + history[first + 6]) / 2.0
        history[to + 3] = (history[first + 3] + history[first + 7]) / 2.0
    state[HISTORY_ROWS] = float(rows)
    state[HISTORY_STRIDE] *= 2.0


@loop_part("void(Job, f8[::1])", Job)
def record(job: Job, state: Floats) -> None:
    """Add a tick to the sums, and a row to the history where it is time for one."""
    records = job.records
    records.block_s[int(state[ROW])] += TICK_S
    if job.way.width_um[int(state[FAR_ROW])] > 0.0:
        if state[SHORT_US] == 0.0 and state[TICKS] >= state[SPARKLESS_UNTIL]:
            # The walls stay as near where the front has receded: sparks go on there.
            at = int(place_um(job, state) / records.stretch_um[0])
            records.lit_s[min(at, len(records.lit_s) - 1)] += TICK_S
        state[LIVE_TICKS] += 1.0
        state[ALL_SPARKS] += state[TICK_SPARKS]
        state[ALL_OPEN_US] += state[OPEN_US]
        state[ALL_ON_US] += state[ON_US]
        state[ALL_GAP_UM] += state[GAP_UM]
    state[VOLTAGE_SUM] += mean_voltage(state)
    state[CURRENT_SUM] += mean_current(job, state)
    stride = state[HISTORY_STRIDE]
    state[HISTORY_TICKS] += 1.0
    if state[HISTORY_TICKS] < stride:
        return
    history = records.history
    row = int(state[HISTORY_ROWS]) * _HISTORY_WIDTH
    history[row] = state[TICKS] * TICK_S
    history[row + 1] = state[AT]
    history[row + 2] = state[VOLTAGE_SUM] / stride
    history[row + 3] = state[CURRENT_SUM] / stride
    state[HISTORY_ROWS] += 1.0
    state[HISTORY_TICKS] = 0.0
    state[VOLTAGE_SUM] = 0.0
    state[CURRENT_SUM] = 0.0
    if row + 2 * _HISTORY_WIDTH > len(history):
        thin(state, history)
