"""The engine of one card: what calls ask of its motion, refused where it cannot be.

It is made of three: the list (`MotionList`), the clock with the state and the pulses (`CardMotion`), and what leads the
motion from state to state as time passes (`Sequencer`).

The list holds entries (`entries`): lines, arcs, stepped blocks, waits, outputs. What runs is a `Stretch`: the entries
from the front of the list that one interpolator runs without rest in between, made into a path, its limits and a plan
from where the axes are. Nothing is stepped through time: place, speed and pulses at any instant follow from the plan,
and the engine only wakes where something happens (`events`): an output is due, a switch is met, the stretch ends, or
entries pushed meanwhile have to be taken into the plan. They change nothing before the plan begins to brake for its
end, so the list is planned anew only then.

Whatever changes the motion (a stop, an override, entries behind) cuts the stretch where it is and makes a new one of
what is left, from the same place, speed and pulses: so none is lost.

Places are pulses from where the axes stood when the card was made. Grade C throughout: the run of the list ends with a
stop and with an immediate move, and survives an empty list; what is left of a stopped immediate move is kept until the
next one begins or the list is started.
"""

from collections.abc import Callable

from controller.card.core.call import (
    LIST_FULL,
    Code,
    CrdSts,
    Refused,
)
from controller.card.core.settings import CardSettings
from controller.card.core.state import CardState
from controller.card.engine.entries import NO_NUMBER, Entry, MotionList, Place, Segment
from controller.card.engine.motion import (
    BrokenList,
    BrokenMove,
    CardMotion,
    Driven,
    Move,
    Moving,
    Running,
    Waiting,
    list_stretch,
    without_list,
    without_move,
)
from controller.card.engine.sequencer import Sequencer
from controller.card.engine.speeds import speeds_of
from controller.stepping.pulses import Pulses


class Engine:
    """Motion of one card over simulated time.

    Attributes
    ----------
    speeds
        What the calls that set speeds change.
    list
        The list; path calls are stored in it while it is open.
    motion
        Clock, state and pulses: where the axes are.
    sequencer
        What time and stops do to the motion.
    """

    def __init__(
        self,
        settings: CardSettings,
        card: CardState,
        on_pulses: Callable[[Pulses], None] | None,
        on_driven: Callable[[Driven], None] | None,
    ) -> None:
        self._settings, self._card = settings, card
        self.speeds = speeds_of(settings)
        self.list = MotionList()
        self.motion = CardMotion(on_pulses, on_driven)
        self.sequencer = Sequencer(settings, card, self.speeds, self.motion, self.list)

    @property
    def number(self) -> int:
        """Number of the path entry being executed, or executed last, since the list was opened."""
        stretch = list_stretch(self.motion.state)
        number = stretch.number(self.motion.now_s) if stretch else None
        return self.list.executed if number is None else number

    def coordinate_status(self) -> int:
        """Word of `GT_GetCrdSts`."""
        status = CrdSts(0) if self.motion.moving else CrdSts.IDLE
        if self._pending() == 0:
            status |= CrdSts.LIST_EMPTY
        return int(status | CrdSts.ABNORMAL if self._card.stopped_abnormally else status)

    def _pending(self) -> int:
        """Entries of the list that are not finished."""
        entries, stretch = len(self.list.entries), list_stretch(self.motion.state)
        return entries - stretch.done(self.motion.now_s) if entries and stretch else entries

    def list_end(self) -> Place:
        """Where the next entry of the list starts: the end of the one before it, or where the axes come to rest."""
        self._begin_list_end()
        return self.list.end()

    def open_list(self, *, afresh: bool) -> None:
        """Open the list, emptied if `afresh`. Refused with 1 if it is to be emptied while anything moves."""
        if not afresh:
            self.list.is_open = True
            return
        state = self.motion.state
        if isinstance(state, Moving):
            raise Refused(Code.COMMAND)
        self._card.command_status, self._card.stopped_abnormally = 0, False
        self.list.clear(is_open=True)
        self.motion.state = without_list(state)

    def check_room(self, entries: int = 1) -> None:
        """Refused with 1, list full, where the list does not take so many entries."""
        room = self._settings.capacity - entries
        if len(self.list.entries) > room and self._pending() > room:
            raise Refused(Code.COMMAND, LIST_FULL)

    def push(self, entry: Entry) -> None:
        """Put an entry into the list, which has room; it runs at once where the list runs and is empty."""
        self._begin_list_end()
        self.list.push(entry)
        self._card.command_status = 0
        state = self.motion.state
        if isinstance(state, Waiting):
            self.sequencer.run_list()
        elif isinstance(state, Moving) and len(self.list.entries) == len(state.stretch.entries) + 1:
            self.sequencer.expect_growth()

    def move(self, entry: Segment) -> None:
        """Run a line or an arc at once. Refused with 1 while anything moves."""
        state = self.motion.state
        if isinstance(state, Moving):
            raise Refused(Code.COMMAND)
        self._card.command_status = 0
        beneath = self.motion.forget_move(state)
        self.sequencer.set_off([entry._replace(number=NO_NUMBER)], Move(beneath))

    def start(self) -> None:
        """Run the list, or go on with it after a stop; nothing changes where it runs. Refused with 1 where it cannot.

        Where the axes stand elsewhere than the list begins, a first line starts from there, and anything else is
        refused with 1 (grade C).
        """
        state = self.motion.state
        if isinstance(state, Moving):
            if isinstance(state, Running) and list_stretch(state):
                return
            raise Refused(Code.COMMAND)
        beneath = without_move(state)
        if isinstance(beneath, BrokenList):
            if not self.motion.is_near(beneath.place):
                raise Refused(Code.COMMAND)
        elif self.list.entries and not self.motion.is_near(self.list.start):
            self.list.start_from(self.motion.place())
        self._card.command_status = 0
        self.motion.forget_move(state)
        self.sequencer.run_list()

    def restore(self) -> None:
        """Go on with what was stopped last. Refused with 1 unless something is left of it and the axes stand there."""
        state = self.motion.state
        if not isinstance(state, BrokenList | BrokenMove) or not self.motion.is_near(state.place):
            raise Refused(Code.COMMAND)
        self._card.command_status = 0
        if isinstance(state, BrokenMove):
            self.sequencer.set_off(state.left, state.move)
        else:
            self.sequencer.run_list()

    def reset(self) -> None:
        """Motion ends where it is, the list is emptied and closed, speeds are those of the settings again."""
        self.sequencer.halt()
        self.list.clear(is_open=False)
        self.speeds.become(speeds_of(self._settings))

    def _begin_list_end(self) -> None:
        if not self.list.entries and list_stretch(self.motion.state) is None:
            self.list.begin(self.motion.entry_end())
