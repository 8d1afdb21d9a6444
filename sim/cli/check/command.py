"""``drycut check``."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.cli.check.options import check_options
from sim.cli.scenario_options import chosen

if TYPE_CHECKING:
    from sim.check.batch import Job
    from sim.check.result import CheckResult
    from sim.cli.check.outputs import Output

_OF_FILES = {
    "--fix": "mends files; it cannot mend the standard input",
    "--diff": "shows mends of files; the standard input has none",
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
    diff: bool,
    **asked: Any,
) -> None:
    """Find all that is wrong with 3B programs, before a wire is threaded.

    Reads files, all .3b and .4b files of folders, globs, and - for the standard input. Settings stand in drycut.toml,
    or in [tool.drycut] of pyproject.toml, in the folder of the file or above it; options come first.

    Exit code: 0 nothing as severe as --fail-on, 1 a finding that is, or a check that could not look at everything,
    2 bad use or unreadable input.

    \b
    drycut check part.3b
    drycut check programs/ --format text --format sarif=drycut.sarif
    drycut check part.3b --fix
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    language = chosen(lang)
    from sim.cli.check.jobs import Asked, jobs_of
    from sim.cli.check.outputs import outputs_of, refuse_programs, write

    _refuse_contradictions(files, formats, {"--fix": fix, "--diff": diff})
    outputs = outputs_of(formats, output_file)
    jobs = jobs_of(files, Asked(**asked))
    refuse_programs((output.file for output in outputs if output.file), jobs)
    if diff:
        from sim.cli.check.mends import show_diffs

        raise click.exceptions.Exit(show_diffs(jobs, output_file, language))
    outcome = _Outcome()
    if fix:
        from sim.cli.check.mends import fix_files

        outcome.code = 0 if fix_files(jobs, language) else 2
    from sim.show.findings.options import Options

    write(outcome.watched(_results(jobs)), outputs, Options(language, quiet=quiet, statistics=statistics))
    raise click.exceptions.Exit(outcome.code)


def _refuse_contradictions(files: Sequence[str], formats: Sequence["Output"], given: Mapping[str, bool]) -> None:
    """UsageError for options of which one leaves no room for the other; `given` are those that mend or watch."""
    from sim.cli.check.jobs import STDIN

    asked = [option for option, is_given in given.items() if is_given]
    if len(asked) > 1:
        raise click.UsageError(f"{' and '.join(asked)} cannot be done in one run")
    if asked and STDIN in files:
        raise click.UsageError(f"{asked[0]} {_OF_FILES[asked[0]]}")
    if formats and asked == ["--diff"]:
        raise click.UsageError("--diff shows mends and no findings; --format has no place beside it")


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
