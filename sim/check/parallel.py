"""Checks of many files by workers. A fault of drycut at one of them is told of that one; the others are checked."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from parser.files import read_bytes
from parser.findings.errors import FileUnreadableError
from sim.base.workers.maker import Maker, made_by, refuse_other_makers
from sim.base.workers.rounds import DIED, Lost, Pool, in_order, results
from sim.check.file_check import Job, check_any, not_checked
from sim.check.result import CheckResult

_FILES_A_TASK = 32


def check_files(jobs: Sequence[Job], pool: Pool, progress: Callable[[int, int], None]) -> Iterator[CheckResult]:
    """Results in the order of the jobs, from a pool; `progress` is told how many of how many are done.

    ClusterError where a worker of another machine would find other things than this one.
    """
    numbered = enumerate(jobs)
    found = results(check_any, numbered, pool, _FILES_A_TASK) if pool.is_here else _elsewhere(jobs, pool)
    for done, (job, result) in enumerate(zip(jobs, in_order(found), strict=True), start=1):
        progress(done, len(jobs))
        yield not_checked(job, DIED) if isinstance(result, Lost) else result


def _elsewhere(jobs: Sequence[Job], pool: Pool) -> Iterator[tuple[int, CheckResult | Lost]]:
    """Numbers and results of jobs whose bytes are sent; what cannot be read is told here."""
    unreadable: list[int] = []
    sent = _sent(jobs, unreadable)
    yield from results(_check_sent, sent, pool, _FILES_A_TASK)
    yield from ((number, check_any(jobs[number])) for number in unreadable)


def _sent(jobs: Sequence[Job], unreadable: list[int]) -> Iterator[tuple[int, tuple[Maker, Job]]]:
    """Numbers of the jobs, and each with the bytes of its file and who asks; fills in which cannot be read."""
    digest = made_by()
    for number, job in enumerate(jobs):
        try:
            data = read_bytes(job.source) if isinstance(job.source, Path) else job.source
        except FileUnreadableError:
            unreadable.append(number)
        else:
            yield number, (digest, job._replace(source=data))


def _check_sent(task: tuple[Maker, Job]) -> CheckResult:
    digest, job = task
    refuse_other_makers(digest)
    return check_any(job)
