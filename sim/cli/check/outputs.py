"""Where the results of one check go, and what it does with findings that a baseline knows.

Where the results of one check go: to stdout in a format, and into files, each in a format of its own.

Each file is whole or not there. In one folder all take their places together, or none does.

What a check does with known findings: it tells which no longer occur, or writes the baseline.
"""

import os
import pickle
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, NamedTuple

import click

from parser.findings.catalogue import Language
from parser.findings.errors import Message
from parser.text.encoding import printable
from sim.check.file_check import Job
from sim.check.result import CheckResult
from sim.check.silence import Baseline, baseline_text, known_of, without_known
from sim.show.findings import FORMATS, render
from sim.show.terminal import printer
from sim.show.terminal.printer import coloured, printed_text
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
from sim.show.texts import Words

if TYPE_CHECKING:
    from sim.show.findings.wording import Options


Files = Mapping[Path, IO[str]]
"""Files that are being written, by the paths at which they will stand."""


class Output(NamedTuple):
    """A format of `FORMATS`, and the file that it goes into; stdout where that is None."""

    form: str
    file: Path | None = None


def outputs_of(chosen: Sequence[Output], file: Path | None, baseline: Path | None = None) -> tuple[Output, ...]:
    """The outputs of ``--format`` and ``--output-file``, that of stdout first; text where no format was asked for.

    Raises UsageError where two go to one place, also where that is the `baseline` that is to be written, or where
    `file` has no format to hold.
    """
    chosen = chosen or (Output("text"),)
    plain = [output._replace(file=file) for output in chosen if output.file is None]
    if len(plain) > 1:
        forms = " and ".join(output.form for output in plain)
        raise click.UsageError(Message("formats-in-one-place", formats=forms, form=plain[1].form))
    if file and not plain:
        raise click.UsageError(Message("output-file-for-nothing"))
    outputs = (*plain, *(output for output in chosen if output.file))
    seen = {_identity(baseline)} if baseline else set()
    for path in (output.file for output in outputs if output.file):
        if _identity(path) in seen:
            raise click.UsageError(Message("two-outputs-in-one-file", path=path))
        seen.add(_identity(path))
    return outputs


def refuse_inputs(files: Iterable[Path], jobs: Iterable["Job"], others: Iterable[Path]) -> None:
    """UsageError where a file that is to be written is one of the programs to check, or another file that is read."""
    written = {_identity(file): file for file in files}
    if not written:
        return
    for path in others:
        if file := written.get(_identity(path)):
            raise click.UsageError(Message("output-is-an-input", file=file))
    for source in (job.source for job in jobs):
        if isinstance(source, Path) and (file := written.get(_identity(source))):
            raise click.UsageError(Message("output-is-a-program", file=file))


def write(results: Iterable["CheckResult"], outputs: Sequence[Output], options: "Options") -> None:
    """Write the results in every format, each file whole or not at all.

    The first output takes the results as the checks give them. Where there are others, each result is laid aside in a
    file without a name, from which they read one after the other: no more than one result is held at a time. Where the
    reader of stdout goes away, the files are finished still. FileUnreadableError where a file cannot be written.
    """
    first, *others = outputs
    with _opened([output.file for output in outputs if output.file]) as files:
        if not others:
            _write_one(first, results, files, options)
            return
        with tempfile.TemporaryFile(prefix="drycut-") as temporary_file:
            coming = _keeping(results, temporary_file)
            _write_one(first, coming, files, options)
            for output in others:
                _write_one(output, _laid_aside(temporary_file), files, options)


def _write_one(output: Output, results: Iterable["CheckResult"], files: Files, options: "Options") -> None:
    form = FORMATS[output.form].form
    if output.file:
        files[output.file].writelines(printed_text(text, form) for text in render(output.form, results, options))
        return
    stream = outlet()
    style = options._replace(colour=coloured(stream), width=width_of(stream))
    for text in render(output.form, results, style):
        printer.write(text, form)


@contextmanager
def _opened(paths: Sequence[Path]) -> Iterator[Files]:
    """The files, empty and open in UTF-8 with line feeds on every system; they take their places at the end."""
    from sim.base.files import staged

    with ExitStack() as stack:
        opened: dict[Path, IO[str]] = {}
        for folder in dict.fromkeys(path.parent for path in paths):
            names = [path.name for path in paths if path.parent == folder]
            stage = stack.enter_context(staged(folder, names))
            for name in names:
                opened[folder / name] = stack.enter_context((stage / name).open("w", encoding="utf-8", newline="\n"))
        yield opened


def _keeping(results: Iterable["CheckResult"], file: IO[bytes]) -> Iterator["CheckResult"]:
    for result in results:
        pickle.dump(result, file, pickle.HIGHEST_PROTOCOL)
        yield result


def _laid_aside(file: IO[bytes]) -> Iterator["CheckResult"]:
    """The results that were laid aside, from the first on."""
    end = file.seek(0, os.SEEK_END)
    file.seek(0)
    while file.tell() < end:
        yield pickle.load(file)  # noqa: S301 - written above, and no one else can open it


def _identity(path: Path) -> object:
    """The same for all names of a file, whether it is there yet or not."""
    try:
        found = path.stat()
    except OSError:
        return os.path.normcase(os.path.realpath(path))
    return found.st_dev, found.st_ino


class Ledger(ABC):
    """Keeps account of known findings while the results of a check pass by."""

    @abstractmethod
    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results of the jobs, as they are to be shown."""

    @abstractmethod
    def closed(self, language: Language) -> str:
        """What there is to say at the end, for people; FileUnreadableError where something cannot be written."""


class AgainstBaseline(Ledger):
    """Results held against a baseline: what is known and does not occur any more is counted."""

    def __init__(self) -> None:
        self._stale = 0

    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results as they are. What a check could not look for may occur still."""
        for job, result in zip(jobs, results, strict=True):
            if result.coverage.is_complete:
                self._stale += len(job.known) - result.silenced.baseline
            yield result

    def closed(self, language: Language) -> str:
        """How many known findings are to go."""
        return Words(language)("findings.stale", n=self._stale) + "\n" if self._stale else ""


class Written(Ledger):
    """A baseline of all findings that there are: they are known from then on."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._baseline = Baseline(_placed(path))
        self._known: dict[str, Mapping[str, str]] = {}

    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results without their findings, as the next check will show them."""
        for job, result in zip(jobs, results, strict=True):
            known = known_of(result)
            self._known[self._baseline.key(_placed(Path(job.name)))] = known
            yield without_known(result, frozenset(known))

    def closed(self, language: Language) -> str:
        """Write the baseline, whole or not at all; what was written."""
        from sim.base.files import staged

        path = self._baseline.path
        with staged(path.parent, (path.name,)) as folder:
            (folder / path.name).write_text(baseline_text(self._known), "ascii", newline="\n")
        n = sum(map(len, self._known.values()))
        return Words(language)("findings.baseline-written", path=printable(str(self._path)), n=n) + "\n"


def _placed(path: Path) -> Path:
    """A path without links but for its last part."""
    return path.parent.resolve() / path.name
