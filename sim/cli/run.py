"""``drycut run``.

``drycut run`` of many programs: what it is given, and what is said of it.
"""

import glob
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.scenario_options import Overrides, overridden, overrides_of, refused, scenario_options, spark_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_files
from sim.cli.spread import Spread, pool_of, spread_options

if TYPE_CHECKING:
    from sim.run.dryrun import DryRun
    from sim.setup.scenario import Scenario


def is_shop(names: Sequence[str]) -> bool:
    """Whether names lead to a shop: several, a folder that is no scenario, or a glob."""
    first = Path(names[0])
    if len(names) > 1 or (first.is_dir() and not (first / "scenario.toml").exists()):
        return True
    return glob.has_magic(names[0]) and not first.exists()


def run_shop(names: Sequence[str], output: Path | None, spread: Spread, options: Overrides, *, as_json: bool) -> int:
    """Run all programs that names lead to into folders of `output`; the exit code.

    UsageError without an output, FileUnreadableError for a name that leads to no program.
    """
    if output is None:
        raise click.UsageError(Message("many-programs-need-a-folder"))
    from sim.cli.progress import StageProgress
    from sim.jobs.batch import TAKEN, run_batch
    from sim.jobs.index import index_text
    from sim.jobs.shop import find_programs
    from sim.show.terminal.batch import print_batch
    from sim.show.terminal.printer import write

    if options.machine is not None:
        from sim.setup.machine.machine import load_machine

        load_machine(options.machine)  # bad use, which each program would tell again
    programs = find_programs(names, lambda path: overridden(path, options), output, TAKEN)
    with StageProgress() as progress, pool_of(spread) as pool:
        done = run_batch(programs, output, pool, lambda n, total: progress("programs", n, total), spoken())
    if as_json:
        write(index_text(done.document), "json")
    else:
        print_batch(done.document, output, spoken())
    if done.faults:
        from sim.cli.faults import tell_faults

        return tell_faults(done.faults, spoken())
    counts = done.document["counts"]
    return 0 if counts["pass"] == counts["programs"] else 1


@click.command(cls=Spoken)
@click.argument("names", nargs=-1, required=True, metavar="PROGRAM|SCENARIO|FOLDER|GLOB...", shell_complete=offer_files)
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path),
    metavar="DIR",
)
@spread_options
@scenario_options
@spark_options
@click.option(
    "--card-log",
    type=FilePath(path_type=Path, dir_okay=False),
    metavar="FILE",
)
@click.option("--trace", is_flag=True)
@click.option("--json", "as_json", is_flag=True)
def run(  # noqa: PLR0913 - click hands over each option by its name
    *,
    names: tuple[str, ...],
    output: Path | None,
    card_log: Path | None,
    trace: bool,
    as_json: bool,
    jobs: int | None,
    scheduler: str | None,
    **options: Any,
) -> None:
    """Dry-run a 3B or ISO program, or a scenario folder that holds one; or all of them in folders and globs.

    \b
    drycut run part.3b -o out/
    drycut run scenarios/keyhole --thickness 60mm
    drycut run part.3b --interpolator card --card-log part.log
    drycut run contour.3b --offset 0.1mm --side right
    drycut run contour.3b --offset 0.18mm,0.12mm,0.1mm --side right
    drycut run die.iso --dialect robofil --offset D0=0.11mm
    drycut run part.3b --kerf --drawing part.dxf --tolerance 5um
    drycut run part.3b --sparks --seed 7
    drycut run programs/ 'jigs/*.4b' -o out/ --jobs 4
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    overrides, spread, files = overrides_of(options), Spread(jobs, scheduler), _Files(output, card_log, trace)
    if is_shop(names):
        _refuse_for_many(files)
        code = run_shop(names, output, spread, overrides, as_json=as_json)
    else:
        _refuse_for_one(files, spread)
        code = _run_one(overridden(Path(names[0]), overrides), files, as_json=as_json)
    raise click.exceptions.Exit(code)


class _Files(NamedTuple):
    """What a run is to write: its files into a folder, its calls into a log, and whether it writes its trace."""

    output: Path | None
    card_log: Path | None
    trace: bool


def _refuse_for_many(files: _Files) -> None:
    """UsageError for what only one program can have."""
    if files.card_log is not None:
        raise click.UsageError(Message("card-log-of-one-program"))
    if files.trace:
        raise click.UsageError(Message("trace-of-one-program"))


def _refuse_for_one(files: _Files, spread: Spread) -> None:
    """UsageError for what only many programs can have, and for a trace that has no folder."""
    if spread != Spread(None, None):
        raise click.UsageError(Message("workers-for-one-program"))
    if files.trace and files.output is None:
        raise click.UsageError(Message("trace-needs-a-folder"))


def _run_one(scenario: "Scenario", files: _Files, *, as_json: bool) -> int:
    """Run one program and print what came of it; the exit code."""
    from sim.run.findings import verdict
    from sim.run.report import build_report, report_text
    from sim.show.terminal.printer import say, write
    from sim.show.terminal.run import print_summary

    try:
        done = _run(scenario, files)
    except ProgramError as error:
        raise refused(scenario, error) from None
    if as_json:
        write(report_text(build_report(done)), "json")
    else:
        print_summary(done, files.output, spoken())
        if files.output is not None:
            from sim.jobs.run_into import files_of
            from sim.jobs.trace_file import TRACE

            made = [done.program.name] if scenario.to_make is not None and not scenario.program.exists() else []
            names = ", ".join([*files_of(done), *([TRACE] if files.trace else []), *made])
            say(words()("commands.written", names=f"{files.output}/ {names}"))
    return 0 if verdict(done.findings) == "pass" else 1


def _run(scenario: "Scenario", files: _Files) -> "DryRun":
    from parser.program import moving
    from sim.cli.progress import StageProgress
    from sim.jobs.shop import program_read, source_of
    from sim.run.recording import check_expectations, logging_to, stages_of
    from sim.run.running import dry_run

    settings = scenario.machine.controller.card_settings
    _refuse_to_overwrite(files.card_log, program_file=scenario.program, output=files.output)
    if files.output is None:
        stages = stages_of(scenario)
    else:
        from sim.jobs.run_into import run_into, stages_of_files

        stages = stages_of_files(scenario, trace=files.trace)
    with StageProgress("read", *stages) as progress, logging_to(files.card_log, settings) as log:
        progress("read", 0, 1)
        source = source_of(scenario, progress)
        program = moving(program_read(scenario, source))
        if files.output is None:
            return check_expectations(dry_run(program, scenario, progress, log=log))
        extra = {scenario.program.name: source.data} if source.is_made else {}
        return run_into(
            files.output, program, scenario, progress, log, trace=files.trace, extra=extra, language=spoken()
        )


def _refuse_to_overwrite(card_log: Path | None, *, program_file: Path, output: Path | None) -> None:
    """BadParameter where the log would take the place of the program or of a file of the run."""
    if card_log is None:
        return
    if not card_log.name:
        raise click.BadParameter(Message("names-no-file"), param_hint="--card-log")
    taken = {program_file.resolve(): Message("the-program")}
    if output is not None:
        from sim.jobs.run_into import NAMES

        taken |= {(output / name).resolve(): Message("a-file-of-the-run") for name in NAMES}
    other = taken.get(card_log.resolve())
    if other is not None:
        raise click.BadParameter(Message("card-log-is-taken", file=card_log, other=other), param_hint="--card-log")
