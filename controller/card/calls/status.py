"""Status of axes and their switches. The levels are raw: 1 where a switch is idle."""

from controller.card.calls.base import CardBase
from controller.card.core.call import UShort, gt
from controller.card.core.codes import LATCHED, AxisSts
from controller.card.core.settings import AXES
from controller.card.core.state import AxisState


class StatusCalls(CardBase):
    """Status words, clearing them, and the levels of switches."""

    @gt(zeros=(0,))
    def GT_GetSts(self, axis: UShort) -> int:
        """Status word of an axis (`AxisSts`)."""
        state = self._axis(axis)
        return int(state.latched | self._live(state))

    def _live(self, state: AxisState) -> int:
        live = (
            (state.enabled, AxisSts.ENABLED),
            (self._engine.motion.axis_moving(state.number), AxisSts.MOVING),
            (state.limits_on, AxisSts.LIMITS_ON),
            (state.home_armed, AxisSts.HOME_ARMED),
            (state.index_armed, AxisSts.INDEX_ARMED),
        )
        return sum(int(bit) for holds, bit in live if holds) | state.number - 1 << 12

    @gt()
    def GT_ClrSts(self, axis: UShort) -> None:
        """Clear the latched bits; a position error that lasts is latched again."""
        self._axis(axis).latched = 0
        self._engine.sequencer.check_errors()

    @gt()
    def GT_RstSts(self, Axis: UShort, value: UShort) -> None:
        """Clear the latched bits that are 0 in the mask; those that are 1 stay (grade B). Else as `GT_ClrSts`."""
        self._axis(Axis).latched &= value & LATCHED
        self._engine.sequencer.check_errors()

    @gt()
    def GT_LmtSns(self, value: UShort) -> None:
        """Sense of the limit switches: where a bit is 1, the switch answers the other way round (grade C).

        Bits as those of `GT_GetLmtSwt`. Such a switch stops what heads for it from within, and nothing beyond it; an
        axis without one is stopped everywhere.
        """
        self._state.limit_sense = value
        self._engine.sequencer.replan()

    @gt()
    def GT_HomeSns(self, value: UShort) -> None:
        """Sense of the home switches, as `GT_LmtSns`: the edge that is captured is the other one (grade C)."""
        self._state.home_sense = value
        self._engine.sequencer.replan()

    @gt(zeros=(0,))
    def GT_GetLmtSwt(self) -> int:
        """Levels of the limit switches, two bits per axis: positive, negative."""
        word = 0
        for number, place in enumerate(self._engine.motion.place()):
            switches = self.settings.switches_of(number + 1)
            word |= ((place < switches.positive) | (place > switches.negative) << 1) << 2 * number
        return word ^ self._state.limit_sense & (1 << 2 * AXES) - 1

    @gt(zeros=(0,))
    def GT_GetHomeSwt(self) -> int:
        """Levels of the home switches, a bit per axis."""
        word = 0
        for number, place in enumerate(self._engine.motion.place()):
            first, last = self.settings.switches_of(number + 1).home
            word |= (not first <= place <= last) << number
        return word ^ self._state.home_sense & (1 << AXES) - 1
