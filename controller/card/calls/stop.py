"""Functions that stop and resume, and tell where the motion is."""

from controller.card.calls.base import CardBase
from controller.card.core.call import gt
from controller.card.core.units import UM_S_PER_PULSE_MS
from controller.card.engine.entries import Place, four

_POINT = (0.0, 0.0, 0.0, 0.0)


class StopCalls(CardBase):
    """Stops, and points of the path in user coordinates."""

    @gt()
    def GT_StpMtn(self) -> None:
        """Brake along the path to rest; harmless at rest."""
        self._engine.sequencer.stop(self._engine.speeds.stop_um_s2)

    @gt()
    def GT_EStpMtn(self) -> None:
        """As `GT_StpMtn`, with the emergency deceleration."""
        self._engine.sequencer.stop(self._engine.speeds.emergency_um_s2)

    @gt()
    def GT_RestoreMtn(self) -> None:
        """Go on with what was stopped last. Refused with 1 unless the axes are at rest at its break point."""
        self._engine.restore()

    @gt(zeros=(_POINT,))
    def GT_GetBrkPnt(self) -> Place:
        """Where the motion came to rest when it was last stopped; the place of power on before."""
        return self._user(self._engine.motion.break_place)

    @gt(zeros=(_POINT,))
    def GT_GetSegPnt(self) -> Place:
        """End of the path entry being executed; at rest where the axes stand (grade C)."""
        return self._user(self._engine.motion.entry_end())

    @gt(zeros=(_POINT,))
    def GT_GetPrfPnt(self) -> Place:
        """Profile place."""
        return self._user(self._engine.motion.place())

    @gt(zeros=(0.0,))
    def GT_GetPrfVel(self) -> float:
        """Speed along the path, pulse/ms."""
        return self._engine.motion.speed() / UM_S_PER_PULSE_MS

    def _user(self, place: Place) -> Place:
        axes = zip(place, self._state.axes, strict=True)
        return four((pulses - axis.zero) / axis.map_count for pulses, axis in axes)
