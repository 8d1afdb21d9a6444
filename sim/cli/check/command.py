"""``drycut check``, with its options in the groups in which its help lists them."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click

from parser.findings.errors import FileUnreadableError, Message
from sim.check.settings.read import FAIL_ON
from sim.cli.check.outputs import Output
from sim.cli.options import TAPER_OPTIONS, UNIT, OwnOrNamed, RegisterValue, setting_options, with_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_files, offer_machines
from sim.cli.spread import Spread, pool_of, spread_options
from sim.setup.part import MATERIAL, THICKNESS
from sim.setup.wire import DIAMETER, SPARK_GAP
from sim.show.findings import FORMATS

if TYPE_CHECKING:
    from parser.findings.catalogue import Language
    from sim.check.file_check import Job
    from sim.check.result import CheckResult
    from sim.cli.check.jobs import CheckOptions, Jobs
    from sim.cli.check.outputs import Ledger
    from sim.show.findings.wording import Options


Command = TypeVar("Command", bound=Callable[..., Any])


class OutputType(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """``sarif`` or ``sarif=check.sarif``: an `Output`."""

    name = "output"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Output:
        """The output; a format that there is not, or no name of a file behind ``=``, is bad use."""
        if isinstance(value, Output):
            return value
        form, into, file = value.partition("=")
        if form not in FORMATS:
            self.fail(Message("not-one-of", found=form, known=", ".join(FORMATS)), param, ctx)
        if into and not file:
            self.fail(Message("lacks-a-file-name", found=value), param, ctx)
        return Output(form, Path(file) if file else None)


_FILE = FilePath(path_type=Path, dir_okay=False)
_OUTPUT = (
    click.option(
        "--format",
        "formats",
        type=OutputType(),
        multiple=True,
        metavar="FORMAT[=FILE]",
    ),
    click.option("--output-file", "-o", type=FilePath(path_type=Path), metavar="FILE"),
    click.option("--statistics", is_flag=True),
    click.option("--quiet", is_flag=True),
)
_SELECTION = (
    click.option("--select", metavar="CODES"),
    click.option("--ignore", metavar="CODES"),
    click.option("--fail-on", type=click.Choice(FAIL_ON)),
    click.option("--exit-zero", is_flag=True),
    click.option(
        "--exclude",
        multiple=True,
        metavar="PATTERN",
    ),
    click.option(
        "--include",
        multiple=True,
        metavar="PATTERN",
    ),
    click.option("--config", type=_FILE, metavar="FILE"),
    click.option("--no-config", is_flag=True),
    click.option("--baseline", type=_FILE, metavar="FILE"),
    click.option("--write-baseline", type=_FILE, metavar="FILE"),
    click.option("--cache", type=FilePath(path_type=Path, file_okay=False), metavar="DIR"),
)
_LISTS = (
    click.option("--show-files", is_flag=True),
    click.option("--show-settings", is_flag=True),
)
_MENDS = (
    click.option("--fix", is_flag=True),
    click.option("--diff", is_flag=True),
)
_WATCH = (click.option("--watch", is_flag=True),)
_DEMANDS = (
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    *setting_options((DIAMETER, SPARK_GAP)),
    click.option("--technology", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml"),
    *setting_options((MATERIAL, THICKNESS)),
    *TAPER_OPTIONS,
    click.option("--open", "may_stay_open", is_flag=True),
)
_ISO = (
    click.option("--dialect", type=OwnOrNamed(is_any=True)),
    UNIT,
    click.option(
        "--offset",
        type=RegisterValue(),
        multiple=True,
    ),
)


check_options = with_options((*_OUTPUT, *_SELECTION, *_LISTS, *_MENDS, *_WATCH, *_DEMANDS, *_ISO))
"""Gives a command the options of ``drycut check``."""


_MODES = ("fix", "diff", "watch", "show_files", "show_settings")
"""Parameters of what is done in place of a check, or with it; one at a time."""
_OF_FILES = {
    "--fix": "mends-no-stdin",
    "--diff": "shows-no-mends-of-stdin",
    "--watch": "watches-no-stdin",
}
"""Options that go without the standard input, and what to say then."""


@click.command(cls=Spoken)
@click.argument("files", nargs=-1, required=True, metavar="FILE|DIR|GLOB|-...", shell_complete=offer_files)
@check_options
@spread_options
def check(  # noqa: PLR0913 - click hands over each option by its name
    *,
    files: tuple[str, ...],
    formats: tuple["Output", ...],
    output_file: Path | None,
    statistics: bool,
    quiet: bool,
    exit_zero: bool,
    cache: Path | None,
    jobs: int | None,
    scheduler: str | None,
    **values: Any,
) -> None:
    """Find all that is wrong with 3B and ISO programs, before a wire is threaded.

    \b
    drycut check part.3b
    drycut check programs/ --format text --format sarif=drycut.sarif
    drycut check part.3b --fix
    drycut check die.iso --dialect robofil --offset D0=0.11mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.check.own_checks import load_own_checks
    from sim.cli.check.jobs import check_options_of, filter_of
    from sim.cli.check.outputs import outputs_of
    from sim.show.findings.wording import Options

    load_own_checks()  # before any code is read, or any result of another process is written
    mode = _mode(values)
    _refuse_contradictions(files, formats, values, mode)
    options, style = check_options_of(values), Options(spoken(), quiet=quiet, statistics=statistics)
    outputs = outputs_of(formats, output_file, options.write_baseline)
    work = _Work(files, options, outputs, style, Spread(jobs, scheduler), cache)
    if mode == "--watch":
        from sim.cli.check import watching

        watching.watch(files, lambda: filter_of(options), lambda: _check(work, _jobs(work)), style.language)
    raise _exit(_done(mode, work, _jobs(work)), is_zero=exit_zero)


