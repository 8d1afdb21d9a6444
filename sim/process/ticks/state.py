"""The state of a cut under sparks, what it goes by, and what it fills: what all ticks share.

Model of brass wire in water after WEDM-Learning-Environment (geduardo, MIT licence): a spark comes with a
probability that the gap tells, takes a crater off the front, and pauses. The control looks at each tick and moves along
the path by whole steps. docs/sparks.md says all of it in words.

The wire stands at a place on the path, the front of the uncut work some µm ahead: their distance is the gap. Where
nothing is left to cut there is no front. All lengths are along the path.
"""

from typing import NamedTuple

from parser.geometry.curves import Floats

TICK_S = 0.001
TICK_US = 1000.0
FAR_UM = 50.0
"""Where a cut starts, and beyond which nothing ignites (SPARC, the environment's rough-cut simulator)."""
ARC_SHARE = 0.3
"""Voltage of an arc, as a share of the open voltage."""

# What becomes of some ticks.
RUNNING = 0
FINISHED = 1
IN_VAIN = 2
SHORTED = 3
STALLED = 4
BREAKS_AGAIN = 5
BROKEN = 6
POWERLESS = 7
COLLIDED = 8

# Laws of the servo.
VOLTAGE = 0
WINDOW = 1
DUTY = 2

# What happens.
SHORT = 1
CHIPS = 2
BREAK = 3
POWER = 4
PAUSE = 5
SPARKS_OFF = 6
PUMP_OFF = 7
DRUM_OFF = 8
KNOB = 9
CLEARED = 10
STOPPED = 11
SINGLE = 12
SKIP = 13
ORIGIN = 14

# Where the state has what.
TICKS = 0
AT = 1
FARTHEST = 2
ROW = 3
FAR_ROW = 4
FRONT_UM = 5
BUSY_US = 6
RESIDUE = 7
RESET_UM_S = 8
SEED_1 = 9
SEED_2 = 10
SPARE = 11
HAS_SPARE = 12
OPEN_US = 13
ON_US = 14
SHORT_US = 15
TICK_SPARKS = 16
SET_SHARE = 17
CHIP_UM = 18
CHIP_CLEAR_UM = 19
CHIP_UNTIL = 20
HOLD_UNTIL = 21
SPARKLESS_UNTIL = 22
PUMPLESS_UNTIL = 23
DRUMLESS_UNTIL = 24
CHIPS_UNTIL = 25
CHIPS_FACTOR = 26
SHORT_TICKS = 27
IS_SHORT = 28
SHORT_AT = 29
AREA_RATE = 30
NEXT_BY_STEP = 31
NEXT_BY_TIME = 32
PROGRESS_TICK = 33
ALL_SPARKS = 34
ALL_OPEN_US = 35
ALL_ON_US = 36
LIVE_TICKS = 37
SHORTS = 38
BREAKS = 39
RETREATED_UM = 40
LOST_TICKS = 41
REMOVED_UM3 = 42
GAP_UM = 43
LOGGED = 44
HISTORY_ROWS = 45
HISTORY_STRIDE = 46
VOLTAGE_SUM = 47
CURRENT_SUM = 48
UNCOOLED_TICKS = 49
HISTORY_TICKS = 50
AREA_UM2 = 51
ALL_GAP_UM = 52
BREAK_UM = 53
BREAKS_HERE = 54
WIRE_OUT = 55
POWER_OUT = 56
IS_BY_HAND = 57
HAND_UM = 58
SINGLE_S = 59
FLOOR_UM = 60
AT_ORIGIN = 61
STOOD_TICKS = 62
NEXT_BY_CUT = 63
CORNER_UNTIL = 64
STATE_SIZE = 65


