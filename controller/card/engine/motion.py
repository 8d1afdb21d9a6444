"""The motion of one card at any instant: its clock, its state, and the pulses that have gone out."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from controller.card.core.settings import AXES
from controller.card.core.state import AxisState
from controller.card.engine.entries import ORIGIN, Place, four
from controller.card.engine.states import BrokenList, BrokenMove, Idle, Moving, Resting, State, without_move
from controller.card.engine.stretch import Stretch
from controller.stepping.interpolators import EqualTime
from controller.stepping.pulses import Pulses

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
        What the axes do; see `states`.
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
