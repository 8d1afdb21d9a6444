"""What the environment asks of the library: the card and its settings, its log, and how fast its time passes.

`DRYCUT_CARD` is a file of TOML with the keys of `CardSettings`, `DRYCUT_CALL_S` the time of a call in s, `DRYCUT_CLOCK`
how many times as fast as the wall clock the card's is, or ``simulated``, `DRYCUT_CARD_LOG` the file of the log.

Time on the card while a program uses it: simulated, or that of the wall clock, so many times as fast.
"""

import math
import threading
import time
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple, Protocol

from controller.card.abi.turns import Turns
from controller.card.core.settings import CardSettings
from controller.card.ge import GECard
from controller.card.log import settings_of
from parser.files import read_text
from parser.findings.errors import SettingsError

CARD, CALL_S, CLOCK, LOG = "DRYCUT_CARD", "DRYCUT_CALL_S", "DRYCUT_CLOCK", "DRYCUT_CARD_LOG"
_CALL_S: Final = 1e-3
"""Programs poll without sleeping: so a second of motion is a thousand calls."""
_CALL_ON_WALL_S: Final = 1e-6
"""The wall clock moves the card; a call only has to take some time."""
_SIMULATED: Final = "simulated"
_FASTEST: Final = 1e6


class CardEnvironment(NamedTuple):
    """Settings of the card; how fast its clock is, None where it is simulated; file of the log, None for none."""

    settings: CardSettings
    times: float | None
    log: Path | None


def card_environment(environment: Mapping[str, str]) -> CardEnvironment:
    """What a program's environment asks for; empty texts ask for nothing.

    SettingsError where it is none, FileUnreadableError where the file of the card cannot be read.
    """
    times = _times(environment.get(CLOCK, ""))
    call_s = {"call_s": _CALL_S if times is None else _CALL_ON_WALL_S}
    settings = call_s | _table(environment.get(CARD, "")) | _call_s(environment.get(CALL_S, ""))
    log = environment.get(LOG, "")
    try:
        return CardEnvironment(settings_of(settings), times, Path(log) if log else None)
    except ValueError as error:
        raise SettingsError("in-file", file=environment.get(CARD) or CALL_S, message=str(error)) from None


def _times(text: str) -> float | None:
    if text in ("", _SIMULATED):
        return None
    times = _number(text)
    if times is None or not 0.0 < times <= _FASTEST:
        raise SettingsError("card-clock-no-number", name=CLOCK, simulated=_SIMULATED, most=_FASTEST, found=text)
    return times


def _call_s(text: str) -> dict[str, float]:
    if not text:
        return {}
    seconds = _number(text)
    if seconds is None:
        raise SettingsError("no-seconds", name=CALL_S, found=text)
    return {"call_s": seconds}


def _number(text: str) -> float | None:
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


def _table(name: str) -> dict[str, Any]:
    if not name:
        return {}
    try:
        return tomllib.loads(read_text(Path(name)))
    except UnicodeDecodeError:
        raise SettingsError("no-utf-8", file=name) from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise SettingsError("in-file", file=name, message=str(error)) from None


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
