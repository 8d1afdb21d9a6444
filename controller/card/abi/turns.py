"""Threads take turns on the card, in the order of its simulated time.

A call costs simulated time, and a sleep lasts some; the real time they take means nothing. So a thread that comes to
the card has a moment at which it goes on: now for a call, later for a sleep. It is its turn when no thread has an
earlier one and all others wait as well: on the card, for one another, or for a file. So time never runs ahead of a
thread that is at work, sleeps of several threads do not add up, and the same program takes the same turns each time.

Threads of this process, as the Linux kernel tells of them: which of them are at work and may yet call the card.
"""

import os
import threading
from collections.abc import Callable, Collection
from typing import Final, NamedTuple, Protocol

_FOLDER: Final = "/proc/self/task"
_LINKS: Final = 2
"""Of the folder, beside one for each thread."""
_AT_WORK: Final = (b"R", b"D")
"""States of a thread that goes on by itself: on a processor or waiting for one, or for a disk."""
_STATE, _USER, _SYSTEM = 0, 11, 12
"""Fields behind the name of a thread: its state, and the processor time it took, in ticks."""
PATIENCE_TICKS: Final = 30
"""Processor time after which a thread is taken for one that goes on without the card: 0.3 s at the usual 100 Hz."""


_HIGHEST: Final = "/proc/sys/kernel/pid_max"
"""Says where the numbers of processes and threads, which count up, begin anew."""
_HIGHEST_ANYWHERE: Final = 1 << 22
"""The most that Linux allows: ``PID_MAX_LIMIT`` of its ``include/linux/threads.h``."""


class Task(NamedTuple):
    """State of a thread, the processor time that it took so far, ticks, and how often a processor took it up."""

    state: bytes
    ticks: int
    runs: bytes


class Tasks:
    """The threads of a process, but for those that its packages began (`foreign`), which never come to the card.

    A thread that only waits, for another thread or for a file, is not at work. One that was at work for long while
    others waited for it, such as one that waits for a flag in a loop, is not waited for until it comes to the card.
    """

    def __init__(self, foreign: Collection[int] = ()) -> None:
        self._foreign = set(foreign)
        self._since: dict[int, int] = {}
        self._process = os.getpid()
        self._highest = _highest_number()

    def order(self, thread: int) -> int:
        """Of threads that began later it is higher, though their numbers begin anew at the kernel's highest."""
        return (thread - self._process) % self._highest

    def only_one(self) -> bool:
        """Whether the thread that asks is the only one, in a microsecond."""
        count = os.stat(_FOLDER).st_nlink - _LINKS  # noqa: PTH116 - asked at every call
        return count == len(self._foreign) + 1

    def came(self, thread: int) -> None:
        """Wait for a thread again, from now on."""
        self._foreign.discard(thread)
        self._since.pop(thread, None)

    def at_work(self, waiting: Collection[int]) -> bool:
        """Whether a thread that is not among those that wait is to be waited for.

        The kernel tells of one thread after the other: the first may be woken, or begin another, before the last is
        looked at. Those that rest in two looks and did not run in between rested all at one moment, between the looks.
        """
        first = self._look(waiting)
        if any(self._holds_up(thread, task) for thread, task in first.items()):
            return True
        second = self._look(waiting)
        return any(
            thread not in first or (first[thread].state not in _AT_WORK and task != first[thread])
            for thread, task in second.items()
        )

    def _look(self, waiting: Collection[int]) -> dict[int, Task]:
        return {thread: _task(thread) for thread in all_tasks() - self._foreign - set(waiting)}

    def _holds_up(self, thread: int, task: Task) -> bool:
        if task.state not in _AT_WORK:
            return False
        return task.ticks - self._since.setdefault(thread, task.ticks) < PATIENCE_TICKS


def _highest_number() -> int:
    return int(_read(_HIGHEST) or _HIGHEST_ANYWHERE)


def all_tasks() -> set[int]:
    """Numbers of all threads of this process; none where the kernel does not tell."""
    try:
        return {int(name) for name in os.listdir(_FOLDER)}  # noqa: PTH208 - as above
    except OSError:
        return set()


def _task(thread: int) -> Task:
    """A thread that has ended does nothing."""
    fields = _read(f"{_FOLDER}/{thread}/stat").rpartition(b") ")[2].split()
    if len(fields) <= _SYSTEM:
        return Task(b"X", 0, b"")
    runs = _read(f"{_FOLDER}/{thread}/schedstat").rpartition(b" ")[2]
    return Task(fields[_STATE], int(fields[_USER]) + int(fields[_SYSTEM]), runs)


def _read(path: str) -> bytes:
    """A short file of the kernel; nothing where there is none."""
    try:
        file = os.open(path, os.O_RDONLY)
    except OSError:
        return b""
    try:
        return os.read(file, 1024)
    except OSError:
        return b""
    finally:
        os.close(file)


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
