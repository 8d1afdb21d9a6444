"""Functions of the machine around the axes that are only recorded: guards, gantry, hand wheel, ADC, senses, pulses."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from controller.card.calls.base import CardBase
from controller.card.calls.special import record
from controller.card.core.call import Double, UShort, gt
from controller.card.core.codes import Code, Refused


class RecordedCalls(CardBase):
    """Each is taken and kept, last call wins; see `recorded`."""

    @property
    def recorded(self) -> Mapping[str, tuple[Any, ...]]:
        """Arguments of the last good call of each recorded function, by name; no function of the library."""
        return MappingProxyType(self._state.recorded)

    @record
    def GT_AlarmOn(self, axis: UShort) -> None:
        """Heed the alarm of a drive; drives give none here."""

    @record
    def GT_AlarmOff(self, axis: UShort) -> None:
        """Do not heed the alarm of a drive."""

    @record
    def GT_StepDir(self, axis: UShort) -> None:
        """Put out pulse and direction."""

    @record
    def GT_StepPulse(self, axis: UShort) -> None:
        """Put out pulses of either direction on lines of their own."""

    @record
    def GT_EncOn(self, axis: UShort) -> None:
        """Use the encoder."""

    @record
    def GT_EncOff(self, axis: UShort) -> None:
        """Do not use the encoder."""

    @record
    def GT_EncSns(self, value: UShort) -> None:
        """Sense of the encoders."""

    @record
    def GT_IndexSns(self, value: UShort) -> None:
        """Sense of the index marks."""

    @record
    def GT_CtrlMode(self, axis: UShort, value: UShort) -> None:
        """Output of an axis: voltage or pulses."""

    @record
    def GT_HandWheel(self, axis: UShort, value: Double) -> None:
        """Let an axis follow the hand wheel."""

    @record
    def GT_ExitHWheel(self) -> None:
        """End of the hand wheel."""

    @record
    def GT_SetAdcChn(self, value: UShort) -> None:
        """Channels of the ADC in use."""

    @gt(zeros=(0,))
    def GT_GetAdc(self, channel: UShort) -> int:
        """Voltage at a channel; 0, as nothing is connected."""
        return 0

    @record
    def GT_GantryMode(self, slave: UShort, master: UShort) -> None:
        """Couple two axes."""

    @record
    def GT_ExitGantryMode(self) -> None:
        """End of the coupling."""

    @record
    def GT_GantryPrm(self, error: UShort, range: UShort = 0, kp: Double = 0) -> None:
        """Parameters of the coupling."""

    @gt()
    def GT_HookCommand(self, CommandHandle: Any) -> None:
        """Let the library tell of each call that is made from now on: its name and its code; None ends that (grade B).

        It is told when the call is over, and may make calls itself, of which it is not told. Refused with 7 where it
        cannot be called.
        """
        if CommandHandle is not None and not callable(CommandHandle):
            raise Refused(Code.PARAMETER)
        self._hook = CommandHandle


class GuardCalls(CardBase):
    """Guards of servo and run."""

    @record
    def GT_SrvGrdOn(self) -> None:
        """Guard the servo."""

    @record
    def GT_SrvGrdOff(self) -> None:
        """Do not guard the servo."""

    @gt(zeros=(0,))
    def GT_SrvGrdErr(self, axis: UShort) -> int:
        """What the guard found; 0, nothing."""
        self._axis(axis)
        return 0

    @record
    def GT_AuEncSnsOn(self) -> None:
        """Find the sense of the encoders."""

    @record
    def GT_AuEncSnsOff(self) -> None:
        """Do not find the sense of the encoders."""

    @record
    def GT_RunGrdOn(self) -> None:
        """Guard the run."""

    @record
    def GT_RunGrdOff(self) -> None:
        """Do not guard the run."""

    @record
    def GT_RunGrdOp(self, axis: UShort, operation: UShort) -> None:
        """What the guard of the run does."""

    @record
    def GT_RunGrdPrm(self, voltage: Double, time: UShort, relative: UShort) -> None:
        """Parameters of the guard of the run."""

    @record
    def GT_AuBiasOn(self) -> None:
        """Find the bias of the output."""

    @record
    def GT_AuBiasOff(self) -> None:
        """Do not find the bias of the output."""

    @record
    def GT_AuBiasTm(self, time: UShort) -> None:
        """Time for finding the bias."""
