"""All programs of a shop, run one beside the other; what has not changed since the last run is taken from it."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.files.reading import read_bytes
from parser.findings.catalogue import Language, Said
from parser.findings.errors import DrawingError, FileUnreadableError, SettingsError
from parser.findings.messages import in_both
from parser.text.encoding import printable
from sim.base.files import staged
from sim.base.workers.makers import made_by
from sim.base.workers.pool import Pool
from sim.base.workers.rounds import DIED, Lost, results
from sim.jobs.index import Entry, Row, build_index, index_text
from sim.jobs.kept import NAME, digest_of, drop, keep, kept
from sim.jobs.one import Done, Task, fault_of, run_task
from sim.jobs.run_into import NAMES
from sim.jobs.shop import ShopProgram
from sim.jobs.source import source_of
from sim.show.index_page import Beside, index_page

INDEX: Final = ("index.html", "index.json")
TAKEN: Final = frozenset({*NAMES, NAME, *INDEX})
"""Names of files in OUT and in its folders, which no folder of a program may have."""


class Batch(NamedTuple):
    """What came of a shop: its index as data, and tracebacks of faults of drycut by the files that they happened at."""

    document: dict[str, Any]
    faults: dict[str, str]


def run_batch(
    programs: Sequence[ShopProgram],
    out: Path,
    pool: Pool,
    progress: Callable[[int, int], None],
    language: Language = "en",
) -> Batch:
    """Run the programs of a shop into their folders in `out`, and write the index of all of them there.

    Each program's files are put into its folder as soon as they are made: where this ends half-way, the next call takes
    them from there. Their pictures are in a language, the pages in both. `progress` is told how many of how many are
    done. FileUnreadableError where `out` cannot be written; ClusterError where workers fail as a whole.
    """
    if out.exists() and not out.is_dir():
        raise FileUnreadableError("is-a-file-not-a-folder", path=out)
    work = _Work(programs, out, progress, language)
    for number, done in results(run_task, work.tasks(), pool):
        work.take(number, done)
    entries = [work.entries[number] for number in range(len(programs))]
    index = build_index(entries)
    beside = [Beside(entry.row.picture, entry.row.message) for entry in entries]
    with staged(out, INDEX) as stage:
        (stage / "index.json").write_text(index_text(index), "utf-8")
        (stage / "index.html").write_text(index_page(index, beside), "utf-8")
    return Batch(index, work.faults)


class _Work:
    """Makes the tasks of a shop and takes what comes of them; `entries` and `faults` hold it."""

    def __init__(
        self, programs: Sequence[ShopProgram], out: Path, progress: Callable[[int, int], None], language: Language
    ) -> None:
        self._programs, self._out, self._progress, self._language = programs, out, progress, language
        self._digests: dict[int, str] = {}
        self.entries: dict[int, Entry] = {}
        self.faults: dict[str, str] = {}

    def tasks(self) -> Iterator[tuple[int, Task]]:
        """The tasks of those that have to be run, with their numbers; of the others the entry is there then."""
        for number, program in enumerate(self._programs):
            try:
                task = _task(program, self._language)
            except (FileUnreadableError, DrawingError, SettingsError) as error:
                self._refuse(number, error.in_both())
                continue
            if task is None:
                self._refuse(number, in_both(program.error))
                continue
            digest = digest_of(task.data, task.scenario, task.drawing, task.made_by, task.language)
            row = kept(self._out / program.folder, digest)
            if row is None:
                self._digests[number] = digest
                yield number, task
            else:
                self._enter(number, row, from_cache=True)

    def take(self, number: int, done: Done | Lost) -> None:
        """Keep what came of a task: its files, or why there are none."""
        program = self._programs[number]
        if isinstance(done, Lost):
            done = fault_of(_title(program), DIED)
        if done.fault:
            self.faults[program.file] = done.fault
        folder = self._out / program.folder
        if done.files:
            keep(folder, self._digests.pop(number), done.row, done.files, TAKEN - set(INDEX))
        else:
            drop(folder, TAKEN - set(INDEX))
        self._enter(number, done.row)

    def _refuse(self, number: int, message: Said) -> None:
        self.take(number, Done(Row("refused", _title(self._programs[number]), message), {}))

    def _enter(self, number: int, row: Row, *, from_cache: bool = False) -> None:
        program = self._programs[number]
        folder = None if row.time_s is None else program.folder
        self.entries[number] = Entry(program.file, folder, row, from_cache)
        self._progress(len(self.entries), len(self._programs))


def _task(program: ShopProgram, language: Language) -> Task | None:
    """The task of a program; None where its scenario cannot be read.

    FileUnreadableError for its file or drawing; DrawingError and SettingsError where it cannot be made of that.
    """
    scenario = program.scenario
    if scenario is None:
        return None
    source = source_of(scenario)
    drawing = read_bytes(scenario.drawing.file) if scenario.drawing is not None else None
    return Task(printable(scenario.program.name), source.data, scenario, drawing, made_by(), language, source.is_made)


def _title(program: ShopProgram) -> str:
    return program.scenario.title if program.scenario is not None else printable(Path(program.file).name)
