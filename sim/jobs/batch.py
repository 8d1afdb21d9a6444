"""All programs of a shop, run one beside the other by workers; what has not changed is taken from the last run.

One program of a shop, as a worker runs it: bytes come in and bytes go out, for the worker may be another machine.

The files of a program's last run, kept in its folder with what they were made of; they serve as long as all fit.

``kept.json`` is one file of the set that stands in the folder: it has a digest of all that went into the run, digests
of the other files, and the row of the index. Each is held against what is there: a file that is missing or was changed,
or another program, setting, drawing or version, and the program is run anew.
"""

import hashlib
import json
import threading
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.files import read_bytes
from parser.findings.catalogue import Bilingual, Language
from parser.findings.codes import Severity
from parser.findings.errors import DrawingError, DrycutError, FileUnreadableError, ProgramError, SettingsError, in_both
from parser.findings.findings import Count, counted
from parser.program import load_program, moving
from parser.text.encoding import printable
from sim.base.files import scratch, staged
from sim.base.units import rounded
from sim.base.workers.maker import Maker, made_by, refuse_other_makers
from sim.base.workers.rounds import DIED, Lost, Pool, results
from sim.jobs.index import Entry, Row, build_index, index_text
from sim.jobs.run_into import FILES, NAMES, PANEL, run_into
from sim.jobs.shop import ShopProgram, source_of
from sim.run.dryrun import DryRun
from sim.run.findings import to_check, verdict
from sim.setup.scenario import Scenario
from sim.show.index_page import BesideTheIndex, index_page
from sim.show.index_page.model import IndexDocument
from sim.show.index_page.page import thumbnail
from sim.show.texts.phrases import same

_BY_ITSELF: Final = threading.Lock()  # workers of a cluster may have several threads, and pygame knows one


class Task(NamedTuple):
    """A program to run.

    Attributes
    ----------
    name, data
        Name of its file, as shown, and its bytes.
    scenario
        What it is run with.
    drawings
        Bytes of the scenario's drawings, that of the top last; empty without one.
    made_by
        What its bytes must come from: `made_by` of who asks for them.
    language
        Of its picture; its pages are in both.
    is_made
        Whether its bytes were made of the drawing, so that they belong to its files.
    """

    name: str
    data: bytes
    scenario: Scenario
    drawings: tuple[bytes, ...]
    made_by: Maker
    language: Language
    is_made: bool = False


class Done(NamedTuple):
    """What came of it: its row of the index, its files by their names, and the traceback of a fault of drycut."""

    row: Row
    files: Mapping[str, bytes]
    fault: str = ""


def run_task(task: Task) -> Done:
    """Run a program. Whatever is wrong with it is told in its row.

    ClusterError where this worker would make other bytes than the one who asks.
    """
    refuse_other_makers(task.made_by)
    try:
        with _BY_ITSELF, scratch() as folder:
            return _run(task, folder)
    except ProgramError as error:
        row = Row("refused", task.scenario.titles, error.in_both(), counted((*error.others, error.finding)))
        return Done(row, {})
    except DrycutError as error:
        return Done(Row("refused", task.scenario.titles, error.in_both()), {})
    except Exception:
        return fault_of(task.scenario.titles, traceback.format_exc())


def fault_of(title: Bilingual, told_text: str) -> Done:
    """A program at which drycut itself failed; the last line of what is told stands in its row."""
    return Done(Row("fault", title, same(told_text.strip().splitlines()[-1])), {}, told_text)


def _run(task: Task, folder: Path) -> Done:
    """Run a program into a folder, and take its files from there."""
    made = folder / "made"
    scenario = _with_drawings(task, folder)
    try:
        program = moving(load_program(task.data, task.name, scenario.choices))
        run = run_into(made, program, scenario, language=task.language)
    except DrawingError as error:  # people know a drawing by where it stands
        places = dict(zip(map(str, _drawings_of(scenario)), map(str, _drawings_of(task.scenario)), strict=True))
        raise DrawingError(error.message.with_values(lambda value: places.get(str(value), value))) from None
    extra = {task.scenario.program.name: task.data} if task.is_made else {}
    return Done(
        _row(run), {**{name: (made / name).read_bytes() for name in (*FILES, PANEL) if (made / name).exists()}, **extra}
    )


def _with_drawings(task: Task, folder: Path) -> Scenario:
    """The scenario with its drawings in a folder, each under its own name."""
    here = [folder / f"drawing-{at}" / file.name for at, file in enumerate(_drawings_of(task.scenario))]
    for path, data in zip(here, task.drawings, strict=True):
        path.parent.mkdir()
        path.write_bytes(data)
    return _drawn_in(task.scenario, here)


def _drawings_of(scenario: Scenario) -> list[Path]:
    """Files of the drawings that a scenario is held against, that of the top last."""
    target = scenario.drawing
    return [] if target is None else [file for file in (target.file, target.upper) if file is not None]


