"""`GECard`: all functions of the card's library on one class."""

from controller.card.calls.axis import IoCalls, PositionCalls, StatusCalls
from controller.card.calls.list import ListCalls, StopCalls
from controller.card.calls.lookahead_mode import LookAheadCalls
from controller.card.calls.path_base import ArcCalls, LineCalls, MoveCalls, StepCalls
from controller.card.calls.recorded import GuardCalls, RecordedCalls, SpecialCalls
from controller.card.calls.speed import ServoCalls, SpeedCalls
from controller.card.core.state import LimitMet


class GECard(
    ListCalls,
    MoveCalls,
    LineCalls,
    ArcCalls,
    StepCalls,
    SpeedCalls,
    StopCalls,
    PositionCalls,
    StatusCalls,
    IoCalls,
    ServoCalls,
    LookAheadCalls,
    RecordedCalls,
    GuardCalls,
    SpecialCalls,
):
    """The emulated GE motion card; see docs/card.md."""

    @property
    def status(self) -> int:
        """Coordinate status of the selected card, as `GT_GetCrdSts` tells it, without a call."""
        with self._alone:
            return self._engine.coordinate_status()

    @property
    def is_moving(self) -> bool:
        """Whether axes of any card move, braking and waiting included."""
        with self._alone:
            return any(engine.motion.moving for engine in self._engines)

    @property
    def limits_met(self) -> tuple[LimitMet, ...]:
        """Limit switches that stopped a motion of the selected card so far, in order."""
        with self._alone:
            return tuple(self._state.limits_met)

    @property
    def places(self) -> list[list[int]]:
        """Where the axes of each card stand, pulses from where they stood when the card was made."""
        with self._alone:
            return [list(engine.motion.pulses_out()) for engine in self._engines]
