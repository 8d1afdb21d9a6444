"""Incidents of a cut: what happened, what the instruments showed, and what lets it go on, each proved by the loops.

An incident begins at a place of the path with a cut that runs well. Whether hands mend it is judged by running on,
never by a key of answers: `REMEDIES` are one way that is known to do.
"""

from collections.abc import Callable, Iterator, Mapping
from random import Random
from typing import Final, Literal, NamedTuple, get_args

import numpy as np

from controller.stepping.counters import Counters
from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from sim.process.cut import Started
from sim.process.ticks import hands
from sim.process.ticks import state as ticks
from sim.process.ticks.hands import judge
from sim.process.ticks.state import Job, Records
from sim.process.ticks.tick import run_ticks
from sim.process.walls import usual_feeds_um_s, usual_gap_um
from sim.process.way import along_at, standing

IncidentKind = Literal["too-fast", "too-slow", "short", "broken", "power", "water", "drum"]
Action = Literal[
    "knob-up",
    "knob-down",
    "pump-on",
    "drum-on",
    "generator-on",
    "back",
    "thread-here",
    "thread-start",
    "power-on",
    "block-again",
    "clear",
]
KINDS: Final[tuple[IncidentKind, ...]] = get_args(IncidentKind)
ACTIONS: Final[tuple[Action, ...]] = get_args(Action)
"""In the order of their numbers in `sim.process.ticks.hands`."""
REMEDIES: Final[Mapping[IncidentKind, tuple[Action, ...]]] = {
    "too-fast": ("knob-up",),
    "too-slow": ("knob-down",),
    "short": ("back", "clear"),
    "broken": ("thread-here",),
    "power": ("power-on",),
    "water": ("pump-on", "thread-here"),
    "drum": ("drum-on", "thread-here"),
}
GOES_ON: Final = hands.GOES_ON
_BEFORE_TICKS: Final = 4000
_AFTER_TICKS: Final = 6000
_SHOWN: Final = 250
_TRIES: Final = 40
_ROOM_UM: Final = 1500.0
_LEAST_WAY: Final = 0.55
_THEN_S: Final = 20.0
_EVER: Final = 1e15
_CHIP_UM: Final = 950.0
_FAST, _SLOW = 0.1, 0.8


class OperationDrill(NamedTuple):
    """A cut in which something happened.

    Attributes
    ----------
    kind
        What happened.
    state
        The state of the loop then.
    strip
        (m, 3) what the instruments showed until then: s before, mean voltage and mean current as shares.
    counters
        What the control shows.
    came_to
        How the control stands: running, or why it stopped, in the numbers of `sim.process.ticks.state`.
    least_um
        Way that it has to make in twenty seconds to go on.
    """

    kind: IncidentKind
    state: Floats
    strip: Floats
    counters: Counters
    came_to: int
    least_um: float


def operation_drills(cut: Started, number: int, count: int) -> tuple[OperationDrill, ...]:
    """Drills on a cut, of as many kinds as there are, the same for the same number. SettingsError for too short a path.

    Each is proved: nothing done does not let it go on, and its remedy does.
    """
    manned = _manned(cut)
    if float(manned.job.way.along_um[-1]) < 3.0 * _ROOM_UM:
        raise SettingsError("too-short-to-operate", length_um=float(manned.job.way.along_um[-1]))
    chance = Random(number)  # noqa: S311 - the same for all who are told the number
    return tuple(_proved(manned, kind, chance) for kind in _kinds(chance, count))


def outcome(cut: Started, drill: OperationDrill, actions: tuple[Action, ...]) -> int:
    """What the cut comes to after actions in their order, in the numbers of `sim.process.ticks.hands`."""
    numbers = np.array([ACTIONS.index(each) for each in actions], dtype=np.float64)
    return int(judge(_manned(cut).job, drill.state.copy(), numbers, drill.least_um))


def _kinds(chance: Random, count: int) -> Iterator[IncidentKind]:
    """All kinds in turn, each round in an order of its own."""
    left: list[IncidentKind] = []
    for _ in range(count):
        left = left or chance.sample(KINDS, len(KINDS))
        yield left.pop()


def _manned(cut: Started) -> Started:
    """The cut with somebody at it, without events, whose records are its own."""
    job = cut.job
    none = np.zeros(0)
    events = job.events._replace(kind=none, for_s=none, size=none, at=none, by_step=np.zeros(1), by_time=np.zeros(1))
    fresh = Records(
        lit_s=np.zeros_like(job.records.lit_s),
        stretch_um=job.records.stretch_um,
        block_s=np.zeros_like(job.records.block_s),
        log=np.zeros_like(job.records.log),
        history=np.zeros(4 * (_BEFORE_TICKS + _AFTER_TICKS + 2)),
    )
    return cut._replace(job=job._replace(bounds=job.bounds._replace(is_manned=1.0), events=events, records=fresh))


