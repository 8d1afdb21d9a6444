"""``drycut check``."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.cli.check.options import check_options
from sim.cli.scenario_options import chosen

if TYPE_CHECKING:
    from parser.findings.catalogue import Language
    from sim.check.batch import Job
    from sim.check.result import CheckResult
    from sim.cli.check.baselines import Ledger
    from sim.cli.check.jobs import Asked
    from sim.cli.check.outputs import Output
    from sim.show.findings.options import Options

_OF_FILES = {
    "--fix": "mends files; it cannot mend the standard input",
    "--diff": "shows mends of files; the standard input has none",
    "--watch": "looks at files; the standard input does not change",
}


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE|DIR|GLOB|-...")
@check_options
def check(  # noqa: PLR0913 - click hands over each option by its name
    *,
    files: tuple[str, ...],
    formats: tuple["Output", ...],
    output_file: Path | None,
    lang: str | None,
    statistics: bool,
    quiet: bool,
    fix: bool,
    exit_zero: bool,
    diff: bool,
    watch: bool,
    **asked: Any,
) -> None:
    """Find all that is wrong with 3B programs, before a wire is threaded.

    Reads files, all .3b and .4b files of folders, globs, and - for the standard input. Settings stand in drycut.toml,
    or in [tool.drycut] of pyproject.toml, in the folder of the file or above it in its project; options come first.

    Exit code: 0 nothing as severe as --fail-on, 1 a finding that is, or a check that could not look at everything,
    2 bad use or unreadable input, 3 a fault of drycut itself.

    \b
    drycut check part.3b
    drycut check programs/ --format text --format sarif=drycut.sarif
    drycut check part.3b --fix
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    language = chosen(lang)
    from sim.cli.check.jobs import Asked, jobs_of
    from sim.cli.check.outputs import outputs_of, refuse_inputs
    from sim.show.findings.options import Options

    given = {"--fix": fix, "--diff": diff, "--watch": watch}
    _refuse_contradictions(files, formats, asked, given)
    options = Asked(**asked)
    outputs = outputs_of(formats, output_file, options.write_baseline)
    style = Options(language, quiet=quiet, statistics=statistics)

    def found() -> list["Job"]:
        jobs = jobs_of(files, options)
        written = (*(output.file for output in outputs), options.write_baseline)
        refuse_inputs(filter(None, written), jobs, filter(None, (options.baseline, options.config)))
        return jobs

    if watch:
        from sim.cli.check import watching

        watching.watch(files, lambda: _check(found(), outputs, style, options), language)
    jobs = found()
    code = 0
    if diff:
        from sim.cli.check.mends import show_diffs

        raise _exit(show_diffs(jobs, output_file, language), is_zero=exit_zero)
    if fix:
        from sim.cli.check.mends import fix_files

        code = 0 if fix_files(jobs, language) else 2
    raise _exit(max(code, _check(jobs, outputs, style, options)), is_zero=exit_zero)


def _exit(code: int, *, is_zero: bool) -> click.exceptions.Exit:
    """The end of the command; where it `is_zero`, the code does not tell that something fails."""
    return click.exceptions.Exit(0 if is_zero and code == 1 else code)


def _ledger(options: "Asked") -> "Ledger":
    from sim.cli.check.baselines import Held, Written

    return Written(options.write_baseline) if options.write_baseline else Held()


def _refuse_contradictions(
    files: Sequence[str], formats: Sequence["Output"], settings: Mapping[str, Any], given: Mapping[str, bool]
) -> None:
    """UsageError for options of which one leaves no room for the other; `given` are those that mend or watch."""
    from sim.cli.check.jobs import STDIN

    asked = [option for option, is_given in given.items() if is_given]
    if len(asked) > 1:
        raise click.UsageError(f"{' and '.join(asked)} cannot be done in one run")
    if asked and STDIN in files:
        raise click.UsageError(f"{asked[0]} {_OF_FILES[asked[0]]}")
    needs = {"--format": formats, "--write-baseline": settings["write_baseline"]}
    beside = [option for option, is_given in needs.items() if is_given]
    if beside and asked == ["--diff"]:
        raise click.UsageError(f"--diff shows mends and no findings; {beside[0]} has no place beside it")
    if settings["write_baseline"] and asked == ["--watch"]:
        raise click.UsageError("--watch checks again and again; --write-baseline has no place beside it")


def _check(jobs: Sequence["Job"], outputs: Sequence["Output"], style: "Options", options: "Asked") -> int:
    """Check the files of the jobs and write what was found; the exit code."""
    from sim.cli.check.outputs import write
    from sim.show.terminal import printer

    outcome, ledger = _Outcome(), _ledger(options)
    write(outcome.watched(ledger.watched(jobs, _results(jobs))), outputs, style)
    printer.write(ledger.closed(style.language), err=True)
    return outcome.told(style.language)


def _results(jobs: Sequence["Job"]) -> Iterator["CheckResult"]:
    from sim.check.batch import PARALLEL_FROM, check_any

    if len(jobs) < PARALLEL_FROM:
        yield from map(check_any, jobs)
        return
    from sim.check.parallel import check_files
    from sim.cli.progress import StageProgress

    with StageProgress() as progress:
        yield from check_files(jobs, lambda done, total: progress("check", done, total))


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

    def told(self, language: "Language") -> int:
        """The exit code; at which files drycut itself failed is told."""
        if not self._faults:
            return self._code
        from sim.cli.faults import tell_faults

        return tell_faults(self._faults, language)