def _done(mode: str, work: "_Work", found: "Jobs") -> int:
    """Show, mend or check the files; the exit code."""
    language = work.style.language
    if mode in ("--show-files", "--show-settings"):
        from sim.cli.check.shown import show_files, show_settings

        return show_files(found, language) if mode == "--show-files" else show_settings(found, work.options, language)
    if mode == "--diff":
        from sim.cli.check.mends import show_diffs

        return show_diffs(found.jobs, work.outputs[0].file, language)
    code = _fix(found.jobs, language) if mode == "--fix" else 0
    return max(code, _check(work, found))


class _Work(NamedTuple):
    """What a check is asked for: names, options that settings give way to, where results go and how, who does it.

    `cache` is the folder of results that need not be worked out again; None where there is none.
    """

    names: Sequence[str]
    options: "CheckOptions"
    outputs: Sequence["Output"]
    style: "Options"
    spread: Spread
    cache: Path | None


def _exit(code: int, *, is_zero: bool) -> click.exceptions.Exit:
    """The end of the command; where it `is_zero`, the code does not tell that something fails."""
    return click.exceptions.Exit(0 if is_zero and code == 1 else code)


def _ledger(options: "CheckOptions") -> "Ledger":
    from sim.cli.check.outputs import AgainstBaseline, Written

    return Written(options.write_baseline) if options.write_baseline else AgainstBaseline()


def _mode(values: dict[str, Any]) -> str:
    """The option of what is done in place of a check, or with it, taken out of the values; empty where none is given.

    UsageError where two are given.
    """
    given = [f"--{name.replace('_', '-')}" for name in _MODES if values.pop(name)]
    if len(given) > 1:
        raise click.UsageError(Message("options-exclude-each-other", options=" and ".join(given)))
    return given[0] if given else ""


