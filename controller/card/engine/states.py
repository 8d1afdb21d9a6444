"""The states of one card's motion, and what becomes of one by a stop, an end, a list opened afresh.

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

from collections.abc import Collection
from dataclasses import dataclass
from typing import TypeAlias

from controller.card.engine.entries import Entry, Place
from controller.card.engine.stretch import Stretch


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
