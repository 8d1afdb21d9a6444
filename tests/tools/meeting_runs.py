"""Runs that swap their sets into one folder at the same time, while a reader opens the files; counts as JSON."""

import json
import os
import sys
from pathlib import Path

from killed_swaps import child
from swaps import NAMES, found, left, memory_folder, write

RUNS, SETS = 3, 25


def run_of(folder: Path, run: int) -> None:
    for number in range(SETS):
        write(folder, dict.fromkeys(NAMES, f"{run} {number}"))


def main() -> None:
    with memory_folder() as folder:
        write(folder, dict.fromkeys(NAMES, "first"))
        runs = [child(lambda run=run: run_of(folder, run)) for run in range(RUNS)]  # type: ignore[misc]
        ends: list[int] = []
        reads = missing = 0
        while len(ends) < RUNS:
            # Who is held up on the way through a link may find nothing, once (docs/report.md).
            missing += len(NAMES) - max(len(found(folder)) for _ in range(2))
            reads += 2 * len(NAMES)
            number, status = os.waitpid(-1, os.WNOHANG)
            if number in runs:
                ends.append(status)
        sets = set(found(folder).values())
        json.dump(
            {
                "reads": reads,
                "missing": missing,
                "failed": sum(status != 0 for status in ends),
                "mixed": len(sets) != 1,
                "left": len(left(folder)),
            },
            sys.stdout,
        )


if __name__ == "__main__":
    main()
