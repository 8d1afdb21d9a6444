"""The state of one card's motion, and all that may be asked of it at any instant."""

import math
from collections.abc import Callable

import numpy as np

from controller.card.core.codes import AxisSts, CrdSts
from controller.card.core.settings import CardSettings
from controller.card.core.state import AxisState, CardState
from controller.card.engine.ahead import Ahead
from controller.card.engine.entries import ORIGIN, Entry, Place
from controller.card.engine.motion_list import MotionList
from controller.card.engine.speeds import speeds_of
from controller.card.engine.stretch import Stretch
from controller.stepping.interpolators import EqualTime
from controller.stepping.pulses import Pulses

_NEAR = 0.5
"""Pulses within which the axes stand at a place."""

NOTHING = Ahead([], [], [])
"""What is ahead of axes at rest."""


class Motion:
    """Where one card's motion is. Places are pulses from where the axes stood when the card was made.

    Attributes
    ----------
    speeds
        What the calls that set speeds change.
    list
        The list; path calls are stored in it while it is open.
    break_place
        Where the motion came to rest when it was last stopped.
    """

    def __init__(self, settings: CardSettings, state: CardState, on_pulses: Callable[[Pulses], None] | None) -> None:
        self._settings, self._state, self._on_pulses = settings, state, on_pulses
        self.speeds = speeds_of(settings)
        self.list = MotionList()
        self.break_place = self._list_break = ORIGIN
        self._number = 0
        self._runs = self._interrupted = self._abnormal = False
        self._stretch: Stretch | None = None
        self._in_list = False
        self._left: list[Entry] = []
        self._numbers = np.zeros(0, dtype=np.int32)
        self._stopping = 0.0
        self._ahead = NOTHING
        self._moved = [False] * len(state.axes)
        self._place, self._at_um = ORIGIN, (0, 0, 0, 0)
        self._now_s, self._due_s, self._grows_s = 0.0, math.inf, math.inf
        self._latest_s = 0.0

    @property
    def moving(self) -> bool:
        """Whether a motion is on, braking and waiting included."""
        return self._stretch is not None

    def axis_moving(self, number: int) -> bool:
        """Whether axis 1 to 4 is moved by what is being executed."""
        return self._stretch is not None and self._stretch.axes_moving(self._now_s)[number - 1]

    def place(self) -> Place:
        """Profile place of the axes now, pulses."""
        if self._stretch is None:
            return self._place
        if not isinstance(self._stretch.interpolator, EqualTime):
            self._hand_out(self._now_s)
        return self._stretch.place(self._now_s)

    def pulses_out(self) -> tuple[int, int, int, int]:
        """Pulses that each axis has been sent by now."""
        self._hand_out(self._now_s)
        return self._at_um

    def error(self, own: AxisState) -> int:
        """Profile less actual position of an axis now, pulses."""
        axis = own.number - 1
        return round(self.place()[axis]) - self.pulses_out()[axis] - own.actual_shift

    def velocity(self) -> Place:
        """Profile velocity of the axes now, µm/s."""
        return self._stretch.velocity(self._now_s) if self._stretch else ORIGIN

    def speed(self) -> float:
        """Speed along the path now, µm/s."""
        return self._stretch.speed(self._now_s) if self._stretch else 0.0

    def entry_end(self) -> Place:
        """End of the path entry being executed; where the axes stand at rest."""
        return self._stretch.row_end(self._now_s) if self._stretch else self._place

    @property
    def number(self) -> int:
        """Number of the path entry being executed, or executed last, since the list was opened."""
        if self._stretch is not None and self._in_list and self._stretch.rows:
            return self._stretch.rows[self._stretch.row(self._now_s)].number
        return self._number

    def coordinate_status(self) -> int:
        """Word of `GT_GetCrdSts`."""
        status = CrdSts(0) if self.moving else CrdSts.IDLE
        if self._pending() == 0:
            status |= CrdSts.LIST_EMPTY
        return int(status | CrdSts.ABNORMAL if self._abnormal else status)

    def _pending(self) -> int:
        """Entries of the list that are not finished."""
        entries = len(self.list.entries)
        if entries and self._stretch is not None and self._in_list:
            return entries - self._stretch.done(self._now_s)
        return entries

    def _near(self, place: Place) -> bool:
        return all(abs(a - b) <= _NEAR for a, b in zip(self._place, place, strict=True))

    def _note_moved(self, stretch: Stretch) -> None:
        self._moved = [a or b for a, b in zip(self._moved, stretch.axes_moved(self._now_s), strict=True)]

    def _latch_finished(self) -> None:
        for own, moved in zip(self._state.axes, self._moved, strict=True):
            own.latched |= AxisSts.FINISHED if moved else 0
        self._moved = [False] * len(self._moved)

    def _hand_out(self, until_s: float) -> None:
        """Work out the pulses due by a time, and hand them on."""
        if self._stretch is None or self._stretch.interpolator is None:
            return
        if self._on_pulses is None and isinstance(self._stretch.interpolator, EqualTime):
            self._stretch.interpolator.skip(until_s)
        for pulses in self._stretch.interpolator.pulses(until_s):
            # Those of a last period that was handed out beforehand may lie behind the first ones of what comes next.
            t_s = np.maximum(pulses.t_s, self._latest_s)
            self._latest_s = float(t_s[-1])
            if self._on_pulses is not None:
                self._on_pulses(pulses._replace(t_s=t_s, row=self._numbers[pulses.row]))
        at = self._stretch.interpolator.at_um
        x, y, z, a = (*at, *self._at_um[len(at) :])
        self._at_um = (x, y, z, a)
