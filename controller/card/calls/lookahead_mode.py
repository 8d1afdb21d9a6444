"""The look-ahead mode of the library: path calls go through the look-ahead into the list (grade C, as all of it).

For the meaning of the numbers see `host_lookahead`; coordinates are in units of `con` pulses from the axis' zero.

Path calls through the look-ahead. `F` is the feed of the block in pulse/ms; after a block with `dccFlag` it rests.

Where as many blocks are kept as there may be, the oldest goes to the list first, and the call is refused with 1 if the
list has no room for it. `CodeNum` comes back in the message of a call that is refused (grade C).
"""

from typing import Any

from controller.card.calls.axis import BITS
from controller.card.calls.host_lookahead import HostLookAheadCalls, rules_of
from controller.card.calls.path_base import PathBase, with_length
from controller.card.core.call import LIST_FULL, Code, Double, Function, Long, Refused, Short, UShort, gt
from controller.card.core.settings import UM_S_PER_PULSE_MS
from controller.card.engine.entries import (
    XY,
    YZ,
    ZX,
    Output,
    Pace,
    Place,
    Segment,
    Wait,
    arc_about,
    arc_by_radius,
    check_size,
    checked_line,
    four,
    line,
)
from controller.card.engine.speeds import checked
from controller.card.lookahead import (
    HostBlock,
    ListLookAhead,
    Mode,
    Off,
    On,
    TLookAheadMsg,
    blocks_kept,
    ruled,
    switched_off,
    switched_on,
)

_MOST_TOLD = 0x7FFF
_NO_CEILING = 1e9
"""pulse/ms; the feed of each block limits its speed."""


