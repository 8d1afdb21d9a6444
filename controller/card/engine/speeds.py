"""Speeds and accelerations of the card: what the calls that set them change, µm/s and µm/s² inside."""

from dataclasses import dataclass, fields

from controller.card.core.call import Code, Refused
from controller.card.core.settings import SPEEDS, UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS, CardSettings
from controller.card.core.state import CardState
from controller.card.engine.entries import Pace

_SLOWEST_UM_S = SPEEDS[0] * UM_S_PER_PULSE_MS
"""No override makes an entry slower: a pulse in three hours."""


@dataclass(slots=True)
class Speeds:
    """Of one card. `end_um_s` is the end speed set for the next entry; overrides are factors."""

    speed_um_s: float
    acceleration_um_s2: float
    ceiling_um_s: float
    stop_um_s2: float
    emergency_um_s2: float
    rapid_um_s: float
    start_um_s: float = 0.0
    end_um_s: float | None = None
    override: float = 1.0
    override_rapid: float = 1.0

    def become(self, others: "Speeds") -> None:
        """Take all values of others."""
        for key in fields(self):
            setattr(self, key.name, getattr(others, key.name))

    def pace(self, *, rapid: bool) -> Pace:
        """Of an entry pushed now."""
        speed = self.rapid_um_s if rapid else self.speed_um_s
        return Pace(speed, self.acceleration_um_s2, rapid, self.end_um_s)

    def run_at(self, pace: Pace) -> float:
        """Speed µm/s of an entry under overrides and ceiling."""
        speed = pace.speed_um_s * (self.override_rapid if pace.rapid else self.override)
        return min(max(speed, _SLOWEST_UM_S), self.ceiling_um_s)


def speeds_of(settings: CardSettings) -> Speeds:
    """Speeds before any call sets them."""
    return Speeds(
        speed_um_s=settings.synvel_pulse_ms * UM_S_PER_PULSE_MS,
        acceleration_um_s2=settings.synacc_pulse_ms2 * UM_S2_PER_PULSE_MS2,
        ceiling_um_s=settings.maxvel_pulse_ms * UM_S_PER_PULSE_MS,
        stop_um_s2=settings.stpacc_pulse_ms2 * UM_S2_PER_PULSE_MS2,
        emergency_um_s2=settings.estpacc_pulse_ms2 * UM_S2_PER_PULSE_MS2,
        rapid_um_s=settings.rapid_pulse_ms * UM_S_PER_PULSE_MS,
    )


def checked(value: float) -> float:
    """A speed or an acceleration as given. Refused with 4 beyond `SPEEDS`, as what is 0 or less."""
    if not SPEEDS[0] <= value <= SPEEDS[1]:
        raise Refused(Code.SPEED)
    return value


def in_pulses(value: float, settings: CardSettings, state: CardState) -> float:
    """A speed or an acceleration as given; where they count user units, those of X (grade C). Refused as `checked`."""
    return checked(value * state.axes[0].map_count if settings.speeds_in_user_units else value)
