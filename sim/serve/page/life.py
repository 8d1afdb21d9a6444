"""How long the server lives: until it is told to end, or no page has been open for a while."""

import time
from collections.abc import Callable
from typing import Final

FIRST_S: Final = 300.0
"""A browser may take its time to start, or the address be copied to it by hand."""
AWAY_S: Final = 60.0
"""Browsers wake hidden pages once a minute at least, and these say so each time: a closed one is silent."""


class Life:
    """Whether the page is still there; `now` tells the time, s."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._until = now() + FIRST_S
        self._is_ended = False

    def note_page(self) -> None:
        """The page was heard of."""
        self._until = self._now() + 2.0 * AWAY_S

    def end(self) -> None:
        """It is to end now."""
        self._is_ended = True

    @property
    def is_over(self) -> bool:
        """Whether it is to end."""
        return self._is_ended or self._now() > self._until
