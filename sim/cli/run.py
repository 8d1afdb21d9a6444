"""``drycut run``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from parser.encoding import printable
from parser.errors import ProgramError
from parser.excerpt import place, with_caret
from sim.cli.lengths import Length
from sim.cli.overrides import Overrides, overridden

if TYPE_CHECKING:
    from parser.program import Program
    from sim.dryrun import DryRun
    from sim.scenario import Scenario


@click.command()
@click.argument("path", type=click.Path(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write cut.png, report.json and trace.npz here.",
)
@click.option("--machine", metavar="NAME|FILE", help="Shipped machine, such as dk7740, or a machine file (.toml).")
@click.option("--thickness", type=Length(), help="Thickness of the work, such as 40mm.")
@click.option("--wire-diameter", type=Length(), help="Diameter of the wire, such as 0.18mm.")
@click.option("--gap", type=Length(), help="Spark gap on one side, such as 10um.")
@click.option("--wire-lag", type=Length(), help="How far the wire bows back behind its guides, such as 20um.")
@click.option(
    "--interpolator",
    type=click.Choice(["point-by-point", "card"]),
    help="How the path becomes steps: as 3B controllers do, or by a motion card at equal times.",
)
@click.option("--offset", type=Length(), help="Offset that the controller is to add, such as 0.1mm; with --side.")
@click.option(
    "--side",
    type=click.Choice(["left", "right"]),
    help="Side of the contour on which the wire runs, along the cutting direction.",
)
@click.option("--kerf", is_flag=True, help="Work out the kerf, the pieces that it leaves, and their sizes.")
@click.option(
    "--drawing",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="DXF",
    help="Hold the cut edge against a drawing.",
)
@click.option("--layer", metavar="NAME", help="Layer of the contour in the drawing.")
@click.option("--tolerance", type=Length(), help="How far edge and drawing may be apart, such as 5um.")
@click.option("--no-fit", is_flag=True, help="Take the drawing as it lies, without fitting place and turn.")
@click.option(
    "--card-log",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write every call to the card here, to be replayed by drycut card replay.",
)
@click.option("--json", "as_json", is_flag=True, help="Print report.json instead of the summary.")
def run(
    path: Path,
    output: Path | None,
    card_log: Path | None,
    as_json: bool,
    **options: Any,
) -> None:
    """Dry-run a 3B program, or a scenario folder that holds one.

    Plans and steps the program as its controller does, lets the table follow, and compares both with the ideal
    geometry.

    \b
    Exit code: 0 the verdict is pass, 1 it is not, 2 bad use or unreadable input.

    \b
    drycut run part.3b -o out/
    drycut run scenarios/keyhole --thickness 60mm
    drycut run part.3b --interpolator card --card-log part.log
    drycut run contour.3b --offset 0.1mm --side right
    drycut run part.3b --kerf --drawing part.dxf --tolerance 5um
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.program import read_program
    from sim.dryrun import verdict
    from sim.report import build_report, report_text
    from sim.summary import print_summary

    scenario = overridden(path, Overrides(**options))
    try:
        program = read_program(scenario.program)
        done = _run(program, scenario, output, card_log)
    except ProgramError as error:
        click.echo(describe(printable(str(scenario.program)), error), err=True)
        raise click.exceptions.Exit(2) from None
    if as_json:
        click.echo(report_text(build_report(done)), nl=False)
    else:
        print_summary(done, output)
    raise click.exceptions.Exit(0 if verdict(done.findings) == "pass" else 1)


def describe(name: str, error: ProgramError) -> str:
    """``part.3b:7:12: error[3B206]: …`` with the line and a caret where the place is known."""
    finding = error.finding
    text = f"{place(name, finding.line, finding.column)}: error[{finding.code}]: {error}"
    return f"{text}\n{with_caret(error.excerpt, finding.column)}" if error.excerpt and finding.column else text


def _run(program: "Program", scenario: "Scenario", output: Path | None, card_log: Path | None) -> "DryRun":
    from sim.card_log import logging_to
    from sim.dryrun import dry_run
    from sim.judge import check_expectations
    from sim.progress import StageProgress

    settings = scenario.machine.controller.card_settings
    _refuse_to_overwrite(card_log, program_file=scenario.program, output=output)
    with StageProgress() as progress, logging_to(card_log, settings) as log:
        if output is None:
            return check_expectations(dry_run(program, scenario, progress, log=log))
        from sim.outcome import run_into

        return run_into(output, program, scenario, progress, log)


def _refuse_to_overwrite(card_log: Path | None, *, program_file: Path, output: Path | None) -> None:
    """BadParameter where the log would take the place of the program or of a file of the run."""
    if card_log is None:
        return
    if not card_log.name:
        raise click.BadParameter("names no file", param_hint="--card-log")
    taken = {program_file.resolve(): "the program"}
    if output is not None:
        from sim.outcome import FILES

        taken |= {(output / name).resolve(): "a file of the run" for name in FILES}
    other = taken.get(card_log.resolve())
    if other is not None:
        raise click.BadParameter(f"{card_log} is {other}; give the log a name of its own", param_hint="--card-log")
