"""Functions that open, fill, run, stop and resume the list, apart from the path itself.

Functions that stop and resume, and tell where the motion is.
"""

from controller.card.calls.base import CardBase
from controller.card.core.call import Code, Long, Refused, Short, UShort, gt
from controller.card.core.settings import UM_S_PER_PULSE_MS
from controller.card.engine.entries import Output, Place, Wait, four

_ALL = 0xFFFF
_BITS = 16


class ListCalls(CardBase):
    """The list, listed outputs and waits, and how far it is."""

    @gt()
    def GT_StrtList(self) -> None:
        """Empty the list and open it. Refused with 1 while anything moves."""
        self._engine.open_list(afresh=True)

    @gt()
    def GT_AddList(self) -> None:
        """Open the list as it is."""
        self._engine.open_list(afresh=False)

    @gt()
    def GT_EndList(self) -> None:
        """Close the list; harmless where it is closed."""
        self._engine.list.is_open = False

    @gt()
    def GT_StrtMtn(self) -> None:
        """Run the list; harmless while it runs. After a stop it goes on as `GT_RestoreMtn` (grade C)."""
        self._engine.start()

    @gt()
    def GT_Delay(self, delay_time: Long) -> None:
        """Wait so many ms at rest. Refused with 7 below 0, and with 1 outside an open list (grade C)."""
        if delay_time < 0:
            raise Refused(Code.PARAMETER)
        if not self._engine.list.is_open:
            raise Refused(Code.COMMAND)
        self._engine.check_room()
        self._engine.push(Wait(delay_time / 1000.0))

    @gt()
    def GT_BufIO(self, value: UShort) -> None:
        """Set all outputs when the list is there, without a rest; outside an open list at once (grade C)."""
        self._listed(Output(_ALL, value))

    @gt()
    def GT_BufIOBit(self, io_bit: UShort, bit_status: Short) -> None:
        """As `GT_BufIO`, one output. Refused with 7 beyond output 15 and for another level than 0 and 1."""
        if io_bit >= _BITS or bit_status not in (0, 1):
            raise Refused(Code.PARAMETER)
        self._listed(Output(1 << io_bit, bit_status << io_bit))

    def _listed(self, output: Output) -> None:
        if not self._engine.list.is_open:
            self._state.set_outputs(*output)
            return
        self._engine.check_room()
        self._engine.push(output)

    @gt(zeros=(0,))
    def GT_GetMtnNm(self) -> int:
        """Number of the path entry being executed since the list was opened, 16 bit.

        The positioning move is 0, the first path entry 1; outputs and waits have none (grade C). At rest that of the
        last one.
        """
        return self._engine.number & 0xFFFF

    @gt(zeros=(0,))
    def GT_GetCrdSts(self) -> int:
        """Coordinate status: bit 0 idle, bit 9 stopped abnormally, bit 13 list empty."""
        return self._engine.coordinate_status()

    @gt(zeros=(0,))
    def GT_GetCmdSts(self) -> int:
        """0x8000 after a push on a full list, else 0.

        It stays until a call is refused for another reason, or one fills or empties the list, or begins a motion.
        """
        return self._state.command_status


_POINT = (0.0, 0.0, 0.0, 0.0)


class StopCalls(CardBase):
    """Stops, and points of the path in user coordinates."""

    @gt()
    def GT_StpMtn(self) -> None:
        """Brake along the path to rest; harmless at rest."""
        self._engine.sequencer.stop(self._engine.speeds.stop_um_s2)

    @gt()
    def GT_EStpMtn(self) -> None:
        """As `GT_StpMtn`, with the emergency deceleration."""
        self._engine.sequencer.stop(self._engine.speeds.emergency_um_s2)

    @gt()
    def GT_RestoreMtn(self) -> None:
        """Go on with what was stopped last. Refused with 1 unless the axes are at rest at its break point."""
        self._engine.restore()

    @gt(zeros=(_POINT,))
    def GT_GetBrkPnt(self) -> Place:
        """Where the motion came to rest when it was last stopped; the place of power on before."""
        return self._user(self._engine.motion.break_place)

    @gt(zeros=(_POINT,))
    def GT_GetSegPnt(self) -> Place:
        """End of the path entry being executed; at rest where the axes stand (grade C)."""
        return self._user(self._engine.motion.entry_end())

    @gt(zeros=(_POINT,))
    def GT_GetPrfPnt(self) -> Place:
        """Profile place."""
        return self._user(self._engine.motion.place())

    @gt(zeros=(0.0,))
    def GT_GetPrfVel(self) -> float:
        """Speed along the path, pulse/ms."""
        return self._engine.motion.speed() / UM_S_PER_PULSE_MS

    def _user(self, place: Place) -> Place:
        axes = zip(place, self._state.axes, strict=True)
        return four((pulses - axis.zero) / axis.map_count for pulses, axis in axes)
