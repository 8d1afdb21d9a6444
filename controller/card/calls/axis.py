"""Functions of single axes: drives, limits, captures, positions, errors, encoders."""

from typing import Any

from controller.card.calls.base import CardBase
from controller.card.core.call import Double, Function, UShort, gt
from controller.card.core.codes import AxisSts, Code, Refused


class AxisCalls(CardBase):
    """Drives, limits and captures of an axis."""

    def _refuse(self, function: Function, given: tuple[Any, ...], refused: Refused) -> None:
        """Keep a refusal; one by an axis that the call is addressed to is latched there as a host error."""
        super()._refuse(function, given, refused)
        if refused.code in (Code.COMMAND, Code.PARAMETER) and function.of_axis and given:
            for axis in self._state.axes[: self.settings.axes]:
                if axis.number == given[0]:
                    axis.latched |= AxisSts.HOST_ERROR

    @gt()
    def GT_AxisOn(self, axis: UShort) -> None:
        """Enable the drive."""
        self._axis(axis).enabled = True

    @gt()
    def GT_AxisOff(self, axis: UShort) -> None:
        """Disable the drive."""
        self._axis(axis).enabled = False

    @gt()
    def GT_LmtsOn(self, axis: UShort) -> None:
        """Heed the limit switches."""
        self._axis(axis).limits_on = True
        self._engine.sequencer.replan()

    @gt()
    def GT_LmtsOff(self, axis: UShort) -> None:
        """Do not heed the limit switches."""
        self._axis(axis).limits_on = False
        self._engine.sequencer.replan()

    @gt()
    def GT_AuStpOn(self, axis: UShort) -> None:
        """Stop when the position error is over its limit; a motion that begins so is stopped at once."""
        self._axis(axis).auto_stop = True
        self._engine.sequencer.check_errors()

    @gt()
    def GT_AuStpOff(self, axis: UShort) -> None:
        """Do not stop when the position error is over its limit."""
        self._axis(axis).auto_stop = False

    @gt()
    def GT_CaptHome(self, axis: UShort) -> None:
        """Capture the place at the next edge of the home switch."""
        self._axis(axis).home_armed = True
        self._engine.sequencer.replan()

    @gt()
    def GT_CaptIndex(self, axis: UShort) -> None:
        """Capture the place at the next index mark."""
        self._axis(axis).index_armed = True
        self._engine.sequencer.replan()

    @gt()
    def GT_CaptProb(self) -> None:
        """Capture the places of all axes when the probe answers."""
        self._state.probe_armed = True

    @gt(zeros=(0,))
    def GT_GetCapt(self, axis: UShort) -> int:
        """Place captured last, in pulses from the axis' zero; 0 before the first (grade C)."""
        state = self._axis(axis)
        return 0 if state.captured is None else state.captured - state.zero

    @gt()
    def GT_MapCnt(self, axis: UShort, Count: Double) -> None:
        """Let one user unit be `Count` pulses, for what is called from now on."""
        state = self._axis(axis)
        if Count <= 0.0:
            raise Refused(Code.PARAMETER)
        state.map_count = float(Count)

    @gt()
    def GT_SetBacklash(self, axis: UShort, backlash: UShort) -> None:
        """Keep the backlash, pulses; it moves nothing."""
        self._axis(axis).backlash = backlash

    def backlash(self, axis: int) -> int:
        """Backlash that was set on axis 1 to 4, pulses; no function of the library."""
        return self._state.axes[axis - 1].backlash

    @gt()
    def GT_DrvRst(self, axis: UShort) -> None:
        """Reset the drive, and with it the latched alarm."""
        self._axis(axis).latched &= ~AxisSts.ALARM


class PositionCalls(AxisCalls):
    """Actual positions, their error and its limit, encoders."""

    @gt()
    def GT_ZeroPos(self, AxisNum: UShort) -> None:
        """Let the axis stand at 0, profile and actual; refused with 1 while the card moves."""
        axis = self._axis(AxisNum)
        if self._engine.motion.moving:
            raise Refused(Code.COMMAND)
        self._engine.motion.snap(axis.number)
        axis.zero, axis.actual_shift = self._engine.motion.pulses_out()[axis.number - 1], 0

    @gt(zeros=(0,))
    def GT_GetAtlPos(self, axis: UShort) -> int:
        """Actual position, whole pulses: those that went out, as no encoder says otherwise."""
        state = self._axis(axis)
        return self._engine.motion.pulses_out()[axis - 1] - state.zero + state.actual_shift

    @gt()
    def GT_SetAtlPos(self, AxisNum: UShort, pos: Double) -> None:
        """Call the actual position so, rounded to whole pulses; the profile stays."""
        axis = self._axis(AxisNum)
        if abs(pos) >= 1 << 31:
            raise Refused(Code.PARAMETER)
        axis.actual_shift = round(pos) - (self._engine.motion.pulses_out()[AxisNum - 1] - axis.zero)
        self._engine.sequencer.check_errors()

    @gt(zeros=(0,))
    def GT_GetAtlErr(self, axis: UShort) -> int:
        """Profile less actual position, pulses, within ±32767."""
        return max(-0x7FFF, min(self._engine.motion.error(self._axis(axis)), 0x7FFF))

    @gt(zeros=(0.0,))
    def GT_GetAtlVel(self, axis: UShort) -> float:
        """Velocity of the axis, pulse/ms."""
        self._axis(axis)
        return self._engine.motion.velocity()[axis - 1] / 1000.0

    @gt()
    def GT_SetPosErr(self, axis: UShort, value: UShort) -> None:
        """Limit of the position error, 0 to 32767 pulses."""
        state = self._axis(axis)
        if value > 0x7FFF:
            raise Refused(Code.PARAMETER)
        state.error_limit = value
        self._engine.sequencer.check_errors()

    @gt(zeros=(0,))
    def GT_GetPosErr(self, axis: UShort) -> int:
        """Limit of the position error, pulses."""
        return self._axis(axis).error_limit

    @gt(zeros=(0,))
    def GT_EncPos(self, encoder: UShort) -> int:
        """Position of an encoder, pulses: each counts the pulses of the axis of its number (grade C)."""
        zero = self._axis(encoder).encoder_zero
        return self._engine.motion.pulses_out()[encoder - 1] - zero

    @gt(zeros=(0.0,))
    def GT_EncVel(self, encoder: UShort) -> float:
        """Velocity of an encoder, pulse/ms."""
        self._axis(encoder)
        return self._engine.motion.velocity()[encoder - 1] / 1000.0

    @gt()
    def GT_ClrEncPos(self, encoder: UShort) -> None:
        """Let the encoder read 0."""
        axis = self._axis(encoder)
        axis.encoder_zero = self._engine.motion.pulses_out()[encoder - 1]
