"""Functions that open, close and reset the card, select one of several, and tell versions."""

from controller.card.calls.base import CardBase
from controller.card.core.call import Code, Refused, ULong, UShort, gt

LIBRARY_VERSION = 0x0100
"""What the version functions answer; grade C."""


class OpenCalls(CardBase):
    """Open, close, reset, several cards, versions."""

    @gt(when_closed=True)
    def GT_Open(self, PortBase: ULong = 65535) -> None:
        """Open the selected card; harmless where it is open."""
        self._state.opened = True

    @gt()
    def GT_Close(self) -> None:
        """Close the selected card; its motion goes on."""
        self._state.opened = False

    @gt()
    def GT_Reset(self) -> None:
        """All as after power on, at rest, with zeros where the axes stand."""
        self._reset()

    @gt()
    def GT_HardRst(self) -> None:
        """As `GT_Reset` (grade C)."""
        self._reset()

    def _reset(self) -> None:
        self._engine.reset()
        self._state.power_on()
        for axis, pulses in zip(self._state.axes, self._engine.motion.pulses_out(), strict=True):
            axis.zero = axis.encoder_zero = pulses

    @gt(when_closed=True)
    def GT_SwitchtoCardNo(self, card: UShort) -> None:
        """Select card 0, 1, …; it may be closed, so that it can be opened next (grade B)."""
        if card >= self.settings.cards:
            raise Refused(Code.PARAMETER)
        self._select(card)

    def GT_GetCurrentCardNo(self) -> int:
        """Number of the selected card, from 0; −1 while none is open (grade C)."""
        with self._alone:
            began, hook = self.time_s, self._hook
            self._pass(self.settings.call_s)
            number = self._number if any(state.opened for state in self._states) else int(Code.CLOSED)
            self._log(began, "GT_GetCurrentCardNo", (), number)
            if hook is not None:
                self._tell(hook, "GT_GetCurrentCardNo", number)
            return number

    @gt(zeros=(0,))
    def GT_GetDllVrsn(self) -> int:
        """Version of the library."""
        return LIBRARY_VERSION

    @gt(zeros=(0,))
    def GT_ChkVrsn(self) -> int:
        """Version of the card, as `GT_GetDllVrsn` (grade C)."""
        return LIBRARY_VERSION

    @gt(zeros=(0,))
    def GT_GetDSPVrsn(self) -> int:
        """Version of the card's program, as `GT_GetDllVrsn` (grade C)."""
        return LIBRARY_VERSION