class LookAheadModeCalls(HostLookAheadCalls, PathBase):
    """The mode in which path calls go through the look-ahead into the open list."""

    def __init__(self, *args: Any, **named: Any) -> None:
        super().__init__(*args, **named)
        self._modes: list[Mode] = [Off()] * self.settings.cards

    def _reset(self) -> None:
        super()._reset()
        self._mode = Off()

    @property
    def _mode(self) -> Mode:
        return self._modes[self._number]

    @_mode.setter
    def _mode(self, mode: Mode) -> None:
        self._modes[self._number] = mode

    @gt()
    def GT_SwitchLookaheadMode(self, mode: UShort) -> None:
        """Switch the mode on (1) or off (0); refused with 1 while blocks are kept."""
        if mode > 1:
            raise Refused(Code.PARAMETER)
        if blocks_kept(self._mode):
            raise Refused(Code.COMMAND)
        self._mode = switched_on(self._mode) if mode else switched_off(self._mode)

    @gt()
    def GT_InitLookAheadEx(self, T: Double, amax: Double, am: Double, n: Short, con: Double) -> None:
        """Set the rules; blocks that are kept are forgotten."""
        self._mode = ruled(self._mode, rules_of(T, amax, am, _NO_CEILING, n, con))

    @gt()
    def GT_InitLookAheadExx(
        self, T: Double, amax: Double, am: Double, n: Short, con: Double, timepara: Double, filename: str
    ) -> None:
        """As `GT_InitLookAheadEx`; the last two are recorded."""
        self._mode = ruled(self._mode, rules_of(T, amax, am, _NO_CEILING, n, con))
        self._state.recorded["GT_InitLookAheadExx"] = (timepara, filename)

    @gt()
    def GT_EndLookaheadMode(self) -> None:
        """Let all blocks go, and leave the mode; refused with 1 until the list is open and has room for them."""
        if blocks_kept(self._mode):
            self._let_all_go(self._lookahead())
        self._mode = switched_off(self._mode)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_M30(self) -> TLookAheadMsg:
        """Let all blocks go; refused with 1 until the list has room for them."""
        return self._let_all_go(self._lookahead())

    def _filled(self, function: Function, given: tuple[Any, ...], refused: Refused) -> tuple[Any, ...]:
        """The message of a refused block: its `CodeNum`, how many before it are kept, and why.

        `GT_M30` has no block: the oldest that is kept is told.
        """
        if function.zeros != (TLookAheadMsg(),):
            return super()._filled(function, given, refused)
        ahead = self._mode.look_ahead if isinstance(self._mode, On) else None
        number = given[-1] if given else ahead.oldest_number if ahead else 0
        before = min(len(ahead), _MOST_TOLD) if given and ahead else 0
        return (TLookAheadMsg(number if isinstance(number, int) else 0, before, int(refused.code)),)

    def _lookahead(self) -> ListLookAhead:
        """Refused with 1 unless the mode is on, its rules are set and the list is open.

        Blocks of a list that was begun anew since are forgotten.
        """
        if not isinstance(self._mode, On) or not self._engine.list.is_open:
            raise Refused(Code.COMMAND)
        ahead = self._mode.look_ahead
        if ahead.begun != self._engine.list.begun:
            ahead.clear(self._engine.list.begun)
        return ahead

    def _let_all_go(self, list_look_ahead: ListLookAhead) -> TLookAheadMsg:
        self._engine.check_room(list_look_ahead.entries)
        self._push_kept(list_look_ahead)
        return TLookAheadMsg()

    def _push_kept(self, list_look_ahead: ListLookAhead) -> None:
        while len(list_look_ahead):
            self._let_go(list_look_ahead)

    def _let_go(self, list_look_ahead: ListLookAhead) -> None:
        for entry in list_look_ahead.oldest(max(1, self._engine.list.number)):
            self._engine.push(entry)

    def _kept_end(self, list_look_ahead: ListLookAhead) -> Place:
        return list_look_ahead.end() or self._engine.list_end()

    def _add_to(self, list_look_ahead: ListLookAhead, segment: Segment, rests: int, number: int) -> TLookAheadMsg:
        self._check_axes(with_length(segment))
        if list_look_ahead.is_full or list_look_ahead.entries >= self.settings.capacity:
            self._engine.check_room(list_look_ahead.oldest_entries)
            self._let_go(list_look_ahead)
        list_look_ahead.add(HostBlock(self._of_this_call(segment), number, bool(rests)))
        return TLookAheadMsg()

    def _push_behind(self, entry: Output | Wait) -> None:
        ahead = self._lookahead()
        if len(ahead):
            if ahead.entries >= self.settings.capacity:
                raise Refused(Code.COMMAND, LIST_FULL)
            ahead.add_behind(entry)
            return
        self._engine.check_room()
        self._engine.push(entry)

    def _kept_place(self, list_look_ahead: ListLookAhead, start: Place, values: tuple[float, ...]) -> Place:
        """Place of coordinates X, Y, …; the other axes stay.

        Refused with 1 where the card lacks an axis, with 3 where it is too far.
        """
        if len(values) > self.settings.axes:
            raise Refused(Code.COMMAND)
        given = (self._kept_at(list_look_ahead, axis, value) for axis, value in enumerate(values))
        place = four((*given, *start[len(values) :]))
        check_size(*place)
        return place

    def _kept_at(self, list_look_ahead: ListLookAhead, axis: int, value: float) -> float:
        return value * list_look_ahead.rules.pulses_per_unit + self._state.axes[axis].zero

    def _kept_in_plane(
        self, list_look_ahead: ListLookAhead, plane: tuple[int, int], u: float, v: float
    ) -> tuple[float, float]:
        """Refused with 1 where the card lacks an axis."""
        if max(plane) >= self.settings.axes:
            raise Refused(Code.COMMAND)
        return self._kept_at(list_look_ahead, plane[0], u), self._kept_at(list_look_ahead, plane[1], v)

    def _kept_move(self, vel: float, *values: float) -> None:
        ahead, entries = self._lookahead(), self._engine.list
        start = self._kept_end(ahead)
        pace = Pace(checked(vel) * UM_S_PER_PULSE_MS, ahead.rules.along_um_s2)
        move = line(entries.number, pace, start, self._kept_place(ahead, start, values))
        self._check_axes(move)
        self._engine.check_room(ahead.entries + 1)
        self._push_kept(ahead)
        self._submit(move._replace(number=entries.number))
        ahead.clear(entries.begun)

    def _kept_line(self, values: tuple[float, ...], F: float, rests: int, number: int, rapid: bool) -> TLookAheadMsg:
        ahead = self._lookahead()
        start, pace = self._kept_end(ahead), Pace(checked(F) * UM_S_PER_PULSE_MS, 0.0, rapid)
        return self._add_to(ahead, checked_line(0, pace, start, self._kept_place(ahead, start, values)), rests, number)

    def _kept_arc(
        self, plane: tuple[int, int], arc: tuple[float, ...], F: float, rests: int, number: int
    ) -> TLookAheadMsg:
        """`arc` is centre and angle."""
        ahead = self._lookahead()
        pace = Pace(checked(F) * UM_S_PER_PULSE_MS, 0.0)
        centre = self._kept_in_plane(ahead, plane, arc[0], arc[1])
        return self._add_to(ahead, arc_about(0, pace, self._kept_end(ahead), plane, centre, arc[2]), rests, number)

    def _kept_arc_p(
        self, plane: tuple[int, int], arc: tuple[float, ...], F: float, rests: int, number: int
    ) -> TLookAheadMsg:
        """`arc` is end, radius and sense."""
        ahead = self._lookahead()
        pace = Pace(checked(F) * UM_S_PER_PULSE_MS, 0.0)
        end = self._kept_in_plane(ahead, plane, arc[0], arc[1])
        radius = arc[2] * ahead.rules.pulses_per_unit
        segment = arc_by_radius(0, pace, self._kept_end(ahead), plane, end, radius, int(arc[3]))
        return self._add_to(ahead, segment, rests, number)


