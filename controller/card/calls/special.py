"""Functions of tools that are only recorded: laser, cut-follow, spindle.

Functions that are taken, kept and answered with 0, and do nothing else.
"""

import functools
from collections.abc import Callable
from inspect import signature
from typing import Any

from controller.card.calls.base import CardBase
from controller.card.core.call import ADDRESSED, Double, Long, Short, ULong, UShort, gt


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
