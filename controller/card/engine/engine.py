"""The motion of one card: its list, the plan it runs, and what happens on the way.

The list (`motion_list`) holds entries (`entries`): lines, arcs, stepped blocks, waits, outputs. What runs is a
`Stretch`: the entries from the front of the list that one interpolator runs without rest in between, made into a path,
its limits and a plan from where the axes are. Nothing is stepped through time: place, speed and pulses at any instant
follow from the plan, and the engine only wakes where something happens (`ahead`): an output is due, a switch is met,
the stretch ends, or entries pushed meanwhile have to be taken into the plan. They change nothing before the plan begins
to brake for its end, so the list is planned anew only then.

Whatever changes the motion (a stop, an override, entries behind) cuts the stretch where it is and makes a new one of
what is left, from the same place, speed and pulses: so none is lost.

Places are pulses from where the axes stood when the card was made. Grade C throughout: the run of the list ends with a
stop and with an immediate move, and survives an empty list; what is left of a stopped immediate move is kept until the
next one begins or the list is started.
"""

import math

from controller.card.core.codes import LIST_FULL, Code, Refused
from controller.card.engine.entries import Entry, Place, Segment, four, line
from controller.card.engine.running import RunningMotion
from controller.card.engine.speeds import speeds_of


class Engine(RunningMotion):
    """Motion of one card over simulated time: what the calls ask of it; `Motion` answers where it is."""

    def list_end(self) -> Place:
        """Where the next entry of the list starts: the end of the one before it, or where the axes come to rest."""
        self._begin_list_end()
        return self.list.end()

    def open_list(self, *, afresh: bool) -> None:
        """Open the list, emptied if `afresh`. Refused with 1 if it is to be emptied while anything moves."""
        if not afresh:
            self.list.is_open = True
            return
        if self.moving:
            raise Refused(Code.COMMAND)
        self._state.command_status = 0
        self.list.clear(is_open=True)
        self._number, self._runs, self._interrupted, self._abnormal = 0, False, False, False

    def push(self, entry: Entry) -> None:
        """Put an entry into the list, which has room; it runs at once where the list runs and is empty."""
        self._begin_list_end()
        self.list.push(entry)
        self._state.command_status = 0
        if self._stretch is None:
            if self._runs:
                self._begin()
        elif self._in_list and len(self.list.entries) == len(self._stretch.entries) + 1:
            self._expect_growth(self._stretch)

    def check_room(self, entries: int = 1) -> None:
        """Refused with 1, list full, where the list does not take so many entries."""
        if self._pending() + entries > self._settings.capacity:
            raise Refused(Code.COMMAND, LIST_FULL)

    def move(self, entry: Segment) -> None:
        """Run a line or an arc at once. Refused with 1 while anything moves."""
        if self.moving:
            raise Refused(Code.COMMAND)
        self._forget_move()
        self._move_on([entry])

    def start(self) -> None:
        """Run the list, or go on with it after a stop; nothing changes where it runs. Refused with 1 where it cannot.

        Where the axes stand elsewhere than the list begins, a first line starts from there, and anything else is
        refused with 1 (grade C).
        """
        if self.moving:
            if self._in_list and not self._stopping:
                return
            raise Refused(Code.COMMAND)
        if self._interrupted:
            if not self._near(self._list_break):
                raise Refused(Code.COMMAND)
        elif self.list.entries and not self._near(self.list.start):
            self._start_from_here()
        self._forget_move()
        self._run_list()

    def restore(self) -> None:
        """Go on with what was stopped last. Refused with 1 unless something is left of it and the axes stand there."""
        if self.moving or not (self._left or self._interrupted) or not self._near(self.break_place):
            raise Refused(Code.COMMAND)
        if self._left:
            self._move_on(self._left)
        else:
            self._run_list()

    def abort(self) -> None:
        """End all motion where it is, without braking: the profile is where the pulses are."""
        if self._stretch is None:
            return
        self._stopping = math.inf
        self._hand_out(self._now_s)
        self._come_to_rest(self._stretch, self._stretch.left(self._now_s))
        self._place = four(float(at) for at in self._at_um)
        self._latch_finished()
        self._wake()

    def reset(self) -> None:
        """Motion ends where it is, the list is emptied and closed, speeds are those of the settings again."""
        self.abort()
        self.list.clear(is_open=False)
        self.speeds = speeds_of(self._settings)
        self._place = self.break_place = four(float(at) for at in self._at_um)
        self._number, self._runs, self._interrupted, self._abnormal, self._left = 0, False, False, False, []

    def snap(self, axis: int) -> None:
        """Put the profile of an idle axis 1 to 4 on the whole pulse it stands at."""
        if self._stretch is None:
            place = list(self._place)
            place[axis - 1] = float(self._at_um[axis - 1])
            self._place = four(place)

    def look(self) -> None:
        """Look again for switches ahead: to call when a capture is armed, or limits are switched on or off."""
        self.replan()

    def _begin_list_end(self) -> None:
        if not self.list.entries and (self._stretch is None or not self._in_list):
            self.list.begin(self.entry_end())

    def _start_from_here(self) -> None:
        """Let the list begin where the axes stand. Refused with 1 unless its first path entry is a line."""
        first, entry = self.list.first_path_entry()
        if entry is None:
            return
        if not isinstance(entry, Segment) or entry.curvature:
            raise Refused(Code.COMMAND)
        self.list.entries[first] = line(entry.number, entry.pace, self._place, entry.end)

    def _forget_move(self) -> None:
        """Forget an immediate move that was stopped: the break point is that of the list again, where it has one."""
        self._left = []
        if self._interrupted:
            self.break_place = self._list_break

    def _move_on(self, entries: list[Entry]) -> None:
        """Run an immediate move, or what is left of it."""
        self._state.command_status = 0
        self._runs, self._in_list, self._left = False, False, []
        self._set_off(entries)

    def _run_list(self) -> None:
        """Run the list from its front."""
        self._state.command_status = 0
        self._runs, self._interrupted = True, False
        self._begin()
