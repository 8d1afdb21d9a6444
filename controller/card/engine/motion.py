"""The motion of one card at any instant: its clock, its states, and the pulses that have gone out.

The states of one card's motion, and what becomes of one by a stop, an end, a list opened afresh.

==========  =================  ===============================================================
from        by                 to
==========  =================  ===============================================================
rest        start, push, move  `Running`; `Waiting` where the list is started empty
`Running`   stop, limit        `Braking`
`Running`   its end            the list: `Waiting`; a move: how the list rests beneath it
`Braking`   standing still     the list: `BrokenList`, or `Idle` where nothing is left of it;
                               a move: `BrokenMove`, or how the list rests beneath it
a break     restore            `Running`
rest        opening the list   `Idle`; what is left of a move stays
any         reset              `Idle`
==========  =================  ===============================================================

What moves is either the list (`ListRun`) or an immediate move (`Move`), beneath which the list keeps its own rest: a
list that was stopped can be gone on with after any number of moves. A motion that brakes has a deceleration, one that
rests has no stretch, and only what was stopped has something left: nothing else can be written down.
"""

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from controller.card.core.settings import AXES
from controller.card.core.state import AxisState
from controller.card.engine.entries import ORIGIN, Entry, Place, four
from controller.card.engine.stretch import Stretch
from controller.stepping.interpolators import EqualTime
from controller.stepping.pulses import Pulses


@dataclass(frozen=True, slots=True)
class Idle:
    """At rest, with nothing to go on with."""


@dataclass(frozen=True, slots=True)
class Waiting:
    """At rest, the list runs and is empty: the next entry pushed begins at once."""


@dataclass(frozen=True, slots=True)
class BrokenList:
    """At rest, the list was stopped at a place and holds what is left of it."""

    place: Place


@dataclass(frozen=True, slots=True)
class Move:
    """An immediate move; `beneath` is how the list rests meanwhile."""

    beneath: Idle | BrokenList


@dataclass(frozen=True, slots=True)
class BrokenMove:
    """At rest, an immediate move was stopped at a place, with entries left. ValueError where none is."""

    place: Place
    move: Move
    left: tuple[Entry, ...]

    def __post_init__(self) -> None:
        if not self.left:
            raise ValueError(f"nothing is left of a move that was broken at {self.place}")


@dataclass(frozen=True, slots=True)
class ListRun:
    """The list runs; it goes on with what is pushed meanwhile."""


Task: TypeAlias = ListRun | Move


@dataclass(frozen=True, slots=True, eq=False)
class Running:
    """On the way along a stretch of a task, waits included."""

    task: Task
    stretch: Stretch


@dataclass(frozen=True, slots=True, eq=False)
class Braking:
    """On the way to a stop, with a deceleration asked for, µm/s². ValueError where that is none."""

    task: Task
    stretch: Stretch
    deceleration_um_s2: float

    def __post_init__(self) -> None:
        if not self.deceleration_um_s2 > 0.0:
            raise ValueError(f"a motion brakes with more than {self.deceleration_um_s2} µm/s²")


Resting: TypeAlias = Idle | Waiting | BrokenList | BrokenMove
Moving: TypeAlias = Running | Braking
State: TypeAlias = Resting | Moving


def list_stretch(state: State) -> Stretch | None:
    """The stretch of the list that is under way; None where the list rests."""
    return state.stretch if isinstance(state, Moving) and isinstance(state.task, ListRun) else None


def braking(state: Moving, deceleration_um_s2: float) -> Braking:
    """A stop is asked for: brake, or brake harder; a softer stop than the one that is on changes nothing."""
    if isinstance(state, Braking) and deceleration_um_s2 <= state.deceleration_um_s2:
        return state
    return Braking(state.task, state.stretch, deceleration_um_s2)


def ended(state: Running) -> Resting:
    """The stretch is run to its end: the list waits for more, a move leaves the list as it rested."""
    return state.task.beneath if isinstance(state.task, Move) else Waiting()


def stopped(state: Braking, place: Place, left: Collection[Entry]) -> Resting:
    """Rest at a place with what is left of the task; if nothing is left, the task is over."""
    if isinstance(state.task, Move):
        return BrokenMove(place, state.task, tuple(left)) if left else state.task.beneath
    return BrokenList(place) if left else Idle()


def without_move(state: Resting) -> Idle | BrokenList:
    """How the list rests once something else than the list begins: a move that was stopped is forgotten."""
    if isinstance(state, BrokenMove):
        return state.move.beneath
    return state if isinstance(state, BrokenList) else Idle()


def without_list(state: Resting) -> Idle | BrokenMove:
    """The list is emptied and does not run: only what is left of a move stays."""
    return BrokenMove(state.place, Move(Idle()), state.left) if isinstance(state, BrokenMove) else Idle()


_ROUNDING = 1e-6
_NEAR = 0.5
"""Pulses within which the axes stand at a place."""


class Driven(NamedTuple):
    """A stretch that the axes were driven along, up to a time on the card's clock, s."""

    stretch: Stretch
    until_s: float


