"""Checks of many files over all cores. A fault of drycut at one of them is told of that one; the others are checked."""

from collections.abc import Callable, Iterator, Sequence

from sim.check.batch import Job, check_any, not_checked
from sim.check.result import CheckResult
from sim.workers.pool import Pool
from sim.workers.rounds import DIED, Lost, in_order, results

_FILES_A_TASK = 32


def check_files(jobs: Sequence[Job], pool: Pool, progress: Callable[[int, int], None]) -> Iterator[CheckResult]:
    """Results in the order of the jobs, from a pool; `progress` is told how many of how many are done."""
    found = in_order(results(check_any, enumerate(jobs), pool, _FILES_A_TASK))
    for done, (job, result) in enumerate(zip(jobs, found, strict=True), start=1):
        progress(done, len(jobs))
        yield not_checked(job, DIED) if isinstance(result, Lost) else result
