"""Status of axes and their switches. Levels are those of the inputs, which no sense turns (`wiring`).

Inputs and outputs that act at once: 16 of each, active low, bit numbers from 0; an open input reads 1.
"""

from controller.card.calls.base import CardBase
from controller.card.core.call import UShort, gt
from controller.card.core.codes import LATCHED, AxisSts, Code, Refused
from controller.card.core.settings import idle_level, sense_of
from controller.card.core.state import AxisState

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
