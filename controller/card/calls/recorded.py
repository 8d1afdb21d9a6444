"""Functions that are only recorded: of the machine around the axes, and of tools.

Functions of the machine around the axes that are only recorded: guards, gantry, hand wheel, ADC, senses, pulses.

Functions of tools that are only recorded: laser, cut-follow, spindle.

Functions that are taken, kept and answered with 0, and do nothing else.
"""

import functools
from collections.abc import Callable, Mapping
from inspect import signature
from types import MappingProxyType
from typing import Any

from controller.card.calls.base import CardBase
from controller.card.core.call import ADDRESSED, Code, Double, Long, Refused, Short, ULong, UShort, gt


def record(body: Callable[..., None]) -> Callable[..., Any]:
    """Decorator of a function without a body: its last good call is kept in `CardState.recorded` by its name."""
    of_axis = next(iter([*signature(body).parameters][1:]), "") in ADDRESSED

    @functools.wraps(body)
    def keep(self: Any, *given: Any) -> None:
        if of_axis:
            self._axis(given[0])
        self._state.recorded[body.__name__] = given

    return gt()(keep)


class SpecialCalls(CardBase):
    """Each is taken and kept, last call wins; see `RecordedCalls.recorded`."""

    @record
    def GT_SetSpindleVel(self, value: Short) -> None:
        """Speed of the spindle."""

    @record
    def GT_CloseSpindle(self) -> None:
        """Stop the spindle."""

    @record
    def GT_SetCutFllw(self, CutPulse: ULong, CutInitPulse: Long) -> None:
        """Let an output follow the cut."""

    @record
    def GT_SetCutStrtPos(self, CutStartPos: Long, CutDir: Short) -> None:
        """Where the following begins."""

    @record
    def GT_DisCutFllw(self) -> None:
        """End of the following."""

    @gt(zeros=(0,))
    def GT_GetHSIOOpt(self) -> int:
        """Levels of the fast outputs, as they were set."""
        return int(self._state.recorded.get("GT_SetHSIOOpt", (0,))[0])

    @gt(zeros=(0,))
    def GT_GetHSIOSts(self) -> int:
        """State of the buffer of the fast outputs; 0, empty."""
        return 0

    @record
    def GT_SetHSIOOpt(self, value: UShort) -> None:
        """Set the fast outputs."""

    @record
    def GT_LaserPowerMode(self, mode: UShort, max_value: Double, min_value: Double, channel: UShort = 1) -> None:
        """How the power of the laser is put out."""

    @record
    def GT_LaserOutFrq(self, frequency: Double, channel: UShort = 1) -> None:
        """Frequency of the laser."""

    @record
    def GT_LaserPrfCmd(self, cmd: Double, channel: UShort = 1) -> None:
        """Power of the laser."""

    @record
    def GT_SetLaserMode(self, channel: UShort, mode: UShort) -> None:
        """Mode of the laser."""

    @record
    def GT_SetRedLightOpt(self, value: UShort) -> None:
        """Pilot light of the laser."""

    @record
    def GT_SetLevelDelay(self, high_delay: UShort, low_delay: UShort) -> None:
        """Delays of the laser."""


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
