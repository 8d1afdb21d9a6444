"""Functions that set how axes move: speeds, accelerations, servo settings.

Functions that set speeds and accelerations, pulse/ms and pulse/ms².

Speeds of entries are stored in order: they hold for the entries pushed afterwards, in the list as for immediate moves.
Ceiling, start speed and overrides hold for a running motion at once, which is planned anew (grade C but for overrides).

Servo settings of cards with analog output. They are set apart, and loaded by an update; no motion depends on them.

The getters tell what was set last, loaded or not (grade C).
"""

from collections.abc import Mapping
from types import MappingProxyType

from controller.card.calls.base import CardBase
from controller.card.core.call import Code, Double, Refused, Short, UShort, gt
from controller.card.core.settings import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.card.core.state import AxisState
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


class ServoCalls(CardBase):
    """Gains, limits and bias of the position loop."""

    def servo(self, axis: int) -> Mapping[str, float]:
        """Servo settings loaded on axis 1 to 4, by name (``Kp``, …); no function of the library."""
        return MappingProxyType(self._state.axes[axis - 1].servo_loaded)

    @gt()
    def GT_Update(self, axis: UShort) -> None:
        """Load the servo settings of an axis."""
        _load(self._axis(axis))

    @gt()
    def GT_MltiUpdt(self, mask: UShort) -> None:
        """Load the servo settings of the axes whose bits are 1, axis 1 at bit 0."""
        if mask >> self.settings.axes:
            raise Refused(Code.PARAMETER)
        for axis in self._state.axes:
            if mask >> axis.number - 1 & 1:
                _load(axis)

    @gt()
    def GT_SetKp(self, axis: UShort, kp: Double) -> None:
        """Proportional gain."""
        self._axis(axis).servo_set["Kp"] = kp

    @gt(zeros=(0.0,))
    def GT_GetKp(self, axis: UShort) -> float:
        """Proportional gain."""
        return self._axis(axis).servo_set.get("Kp", 0.0)

    @gt()
    def GT_SetKi(self, axis: UShort, ki: Double) -> None:
        """Integral gain."""
        self._axis(axis).servo_set["Ki"] = ki

    @gt(zeros=(0.0,))
    def GT_GetKi(self, axis: UShort) -> float:
        """Integral gain."""
        return self._axis(axis).servo_set.get("Ki", 0.0)

    @gt()
    def GT_SetKd(self, axis: UShort, kd: Double) -> None:
        """Derivative gain."""
        self._axis(axis).servo_set["Kd"] = kd

    @gt(zeros=(0.0,))
    def GT_GetKd(self, axis: UShort) -> float:
        """Derivative gain."""
        return self._axis(axis).servo_set.get("Kd", 0.0)

    @gt()
    def GT_SetKvff(self, axis: UShort, kvff: Double) -> None:
        """Velocity feed-forward."""
        self._axis(axis).servo_set["Kvff"] = kvff

    @gt(zeros=(0.0,))
    def GT_GetKvff(self, axis: UShort) -> float:
        """Velocity feed-forward."""
        return self._axis(axis).servo_set.get("Kvff", 0.0)

    @gt()
    def GT_SetKaff(self, axis: UShort, kaff: Double) -> None:
        """Acceleration feed-forward."""
        self._axis(axis).servo_set["Kaff"] = kaff

    @gt(zeros=(0.0,))
    def GT_GetKaff(self, axis: UShort) -> float:
        """Acceleration feed-forward."""
        return self._axis(axis).servo_set.get("Kaff", 0.0)

    @gt()
    def GT_SetILmt(self, axis: UShort, limit: UShort) -> None:
        """Limit of the integral."""
        self._axis(axis).servo_set["ILmt"] = limit

    @gt(zeros=(0,))
    def GT_GetILmt(self, axis: UShort) -> int:
        """Limit of the integral."""
        return int(self._axis(axis).servo_set.get("ILmt", 0))

    @gt()
    def GT_SetMtrLmt(self, axis: UShort, limit: UShort) -> None:
        """Limit of the output."""
        self._axis(axis).servo_set["MtrLmt"] = limit

    @gt(zeros=(0,))
    def GT_GetMtrLmt(self, axis: UShort) -> int:
        """Limit of the output."""
        return int(self._axis(axis).servo_set.get("MtrLmt", 0))

    @gt()
    def GT_SetMtrBias(self, axis: UShort, bias: Short) -> None:
        """Bias of the output."""
        self._axis(axis).servo_set["MtrBias"] = bias

    @gt(zeros=(0,))
    def GT_GetMtrBias(self, axis: UShort) -> int:
        """Bias of the output."""
        return int(self._axis(axis).servo_set.get("MtrBias", 0))

    @gt(zeros=(0,))
    def GT_GetIntgr(self, axis: UShort) -> int:
        """Integral of the position error; 0, as no loop runs here."""
        self._axis(axis)
        return 0

    @gt(zeros=(0,))
    def GT_GetMtrCmd(self, axis: UShort) -> int:
        """Voltage put out; 0, as no loop runs here."""
        self._axis(axis)
        return 0


def _load(axis: AxisState) -> None:
    axis.servo_loaded = dict(axis.servo_set)
