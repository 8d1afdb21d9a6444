"""Jobs done by workers in rounds, and who the workers of this machine are.

Workers of this machine: a process a core.

What a pool of workers is: where jobs are done, how many may be handed over at once, and how a death is told.

Jobs done in rounds: as many at once as there is room for; after a death, those that were under way one by one.

`concurrent.futures` fails all jobs under way where a process dies, and no pool can tell which of them killed it: a job
that takes all memory may let the system kill another worker. So each of them is done once more while nothing else runs.
The one at which a worker then dies again is told as `Lost`; the others have their results.
"""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager
from itertools import islice
from types import FrameType
from typing import Any, Final, NamedTuple, Protocol, TypeVar

from controller.compiled.signals import signals_come, signals_wait


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


def _submitted(executor: Executor, work: Callable[[Any], Any], jobs: list[Any]) -> Future[list[Any]]:
    """Jobs handed over to a worker.

    The first ones start the workers. Told to end while it is forked, a worker would hear nothing: the handler of this
    process raises where nobody takes it. From Python 3.12 on the executor tells them once, and waits. So signals wait
    until the worker is `_ready`.
    """
    with signals_wait():
        return executor.submit(_all, work, jobs)


def _ready() -> None:
    """Make a worker end when it should: Ctrl-C reaches all processes of a terminal, and the first one ends the others.

    A worker that is told to end clears its files away. One whose first process was killed would wait for jobs for ever.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _end_at_once)
    signals_come()
    signal.signal(signal.SIGTERM, _end)
    threading.Thread(target=_end_with_the_first, daemon=True).start()


def _end_at_once(number: int, frame: FrameType | None) -> None:
    """End a worker that has no files yet; an error here would be printed."""
    os._exit(128 + number)


def _end(number: int, frame: FrameType | None) -> None:
    sys.exit(128 + number)


def _end_with_the_first() -> None:
    first = multiprocessing.parent_process()
    if first is not None:
        first.join()
        os._exit(1)


Job = TypeVar("Job")
Result = TypeVar("Result")


class Lost(NamedTuple):
    """In place of the result of a job whose worker died, also when it did nothing but this job."""


DIED: Final = "its process ended at once: it was killed, or there was not enough memory"
"""What people are told of a job that is `Lost`."""

_Group = list[tuple[int, Any]]  # jobs by their numbers


def results(
    work: Callable[[Job], Result], jobs: Iterable[tuple[int, Job]], pool: Pool, size: int = 1
) -> Iterator[tuple[int, Result | Lost]]:
    """Each job's number with its result, as they come; every number once.

    Parameters
    ----------
    work
        A function of a module, which workers import. What it raises is raised here, and ends all.
    jobs
        Numbers and jobs, taken as there is room for them.
    pool
        Who does them.
    size
        Jobs that are handed over together, where one takes less time than handing it over.
    """
    groups = _in_groups(iter(jobs), size)
    while suspects := (yield from _round(work, groups, pool)):
        yield from _one_by_one(work, suspects, pool)


def in_order(numbered: Iterable[tuple[int, Result]]) -> Iterator[Result]:
    """Results in the order of their numbers: all of 0, 1, 2 and so on."""
    early: dict[int, Result] = {}
    due = 0
    for number, result in numbered:
        early[number] = result
        while due in early:
            yield early.pop(due)
            due += 1


def _in_groups(jobs: Iterator[tuple[int, Job]], size: int) -> Iterator[_Group]:
    while group := list(islice(jobs, size)):
        yield group


def _round(
    work: Callable[[Any], Any], groups: Iterator[_Group], pool: Pool
) -> Generator[tuple[int, Any], None, _Group]:
    """Results until all is done or a worker dies; then the jobs that were under way and have none."""
    lost: _Group = []
    under_way: dict[Future[list[Any]], _Group] = {}
    with pool.open() as executor:
        while True:
            if not lost:
                lost = _hand_over(executor, work, groups, under_way, pool)
            if not under_way:
                return lost
            done, _ = wait(under_way, return_when=FIRST_COMPLETED)
            for future in done:
                group = under_way.pop(future)
                try:
                    values = future.result()
                except pool.died:
                    lost = [*lost, *group]
                    continue
                yield from zip((number for number, _ in group), values, strict=True)


def _hand_over(
    executor: Executor,
    work: Callable[[Any], Any],
    groups: Iterator[_Group],
    under_way: dict[Future[list[Any]], _Group],
    pool: Pool,
) -> _Group:
    """Hand groups over until there is no more room; the jobs of one that the pool does not take any more."""
    for group in islice(groups, max(0, pool.ahead() - len(under_way))):
        try:
            under_way[_submitted(executor, work, [job for _, job in group])] = group
        except pool.died:
            return group
    return []


def _all(work: Callable[[Any], Any], jobs: Sequence[Any]) -> list[Any]:
    return [work(job) for job in jobs]


def _one_by_one(work: Callable[[Any], Any], jobs: _Group, pool: Pool) -> Iterator[tuple[int, Any]]:
    """Results of jobs while nothing else runs: a worker dies at the job that it was given last."""
    left = iter(jobs)
    while True:
        with pool.open(alone=True) as executor:
            for number, job in left:
                try:
                    (value,) = _submitted(executor, work, [job]).result()
                except pool.died:
                    yield number, Lost()
                    break
                yield number, value
            else:
                return
