"""The benchmark: ``make bench``. It writes its own paths; figures are CPU time, ratios are taken in turns.

The path has 100,000 blocks of 0.1 mm, two lines to one arc, in all directions: 10 m and about 12.7 million steps.
Beside it stand a plain loop, other planners, shapely, and two peers where they are installed (`bench_peers.py`).
"""

import argparse
import resource
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path

from bench_check import check_lines
from bench_compare import compare_lines
from bench_goals import goal_lines
from bench_growth import growth_lines
from bench_motion import motion_lines
from bench_offset import offset_lines
from bench_path import write_path
from bench_table import add_options, table_lines

_MOST_COMPARED = 10_000


def _peak_line() -> list[str]:
    peak_kib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return [f"peak memory         {peak_kib / 1024:.0f} MiB"]


def parts(given: argparse.Namespace, folder: Path) -> dict[str, Callable[[], Iterable[str]]]:
    """What is measured, by the names of the command line: each gives lines to print."""
    n, path = given.blocks, folder / "path.3b"
    made = write_path(path, n)
    return {
        "path": lambda: [*motion_lines(path, made), *_peak_line()],
        "offset": lambda: offset_lines(min(n, _MOST_COMPARED)),
        "check": lambda: check_lines(path, n),
        "table": lambda: table_lines(given.length),
        "compare": lambda: compare_lines(min(n, _MOST_COMPARED)),
        "goals": lambda: goal_lines(folder, n, given.rounds),
        "growth": growth_lines,
    }


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    names = "path, offset, check, table, compare, goals, growth"
    options.add_argument("parts", nargs="*", metavar="PART", help=f"what to measure, all of it by default: {names}")
    options.add_argument("--blocks", type=int, default=100_000)
    options.add_argument("--rounds", type=int, default=5, help="of which each goal takes the least")
    add_options(options)
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        known = parts(given, Path(folder))
        for name in given.parts or known:
            if name not in known:
                options.error(f"there is no part {name}: {names}")
            for line in known[name]():
                print(line, flush=True)


if __name__ == "__main__":
    main()