def _proved(cut: Started, kind: IncidentKind, chance: Random) -> OperationDrill:
    """An incident of a kind at some place at which it is one, and its remedy mends it. SettingsError where none is."""
    for _ in range(_TRIES):
        drill = _at(cut, kind, chance)
        if outcome(cut, drill, ()) != GOES_ON and outcome(cut, drill, REMEDIES[kind]) == GOES_ON:
            return drill
    raise SettingsError("nothing-to-operate", kind=kind)


def _at(cut: Started, kind: IncidentKind, chance: Random) -> OperationDrill:
    job, way = cut.job, cut.job.way
    place_um = chance.uniform(_ROOM_UM, float(way.along_um[-1]) - _ROOM_UM)
    state = _running_at(cut, place_um, chance.randrange(1, 2**31 - 2))
    run_ticks(job, state, _BEFORE_TICKS)
    _MAKERS[kind](state, along_at(cut.rows, float(state[ticks.AT]))[1])
    came_to = run_ticks(job, state, _AFTER_TICKS)
    row = int(state[ticks.FAR_ROW])
    usual_um_s = float(usual_feeds_um_s(cut.spark, way.width_um[row : row + 1], cut.work.height_um)[0])
    counters = standing(cut.work, cut.rows, float(state[ticks.AT])).counters
    return OperationDrill(
        kind, state, _strip(job, state, came_to), counters, came_to, _LEAST_WAY * _THEN_S * usual_um_s
    )


def _running_at(cut: Started, place_um: float, seed: int) -> Floats:
    """A cut that stands at a place on the path, its slot behind it."""
    way, state = cut.job.way, cut.state.copy()
    row = int(np.searchsorted(way.along_um, place_um, side="right")) - 1
    low, high = way.along_um[row : row + 2].tolist()
    first, last = way.before[row : row + 2].tolist()
    step = first + float(np.floor((last - first) * (place_um - low) / (high - low)))
    state[[ticks.AT, ticks.FARTHEST]], state[[ticks.ROW, ticks.FAR_ROW]] = step, row
    state[ticks.FRONT_UM] = place_um + usual_gap_um(cut.spark)
    state[ticks.SEED_1] = float(seed)
    return state


def _strip(job: Job, state: Floats, came_to: int) -> Floats:
    """What the instruments showed, in so many means; a second more of what they show where all stands.

    Without a wire the gap is open: full voltage, no current. Without power, and where an alarm switched the generator
    off, there is neither.
    """
    rows = job.records.history.reshape(-1, 4)[: int(state[ticks.HISTORY_ROWS])]
    parts = np.array_split(rows, min(_SHOWN, len(rows)))
    means = np.array([[part[-1, 0], part[:, 2].mean(), part[:, 3].mean()] for part in parts])
    if came_to != ticks.RUNNING:
        open_share = 1.0 if came_to in {ticks.BROKEN, ticks.BREAKS_AGAIN} else 0.0
        last_s = means[-1, 0]
        means = np.vstack([means, [[last_s, open_share, 0.0], [last_s + 1.0, open_share, 0.0]]])
    means[:, 0] -= means[-1, 0]
    return means


def _chip(state: Floats, here_um: float) -> None:
    """A chip that only a long way back clears, longer than the control goes before it stops."""
    state[ticks.CHIP_UM] = here_um
    state[ticks.CHIP_CLEAR_UM], state[ticks.CHIP_UNTIL] = _CHIP_UM, _EVER


def _setting(where: int, value: float) -> Callable[[Floats, float], None]:
    def make(state: Floats, _here_um: float) -> None:
        state[where] = value

    return make


_MAKERS: Final[Mapping[IncidentKind, Callable[[Floats, float], None]]] = {
    "too-fast": _setting(ticks.SET_SHARE, _FAST),
    "too-slow": _setting(ticks.SET_SHARE, _SLOW),
    "short": _chip,
    "broken": _setting(ticks.WIRE_OUT, 1.0),
    "power": _setting(ticks.POWER_OUT, 1.0),
    "water": _setting(ticks.PUMPLESS_UNTIL, _EVER),
    "drum": _setting(ticks.DRUMLESS_UNTIL, _EVER),
}
