"""A card under watch: its pulses are collected, and short names for what tests ask of it."""

import numpy as np

from controller import GECard
from controller.card.core.settings import CardSettings
from controller.stepping.pulses import Pulses

IDLE, ABNORMAL, EMPTY = 1 << 0, 1 << 9, 1 << 13


class Watched:
    """An open card with the settings asked for."""

    def __init__(self, **settings):
        self.collected: list[Pulses] = []
        self.card = GECard(CardSettings(**settings), on_pulses=self.collected.append)
        assert self.card.GT_Open() == 0

    def pulses(self) -> Pulses:
        """All pulses that came due so far, one row each."""
        self.places()
        empty = Pulses(np.zeros(0), *(np.zeros(0, dtype=np.int32) for _ in range(3)))
        return Pulses._make(np.concatenate(columns) for columns in zip(empty, *self.collected, strict=True))

    def places(self) -> tuple[int, ...]:
        return tuple(self.card.places[0])

    def status(self) -> int:
        code, status = self.card.GT_GetCrdSts()
        assert code == 0
        return status

    def point(self) -> tuple[float, ...]:
        return self.card.GT_GetPrfPnt()[1]

    def until_idle(self, step_ms: float = 50.0, most: int = 4000) -> float:
        """Sleep until the motion is over, at most so many times; the time then, s."""
        for _ in range(most):
            if self.status() & IDLE:
                return self.card.time_s
            self.card.sleep(step_ms)
        raise AssertionError(f"still moving at {self.card.time_s} s")

    def load(self, *path: tuple[float, ...], vel: float = 1.0, acc: float = 0.01) -> None:
        """A closed list from where the axes stand: a place is a line, centre and angle an arc."""
        assert self.card.GT_StrtList() == 0
        x, y, *_ = self.point()
        assert self.card.GT_MvXY(x, y, vel, acc) == 0
        for numbers in path:
            assert (self.card.GT_LnXY if len(numbers) == 2 else self.card.GT_ArcXY)(*numbers) == 0
        assert self.card.GT_EndList() == 0
