"""From state to state as time passes: a motion sets off, is planned anew, brakes, ends.

Each way from one state of `motion` to another stands here in one method, but for those that a call takes while the axes
rest (`engine`).
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from controller.card.core.call import AxisSts
from controller.card.core.settings import CardSettings
from controller.card.core.state import CardState, LimitMet
from controller.card.engine.entries import Entry, MotionList, PathEntry
from controller.card.engine.events import Capture, Events, Trip, events_of, grows_s, take_due
from controller.card.engine.motion import (
    Braking,
    CardMotion,
    ListRun,
    Moving,
    Running,
    Task,
    Waiting,
    braking,
    ended,
    list_stretch,
    stopped,
)
from controller.card.engine.speeds import Speeds
from controller.card.engine.stretch import Start, make_stretch


class Sequencer:
    """Leads the motion of one card through its states; wakes only where something happens."""

    def __init__(
        self, settings: CardSettings, card: CardState, speeds: Speeds, motion: CardMotion, entries: MotionList
    ) -> None:
        self._settings, self._card, self._speeds = settings, card, speeds
        self._motion, self._list = motion, entries
        self._events = Events()
        self._due_s = math.inf

    def advance(self, now_s: float) -> None:
        """Let time pass up to `now_s`."""
        while self._due_s <= now_s:
            self._motion.now_s = max(self._motion.now_s, self._due_s)
            self._happen()
        self._motion.now_s = now_s

    def set_off(self, entries: Sequence[Entry], task: Task) -> None:
        """From rest: run entries."""
        stops = self._latch_errors()  # at rest: to ask later would hand out the first pulse during a call
        self._card.stopped_abnormally = False
        start = Start(self._motion.now_s, self._motion.place(), self._motion.pulses_out())
        self._go(Running(task, make_stretch(entries, start, self._speeds, self._settings)))
        if stops:
            self.stop(self._speeds.stop_um_s2)

    def run_list(self) -> None:
        """From rest: run the front of the list; where it is empty, wait for its next entry."""
        self._motion.rest(Waiting(), self._motion.place())
        if self._list.entries:
            self.set_off(self._list.first_run(), ListRun())

    def stop(self, deceleration_um_s2: float, *, abnormal: bool = False) -> None:
        """Brake along the path to rest; harmless when idle, and while braking harder already."""
        state = self._motion.state
        if not isinstance(state, Moving):
            return
        self._card.stopped_abnormally |= abnormal
        self._motion.state = braking(state, deceleration_um_s2)
        if self._motion.state is not state:
            self.replan()

    def halt(self) -> None:
        """End all motion where it is, without braking."""
        self._motion.halt(self._settings.servo_period_s)
        self._events = Events()
        self._wake()

    def replan(self) -> None:
        """Plan the rest of the motion anew from here: to call when speeds or what switches do have changed."""
        state, now = self._motion.state, self._motion.now_s
        if not isinstance(state, Moving):
            return
        stretch = state.stretch
        self._motion.hand_out(now)
        left = stretch.unfinished(now)
        if not left:
            self._events.grows_s = math.inf  # all is run, but for the last servo period
            return
        if not any(isinstance(entry, PathEntry) and entry.kind for entry in left):
            self._motion.hand_out(math.inf)  # the last period's pulses: what is left makes none
        motion = stretch.plan.at(now - stretch.start.clock_s)
        speed, acceleration = float(motion.speed_um_s), float(motion.acceleration_um_s2)
        start = Start(now, stretch.place(now), self._motion.at_um, speed, acceleration)
        self._cut(state, left)
        if isinstance(state.task, ListRun):
            left = self._list.first_run()
        deceleration = state.deceleration_um_s2 if isinstance(state, Braking) else 0.0
        self._go(replace(state, stretch=make_stretch(left, start, self._speeds, self._settings, deceleration)))

    def expect_growth(self) -> None:
        """Find when the entries behind those that run have to be taken into the plan; never where it comes to rest."""
        state, self._events.grows_s = self._motion.state, math.inf
        if isinstance(state, Running) and (stretch := list_stretch(state)):
            self._events.grows_s = grows_s(stretch, self._list.entries, self._motion.now_s, self._settings)
        self._wake()

    def check_errors(self) -> None:
        """Latch the motion error of axes whose position error is over its limit, and stop for those that ask for it."""
        if self._latch_errors():
            self.stop(self._speeds.stop_um_s2)

    def _happen(self) -> None:
        """What is due now."""
        now, events = self._motion.now_s, self._events
        for due in take_due(events.outputs, now):
            self._card.set_outputs(*due.output)
        for capture in take_due(events.captures, now):
            self._capture(capture)
        state = self._motion.state
        if events.trips and events.trips[0].time_s <= now:
            self._trip(events.trips.pop(0))
        elif isinstance(state, Moving) and state.stretch.end_s <= now:
            self._finish(state)
        elif events.grows_s <= now:
            self.replan()
        self._wake()

    def _wake(self) -> None:
        self._due_s = self._events.next_s()

    def _go(self, state: Moving) -> None:
        """Go along a stretch, from rest or from the one before it."""
        self._motion.state = state
        self._events = events_of(state.stretch, self._card, self._settings)
        self.expect_growth()

    def _capture(self, capture: Capture) -> None:
        own = self._card.axes[capture.axis]
        own.capture(capture.place)
        if capture.armed is AxisSts.HOME_ARMED:
            own.home_armed = False
        else:
            own.index_armed = False

    def _trip(self, trip: Trip) -> None:
        """Meet a limit switch: its flag at once, then the axes brake.

        A move that begins beyond the switch and goes on that way makes no pulse, or those of the start speed's braking.
        """
        self._card.axes[trip.axis].latched |= trip.bit
        if not self._card.stopped_abnormally:  # while it brakes beyond the switch it meets that again
            is_positive = trip.bit is AxisSts.POSITIVE_LIMIT
            self._card.limits_met.append(LimitMet(self._motion.now_s, trip.axis + 1, is_positive))
        self.stop(self._speeds.stop_um_s2, abnormal=True)

    def _latch_errors(self) -> bool:
        """Latch the motion error of axes; whether one of them asks for a stop."""
        over = [own for own in self._card.axes if abs(self._motion.error(own)) > own.error_limit]
        for own in over:
            own.latched |= AxisSts.MOTION_ERROR
        return any(own.auto_stop for own in over)

    def _finish(self, state: Moving) -> None:
        """The plan has ended: come to rest, or go on with what comes next."""
        self._motion.hand_out(math.inf)
        if isinstance(state, Running):
            for due in self._events.outputs:  # due by now but for the rounding of times
                self._card.set_outputs(*due.output)
            self._cut(state, [])
            self._motion.rest(ended(state), state.stretch.row_end(self._motion.now_s))
        else:
            self._break(state)
        self._events = Events()
        if isinstance(self._motion.state, Waiting):
            self.run_list()
        if not self._motion.moving:
            for own, moved in zip(self._card.axes, self._motion.take_moved(), strict=True):
                own.latched |= AxisSts.FINISHED if moved else 0

    def _break(self, state: Braking) -> None:
        """A stop has come to rest: keep the place and what is left; the list keeps its own."""
        stretch, now = state.stretch, self._motion.now_s
        left = stretch.unfinished(now)
        place = stretch.place(now) if left else stretch.row_end(now)
        self._cut(state, left)
        self._motion.break_place = place
        behind = self._list.entries if isinstance(state.task, ListRun) else left
        self._motion.rest(stopped(state, place, behind), place)

    def _cut(self, state: Moving, left: list[Entry]) -> None:
        """The stretch is over, up to now: keep what is left of the list, and what else only the stretch knows."""
        stretch, now = state.stretch, self._motion.now_s
        self._motion.note_moved(stretch)
        if isinstance(state.task, ListRun):
            number = stretch.number(now)
            self._list.executed = self._list.executed if number is None else number
            self._list.replace(len(stretch.entries), left)
