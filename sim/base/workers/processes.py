"""Workers of this machine: a process a core.

What a pool of workers is: where jobs are done, how many may be handed over at once, and how a death is told.
"""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager
from types import FrameType
from typing import Final, Protocol


class Pool(Protocol):
    """Workers that do jobs.

    Attributes
    ----------
    died
        Errors of a future whose worker died. Of the jobs that were under way then nobody knows which one killed it.
    is_here
        Whether the workers run on this machine: then they see its files, and are made of the same.
    """

    died: tuple[type[BaseException], ...]
    is_here: bool

    def ahead(self) -> int:
        """How many jobs may be under way at once, so that no worker waits and few results are held."""

    def open(self, *, alone: bool = False) -> AbstractContextManager[Executor]:
        """The workers, for as long as the context lasts; with `alone` one of them, or as good as one.

        Where the context ends by an error, what is under way is dropped.
        """


_MOST: Final = 61 if sys.platform == "win32" else 1_000_000  # what Windows can wait for (concurrent.futures)
_AHEAD_EACH: Final = 2  # one that it does, and one that waits for it
_PATIENCE_S: Final = 1.0  # a process that is told to end clears its files away first
_MOST_TOLD: Final = 5


class Processes:
    """A `Pool` of processes of this machine, as many as asked for, else as many as it has cores for us."""

    died: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    is_here = True

    def __init__(self, count: int | None = None) -> None:
        self._count = min(count or cores(), _MOST)

    def ahead(self) -> int:
        """Jobs under way at once."""
        return _AHEAD_EACH * self._count

    @contextmanager
    def open(self, *, alone: bool = False) -> Iterator[ProcessPoolExecutor]:
        """The processes; they are told to end at once where the context ends by an error."""
        executor = ProcessPoolExecutor(1 if alone else self._count, initializer=_ready)
        try:
            yield executor
        except BaseException:
            executor.shutdown(wait=False, cancel_futures=True)
            _end_all()
            raise
        executor.shutdown()


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1


def _end_all() -> None:
    """End the processes that this one has started: each in what it does, then in the job that it has taken already.

    One that does not hear, since it is in a long compiled loop, is killed.
    """
    ended = 0
    while children := multiprocessing.active_children():
        for child in children:
            child.terminate() if ended < _MOST_TOLD else child.kill()
        for child in children:
            child.join(_PATIENCE_S)
        ended += 1


def _ready() -> None:
    """Make a worker end when it should: Ctrl-C reaches all processes of a terminal, and the first one ends the others.

    A worker that is told to end clears its files away. One whose first process was killed would wait for jobs for ever.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _end)
    threading.Thread(target=_end_with_the_first, daemon=True).start()


def _end(number: int, frame: FrameType | None) -> None:
    sys.exit(128 + number)


def _end_with_the_first() -> None:
    first = multiprocessing.parent_process()
    if first is not None:
        first.join()
        os._exit(1)
