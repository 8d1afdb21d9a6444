"""Functions that set speeds and accelerations, pulse/ms and pulse/ms².

Speeds of entries are stored in order: they hold for the entries pushed afterwards, in the list as for immediate moves.
Ceiling, start speed and overrides hold for a running motion at once, which is planned anew (grade C but for overrides).
"""

from controller.card.calls.base import CardBase
from controller.card.core.call import Double, gt
from controller.card.core.codes import Code, Refused
from controller.card.core.units import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.card.engine.speeds import in_pulses

_OVERRIDE = 2.0
"""Overrides are below this; grade B."""


class SpeedCalls(CardBase):
    """Speeds, accelerations, overrides."""

    @gt()
    def GT_SetSynVel(self, vel: Double) -> None:
        """Path speed of the entries that follow."""
        self._engine.speeds.speed_um_s = self._speed(vel)

    @gt()
    def GT_SetSynAcc(self, accel: Double) -> None:
        """Path acceleration of the entries that follow."""
        self._engine.speeds.acceleration_um_s2 = self._acceleration(accel)

    @gt()
    def GT_SetDccVel(self, vel: Double) -> None:
        """End speed of the next path entry. Refused with 4 below 0."""
        self._engine.speeds.end_um_s = self._speed(vel) if vel else 0.0

    @gt()
    def GT_SetStrtVel(self, value: Double) -> None:
        """Start (jump) speed: with it the list begins and ends, and slower it does not get between."""
        self._engine.speeds.start_um_s = self._speed(value) if value else 0.0
        self._engine.sequencer.replan()

    @gt()
    def GT_SetMaxVel(self, value: Double) -> None:
        """Ceiling of the path speed."""
        self._engine.speeds.ceiling_um_s = self._speed(value)
        self._engine.sequencer.replan()

    @gt()
    def GT_SetStpAcc(self, value: Double) -> None:
        """Deceleration of stops."""
        self._engine.speeds.stop_um_s2 = self._acceleration(value)

    @gt()
    def GT_SetEStpAcc(self, value: Double) -> None:
        """Deceleration of emergency stops."""
        self._engine.speeds.emergency_um_s2 = self._acceleration(value)

    @gt()
    def GT_Override(self, value: Double) -> None:
        """Scale the speed of running and later entries. Refused with 7 unless between 0 and 2."""
        self._engine.speeds.override = _override(value)
        self._engine.sequencer.replan()

    @gt()
    def GT_OverrideG0(self, value: Double) -> None:
        """As `GT_Override`, for rapid entries."""
        self._engine.speeds.override_rapid = _override(value)
        self._engine.sequencer.replan()

    def _speed(self, pulse_ms: float) -> float:
        return in_pulses(pulse_ms, self.settings, self._state) * UM_S_PER_PULSE_MS

    def _acceleration(self, pulse_ms2: float) -> float:
        return in_pulses(pulse_ms2, self.settings, self._state) * UM_S2_PER_PULSE_MS2


def _override(value: float) -> float:
    if not 0.0 < value < _OVERRIDE:
        raise Refused(Code.PARAMETER)
    return value
