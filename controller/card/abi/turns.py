"""Threads take turns on the card, in the order of its simulated time.

A call costs simulated time, and a sleep lasts some; the real time they take means nothing. So a thread that comes to
the card has a moment at which it goes on: now for a call, later for a sleep. It is its turn when no thread has an
earlier one and all others wait as well: on the card, for one another, or for a file. So time never runs ahead of a
thread that is at work, sleeps of several threads do not add up, and the same program takes the same turns each time.
"""

import threading
from collections.abc import Callable
from typing import Final, NamedTuple, Protocol

from controller.card.abi.tasks import Tasks

_FIRST_LOOK_S: Final = 0.0005
_LONGEST_LOOK_S: Final = 0.004
"""Real time between looks at threads that are at work; a thread that comes to the card looks at once."""


class Passed(Protocol):
    """How often threads came to the card, and how often they left it."""

    def __getitem__(self, at: int, /) -> int: ...


class _Wait(NamedTuple):
    """A thread that waits for its turn: when that is, s; its order, lower ones first; its number; its gate."""

    at_s: float
    order: int
    thread: int
    gate: threading.Lock


class Turns:
    """Turns of threads on a clock.

    Parameters
    ----------
    tasks
        The threads of the process.
    passed
        Threads that came, counted before they do anything else here, and threads that left, counted last.
    """

    def __init__(self, tasks: Tasks, passed: Passed) -> None:
        self._tasks, self._passed = tasks, passed
        self._lock = threading.Lock()
        self._waits: list[_Wait] = []
        self._depth = 0
        self._has_turn = 0

    def take(self, at_s: Callable[[], float]) -> None:
        """Wait for the turn of this thread, at a moment that is asked for when it has come; its own again at once."""
        thread = threading.get_native_id()
        if self._has_turn == thread:
            self._depth += 1
            return
        with self._lock:
            self._tasks.came(thread)
            if not self._has_turn and not self._waits and self._inside() == 1 and self._tasks.only_one():
                self._has_turn = thread
                return
            wait = _Wait(at_s(), self._tasks.order(thread), thread, threading.Lock())
            wait.gate.acquire()
            self._waits.append(wait)
            self._give()
        look_s = _FIRST_LOOK_S
        while not wait.gate.acquire(timeout=look_s):
            look_s = min(2.0 * look_s, _LONGEST_LOOK_S)
            with self._lock:
                self._give()

    def end(self) -> None:
        """The turn of this thread is over; whose is next is seen when all wait again."""
        if self._depth:
            self._depth -= 1
        else:
            self._has_turn = 0

    def _inside(self) -> int:
        """Threads that came and did not leave yet."""
        return self._passed[0] - self._passed[1]

    def _give(self) -> None:
        """Let the next thread have its turn, if all wait; those on their way in or out do not wait yet."""
        came = self._passed[0]  # one that comes after this look waits for Python, and so seems to rest
        if self._has_turn or not self._waits or self._inside() != len(self._waits):
            return
        if self._tasks.at_work([wait.thread for wait in self._waits]) or self._passed[0] != came:
            return
        following = min(self._waits)
        self._waits.remove(following)
        self._has_turn = following.thread
        following.gate.release()
