"""Units of the card's calls in those of the inside; one pulse is 1 µm, and the card counts in ms (grade A).

Settings of the emulated card: all that no header or program tells (grade C), each with a default that says so.

How a switch is wired, and what the card takes its level for.

The level of an input is never turned. Sense bit 0 says that the high level triggers, 1 that the low one does. An input
with nothing on it reads 1: so 1 is right for a switch that is open while it is idle, 0 for one that is closed. Grade B:
three programs for the card send the word, one checks the levels at rest after it.
"""

import math
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias, get_args

UM_S_PER_PULSE_MS = 1e3
UM_S2_PER_PULSE_MS2 = 1e6
UM_S3_PER_PULSE_MS3 = 1e9


Wiring: TypeAlias = Literal["as-sensed", "normally-open", "normally-closed"]
"""``as-sensed`` is the one that the program's sense word is right for, whatever that says."""
AS_SENSED: Final = "as-sensed"
WIRINGS: Final[tuple[Wiring, ...]] = get_args(Wiring)


def sense_of(word: int | None, at: int) -> int | None:
    """Bit of a sense word; None before the program sends one."""
    return None if word is None else word >> at & 1


def idle_level(wiring: Wiring, sense: int | None) -> int:
    """Level of the input while the switch is idle."""
    if wiring == AS_SENSED:
        return 1 if sense is None else sense
    return int(wiring == "normally-open")


def is_taken_for_met(wiring: Wiring, sense: int | None) -> bool:
    """Whether the card takes an idle switch for one that is met, and one that is met for idle.

    Before the program sends a word the high level triggers (grade C).
    """
    return wiring != AS_SENSED and idle_level(wiring, sense) != bool(sense)


AXES = 4
"""Axis numbers 1..4 carry the coordinates X, Y, Z, A; grade A."""

SPEEDS = (1e-7, 1e9)
"""Least and most of a speed in pulse/ms and of an acceleration in pulse/ms²; grade C."""
_FARTHEST = float(1 << 31)
_PLACES = (-_FARTHEST, _FARTHEST)
_WHOLE = {"axes", "cards", "capacity"}
_BOUNDS = {
    "axes": (2, AXES),
    "cards": (1, 16),
    "capacity": (1, (1 << 31) - 1),
    "servo_period_s": (1e-5, 1.0),
    "pulse_limit_hz": (1.0, 1e12),
    "call_s": (1e-30, 1.0),
    "jerk_pulse_ms3": (1e-10, 1e9),
    **dict.fromkeys(
        (
            "synvel_pulse_ms",
            "synacc_pulse_ms2",
            "maxvel_pulse_ms",
            "stpacc_pulse_ms2",
            "estpacc_pulse_ms2",
            "rapid_pulse_ms",
        ),
        SPEEDS,
    ),
}
"""Least and most of each number that is set; `_WHOLE` are whole ones."""


def _check(
    name: str, value: Any, bounds: tuple[float, float], *, whole: bool = False, also: tuple[float, ...] = ()
) -> None:
    """ValueError with name, bounds and value where a number lies beyond its bounds, or is none."""
    least, most = bounds
    is_number = isinstance(value, int if whole else int | float) and not isinstance(value, bool)
    if is_number and (least <= value <= most or value in also):
        return
    kind, rest = "a whole number " if whole else "", " or infinite" if also else ""
    raise ValueError(f"{name} of a card is {kind}from {least:g} to {most:g}{rest}, not {value!r}")


