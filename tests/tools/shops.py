"""A shop of small programs, pools for it, and runs of it that take no time."""

import json
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from parser.findings.catalogue import Language
from parser.program import load_program
from sim.base.workers.rounds import Pool
from sim.jobs.batch import TAKEN, Batch, Done, Task, run_batch
from sim.jobs.index import Row
from sim.jobs.shop import find_programs
from sim.setup.scenario import load_scenario

TINY = "B{0}B0B{0}GXL1\nB0B{0}B{0}GYL2\nB{0}B0B{0}GXL3\nB0B{0}B{0}GYL4\nDD\n"
"""A square of so many µm, which takes half a second to run with its files."""


class Here:
    """A pool that is this process."""

    died: tuple[type[BaseException], ...] = ()

    def ahead(self) -> int:
        return 1

    @contextmanager
    def open(self, *, alone: bool = False) -> Iterator[ThreadPoolExecutor]:
        with ThreadPoolExecutor(1) as executor:
            yield executor


def make_shop(folder: Path, count: int) -> Path:
    """A folder of programs that differ."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(count):
        (folder / f"{number:02}.3b").write_text(TINY.format(40 + number), "ascii")
    return folder


def nothing(done: int, total: int) -> None:
    """Takes no notice of progress."""


def run_folder(
    shop: Path,
    out: Path,
    pool: Pool | None = None,
    scenario_of: Any = load_scenario,
    progress: Callable[[int, int], None] = nothing,
    *,
    language: Language = "en",
) -> Batch:
    """All programs of a folder, run into another one."""
    programs = find_programs([str(shop)], scenario_of, out, TAKEN)
    return run_batch(programs, out, pool or Here(), progress, language)


def instead_of_running(task: Task, folder: Path) -> Done:
    """What a run gives, without one: a file that holds the program, and figures that follow from it."""
    load_program(task.data, task.name)
    if b"ZERO" in task.data:
        raise ZeroDivisionError("boom")
    row = Row("pass", task.scenario.titles, time_s=float(len(task.data)), max_um=1.0, picture="M1,1l2,0")
    return Done(row, {"report.json": task.data + b"".join(task.drawings), "report.html": b"page"})


def rows(out: Path) -> dict[str, dict[str, Any]]:
    """The programs of an index by the names of their files."""
    index = json.loads((out / "index.json").read_bytes())
    return {Path(one["file"]).name: one for one in index["programs"]}