def _drawn_in(scenario: Scenario, files: Sequence[Path]) -> Scenario:
    """The scenario with its drawings in other files, as `_drawings_of` has them."""
    target = scenario.drawing
    if target is None:
        return scenario
    return replace(scenario, drawing=target._replace(file=files[0], upper=files[1] if len(files) > 1 else None))


def _row(run: DryRun) -> Row:
    """The row of a run, its figures those of ``report.json``."""
    return Row(
        verdict(run.findings),
        run.scenario.titles,
        findings=counted(run.findings),
        time_s=rounded(run.ran_s),
        time_within_s=run.time_s and (rounded(run.time_s.least), rounded(run.time_s.most)),
        max_um=rounded(run.deviations.wire.max_um),
        to_check=to_check(run.findings),
        drawing_um=None if run.comparison is None else rounded(run.comparison.max_um),
        picture=thumbnail(run.toolpath),
    )


NAME: Final = "kept.json"
_SCHEMA: Final = "drycut.kept/1"


def digest_of(program: bytes, scenario: Scenario, drawings: Sequence[bytes], made_by: Maker, language: Language) -> str:
    """Digest of all that the files of a run follow from: nothing of it is a path, so a shop may be moved."""
    named = _drawn_in(scenario, [Path(file.name) for file in _drawings_of(scenario)])
    settings = replace(named, program=Path(scenario.program.name))
    settings_text = repr((made_by, language, settings)).encode("utf-8", "surrogatepass")
    parts = (settings_text, program, *drawings)
    return _sum(b"".join(_sum(part).encode() for part in parts))


def keep(folder: Path, digest: str, row: Row, files: Mapping[str, bytes], names: frozenset[str]) -> None:
    """Put the files of a run into its folder with what they were made of, all of them or none.

    A file of `names` that the run did not make goes. FileUnreadableError where the folder cannot be written.
    """
    record = {"schema": _SCHEMA, "made_of": digest, "files": {name: _sum(files[name]) for name in sorted(files)}}
    with staged(folder, sorted({*names, *files, NAME})) as stage:
        for name, data in files.items():
            (stage / name).write_bytes(data)
        (stage / NAME).write_text(json.dumps(_sealed({**record, "row": row._asdict()})), "utf-8")


def row_of_last_run(folder: Path, digest: str) -> Row | None:
    """The row of the run whose files stand in a folder; None where they are not those of this digest, or not whole."""
    try:
        record = json.loads(read_bytes(folder / NAME))
        if record["made_of"] != digest or record != _sealed(record):
            return None
        if any(_sum_of(folder / name) != checksum for name, checksum in record["files"].items()):
            return None
        row = record["row"]
        findings = tuple(Count(code, Severity(severity), n) for code, severity, n in row["findings"])
        said = {name: Bilingual(*row[name]) for name in ("title", "message")}
        within = row["time_within_s"] and tuple(row["time_within_s"])
        return Row(**{**row, "findings": findings, "time_within_s": within, **said})
    except (FileUnreadableError, OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return None


def drop(folder: Path, names: frozenset[str]) -> None:
    """Take away the files of an earlier run of a program that has none now, and the folder if it is empty then."""
    if folder.is_dir():
        with staged(folder, sorted({*names, NAME})):
            pass
        with suppress(OSError):  # something else is in it
            folder.rmdir()


def _sealed(record: Mapping[str, Any]) -> dict[str, Any]:
    """The record with a digest of itself."""
    bare = {key: value for key, value in record.items() if key != "sum"}
    return {**bare, "sum": _sum(json.dumps(bare).encode())}


def _sum(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _sum_of(file: Path) -> str:
    """Digest of a file of the set, however large; OSError for what is no file, of which reading might never end."""
    if not file.is_file():
        raise FileNotFoundError(file)
    with file.open("rb") as data:
        return hashlib.file_digest(data, "sha256").hexdigest()


INDEX: Final = ("index.html", "index.json")
TAKEN: Final = frozenset({*NAMES, NAME, *INDEX})
"""Names of files in OUT and in its folders, which no folder of a program may have."""


class Batch(NamedTuple):
    """What came of a shop: its index as data, and tracebacks of faults of drycut by the files that they happened at."""

    document: IndexDocument
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
    pictures = [BesideTheIndex(entry.row.picture, entry.row.message) for entry in entries]
    with staged(out, INDEX) as stage:
        (stage / "index.json").write_text(index_text(index), "utf-8")
        (stage / "index.html").write_text(index_page(index, pictures), "utf-8")
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
            digest = digest_of(task.data, task.scenario, task.drawings, task.made_by, task.language)
            row = row_of_last_run(self._out / program.folder, digest)
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

    def _refuse(self, number: int, message: Bilingual) -> None:
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
    drawings = tuple(map(read_bytes, _drawings_of(scenario)))
    return Task(printable(scenario.program.name), source.data, scenario, drawings, made_by(), language, source.is_made)


def _title(program: ShopProgram) -> Bilingual:
    return program.scenario.titles if program.scenario is not None else same(printable(Path(program.file).name))