@dataclass(frozen=True, slots=True)
class Switches:
    """Switches of one axis, in pulses from where the axis stands when the card is made; none where infinite.

    Attributes
    ----------
    negative, positive
        The limit switches answer at and beyond these places.
    home
        The home switch answers from the first to the second place.
    index_every
        Distance of the index marks, which lie at its multiples; 0 for none.
    limit_wiring, home_wiring
        How limit switches and home switch are wired; ``as-sensed`` is right for any sense that the program says.
    """

    negative: float = -math.inf
    positive: float = math.inf
    home: tuple[float, float] = (math.inf, math.inf)
    index_every: float = 0.0
    limit_wiring: Wiring = AS_SENSED
    home_wiring: Wiring = AS_SENSED

    def __post_init__(self) -> None:
        _check("negative", self.negative, _PLACES, also=(-math.inf, math.inf))
        _check("positive", self.positive, _PLACES, also=(-math.inf, math.inf))
        for place in self.home:
            _check("home", place, _PLACES, also=(-math.inf, math.inf))
        if self.home[0] > self.home[1]:
            raise ValueError(f"home of a card lies from the lower place to the higher, not {self.home}")
        if self.index_every != 0.0:
            _check("index_every", self.index_every, (1.0, _FARTHEST))
        for name, wiring in (("limit_wiring", self.limit_wiring), ("home_wiring", self.home_wiring)):
            if wiring not in WIRINGS:
                raise ValueError(f"{name} of a card is one of {', '.join(WIRINGS)}, not {wiring!r}")


@dataclass(frozen=True, slots=True)
class CardSettings:
    """What is a setting of the card, units as named; one pulse is 1 µm.

    Attributes
    ----------
    axes
        Axes the card has, 2 to 4; paths in others are refused with 1 (grade C).
    cards
        Cards in the machine, numbered from 0 (grade B).
    servo_period_s
        Period at which the card's own interpolator works (grade C).
    pulse_limit_hz
        Most pulses of one axis in a second (grade C).
    capacity
        Entries the list holds (grade C).
    call_s
        Simulated time that every call takes (grade C): programs poll without sleeping.
    carries_speed
        Whether the path speed is carried through the junction of two entries; else each entry ends at rest unless
        `GT_SetDccVel` says otherwise (grade B/C).
    speeds_in_user_units
        Whether speeds count user units of `GT_MapCnt` instead of pulses (grade C).
    needs_axis_on
        Whether a path is refused with 1 while an axis that it moves is off (grade C).
    synvel_pulse_ms, synacc_pulse_ms2
        Speed and acceleration before the first call that sets them (grade C).
    maxvel_pulse_ms
        Ceiling of the path speed before `GT_SetMaxVel` (grade C).
    stpacc_pulse_ms2, estpacc_pulse_ms2
        Smooth-stop and emergency deceleration before a call sets them (grade C).
    rapid_pulse_ms
        Speed of the ``G0`` variants where no `F` is given (grade C).
    jerk_pulse_ms3
        Jerk limit of plans that start at rest; none where infinite (grade C).
    switches
        Of the axes in order; axes beyond have none.
    """

    axes: Literal[2, 3, 4] = 4
    cards: int = 1
    servo_period_s: float = 200e-6
    pulse_limit_hz: float = 1e6
    capacity: int = 4096
    call_s: float = 20e-6
    carries_speed: bool = True
    speeds_in_user_units: bool = False
    needs_axis_on: bool = False
    synvel_pulse_ms: float = 1.0
    synacc_pulse_ms2: float = 0.01
    maxvel_pulse_ms: float = 1000.0
    stpacc_pulse_ms2: float = 0.1
    estpacc_pulse_ms2: float = 1.0
    rapid_pulse_ms: float = 10.0
    jerk_pulse_ms3: float = math.inf
    switches: tuple[Switches, ...] = field(default=())

    def __post_init__(self) -> None:
        for name, bounds in _BOUNDS.items():
            also = (math.inf,) if name == "jerk_pulse_ms3" else ()
            _check(name, getattr(self, name), bounds, whole=name in _WHOLE, also=also)
        if len(self.switches) > AXES:
            raise ValueError(f"switches of a card are 0 to {AXES} sets, one of each axis, not {len(self.switches)}")

    def switches_of(self, axis: int) -> Switches:
        """Switches of axis 1 to 4."""
        return self.switches[axis - 1] if axis <= len(self.switches) else Switches()
