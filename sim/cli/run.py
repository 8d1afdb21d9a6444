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
    from sim.wire import Wire


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
@click.option(
    "--card-log",
    type=click.Path(path_type=Path, dir_okay=False),
    metavar="FILE",
    help="Write every call to the card here, to be replayed by drycut card replay.",
)
@click.option("--json", "as_json", is_flag=True, help="Print report.json instead of the summary.")
def run(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path | None,
    machine: str | None,
    thickness: float | None,
    wire_diameter: float | None,
    gap: float | None,
    wire_lag: float | None,
    interpolator: str | None,
    card_log: Path | None,
    as_json: bool,
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
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.program import read_program
    from sim.dryrun import verdict
    from sim.report import build_report, report_text
    from sim.summary import print_summary

    scenario = _overridden(path, machine, thickness, (wire_diameter, gap, wire_lag))
    if interpolator is not None:
        scenario = _stepping_by(scenario, interpolator)
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


def _overridden(
    path: Path,
    machine: str | None,
    thickness: float | None,
    of_wire: tuple[float | None, float | None, float | None],
) -> "Scenario":
    """Scenario of the path with the options of the command line in place of its own values."""
    from sim import scenario as scenarios
    from sim.machine import load_machine

    scenario = scenarios.load_scenario(path)
    if machine is not None:
        scenario = replace(scenario, machine=load_machine(machine))
    thickness_mm = scenario.thickness_mm
    if thickness is not None:
        thickness_mm = number(mm(thickness), scenarios.THICKNESS_MM, "--thickness in mm")
    return replace(scenario, thickness_mm=thickness_mm, wire=_wire(scenario.wire, *of_wire))


def _wire(wire: "Wire", diameter: float | None, gap: float | None, lag: float | None) -> "Wire":
    """The wire with the options, µm, in place of its own values."""
    from sim.wire import SPARK_GAP_MM, WIRE_DIAMETER_MM, WIRE_LAG_UM

    if diameter is not None:
        number(mm(diameter), WIRE_DIAMETER_MM, "--wire-diameter in mm")
        wire = replace(wire, diameter_um=diameter)
    if gap is not None:
        number(mm(gap), SPARK_GAP_MM, "--gap in mm")
        wire = replace(wire, spark_gap_um=gap)
    if lag is not None:
        wire = replace(wire, lag=number(lag, WIRE_LAG_UM, "--wire-lag in µm"))
    return wire


def _stepping_by(scenario: "Scenario", interpolator: str) -> "Scenario":
    """Scenario with another interpolator; counts and ends of steps that it expects of its own are not held to."""
    from sim.expect import not_of_steps

    if interpolator == scenario.machine.controller.interpolation:
        return scenario
    kept = not_of_steps(scenario.expect)
    left_out = ", ".join(e.path for e in scenario.expect if e not in kept)
    if left_out:
        click.echo(f"drycut: [expect]: not held, since another interpolator steps: {left_out}", err=True)
    return replace(scenario, machine=scenario.machine.stepping_by(interpolator), expect=kept)  # type: ignore[arg-type]


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
