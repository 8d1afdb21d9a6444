"""One axis of the table: what it is, what it is asked for, and how far it has come."""

from typing import NamedTuple

from parser.geometry.curves import Floats
from sim.table.physics.drive import Drive
from sim.table.physics.rating import Rating, Strength, Train, Turn
from sim.table.physics.state import Slide


class Axis(NamedTuple):
    """What an axis is.

    Attributes
    ----------
    drive, strength
        Its drive, and what its motor can do.
    step_time_s
        Time that the motor takes for a step.
    trip_um
        Lag at which a servo trips; infinite for a stepper.
    speed_limit_um_s
        Speed limit, for its peak; infinite where there is none.
    low_um, high_um
        Ends of its travel.
    step_tick_s, steps_tick_s, shaken_tick_s
        Ticks while single steps are felt, while the motor makes several at once, and while the axis is shaken by more.
    shakes_s
        Times at which shakes begin and end in turn, and infinity.
    """

    drive: Drive
    strength: Strength
    step_time_s: float
    trip_um: float
    speed_limit_um_s: float
    low_um: float
    high_um: float
    step_tick_s: float
    steps_tick_s: float
    shaken_tick_s: float
    shakes_s: Floats


class AxisDemand(NamedTuple):
    """What an axis is asked for.

    Attributes
    ----------
    train
        Its pulses, as far as they are known.
    braked_s
        When a servo of the table tripped: then both are braked; infinite where none did.
    until_s
        Time up to which the pulses lead.
    """

    train: Train
    braked_s: float
    until_s: float


class Noted(NamedTuple):
    """How far the record of an axis is: the next sample, bin, slip and shake, pulses commanded, and ticks in all."""

    sample: int
    bin: int
    slip: int
    shake: int
    commanded: int
    ticks: int


class State(NamedTuple):
    """How far an axis has come; `tripped_s` is when its servo tripped, infinite where it did not."""

    slide: Slide
    turn: Turn
    rating: Rating
    noted: Noted
    tripped_s: float