class LookAheadCalls(LookAheadModeCalls):
    """Moves, lines, arcs, outputs and waits; as the functions without ``Ex`` where nothing else is said."""

    @gt()
    def GT_MvXYEx(self, x: Double, y: Double, vel: Double) -> None:
        """Positioning move, mostly the first entry of the list; blocks that are kept go before it."""
        self._kept_move(vel, x, y)

    @gt()
    def GT_MvXYZEx(self, x: Double, y: Double, z: Double, vel: Double) -> None:
        """As `GT_MvXYEx`."""
        self._kept_move(vel, x, y, z)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYG0Ex(self, x: Double, y: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line at rapid speed `F`."""
        return self._kept_line((x, y), F, dccFlag, CodeNum, rapid=True)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYZG0Ex(self, x: Double, y: Double, z: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line at rapid speed `F`."""
        return self._kept_line((x, y, z), F, dccFlag, CodeNum, rapid=True)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYEx(self, x: Double, y: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line."""
        return self._kept_line((x, y), F, dccFlag, CodeNum, rapid=False)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYZEx(self, x: Double, y: Double, z: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line."""
        return self._kept_line((x, y, z), F, dccFlag, CodeNum, rapid=False)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcXYPEx(
        self, x_end: Double, y_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(XY, (x_end, y_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcYZPEx(
        self, y_end: Double, z_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(YZ, (y_end, z_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcZXPEx(
        self, z_end: Double, x_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(ZX, (z_end, x_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcXYEx(
        self, x_center: Double, y_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(XY, (x_center, y_center, angle), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcYZEx(
        self, y_center: Double, z_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(YZ, (y_center, z_center, angle), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcZXEx(
        self, z_center: Double, x_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(ZX, (z_center, x_center, angle), F, dccFlag, CodeNum)

    @gt()
    def GT_BufIOEx(self, status: UShort) -> None:
        """All outputs, behind the block before."""
        self._push_behind(Output(0xFFFF, status))

    @gt()
    def GT_BufIOBitEx(self, io_bit: UShort, bit_status: Short) -> None:
        """One output, behind the block before."""
        if io_bit >= BITS or bit_status not in (0, 1):
            raise Refused(Code.PARAMETER)
        self._push_behind(Output(1 << io_bit, bit_status << io_bit))

    @gt()
    def GT_DelayEx(self, time: Long) -> None:
        """Wait, ms, behind the block before, which ends at rest."""
        if time < 0:
            raise Refused(Code.PARAMETER)
        self._push_behind(Wait(time / 1000.0))