def _refuse_contradictions(
    files: Sequence[str], formats: Sequence["Output"], settings: Mapping[str, Any], mode: str
) -> None:
    """UsageError for options of which one leaves no room for the other."""
    from sim.cli.check.jobs import STDIN

    if STDIN in files and mode in _OF_FILES:
        raise click.UsageError(Message(_OF_FILES[mode], option=mode))
    needs = {"--format": formats, "--write-baseline": settings["write_baseline"]}
    dependent = [option for option, is_given in needs.items() if is_given]
    if dependent and mode == "--diff":
        raise click.UsageError(Message("diff-shows-no-findings", option=dependent[0]))
    if settings["write_baseline"] and mode == "--watch":
        raise click.UsageError(Message("watch-writes-no-baseline"))


def _jobs(work: _Work) -> "Jobs":
    """The jobs; UsageError where an output would take the place of what is read."""
    from sim.cli.check.jobs import jobs_of
    from sim.cli.check.outputs import refuse_inputs

    found, options = jobs_of(work.names, work.options), work.options
    written = (*(output.file for output in work.outputs), options.write_baseline)
    refuse_inputs(filter(None, written), found.jobs, filter(None, (options.baseline, options.config)))
    return found


def _fix(jobs: Sequence["Job"], language: "Language") -> int:
    """Mend the files of the jobs; the exit code that this asks for."""
    from sim.cli.check.mends import fix_files

    return 0 if fix_files(jobs, language) else 2


def _check(work: _Work, found: "Jobs") -> int:
    """Check the files of the jobs and write what was found; the exit code. What is passed over is told on stderr."""
    from sim.cli.check.outputs import write
    from sim.show.terminal import printer

    jobs = found.jobs
    outcome, ledger, language = _Outcome(), _ledger(work.options), work.style.language
    results = outcome.watched(ledger.watched(jobs, _results(jobs, work)))
    write(results, work.outputs, work.style._replace(help_uri=found.help_uri))
    printer.write(ledger.closed(language), err=True)
    if found.passed_over and not work.style.quiet:
        from sim.cli.check.shown import passed_over_text

        printer.say(passed_over_text(found.passed_over, language), err=True)
    return outcome.exit_code(language)


def _results(jobs: Sequence["Job"], work: _Work) -> Iterator["CheckResult"]:
    """Results of the jobs; of files that stand as they did those of the cache, where one is given."""
    if work.cache is None:
        return _checked(jobs, work.spread)
    from sim.check.own_checks import has_own_checks
    from sim.check.stored import with_stored
    from sim.show.terminal.printer import say

    if has_own_checks():
        say(words()("commands.check-cache-own-checks"), err=True)
        return _checked(jobs, work.spread)

    def refused(error: FileUnreadableError) -> None:
        say(words()("commands.check-cache-refused", why=error.message), err=True)

    return with_stored(jobs, work.cache, lambda others: _checked(others, work.spread), refused)


def _checked(jobs: Sequence["Job"], spread: Spread) -> Iterator["CheckResult"]:
    """Results of the jobs, worked out: by workers where they are many, or somebody asked for workers."""
    from sim.check.file_check import PARALLEL_FROM, check_any

    if len(jobs) < PARALLEL_FROM and spread == Spread(None, None):
        yield from map(check_any, jobs)
        return
    from sim.check.parallel import check_files
    from sim.cli.progress import StageProgress

    with StageProgress() as progress, pool_of(spread) as pool:
        yield from check_files(jobs, pool, lambda done, total: progress("check", done, total))


class _Outcome:
    """What the results that pass by come to."""

    def __init__(self) -> None:
        self._code = 0
        self._faults: dict[str, str] = {}

    def watched(self, results: Iterable["CheckResult"]) -> Iterator["CheckResult"]:
        """The results, as they are."""
        for result in results:
            if result.fault:
                self._faults[result.name] = result.fault
            elif result.unreadable:
                self._code = 2
            elif result.failed:
                self._code = max(self._code, 1)
            yield result

    def exit_code(self, language: "Language") -> int:
        """The exit code; at which files drycut itself failed is told."""
        if not self._faults:
            return self._code
        from sim.cli.faults import tell_faults

        return tell_faults(self._faults, language)
