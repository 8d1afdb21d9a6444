"""Kill runs that swap sets of files, before each step or at random, and count what a reader finds.

``python tests/tools/killed_swaps.py --random 1000`` prints the counts as JSON; the process forks, so it has no threads.
"""

import argparse
import json
import os
import random
import signal
import sys
import time
from collections import Counter
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

from swaps import NAMES, NEW, OLD, before_each_call, found, left, memory_folder, without_links, write

from sim.base.files import staged

MOST_S = 0.02
"""Within which a random kill comes; a child swaps some ten sets in it."""


def child(work: Callable[[], None]) -> int:
    """A process of its own for some work; its number."""
    number = os.fork()
    if number == 0:
        try:
            work()
        except BaseException:  # nothing of a child may run on in the code of its parent
            os._exit(1)
        os._exit(0)
    return number


def killed_before_step(folder: Path, step: int) -> bool:
    """Swap in a child that is killed before a step; False where it has fewer."""

    def told(number: int, call: str) -> None:
        if number == step:
            os.kill(os.getpid(), signal.SIGKILL)

    def work() -> None:
        with before_each_call(told):
            write(folder, NEW)

    return os.waitstatus_to_exitcode(os.waitpid(child(work), 0)[1]) == -signal.SIGKILL


def killed_after(folder: Path, wait_s: float) -> bool:
    """Swap sets in a child, one after the other, that is killed after a time."""

    def work() -> None:
        while True:
            write(folder, NEW)
            write(folder, OLD)

    number = child(work)
    time.sleep(wait_s)
    os.kill(number, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]) == -signal.SIGKILL


def looked_at(folder: Path) -> Counter[str]:
    """What a reader finds after a kill, and after the next run, which stops early."""
    texts = found(folder)
    mixed = not (texts.items() <= OLD.items() or texts.items() <= NEW.items())
    counts = Counter(kills=1, mixed=mixed, parts=not mixed and texts not in (OLD, NEW), new=texts == NEW)
    counts["stages"] = len(left(folder)) > 0
    try:
        with staged(folder, NAMES):
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        counts["not_whole_after_next_run"] = found(folder) not in (OLD, NEW)
        counts["left_after_next_run"] = len(left(folder)) > 0
    return counts


def trial(folder: Path, by_random: int, seed: int) -> Counter[str]:
    """Counts of one kill before each step of a swap, and of kills at random moments."""
    counts: Counter[str] = Counter()
    write(folder, OLD)
    step = 1
    while killed_before_step(folder, step):
        counts += looked_at(folder)
        write(folder, OLD)
        step += 1
    moments = random.Random(seed)
    for _ in range(by_random):
        killed_after(folder, moments.uniform(0.0, MOST_S))
        counts += looked_at(folder)
    return counts


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--random", type=int, default=20, help="kills at random moments")
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--moves", action="store_true", help="as on a file system without links")
    options = asked.parse_args()
    with memory_folder() as folder, without_links() if options.moves else nullcontext():
        json.dump(trial(folder, options.random, options.seed), sys.stdout)


if __name__ == "__main__":
    main()
