"""``--fix`` and ``--diff``: what is certain, mended in all files of a run, or shown."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import click

from parser.findings.catalogue import Language
from parser.findings.errors import FileUnreadableError, ProgramError
from parser.text.encoding import printable
from sim.check.batch import Job
from sim.cli.check.fixing import Mended, fix_file, left, mended
from sim.cli.scenario_options import describe
from sim.files import staged

_Put = Callable[[Mended], object]


def fix_files(jobs: Sequence[Job], language: Language) -> bool:
    """Mend the files; what was changed, and what was not, goes to stderr. Whether all could be written."""
    all_written = True
    for job in jobs:
        if not (isinstance(job.source, Path) and job.source.is_file()):
            continue
        try:
            mend = fix_file(job.source, job.name, job.settings)
        except FileUnreadableError as error:
            click.echo(f"Error: {error}", err=True)
            all_written = False
        else:
            if mend:
                click.echo(mend.diff + left(mend, language), err=True, nl=False)
    return all_written


def show_diffs(jobs: Sequence[Job], file: Path | None, language: Language) -> int:
    """Show what `fix_files` would change, on stdout or in a file, and on stderr what it would not; nothing is mended.

    The exit code: 2 where a file cannot be read, else 1 where one would be changed.
    """
    with _taking(file) as put:
        return max((_show(job, put, language) for job in jobs), default=0)


def _show(job: Job, put: _Put, language: Language) -> int:
    assert isinstance(job.source, Path)  # noqa: S101 - the command refuses the standard input
    try:
        mend = mended(job.source, job.name, job.settings)
    except ProgramError as error:
        click.echo(describe(printable(job.name), error), err=True)
        return 2
    except OSError as error:
        click.echo(f"{printable(job.name)}: cannot be read: {error.strerror or error}", err=True)
        return 2
    if mend.changed:
        put(mend)
    click.echo(left(mend, language), err=True, nl=False)
    return int(mend.changed)


@contextmanager
def _taking(file: Path | None) -> Iterator[_Put]:
    """Where the diffs go: into the file or into what reads stdout byte for byte, onto a terminal for people."""
    if file:
        with staged(file.parent, [file.name]) as folder, (folder / file.name).open("wb") as made:
            yield lambda mend: made.write(mend.patch)
    elif sys.stdout.isatty():
        yield lambda mend: click.echo(mend.diff, nl=False)
    else:
        yield lambda mend: click.echo(mend.patch, nl=False)
