"""Functions of single axes: drives, limits, captures, positions, errors, encoders, and their status.

Status of axes and their switches. Levels are those of the inputs, which no sense turns (`wiring`).

Inputs and outputs that act at once: 16 of each, active low, bit numbers from 0; an open input reads 1.
"""

from typing import Any

from controller.card.calls.base import CardBase
from controller.card.core.call import LATCHED, AxisSts, Code, Double, Function, Refused, UShort, gt
from controller.card.core.settings import idle_level, sense_of
from controller.card.core.state import AxisState


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


BITS = 16
PROBE_INPUT = 15
"""Input of the probe, which answers when it goes to 0; grade C."""


class IoCalls(CardBase):
    """Outputs and inputs; the listed outputs are with the list."""

    @gt()
    def GT_ExOpt(self, value: UShort) -> None:
        """Set all outputs at once, even while a list is open."""
        self._state.outputs = value

    @gt()
    def GT_ExOptBit(self, bit: UShort, value: UShort) -> None:
        """Set output `bit` to 0 or 1 at once."""
        if bit >= BITS or value > 1:
            raise Refused(Code.PARAMETER)
        self._state.set_outputs(1 << bit, value << bit)

    @gt(zeros=(0,))
    def GT_GetExOpt(self) -> int:
        """Levels of the outputs."""
        return self._state.outputs

    @gt(zeros=(0,))
    def GT_ExInpt(self) -> int:
        """Levels of the inputs."""
        return self._state.inputs

    def set_input(self, bit: int, level: int) -> None:
        """Give input `bit` a level from outside; no function of the library. ValueError beyond 0 to 15 and 0 to 1."""
        if bit not in range(BITS) or level not in (0, 1):
            raise ValueError(f"an input is 0 to {BITS - 1} and its level 0 or 1, not {bit} and {level}")
        with self._alone:
            fell = self._state.inputs >> bit & 1 > level
            self._state.inputs = self._state.inputs & ~(1 << bit) | level << bit
            if fell and bit == PROBE_INPUT and self._state.probe_armed:
                self._capture_probe()
            self._log(self.time_s, "set_input", (bit, level), None)

    def _capture_probe(self) -> None:
        self._state.probe_armed = False
        for axis, pulses in zip(self._state.axes, self._engine.motion.pulses_out(), strict=True):
            axis.capture(pulses)


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
        """Sense of the limit switches, bits as those of `GT_GetLmtSwt`: 0 the high level triggers, 1 the low one (B).

        A switch that is wired otherwise stops what heads for it from within, and nothing beyond it.
        """
        self._state.limit_sense = value
        self._engine.sequencer.replan()

    @gt()
    def GT_HomeSns(self, value: UShort) -> None:
        """Sense of the home switches, as `GT_LmtSns`: of one wired otherwise the other edge is captured (grade C)."""
        self._state.home_sense = value
        self._engine.sequencer.replan()

    @gt(zeros=(0,))
    def GT_GetLmtSwt(self) -> int:
        """Levels of the limit switches, two bits per axis: positive, negative."""
        word, sense = 0, self._state.limit_sense
        for number, place in enumerate(self._engine.motion.place()):
            switches = self.settings.switches_of(number + 1)
            met = place >= switches.positive, place <= switches.negative
            for bit, is_met in enumerate(met, 2 * number):
                word |= (idle_level(switches.limit_wiring, sense_of(sense, bit)) ^ is_met) << bit
        return word

    @gt(zeros=(0,))
    def GT_GetHomeSwt(self) -> int:
        """Levels of the home switches, a bit per axis."""
        word, sense = 0, self._state.home_sense
        for number, place in enumerate(self._engine.motion.place()):
            switches = self.settings.switches_of(number + 1)
            is_met = switches.home[0] <= place <= switches.home[1]
            word |= (idle_level(switches.home_wiring, sense_of(sense, number)) ^ is_met) << number
        return word
