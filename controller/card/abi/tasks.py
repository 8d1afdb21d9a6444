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


class Task(NamedTuple):
    """State of a thread and the processor time that it took so far, ticks."""

    state: bytes
    ticks: int


class Tasks:
    """The threads of a process, but for those that its packages began (`foreign`), which never come to the card.

    A thread that only waits, for another thread or for a file, is not at work. One that was at work for long while
    others waited for it, such as one that waits for a flag in a loop, is not waited for until it comes to the card.
    """

    def __init__(self, foreign: Collection[int] = ()) -> None:
        self._foreign = set(foreign)
        self._since: dict[int, int] = {}

    def only_one(self) -> bool:
        """Whether the thread that asks is the only one, in a microsecond."""
        count = os.stat(_FOLDER).st_nlink - _LINKS  # noqa: PTH116 - asked at every call
        return count == len(self._foreign) + 1

    def came(self, thread: int) -> None:
        """Wait for a thread again, from now on."""
        self._foreign.discard(thread)
        self._since.pop(thread, None)

    def at_work(self, waiting: Collection[int]) -> bool:
        """Whether a thread that is not among those that wait is to be waited for."""
        return any(self._holds_up(thread) for thread in all_tasks() - self._foreign - set(waiting))

    def _holds_up(self, thread: int) -> bool:
        task = _task(thread)
        if task.state not in _AT_WORK:
            return False
        return task.ticks - self._since.setdefault(thread, task.ticks) < PATIENCE_TICKS


def all_tasks() -> set[int]:
    """Numbers of all threads of this process; none where the kernel does not tell."""
    try:
        return {int(name) for name in os.listdir(_FOLDER)}  # noqa: PTH208 - as above
    except OSError:
        return set()


def _task(thread: int) -> Task:
    """A thread that has ended does nothing."""
    try:
        file = os.open(f"{_FOLDER}/{thread}/stat", os.O_RDONLY)
    except OSError:
        return Task(b"X", 0)
    try:
        fields = os.read(file, 1024).rpartition(b") ")[2].split()
        return Task(fields[_STATE], int(fields[_USER]) + int(fields[_SYSTEM]))
    except (OSError, IndexError):
        return Task(b"X", 0)
    finally:
        os.close(file)
