"""Inputs and outputs that act at once: 16 of each, active low, bit numbers from 0; an open input reads 1."""

from controller.card.calls.base import CardBase
from controller.card.core.call import UShort, gt
from controller.card.core.codes import Code, Refused

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
