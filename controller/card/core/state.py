"""What one card remembers between calls, apart from its motion."""

from dataclasses import dataclass, field
from typing import Any, NamedTuple

from controller.card.core.call import AxisSts
from controller.card.core.settings import AXES


@dataclass(slots=True)
class AxisState:
    """One axis. Places are whole pulses from where it stood when the card was made.

    Attributes
    ----------
    latched
        Latched bits of its status word (`codes.LATCHED`).
    zero
        Place of its zero; `actual_shift` is what `GT_SetAtlPos` put the actual position off the pulses.
    captured
        Place latched by a home, index or probe edge; None before the first.
    map_count
        Pulses in one user unit.
    encoder_zero
        Place where its encoder reads 0.
    backlash
        Pulses of `GT_SetBacklash`; they are kept, and move nothing.
    servo_set, servo_loaded
        Servo settings by name, as they were set and as the last update loaded them.
    """

    number: int
    enabled: bool = False
    limits_on: bool = True
    latched: int = 0
    zero: int = 0
    actual_shift: int = 0
    home_armed: bool = False
    index_armed: bool = False
    captured: int | None = None
    map_count: float = 1.0
    error_limit: int = 32767
    auto_stop: bool = False
    encoder_zero: int = 0
    backlash: int = 0
    servo_set: dict[str, float] = field(default_factory=dict)
    servo_loaded: dict[str, float] = field(default_factory=dict)

    def capture(self, place: int) -> None:
        """Latch a place, of a home, index or probe edge."""
        self.captured = place
        self.latched |= AxisSts.CAPTURED


class LimitMet(NamedTuple):
    """A limit switch that stopped a motion: when, s; its axis, from 1; whether the positive one."""

    t_s: float
    axis: int
    is_positive: bool


@dataclass(slots=True)
class CardState:
    """Axes 1 to 4 in order, inputs and outputs (16 bit, active low), the last refusal, and what is only recorded.

    `stopped_abnormally` is latched when a limit stops a motion, until the next one begins or the list is emptied.
    `limits_met` are those that stopped a motion so far, in order, whatever was reset since. `limit_sense` and
    `home_sense` are the words of the program, bits as those of the levels; None before it sends one.
    """

    opened: bool = False
    axes: list[AxisState] = field(default_factory=lambda: [AxisState(number) for number in range(1, AXES + 1)])
    outputs: int = 0xFFFF
    inputs: int = 0xFFFF
    command_status: int = 0
    stopped_abnormally: bool = False
    probe_armed: bool = False
    limit_sense: int | None = None
    home_sense: int | None = None
    recorded: dict[str, tuple[Any, ...]] = field(default_factory=dict)
    limits_met: list[LimitMet] = field(default_factory=list)

    def set_outputs(self, mask: int, value: int) -> None:
        """Let the outputs under a mask take the levels of `value`."""
        self.outputs = (self.outputs & ~mask) | (value & mask)

    def power_on(self) -> None:
        """All as after power on, except that the card stays open and the world outside is as it was."""
        self.axes[:] = [AxisState(number) for number in range(1, AXES + 1)]
        self.outputs, self.command_status, self.probe_armed = 0xFFFF, 0, False
        self.limit_sense = self.home_sense = None
        self.stopped_abnormally = False
        self.recorded.clear()
