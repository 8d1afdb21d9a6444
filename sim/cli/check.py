"""``drycut check``."""

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.units import mm
from sim.cli.scenario_options import Length, chosen

if TYPE_CHECKING:
    from parser.findings.catalogue import Language
    from sim.check.batch import Job
    from sim.check.result import CheckResult
    from sim.check.settings import CheckSettings

STDIN = "-"


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE|DIR|GLOB|-...")
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json", "sarif", "junit", "github"]),
    default="text",
    show_default=True,
    help="How to print the findings.",
)
@click.option("--select", metavar="CODES", help="Show these codes alone: 3B2,3B301 is all 3B2xx and 3B301.")
@click.option("--ignore", metavar="CODES", help="Do not show these codes.")
@click.option("--fail-on", type=click.Choice(["warning", "error"]), help="Least severity for exit code 1 [error].")
@click.option("--lang", type=click.Choice(["en", "zh"]), help="Language; that of the locale where left out.")
@click.option("--fix", is_flag=True, help="Mend in the files what is certain, and show what was changed.")
@click.option("--stats", is_flag=True, help="Count the findings by code.")
@click.option("--quiet", is_flag=True, help="No line for files without findings.")
@click.option("--machine", metavar="NAME|FILE", help="Check the travel of this machine, such as dk7740, or a .toml.")
@click.option("--wire-diameter", type=Length(), help="Check corners for this wire, such as 0.18mm.")
@click.option("--gap", type=Length(), help="Spark gap on one side, such as 10um.")
def check(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    files: tuple[str, ...],
    form: str,
    select: str | None,
    ignore: str | None,
    fail_on: str | None,
    lang: str | None,
    fix: bool,
    stats: bool,
    quiet: bool,
    machine: str | None,
    wire_diameter: float | None,
    gap: float | None,
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
    options = _options(select, ignore, fail_on, machine, wire_diameter, gap)
    language = chosen(lang)
    from sim.check.files import find_files

    jobs = [_job(name, options) for name in find_files(files)]
    outcome = _Outcome()
    if fix and not _fix(jobs, language):
        outcome.code = 2
    from sim.show.findings import render
    from sim.show.findings.options import Options

    colour = form == "text" and sys.stdout.isatty() and "NO_COLOR" not in os.environ
    style = Options(language, colour, quiet, stats)
    for text in render(form, outcome.watched(_results(jobs)), style):
        click.echo(text, nl=False)
    raise click.exceptions.Exit(outcome.code)


def _options(  # noqa: PLR0913, PLR0917 - the options above
    select: str | None,
    ignore: str | None,
    fail_on: str | None,
    machine: str | None,
    wire_diameter: float | None,
    gap: float | None,
) -> dict[str, object]:
    """Settings that the command line gives, in place of those of the files."""
    from sim.check.settings import code_list, severity
    from sim.setup.toml.reader import number
    from sim.setup.wire import SPARK_GAP_MM, WIRE_DIAMETER_MM

    given: dict[str, object] = {}
    if select is not None:
        given["select"] = code_list(select.split(","), "--select")
    if ignore is not None:
        given["ignore"] = code_list(ignore.split(","), "--ignore")
    if fail_on is not None:
        given["fail_on"] = severity(fail_on, "--fail-on")
    if machine is not None:
        from sim.setup.machine.machine import load_machine

        given["machine"] = load_machine(machine)
    if wire_diameter is not None:
        number(mm(wire_diameter), WIRE_DIAMETER_MM, "--wire-diameter in mm")
        given["wire_diameter_um"] = wire_diameter
    if gap is not None:
        number(mm(gap), SPARK_GAP_MM, "--gap in mm")
        given["spark_gap_um"] = gap
    return given


def _job(name: str, options: dict[str, object]) -> "Job":
    from sim.check.batch import Job
    from sim.check.settings import settings_near

    path = Path() if name == STDIN else Path(name).parent
    settings: CheckSettings = replace(settings_near(path), **options)  # type: ignore[arg-type]
    _ = settings.demands  # settings that contradict each other are told before the first file
    if name == STDIN:
        return Job("<stdin>", sys.stdin.buffer.read(), settings)
    return Job(name, Path(name), settings)


def _fix(jobs: Sequence["Job"], language: "Language") -> bool:
    """Mend the files of the jobs; what was changed, and what was not, goes to stderr. Whether all could be written."""
    from parser.findings.errors import FileUnreadableError
    from sim.cli.fixing import fix_file, told

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
