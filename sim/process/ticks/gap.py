"""Place and gap of the wire, and the sparks of a tick there."""

import math

from controller.compiled.loops import loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.chance import mean_delay_us, random_normal, random_share
from sim.process.ticks.state import (
    ARC_SHARE,
    AT,
    BUSY_US,
    CHIP_CLEAR_UM,
    CHIP_UM,
    CHIP_UNTIL,
    FAR_ROW,
    FAR_UM,
    FARTHEST,
    FRONT_UM,
    GAP_UM,
    ON_US,
    OPEN_US,
    REMOVED_UM3,
    ROW,
    SHORT_US,
    SPARKLESS_UNTIL,
    TICK_SPARKS,
    TICK_US,
    TICKS,
    Job,
)


@loop_part("f8(Job, i8)", Job)
def step_um(job: Job, row: int) -> float:
    """Path in one step of a block, µm."""
    steps = job.way.before[row + 1] - job.way.before[row]
    return float((job.way.along_um[row + 1] - job.way.along_um[row]) / steps)


@loop_part("f8(Job, i8, f8)", Job)
def path_to_um(job: Job, row: int, at: float) -> float:
    """Path from its start to a step in a block, µm."""
    return float(job.way.along_um[row] + (at - job.way.before[row]) * step_um(job, row))


@loop_part("f8(Job, f8[::1])", Job)
def place_um(job: Job, state: Floats) -> float:
    """Path from its start to the wire, µm."""
    return path_to_um(job, int(state[ROW]), state[AT])


@loop_part("void(Job, f8[::1], f8)", Job)
def find_gap(job: Job, state: Floats, place: float) -> None:
    """Find the gap at a place. Where nothing is cut, the front goes with the wire; so it does in a start hole."""
    far_row = int(state[FAR_ROW])
    is_threaded = state[FARTHEST] == job.way.before[far_row] and job.way.thread_um[far_row] == job.way.along_um[far_row]
    if is_threaded or job.way.width_um[far_row] <= 0.0:
        state[FRONT_UM] = max(state[FRONT_UM], place + FAR_UM)
    state[GAP_UM] = min(state[FRONT_UM] - place, FAR_UM)


@loop_part("f8(f8[::1])")
def mean_voltage(state: Floats) -> float:
    """Mean voltage of a tick, as a share of the open one: that of the open gap, less of an arc, none else."""
    return float((state[OPEN_US] + ARC_SHARE * state[ON_US]) / TICK_US)


@loop_part("f8(Job, f8[::1])", Job)
def mean_current(job: Job, state: Floats) -> float:
    """Mean current of a tick, as a share of the most: that of a short, or of sparks without a delay."""
    most_on_us = TICK_US * job.discharge.on_us / (job.discharge.on_us + job.discharge.off_us)
    return 1.0 if state[SHORT_US] > 0.0 else float(min(state[ON_US] / most_on_us, 1.0))


@loop_part("b1(f8[::1], f8)")
def is_shorted(state: Floats, place: float) -> bool:
    """Whether the wire touches the work, or a chip that lies between; farther back than that the chip is washed out."""
    if state[TICKS] < state[CHIP_UNTIL]:
        if place > state[CHIP_UM] - state[CHIP_CLEAR_UM]:
            return True
        state[CHIP_UNTIL] = 0.0
    return bool(state[GAP_UM] <= 0.0)


@loop_part("void(Job, f8[::1], f8)", Job)
def let_spark(job: Job, state: Floats, place: float) -> None:
    """The sparks of one tick, at one place: what the control sees of them, and the front that recedes.

    A delay that the end of the tick cuts off is drawn anew: it has no memory.
    """
    state[OPEN_US] = 0.0
    state[ON_US] = 0.0
    state[SHORT_US] = 0.0
    state[TICK_SPARKS] = 0.0
    if is_shorted(state, place):
        state[SHORT_US] = TICK_US
        state[BUSY_US] = 0.0
        return
    if state[TICKS] < state[SPARKLESS_UNTIL]:
        state[BUSY_US] = 0.0
        return
    if state[GAP_UM] >= FAR_UM:
        state[OPEN_US] = TICK_US
        state[BUSY_US] = 0.0
        return
    spark_until(job, state, TICK_US)


@loop_part("void(Job, f8[::1], f8)", Job)
def spark_until(job: Job, state: Floats, end_us: float) -> None:
    """Sparks one by one up to the end of a tick, from where the pause of the last one ends.

    Each takes the mean crater at once. How much the craters of a tick are larger or smaller in all is drawn at its end:
    the sum of n normal volumes is normal, with √n times their spread. That takes half of the time of craters drawn one
    by one, and comes to the same but for the spread of the gap within a tick.
    """
    discharge = job.discharge
    cycle_us = discharge.on_us + discharge.off_us
    face_um2 = job.way.width_um[int(state[FAR_ROW])] * discharge.height_um
    deeper = discharge.crater_um3 / face_um2 if face_um2 > 0.0 else 0.0
    at_us, gap, open_us, sparks = state[BUSY_US], state[GAP_UM], 0.0, 0.0
    while at_us < end_us:
        delay = -mean_delay_us(gap) * math.log(random_share(state))
        if at_us + delay >= end_us:
            open_us += end_us - at_us
            at_us = end_us
        else:
            open_us += delay
            sparks += 1.0
            at_us += delay + cycle_us
            gap = min(gap + deeper, FAR_UM)
    state[BUSY_US] = at_us - end_us
    state[OPEN_US] = open_us
    state[ON_US] = sparks * discharge.on_us
    state[TICK_SPARKS] = sparks
    if sparks > 0.0 and face_um2 > 0.0:
        take_craters(job, state, sparks, face_um2)


@loop_part("void(Job, f8[::1], f8, f8)", Job)
def take_craters(job: Job, state: Floats, sparks: float, face_um2: float) -> None:
    """Take the craters of a tick off the front: their number is that of its sparks, their volume by chance."""
    discharge = job.discharge
    spread = discharge.spread_um3 * math.sqrt(sparks) * random_normal(state)
    removed = max(discharge.crater_um3 * sparks + spread, 0.0)
    state[REMOVED_UM3] += removed
    state[FRONT_UM] += removed / face_um2
    state[GAP_UM] = min(state[GAP_UM] + removed / face_um2, FAR_UM)
