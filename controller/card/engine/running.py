"""The motion of one card as time passes: what happens on the way, and the plan made anew where it changes."""

import math

import numpy as np

from controller.card.core.codes import AxisSts
from controller.card.engine.ahead import look_ahead
from controller.card.engine.entries import Entry, Kind, Output, Segment, Stepped
from controller.card.engine.making import make_stretch
from controller.card.engine.motion import NOTHING, Motion
from controller.card.engine.stretch import Start, Stretch


class RunningMotion(Motion):
    """Motion that goes on with time, is planned anew, and comes to rest."""

    def advance(self, now_s: float) -> None:
        """Let time pass up to `now_s`."""
        while self._due_s <= now_s:
            self._now_s = max(self._now_s, self._due_s)
            self._happen()
        self._now_s = now_s

    def hand_out(self) -> None:
        """Hand out the pulses due by now, if anybody listens."""
        if self._on_pulses is not None:
            self._hand_out(self._now_s)

    def _happen(self) -> None:
        """What is due now."""
        now, ahead = self._now_s, self._ahead
        while ahead.outputs and ahead.outputs[0][0] <= now:
            self.set_output(ahead.outputs.pop(0)[1])
        while ahead.captures and ahead.captures[0].time_s <= now:
            self._capture()
        if ahead.trips and ahead.trips[0].time_s <= now:
            self._trip()
        elif self._stretch is not None and self._stretch.end_s <= now:
            self._finish(self._stretch)
        elif self._grows_s <= now:
            self.replan()
        self._wake()

    def _wake(self) -> None:
        ends = self._stretch.end_s if self._stretch else math.inf
        self._due_s = min(self._ahead.next_s(), ends, self._grows_s)

    def _capture(self) -> None:
        _, axis, armed, place = self._ahead.captures.pop(0)
        own = self._state.axes[axis]
        own.captured = place
        own.latched |= AxisSts.CAPTURED
        if armed is AxisSts.HOME_ARMED:
            own.home_armed = False
        else:
            own.index_armed = False

    def _trip(self) -> None:
        """Meet a limit switch: its flag at once, then the axes brake.

        A move that begins beyond the switch and goes on that way makes no pulse, or those of the start speed's braking.
        """
        _, axis, bit = self._ahead.trips.pop(0)
        self._state.axes[axis].latched |= bit
        self.stop(self.speeds.stop_um_s2, abnormal=True)

    def set_output(self, output: Output) -> None:
        """Set outputs now."""
        self._state.outputs = (self._state.outputs & ~output.mask) | (output.value & output.mask)

    def stop(self, deceleration_um_s2: float, *, abnormal: bool = False) -> None:
        """Brake along the path to rest; harmless when idle, and while braking harder already."""
        if self._stretch is None:
            return
        self._abnormal = self._abnormal or abnormal
        if deceleration_um_s2 > self._stopping:
            self._stopping = deceleration_um_s2
            self.replan()

    def replan(self) -> None:
        """Plan the rest of the motion anew from here: to call when speeds have changed."""
        stretch, now = self._stretch, self._now_s
        if stretch is None:
            return
        self._hand_out(now)
        left = stretch.left(now)
        if not left:
            self._grows_s = math.inf  # all is run, but for the last servo period
            return
        if not any(isinstance(entry, Segment | Stepped) and entry.kind for entry in left):
            self._hand_out(math.inf)  # the last period's pulses: what is left makes none
        motion = stretch.plan.at(now - stretch.start.clock_s)
        speed, acceleration = float(motion.speed_um_s), float(motion.acceleration_um_s2)
        start = Start(now, stretch.place(now), self._at_um, speed, acceleration)
        self._note_moved(stretch)
        if self._in_list:
            self._number = self.number
            self.list.replace(len(stretch.entries), left)
            left = self.list.first_run()
        self._run(make_stretch(left, start, self.speeds, self._settings, self._stopping))

    def check_errors(self) -> None:
        """Latch the motion error of axes whose position error is over its limit, and stop for those that ask for it."""
        if self._latch_errors():
            self.stop(self.speeds.stop_um_s2)

    def _latch_errors(self) -> bool:
        """Latch the motion error of axes; whether one of them asks for a stop."""
        over = [own for own in self._state.axes if abs(self.error(own)) > own.error_limit]
        for own in over:
            own.latched |= AxisSts.MOTION_ERROR
        return any(own.auto_stop for own in over)

    def _begin(self) -> None:
        """Set off with the front of the list."""
        if self.list.entries:
            self._in_list = True
            self._set_off(self.list.first_run())

    def _set_off(self, entries: list[Entry]) -> None:
        """Begin a motion from rest."""
        stops = self._latch_errors()  # at rest: to ask later would hand out the first pulse during a call
        self._stopping, self._abnormal = 0.0, False
        start = Start(self._now_s, self._place, self._at_um)
        self._run(make_stretch(entries, start, self.speeds, self._settings))
        if stops:
            self.stop(self.speeds.stop_um_s2)

    def _run(self, stretch: Stretch) -> None:
        self._stretch = stretch
        numbers = [row.number if self._in_list else -1 for row in stretch.rows]
        self._numbers = np.array(numbers, dtype=np.int32)
        self._ahead = look_ahead(stretch, self._state, self._settings)
        self._expect_growth(stretch)
        self._wake()

    def _expect_growth(self, stretch: Stretch) -> None:
        """Find when the entries behind those that run have to be taken into the plan; never where it comes to rest."""
        self._grows_s = math.inf
        planned, entries = len(stretch.entries), self.list.entries
        if not self._in_list or self._stopping or len(entries) <= planned or not stretch.rows:
            return
        kind = stretch.rows[0].kind
        if entries[planned].kind in (None, kind) and stretch.done(self._now_s) < planned:
            self._grows_s = max(self._whole_periods(stretch.grows_s(self._now_s), kind), self._now_s)
            self._due_s = min(self._due_s, self._grows_s)

    def _whole_periods(self, time_s: float, kind: Kind | None) -> float:
        """The end of the servo period at or before a time: a plan that changes there changes no pulse before."""
        if kind is not Kind.EQUAL_TIME or self._settings.jerk_pulse_ms3 < math.inf:
            return time_s
        return math.floor(time_s / self._settings.servo_period_s) * self._settings.servo_period_s

    def _finish(self, stretch: Stretch) -> None:
        """The plan has ended: come to rest, or go on with what comes next."""
        self._hand_out(math.inf)
        if not self._stopping:
            for _, output in self._ahead.outputs:  # due by now but for the rounding of times
                self.set_output(output)
        self._come_to_rest(stretch, stretch.left(self._now_s) if self._stopping else [])
        if self._runs and self._in_list:
            self._begin()
        if self._stretch is None:
            self._latch_finished()

    def _come_to_rest(self, stretch: Stretch, left: list[Entry]) -> None:
        self._note_moved(stretch)
        self._number, self._place = self.number, stretch.place(self._now_s)
        if not left:
            self._place = stretch.row_end(self._now_s)
        if self._in_list:
            self.list.replace(len(stretch.entries), left)
        if self._stopping:
            self._break(left)
        self._stretch, self._ahead, self._grows_s = None, NOTHING, math.inf

    def _break(self, left: list[Entry]) -> None:
        """A stop has come to rest: keep the place, and what is left of an immediate move; the list keeps its own."""
        self.break_place = self._place
        if self._in_list:
            self._list_break, self._runs, self._interrupted = self._place, False, bool(self.list.entries)
        else:
            self._left = left
