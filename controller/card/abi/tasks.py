"""Threads of this process, as the Linux kernel tells of them: which of them are at work and may yet call the card."""

import os
from collections.abc import Collection
from typing import Final, NamedTuple

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
