"""What work costs: CPU time, time on the clock and memory, of a function here or of a process of its own."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

from places import ROOT

DRYCUT = (sys.executable, "-m", "drycut")
_GOOD_CODES = (0, 1)  # of drycut: 1 says that a program is not sound


class Used(NamedTuple):
    """Seconds of CPU and on the clock, and MiB of the largest process."""

    cpu_s: float
    wall_s: float
    peak_mib: float


def used_by(command: Sequence[str]) -> Used:
    """What a process and its own processes took, its output dropped; RuntimeError where it fails."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    nothing = subprocess.DEVNULL
    with tempfile.TemporaryFile() as errors:
        began = time.perf_counter()
        process = subprocess.Popen(command, stdin=nothing, stdout=nothing, stderr=errors, env=environment)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - began
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in _GOOD_CODES:
            errors.seek(0)
            raise RuntimeError(f"{command[0]} ended with {process.returncode}: {errors.read()[-500:]!r}")
    return Used(used.ru_utime + used.ru_stime, wall, used.ru_maxrss / 1024.0)


def cpu_of(work: Callable[[], object]) -> float:
    """Seconds of CPU that a function takes in this process."""
    began = time.process_time()
    work()
    return time.process_time() - began


def in_turns(rounds: int, *works: Callable[[], float]) -> list[float]:
    """The least of some rounds of each work, all of them in turns, so that they meet the same noise."""
    taken = [[work() for work in works] for _ in range(rounds)]
    return [min(column) for column in zip(*taken, strict=True)]