class CardMotion:
    """Where one card's axes are. Places are pulses from where the axes stood when the card was made.

    Attributes
    ----------
    now_s
        The card's clock.
    state
        What the axes do; see its states above.
    break_place
        Where the motion came to rest when it was last stopped; while something is broken, the place of that.
    at_um
        Pulses handed out to each axis so far; `pulses_out` hands out those due by now first.
    """

    def __init__(
        self,
        on_pulses: Callable[[Pulses], None] | None = None,
        on_driven: Callable[[Driven], None] | None = None,
    ) -> None:
        self.now_s = 0.0
        self.state: State = Idle()
        self.break_place = self._rest_place = ORIGIN
        self.at_um = (0, 0, 0, 0)
        self._moved = [False] * AXES
        self._latest_s = 0.0
        self._on_pulses, self._on_driven = on_pulses, on_driven

    @property
    def moving(self) -> bool:
        """Whether a motion is on, braking and waiting included."""
        return isinstance(self.state, Moving)

    @property
    def _stretch(self) -> Stretch | None:
        return self.state.stretch if isinstance(self.state, Moving) else None

    def axis_moving(self, number: int) -> bool:
        """Whether axis 1 to 4 is moved by what is being executed."""
        stretch = self._stretch
        return stretch is not None and stretch.axes_moving(self.now_s)[number - 1]

    def place(self) -> Place:
        """Profile place of the axes now, pulses."""
        stretch = self._stretch
        if stretch is None:
            return self._rest_place
        if not isinstance(stretch.interpolator, EqualTime):
            self.hand_out(self.now_s)
        return stretch.place(self.now_s)

    def pulses_out(self) -> tuple[int, int, int, int]:
        """Pulses that each axis has been sent by now."""
        self.hand_out(self.now_s)
        return self.at_um

    def error(self, own: AxisState) -> int:
        """Profile less actual position of an axis now, pulses."""
        axis = own.number - 1
        return round(self.place()[axis]) - self.pulses_out()[axis] - own.actual_shift

    def velocity(self) -> Place:
        """Profile velocity of the axes now, µm/s."""
        stretch = self._stretch
        return stretch.velocity(self.now_s) if stretch else ORIGIN

    def speed(self) -> float:
        """Speed along the path now, µm/s."""
        stretch = self._stretch
        return stretch.speed(self.now_s) if stretch else 0.0

    def entry_end(self) -> Place:
        """End of the path entry being executed; where the axes stand at rest."""
        stretch = self._stretch
        return stretch.row_end(self.now_s) if stretch else self._rest_place

    def is_near(self, place: Place) -> bool:
        """Whether axes at rest stand at a place, to half a pulse."""
        return all(abs(a - b) <= _NEAR for a, b in zip(self._rest_place, place, strict=True))

    def rest(self, state: Resting, place: Place) -> None:
        """Come to rest at a place; where a list or a move is broken, its place becomes the break point."""
        self.state, self._rest_place = state, place
        if isinstance(state, BrokenList | BrokenMove):
            self.break_place = state.place

    def forget_move(self, state: Resting) -> Idle | BrokenList:
        """Forget a move that was stopped: the break point is that of the list again, where it has one."""
        forgotten = without_move(state)
        self.rest(forgotten, self._rest_place)
        return forgotten

    def snap(self, axis: int) -> None:
        """Put the profile of axis 1 to 4, at rest, on the whole pulse it stands at."""
        place = list(self._rest_place)
        place[axis - 1] = float(self.at_um[axis - 1])
        self._rest_place = four(place)

    def halt(self, period_s: float) -> None:
        """End all motion where it is, without braking: profile and break point are where the pulses are.

        Those are of the servo periods that are over, of `period_s`.
        """
        if self._stretch is not None:
            self._tell(self._stretch, math.floor(self.now_s / period_s + _ROUNDING) * period_s)
        place = four(map(float, self.pulses_out()))
        self.rest(Idle(), place)
        self.break_place = place
        self.take_moved()

    def _tell(self, stretch: Stretch, until_s: float) -> None:
        if self._on_driven is not None and until_s >= stretch.start.clock_s:
            self._on_driven(Driven(stretch, until_s))

    def note_moved(self, stretch: Stretch) -> None:
        """Note the axes that a stretch has moved by now; it is over."""
        self._tell(stretch, self.now_s)
        self._moved = [a or b for a, b in zip(self._moved, stretch.axes_moved(self.now_s), strict=True)]

    def take_moved(self) -> list[bool]:
        """Of each axis, whether it was moved since this was asked last."""
        moved, self._moved = self._moved, [False] * AXES
        return moved

    def hand_out_heard(self) -> None:
        """Hand out the pulses due by now, if anybody listens."""
        if self._on_pulses is not None:
            self.hand_out(self.now_s)

    def hand_out(self, until_s: float) -> None:
        """Work out the pulses of the stretch that are due by a time, and hand them on."""
        stretch = self._stretch
        if stretch is None or stretch.interpolator is None:
            return
        if self._on_pulses is None and isinstance(stretch.interpolator, EqualTime):
            stretch.interpolator.skip(until_s)
        for pulses in stretch.interpolator.pulses(until_s):
            # Those of a last period that was handed out beforehand may lie behind the first ones of what comes next.
            t_s = np.maximum(pulses.t_s, self._latest_s)
            self._latest_s = float(t_s[-1])
            if self._on_pulses is not None:
                self._on_pulses(pulses._replace(t_s=t_s, row=stretch.numbers[pulses.row]))
        at = stretch.interpolator.at_um
        x, y, z, a = (*at, *self.at_um[len(at) :])
        self.at_um = (x, y, z, a)
