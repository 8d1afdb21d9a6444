"""``--fix`` and ``--diff``: what is certain, mended in all files of a run, or shown."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from parser.findings.catalogue import Language
from parser.findings.errors import FileUnreadableError, ProgramError
from sim.check.batch import Job
from sim.cli.check.fixing import Mended, fix_file, left, mended
from sim.cli.scenario_options import describe
from sim.files import staged
from sim.show.terminal.printer import say, write, write_exactly
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
from sim.show.words import Words

_Put = Callable[[Mended], object]


def fix_files(jobs: Sequence[Job], language: Language) -> bool:
    """Mend the files; what was changed, and what was not, goes to stderr. Whether all could be written."""
    all_written = True
    for job in jobs:
        if not (isinstance(job.source, Path) and job.source.is_file()):
            continue
        try:
            mend = fix_file(job.source, job.name, job.settings, job.known)
        except FileUnreadableError as error:
            say(f"drycut: error: {error}", err=True)
            all_written = False
        else:
            if mend:
                write(mend.diff + left(mend, language, width_of(outlet(err=True))), err=True)
    return all_written


def show_diffs(jobs: Sequence[Job], file: Path | None, language: Language) -> int:
    """Show what `fix_files` would change, on stdout or in a file, and on stderr what it would not; nothing is mended.

    The exit code: 2 where a file cannot be read, else 1 where one would be changed.
    """
    with _taking(file, language) as put:
        return max((_show(job, put, language) for job in jobs), default=0)


def _show(job: Job, put: _Put, language: Language) -> int:
    assert isinstance(job.source, Path)  # noqa: S101 - the command refuses the standard input
    try:
        mend = mended(job.source, job.name, job.settings, job.known)
    except ProgramError as error:
        for line in describe(job.name, error):
            say(line, err=True)
        return 2
    except FileUnreadableError as error:
        say(f"drycut: error: {error}", err=True)
        return 2
    if mend.changed:
        put(mend)
    write(left(mend, language, width_of(outlet(err=True))), err=True)
    return int(mend.changed)


@contextmanager
def _taking(file: Path | None, language: Language) -> Iterator[_Put]:
    """Where the diffs go: into the file or into what reads stdout byte for byte, onto a terminal for people."""
    if file:
        with staged(file.parent, [file.name]) as folder, (folder / file.name).open("wb") as made:
            yield lambda mend: made.write(mend.patch)
    elif outlet().isatty():
        yield lambda mend: write(mend.diff)
    else:
        yield lambda mend: _print_patch(mend, language)


def _print_patch(mend: Mended, language: Language) -> None:
    """Print a patch byte for byte, unless that is what a log must not hold: what reads stdout may be a log."""
    if not write_exactly(mend.patch, f"{mend.program.name}\n{mend.program.text}\n{mend.text}"):
        write(mend.diff)
        say(Words(language)("findings.not-exact", name=mend.program.name), err=True)
