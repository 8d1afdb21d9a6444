"""``drycut check``."""

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from sim.cli.check.options import check_options
from sim.cli.scenario_options import chosen

if TYPE_CHECKING:
    from parser.findings.catalogue import Language
    from sim.check.batch import Job
    from sim.check.result import CheckResult


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE|DIR|GLOB|-...")
@check_options
def check(  # noqa: PLR0913 - click hands over each option by its name
    *,
    files: tuple[str, ...],
    form: str,
    lang: str | None,
    statistics: bool,
    quiet: bool,
    fix: bool,
    **asked: Any,
) -> None:
    """Find all that is wrong with 3B programs, before a wire is threaded.

    Reads files, all .3b and .4b files of folders, globs, and - for the standard input. Settings stand in drycut.toml,
    or in [tool.drycut] of pyproject.toml, in the folder of the file or above it; options come first.

    Exit code: 0 nothing as severe as --fail-on, 1 a finding that is, or a check that could not look at everything,
    2 bad use or unreadable input.

    \b
    drycut check part.3b
    drycut check programs/ --format sarif > drycut.sarif
    drycut check part.3b --fix
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    language = chosen(lang)
    from sim.cli.check.jobs import Asked, jobs_of

    jobs = jobs_of(files, Asked(**asked))
    outcome = _Outcome()
    if fix and not _fix(jobs, language):
        outcome.code = 2
    from sim.show.findings import render
    from sim.show.findings.options import Options
    from sim.show.terminal.wrap import width_of

    colour = form == "text" and sys.stdout.isatty() and "NO_COLOR" not in os.environ
    style = Options(language, colour, quiet, statistics, width_of(sys.stdout))
    for text in render(form, outcome.watched(_results(jobs)), style):
        click.echo(text, nl=False)
    raise click.exceptions.Exit(outcome.code)


def _fix(jobs: Sequence["Job"], language: "Language") -> bool:
    """Mend the files of the jobs; what was changed, and what was not, goes to stderr. Whether all could be written."""
    from parser.findings.errors import FileUnreadableError
    from sim.cli.check.fixing import fix_file, told

    all_written = True
    for job in jobs:
        if isinstance(job.source, bytes):
            raise click.UsageError("--fix mends files; it cannot mend the standard input")
        if not job.source.is_file():
            continue
        try:
            click.echo(told(fix_file(job.source, job.name, job.settings), job.name, language), err=True, nl=False)
        except FileUnreadableError as error:
            click.echo(f"Error: {error}", err=True)
            all_written = False
    return all_written


def _results(jobs: Sequence["Job"]) -> Iterator["CheckResult"]:
    from sim.check.batch import PARALLEL_FROM, check_file, check_files

    if len(jobs) < PARALLEL_FROM:
        yield from map(check_file, jobs)
        return
    from sim.cli.progress import StageProgress

    with StageProgress() as progress:
        yield from check_files(jobs, lambda done, total: progress("check", done, total))


class _Outcome:
    """Exit code of the results that pass by."""

    def __init__(self) -> None:
        self.code = 0

    def watched(self, results: Iterable["CheckResult"]) -> Iterator["CheckResult"]:
        """The results; `code` grows with them."""
        for result in results:
            if result.unreadable:
                self.code = 2
            elif result.failed:
                self.code = max(self.code, 1)
            yield result
