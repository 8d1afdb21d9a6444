"""What the panel hands over to its script."""

from typing import TypedDict


class PanelWayEntry(TypedDict):
    """The stepped path: `sim.process.ticks.state.Way`."""

    before: list[float]
    along_um: list[float]
    width_um: list[float]
    thread_um: list[float]
    wait_s: list[float]


class PanelWordsEntry(TypedDict):
    """What each block is stepped by: X, Y and J in µm, count direction (0 for X), turn and quadrant."""

    x_um: list[int]
    y_um: list[int]
    count_um: list[int]
    axis: list[int]
    turn: list[int]
    quadrant: list[int]


class PanelDischargeEntry(TypedDict):
    """Sparks: `sim.process.ticks.state.Discharge`."""

    on_us: float
    off_us: float
    crater_um3: float
    spread_um3: float
    height_um: float


class PanelServoEntry(TypedDict):
    """The law: `sim.process.ticks.state.Servo`."""

    law: float
    gain_um_s: float
    reset_s: float
    least_um_s: float
    most_um_s: float
    ring_um: float


class PanelBoundsEntry(TypedDict):
    """What stops the cut: `sim.process.ticks.state.Bounds`; no area rate where nobody knows one."""

    short_s: float
    area_rate_mm2_min: float | None
    thread_s: float
    restart_s: float
    jog_um_s: float
    is_from_start: float


class PanelEventsEntry(TypedDict):
    """What happens: `sim.process.ticks.state.Events`."""

    kind: list[float]
    for_s: list[float]
    size: list[float]
    at: list[float]
    by_step: list[float]
    by_time: list[float]


class PanelModeEntry(TypedDict):
    """A mode of sparks, and its craters."""

    name: str
    crater_um3: float
    spread_um3: float


class PanelEntry(TypedDict):
    """A cut that a panel drives.

    `blocks` are names and `texts` the words of the blocks that are cut, `starts_um` where their steps begin, `points`
    evenly spaced places along each, x and y by turns. `usual_s` is the time that a stretch of `stretch_um` takes at
    the usual feed, `gap_um` the gap at the walls then, `start_um` the path before the first wall, by block; `half`
    are the stretches before and behind that a wall is in reach of. `digest` is of all that decides the cut: a sitting
    names it.
    """

    digest: str
    blocks: list[str]
    texts: list[str]
    starts_um: list[list[int]]
    points: list[list[float]]
    way: PanelWayEntry
    words: PanelWordsEntry
    discharge: PanelDischargeEntry
    servo: PanelServoEntry
    bounds: PanelBoundsEntry
    events: PanelEventsEntry
    modes: list[PanelModeEntry]
    mode: str
    law: str
    seeds: list[float]
    set_share: float
    open_v: float
    stretch_um: float
    half: int
    usual_s: list[float]
    gap_um: list[float]
    start_um: list[float]
