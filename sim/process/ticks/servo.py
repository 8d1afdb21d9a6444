"""The servo: what its law makes of a tick, and the steps that it makes or undoes."""

from controller.compiled.loops import loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.gap import mean_voltage, path_to_um, place_um, step_um
from sim.process.ticks.state import (
    AT,
    DUTY,
    FAR_ROW,
    FAR_UM,
    FARTHEST,
    FLOOR_UM,
    GAP_UM,
    NEXT_BY_STEP,
    OPEN_US,
    PROGRESS_TICK,
    RESET_UM_S,
    RESIDUE,
    RETREATED_UM,
    ROW,
    SET_SHARE,
    SHORT_US,
    SPARKLESS_UNTIL,
    TICK_S,
    TICK_SPARKS,
    TICK_US,
    TICKS,
    WINDOW,
    Job,
)

_ROUNDING_UM = 1e-6


@loop_part("f8(f8, f8, f8)")
def within(value: float, low: float, high: float) -> float:
    """A value, or the nearer of two bounds."""
    return min(max(value, low), high)


@loop_part("f8(Job, f8[::1])", Job)
def way_of_law(job: Job, state: Floats) -> float:
    """Way along the path that the law makes of a tick, µm."""
    servo = job.servo
    if servo.law == WINDOW:
        # Spark-corefw, app/src/motion.c: by the share of the last millisecond.
        if state[OPEN_US] > state[SET_SHARE] * TICK_US:
            return 1.0
        return -5.0 if state[SHORT_US] > 0.5 * TICK_US else 0.0
    if servo.law == DUTY:
        # powercore.py of danger-klipper: by the sparks that came of those that could.
        most = TICK_US / (job.discharge.on_us + job.discharge.off_us)
        off = state[SET_SHARE] - min(state[TICK_SPARKS] / most, 1.0)
    else:
        off = mean_voltage(state) - state[SET_SHARE]
    if state[SHORT_US] > 0.0:
        state[RESET_UM_S] = 0.0  # what was learned led into the short
    elif state[GAP_UM] < FAR_UM:  # while nothing ignites, no lasting error is learned
        reset = state[RESET_UM_S] + servo.gain_um_s * off * TICK_S / servo.reset_s
        state[RESET_UM_S] = within(reset, max(servo.least_um_s, 0.0), servo.most_um_s)
    return within(servo.gain_um_s * off + state[RESET_UM_S], servo.least_um_s, servo.most_um_s) * TICK_S


@loop_part("void(Job, f8[::1])", Job)
def step_forward(job: Job, state: Floats) -> None:
    """Make the next step of the path."""
    before = job.way.before
    last = len(before) - 2
    state[AT] += 1.0
    row = int(state[ROW])
    while row < last and state[AT] >= before[row + 1]:
        row += 1
    state[ROW] = float(row)
    if state[AT] > state[FARTHEST]:
        state[FARTHEST] = state[AT]
        state[FAR_ROW] = float(row)
        state[PROGRESS_TICK] = state[TICKS]


@loop_part("void(Job, f8[::1])", Job)
def step_back(job: Job, state: Floats) -> None:
    """Undo the last step of the path."""
    state[AT] -= 1.0
    row = int(state[ROW])
    while row > 0 and state[AT] < job.way.before[row]:
        row -= 1
    state[ROW] = float(row)


@loop_part("f8(Job, f8[::1])", Job)
def next_stop(job: Job, state: Floats) -> float:
    """The step at which something happens next, or the last one."""
    end = job.way.before[len(job.way.before) - 1]
    at = int(state[NEXT_BY_STEP])
    if at < job.events.by_step[0]:
        return float(min(end, max(job.events.at[at], state[AT])))
    return float(end)


@loop_part("b1(Job, f8[::1])", Job)
def go_back(job: Job, state: Floats) -> bool:
    """Go back by whole steps; whether the control stands at the end of its way back and would go on."""
    far_row = int(state[FAR_ROW])
    far_um = path_to_um(job, far_row, state[FARTHEST])
    lowest_um = max(far_um - job.servo.ring_um, job.way.thread_um[far_row], state[FLOOR_UM]) - _ROUNDING_UM
    here_um = place_um(job, state)
    while state[RESIDUE] <= -1.0:
        if state[AT] <= 0.0 or place_um(job, state) - step_um(job, int(state[ROW])) < lowest_um:
            state[RESIDUE] = 0.0
            return bool(state[SHORT_US] > 0.0 or state[TICKS] < state[SPARKLESS_UNTIL])
        step_back(job, state)
        state[RESIDUE] += 1.0
    if state[SHORT_US] > 0.0:
        state[RETREATED_UM] += here_um - place_um(job, state)
    return False


@loop_part("b1(Job, f8[::1], f8)", Job)
def move(job: Job, state: Floats, way: float) -> bool:
    """Move along the path by whole steps; whether the control wanted to go back farther than it can."""
    state[RESIDUE] += way / step_um(job, int(state[ROW]))
    while state[RESIDUE] >= 1.0:
        if state[AT] >= next_stop(job, state):
            state[RESIDUE] = 0.0
            return False
        step_forward(job, state)
        state[RESIDUE] -= 1.0
    return go_back(job, state) if state[RESIDUE] <= -1.0 else False
