"""What is watched each tick: shorts that last, and the wire that breaks."""

from controller.compiled.loops import loop_part
from parser.geometry.curves import Floats
from sim.process.ticks.log import note
from sim.process.ticks.state import (
    AREA_RATE,
    AREA_UM2,
    AT,
    CHIPS_FACTOR,
    CHIPS_UNTIL,
    CLEARED,
    DRUMLESS_UNTIL,
    FAR_ROW,
    FARTHEST,
    IS_SHORT,
    LOST_TICKS,
    PUMPLESS_UNTIL,
    SHORT,
    SHORT_AT,
    SHORT_TICKS,
    SHORT_US,
    SHORTS,
    TICK_S,
    TICK_SPARKS,
    TICKS,
    UNCOOLED_TICKS,
    Job,
)

_SHORT_TICKS = 10
"""Of a short that counts (assumed): in a narrow gap the wire touches for a tick or two."""
_AREA_SMOOTH = 0.002
"""Share of a tick in the mean of the area rate: half a second, as wires break by what lasts (assumed)."""
_UNCOOLED_MOST = 1000.0
"""Ticks with sparks that a wire without water stands (assumed)."""
_STANDING_MOST = 500.0
"""The same of a wire that stands still (assumed)."""


@loop_part("void(Job, f8[::1])", Job)
def watch_short(job: Job, state: Floats) -> None:
    """Count the ticks of a short. One that lasts is noted, and so is its end; what it costs ends where it began."""
    if state[SHORT_US] > 0.0:
        state[SHORT_TICKS] += 1.0
        if state[SHORT_TICKS] == _SHORT_TICKS and state[IS_SHORT] == 0.0:
            state[IS_SHORT] = 1.0
            state[SHORT_AT] = state[FARTHEST]
            state[SHORTS] += 1.0
            state[LOST_TICKS] += _SHORT_TICKS - 1.0
            note(job, state, SHORT, 0.0)
    else:
        state[SHORT_TICKS] = 0.0
        if state[IS_SHORT] == 1.0:
            state[IS_SHORT] = 2.0
            note(job, state, CLEARED, state[SHORT_AT] - state[AT])
    if state[IS_SHORT] == 2.0 and state[AT] >= state[SHORT_AT]:
        state[IS_SHORT] = 0.0
    if state[IS_SHORT] > 0.0:
        state[LOST_TICKS] += 1.0


@loop_part("b1(Job, f8[::1], f8)", Job)
def breaks(job: Job, state: Floats, removed_um3: float) -> bool:
    """Whether the wire breaks in this tick: more is cut than it stands, or nothing cools it, or it stands still."""
    width_um = job.way.width_um[int(state[FAR_ROW])]
    rate = 0.0
    if width_um > 0.0:
        state[AREA_UM2] += removed_um3 / width_um
        rate = removed_um3 / width_um * 1e-6 / TICK_S * 60.0
    state[AREA_RATE] += _AREA_SMOOTH * (rate - state[AREA_RATE])
    most = job.bounds.area_rate_mm2_min
    if state[TICKS] < state[CHIPS_UNTIL]:
        most *= state[CHIPS_FACTOR]
    is_standing = state[TICKS] < state[DRUMLESS_UNTIL]
    is_bare = is_standing or state[TICKS] < state[PUMPLESS_UNTIL]
    is_lit = state[TICK_SPARKS] > 0.0 or state[SHORT_US] > 0.0
    state[UNCOOLED_TICKS] = state[UNCOOLED_TICKS] + 1.0 if is_bare and is_lit else 0.0
    limit = _STANDING_MOST if is_standing else _UNCOOLED_MOST
    return bool(state[AREA_RATE] > most or state[UNCOOLED_TICKS] > limit)
