"""Checks of many files over all cores. A fault of drycut at one of them is told of that one; the others are checked."""

import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Final

from sim.check.batch import Job, check_any, not_checked
from sim.check.result import CheckResult

_FILES_A_TASK = 32
_DIED: Final = "its process ended at once: it was killed, or there was not enough memory"


def check_files(jobs: Sequence[Job], progress: Callable[[int, int], None]) -> Iterator[CheckResult]:
    """Results in the order of the jobs, over all cores; `progress` is told how many of how many are done."""
    for done, result in enumerate(_results(jobs), start=1):
        progress(done, len(jobs))
        yield result


def _results(jobs: Sequence[Job]) -> Iterator[CheckResult]:
    """Results of all jobs. Where a process dies, nobody knows at which file: its task is done one by one."""
    at = 0
    while at < len(jobs):
        for result in _until_one_dies(jobs[at:]):
            at += 1
            yield result
        for result in _one_by_one(jobs[at : at + _FILES_A_TASK]):
            at += 1
            yield result


def _until_one_dies(jobs: Sequence[Job]) -> Iterator[CheckResult]:
    with ProcessPoolExecutor(os.cpu_count(), initializer=_left_to_the_first) as pool:
        try:
            yield from pool.map(check_any, jobs, chunksize=_FILES_A_TASK)
        except BrokenProcessPool:
            return


def _one_by_one(jobs: Sequence[Job]) -> Iterator[CheckResult]:
    """Results of jobs from one process: it dies at the file that it was given last, and another goes on."""
    at = 0
    while at < len(jobs):
        with ProcessPoolExecutor(1, initializer=_left_to_the_first) as pool:
            try:
                while at < len(jobs):
                    yield pool.submit(check_any, jobs[at]).result()
                    at += 1
            except BrokenProcessPool:
                yield not_checked(jobs[at], _DIED)
                at += 1


def _left_to_the_first() -> None:
    """Ctrl-C reaches all processes of a terminal; the first of them ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
