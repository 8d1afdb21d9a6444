"""``drycut run``."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.encoding import printable
from parser.errors import ProgramError
from parser.excerpt import place, with_caret
from parser.units import mm
from sim.cli.lengths import Length
from sim.settings import number

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
@click.option("--json", "as_json", is_flag=True, help="Print report.json instead of the summary.")
def run(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path | None,
    machine: str | None,
    thickness: float | None,
    wire_diameter: float | None,
    gap: float | None,
    as_json: bool,
) -> None:
    """Dry-run a 3B program, or a scenario folder that holds one.

    Steps the program as a 3B controller does, lets the table follow, and compares both with the ideal geometry.

    \b
    Exit code: 0 the verdict is pass, 1 it is not, 2 bad use or unreadable input.

    \b
    drycut run part.3b -o out/
    drycut run scenarios/keyhole --thickness 60mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.program import read_program
    from sim.dryrun import verdict
    from sim.report import build_report, report_text
    from sim.summary import print_summary

    scenario = _overridden(path, machine, thickness, wire_diameter, gap)
    try:
        program = read_program(scenario.program)
        done = _run(program, scenario, output)
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


def _overridden(
    path: Path, machine: str | None, thickness: float | None, wire_diameter: float | None, gap: float | None
) -> "Scenario":
    """Scenario of the path with the options of the command line in place of its own values."""
    from sim import scenario as scenarios
    from sim.machine import load_machine
    from sim.wire import SPARK_GAP_MM, WIRE_DIAMETER_MM

    scenario = scenarios.load_scenario(path)
    wire = scenario.wire
    if machine is not None:
        scenario = replace(scenario, machine=load_machine(machine))
    if thickness is not None:
        scenario = replace(scenario, thickness_mm=number(mm(thickness), scenarios.THICKNESS_MM, "--thickness in mm"))
    if wire_diameter is not None:
        number(mm(wire_diameter), WIRE_DIAMETER_MM, "--wire-diameter in mm")
        wire = replace(wire, diameter_um=wire_diameter)
    if gap is not None:
        number(mm(gap), SPARK_GAP_MM, "--gap in mm")
        wire = replace(wire, spark_gap_um=gap)
    return replace(scenario, wire=wire)


def _run(program: "Program", scenario: "Scenario", output: Path | None) -> "DryRun":
    from sim.dryrun import dry_run
    from sim.judge import check_expectations
    from sim.progress import StageProgress

    with StageProgress() as progress:
        if output is None:
            return check_expectations(dry_run(program, scenario, progress))
        from sim.outcome import run_into

        return run_into(output, program, scenario, progress)
