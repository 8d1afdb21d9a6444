"""``drycut compare``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.cli.options import (
    Length,
    Offsets,
    OrRegister,
    offsets_of,
    setting_options,
    taken_settings,
    with_dialect,
    with_options,
)
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath
from sim.setup.part import DRAWING

if TYPE_CHECKING:
    from parser.dialect.reader import ChosenDialect
    from parser.program import Program
    from sim.setup.scenario import Scenario


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.argument("drawing", type=FilePath(path_type=Path), metavar="[DRAWING.dxf]", required=False)
@click.option(
    "--offset",
    type=OrRegister(Length()),
    multiple=True,
)
@with_dialect
@with_options(setting_options(DRAWING.keys))
@click.option("--json", "as_json", is_flag=True)
def compare(  # noqa: PLR0913 - click hands over each option by its name
    *,
    path: Path,
    offset: tuple[Any, ...],
    dialect: "ChosenDialect | None",
    unit: str | None,
    as_json: bool,
    drawing: Path | None,
    **options: Any,
) -> None:
    """Compare the edge that a program cuts with a drawing (DXF).

    \b
    drycut compare part.3b part.dxf --offset 0.1mm --tolerance 5um
    drycut compare part.3b part.dxf --layer CUT --json
    drycut compare scenarios/punch
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.drawing.read import read_drawing
    from sim.cli.scenario_options import drawing_target, of_options, read_with
    from sim.measure.compare.compare import compare_program
    from sim.measure.compare.result import FitRequest
    from sim.run.report.drawing import document_text
    from sim.setup.scenario import load_scenario
    from sim.show.terminal.compare import print_comparison
    from sim.show.terminal.printer import write

    given = _checked(offsets_of(offset))
    scenario = read_with(load_scenario(path), dialect, unit, given.registers)
    settings = of_options(DRAWING.keys, taken_settings(DRAWING.keys, options))
    target = drawing_target(scenario.drawing, drawing, None, settings)
    if target is None:
        raise click.MissingParameter(param_hint="DRAWING.dxf", param_type="argument")
    program = _program(scenario)
    offset_um, source = _offset(given.plain, program, scenario)
    drawn = read_drawing(target.file, layer=target.layer, gap_um=target.gap_um, unit=target.unit)
    request = FitRequest(target.tolerance_um, target.fit, target.sharp_corners)
    done = compare_program(program.toolpath, offset_um, drawn, request)
    if as_json:
        write(document_text(done), "json")
    else:
        print_comparison(done, program.name, program.toolpath.source.names, source, spoken())
    raise click.exceptions.Exit(0 if done.passes else 1)


def _checked(given: Offsets) -> Offsets:
    """The options, their plain length within its bounds. SettingsError else."""
    from parser.units import mm
    from sim.setup.part import OFFSET_MM
    from sim.setup.toml.reader import number

    number(mm(given.plain or 0.0), OFFSET_MM._replace(low=0.0), "--offset in mm")
    return given


def _program(scenario: "Scenario") -> "Program":
    """The program of a scenario, with the offset that its controller is to add; one that cannot be read is refused."""
    from parser.findings.errors import ProgramError
    from parser.program import moving
    from sim.check.travel import refuse_too_large
    from sim.cli.scenario_options import refused
    from sim.jobs.shop import program_read, source_of
    from sim.run.prepare import as_run_in

    try:
        program = moving(program_read(scenario, source_of(scenario)))
        refuse_too_large(program)
        return as_run_in(program, scenario)
    except ProgramError as error:
        raise refused(scenario, error) from None


def _offset(given: float | None, program: "Program", scenario: "Scenario") -> tuple[float, str]:
    """The offset in µm, and what it is for people; a header without one, or with 0, tells nothing.

    Nor does the header where the controller is to add an offset: the program is that of the drawing's contour.
    """
    from parser.units import mm

    if given is not None:
        return given, words()("compare.as-given", offset=f"{mm(given):g}")
    header_um = program.header.get("offset_um")
    if isinstance(header_um, float) and header_um and scenario.offset is None:
        offset_um = abs(header_um)
        return offset_um, words()("compare.of-header", offset=f"{mm(offset_um):g}")
    return scenario.wire.reach_um, words()("compare.of-wire", offset=f"{mm(scenario.wire.reach_um):g}")
