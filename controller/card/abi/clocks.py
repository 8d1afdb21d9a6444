"""Time on the card while a program uses it: simulated, or that of the wall clock, so many times as fast."""

import threading
import time
from typing import Protocol

from controller.card.abi.turns import Turns
from controller.card.ge import GECard


class Clock(Protocol):
    """Between `begin` and `end` a thread has the card for itself, and it is as late there as it should be."""

    def begin(self) -> None:
        """Wait for the card."""

    def end(self) -> None:
        """Let others have it."""

    def sleep(self, seconds: float) -> None:
        """Let the thread sleep. ValueError beyond what the card's clock holds."""


class SimulatedClock:
    """Time passes by calls and sleeps alone. With several threads it passes when all wait: `Turns`."""

    def __init__(self, card: GECard, turns: Turns) -> None:
        self._card, self._turns = card, turns

    def begin(self) -> None:
        """Wait for the turn of this thread."""
        self._turns.take(self._now)

    def end(self) -> None:
        """The turn is over."""
        self._turns.end()

    def sleep(self, seconds: float) -> None:
        """Wait until it is so much later on the card."""
        began = self._card.time_s
        self._turns.take(lambda: began + seconds)
        try:
            now = self._card.time_s
            left = seconds if now == began else began + seconds - now
            if left > 0.0:
                self._card.sleep(left * 1e3)
        finally:
            self._turns.end()

    def _now(self) -> float:
        return self._card.time_s


class WallClock:
    """The card is as late as the wall clock, `times` as fast; sleeps last so much shorter."""

    def __init__(self, card: GECard, times: float) -> None:
        self._card, self._times = card, times
        self._lock = threading.RLock()
        self._began = time.monotonic()

    def begin(self) -> None:
        """Wait for the card, and let it follow the clock."""
        self._lock.acquire()
        behind = (time.monotonic() - self._began) * self._times - self._card.time_s
        if behind > 0.0:
            self._card.sleep(behind * 1e3)

    def end(self) -> None:
        """Let others have the card."""
        self._lock.release()

    def sleep(self, seconds: float) -> None:
        """Sleep."""
        time.sleep(seconds / self._times)