class Way(NamedTuple):
    """The stepped path, n blocks.

    Attributes
    ----------
    before
        (n + 1,) steps before each block, and of all.
    along_um
        (n + 1,) µm of path before each block, and of all.
    width_um
        (n,) width of what each block cuts, µm; 0 where it cuts nothing.
    thread_um
        (n,) µm of path before the place where the wire was threaded last.
    wait_s
        (n,) how long the control stands at the end of each, under sparks.
    """

    before: Floats
    along_um: Floats
    width_um: Floats
    thread_um: Floats
    wait_s: Floats


class Discharge(NamedTuple):
    """Sparks: how long each one lasts and pauses, its crater with its spread, and the height of the work in µm."""

    on_us: float
    off_us: float
    crater_um3: float
    spread_um3: float
    height_um: float


class Servo(NamedTuple):
    """The law by which the control moves, and the speeds that bound it.

    Attributes
    ----------
    law
        `VOLTAGE`, `WINDOW` or `DUTY`.
    gain_um_s
        Speed for an error of all of what is looked at.
    reset_s
        Time in which a lasting error adds as much again.
    least_um_s, most_um_s
        Lowest speed, below 0 where the law can go back, and highest one.
    ring_um
        The farthest that the control can go back.
    """

    law: float
    gain_um_s: float
    reset_s: float
    least_um_s: float
    most_um_s: float
    ring_um: float


class Bounds(NamedTuple):
    """What stops the cut, and how long it takes to go on.

    Attributes
    ----------
    short_s
        A short that lasts longer stops the control.
    area_rate_mm2_min
        The wire breaks where more is cut; infinite where nobody knows.
    thread_s, restart_s
        To thread the wire anew, and to go on after a power loss.
    jog_um_s
        Speed through the slot without sparks.
    is_from_start
        1 where a broken wire is threaded at the start, 0 where it is threaded in place.
    is_reversed
        1 where the cut ends with a broken wire, for another that comes from the end of the path.
    is_manned
        1 where somebody threads a broken wire and switches the power on again, 0 where it is done at once.
    """

    short_s: float
    area_rate_mm2_min: float
    thread_s: float
    restart_s: float
    jog_um_s: float
    is_from_start: float
    is_reversed: float
    is_manned: float


class Events(NamedTuple):
    """What happens: at a step, then at a time, then after so much time of cutting, each in order.

    Attributes
    ----------
    kind, for_s, size
        (k,) which, how long, and how much: of a short the way back that clears it, µm; of chips a factor; of a power
        loss 1 where the control keeps its place; of the knob the new set value; of single block the time of each stop.
    at
        (k,) step, or tick, or tick of cutting, which leaves out the time that a cut stands.
    by_step, by_time
        (1,) how many of them come at a step, and how many at a time.
    """

    kind: Floats
    for_s: Floats
    size: Floats
    at: Floats
    by_step: Floats
    by_time: Floats


class Records(NamedTuple):
    """What the loop fills.

    Attributes
    ----------
    lit_s
        Time with sparks in each of the stretches of `stretch_um` of path.
    stretch_um
        (1,) length of these.
    block_s
        (n,) time in each block.
    log
        Rows of time in s, step, kind, size.
    history
        Rows of time in s, step, mean voltage and mean current as shares; every other one goes where they are full.
    """

    lit_s: Floats
    stretch_um: Floats
    block_s: Floats
    log: Floats
    history: Floats


class Job(NamedTuple):
    """All that the loop goes by."""

    way: Way
    discharge: Discharge
    servo: Servo
    bounds: Bounds
    events: Events
    records: Records


class Walls(NamedTuple):
    """What the walls of k rows are held against.

    Attributes
    ----------
    usual_s, gap_um
        (k,) time that a stretch takes at the usual feed, 0 where nothing is cut, and the gap at the walls then.
    start_um
        (k,) µm of path before the first wall: up to there the wire goes through its start hole.
    stretch_um, half
        Length of a stretch, and how many of them before and behind a wall is in reach of.
    """

    usual_s: Floats
    gap_um: Floats
    start_um: Floats
    stretch_um: float
    half: int
