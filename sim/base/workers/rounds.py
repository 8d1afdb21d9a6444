"""Jobs done in rounds: as many at once as there is room for; after a death, those that were under way one by one.

`concurrent.futures` fails all jobs under way where a process dies, and no pool can tell which of them killed it: a job
that takes all memory may let the system kill another worker. So each of them is done once more while nothing else runs.
The one at which a worker then dies again is told as `Lost`; the others have their results.
"""

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from itertools import islice
from typing import Any, Final, NamedTuple, TypeVar

from sim.base.workers.processes import Pool

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
            under_way[executor.submit(_all, work, [job for _, job in group])] = group
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
                    (value,) = executor.submit(_all, work, [job]).result()
                except pool.died:
                    yield number, Lost()
                    break
                yield number, value
            else:
                return
